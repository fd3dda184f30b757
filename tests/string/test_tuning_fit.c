#include "core/string/tuning.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { MOST_MASSES = 1024, MOST_DENSE = 40 };

/* Bending, in units of k1, below which stiffness gives way only when all loss is gone. */
static const double FIRST_STOP = -0.125;

/* Far above the rounding of a radius, and the √ε of a double pole at −1. */
static const double RADIUS_MARGIN = 1e-6;

/* What 40 halvings of the way that a field gives leave undecided, and some rounding. */
static const double UNDECIDED = 1e-10;

/* What was solved for, read back from the coefficients. */
typedef struct {
  double bending; /* k2/k1 */
  double third;   /* k3/k1 */
  double loss;
} Given;

static double relative(double value, double truth) {
  return fabs(value - truth) / fabs(truth);
}

static StringCoefs solve(const TuningTarget* target, uint32_t n_masses) {
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(target, n_masses, &coefs), STATUS_OK);
  return coefs;
}

static Given given_of(StringCoefs coefs, uint32_t n_masses) {
  const double lambda1 = tuning_lambda(n_masses, 1);
  return (Given){
      .bending = coefs.k2 / coefs.k1,
      .third = coefs.k3 / coefs.k1,
      .loss = coefs.z1 * lambda1 / (coefs.z0 + coefs.z1 * lambda1),
  };
}

/* The string of the target with other bending, third and loss. */
static StringCoefs string_with(const TuningTarget* target, uint32_t n_masses, Given given) {
  TuningTarget flexible = *target;
  flexible.loss = given.loss;
  flexible.inharmonicity = 0.0;
  flexible.partials = PARTIALS_LUMPED;
  StringCoefs coefs = solve(&flexible, n_masses);
  const double lambda1 = tuning_lambda(n_masses, 1);
  coefs.k1 /= 1.0 + given.bending * lambda1 + given.third * lambda1 * lambda1;
  coefs.k2 = given.bending * coefs.k1;
  coefs.k3 = given.third * coefs.k1;
  return coefs;
}

/* Whether nothing on the straight way from `given` to `wanted` is safe, but where it begins. */
static bool
is_nothing_safe_between(const TuningTarget* target, uint32_t n_masses, Given given, Given wanted) {
  for (int step = 0; step <= 72; ++step) {
    const double share = pow(1.25, -step);
    const Given between = {
        given.bending + share * (wanted.bending - given.bending),
        given.third + share * (wanted.third - given.third),
        given.loss + share * (wanted.loss - given.loss),
    };
    const StringCoefs coefs = string_with(target, n_masses, between);
    /* Down to the first stop, mode by mode; below it the bound is what the fit goes by. */
    const double headroom = between.bending < FIRST_STOP - UNDECIDED
                                ? tuning_headroom(coefs, n_masses)
                                : oracle_headroom(coefs, n_masses);
    if (headroom >= TUNING_MARGIN + UNDECIDED) {
      return false;
    }
  }
  return true;
}

/* A note that has all the masses it can hold. */
static TuningTarget random_note(Random* random, uint32_t* n_masses) {
  TuningTarget target = {
      .rate_hz = 48000.0,
      .tone = {random_log_between(random, 27.5, 6000.0), random_log_between(random, 0.003, 30.0)},
      .loss = random_below(random, 3) ? random_between(random, 0.0, 1.0) : 0.0,
      .inharmonicity = random_below(random, 3) ? random_log_between(random, 1e-6, 1e-2) : 0.0,
      .partials = (Partials)random_below(random, 3),
  };
  *n_masses = tuning_max_masses(&target, MOST_MASSES);
  assert_true(*n_masses > 0);
  return target;
}

static void bent_string_keeps_pitch_and_decay_and_is_stable(void** state) {
  (void)state;
  double worst = 0.0;
  double lowest = HUGE_VAL;
  int n_dense = 0;
  Random random = random_start();
  for (int trial = 0; trial < 4000; ++trial) {
    uint32_t n_masses = 0;
    TuningTarget target = random_note(&random, &n_masses);
    target.tone.f0_hz *= exp2(random_between(&random, -12.0, 7.0) / 12.0);
    StringCoefs coefs = {0};
    assert_int_equal(tuning_fit(&target, n_masses, &coefs), STATUS_OK);
    const Tone tone = pole_tone(target.rate_hz, tuning_mode(coefs, n_masses, 1));
    worst = fmax(worst, fmax(relative(tone.f0_hz, target.tone.f0_hz),
                             relative(tone.tau_s, target.tone.tau_s)));
    lowest = fmin(lowest, oracle_headroom(coefs, n_masses));
    if (n_masses <= MOST_DENSE && trial % 4 == 0) {
      assert_true(oracle_spectral_radius(coefs, n_masses) <= 1.0 + RADIUS_MARGIN);
      ++n_dense;
    }
  }
  assert_within("F and τ, relative", worst, 1e-12);
  assert_within("margin less the lowest headroom", TUNING_MARGIN - lowest, 16.0 * DBL_EPSILON);
  assert_true(n_dense > 300);
}

static void string_that_is_safe_gives_nothing_way(void** state) {
  (void)state;
  int n_safe = 0;
  Random random = random_start();
  for (int trial = 0; trial < 4000; ++trial) {
    uint32_t n_masses = 0;
    TuningTarget target = random_note(&random, &n_masses);
    target.tone.f0_hz *= exp2(random_between(&random, -12.0, 1.0) / 12.0);
    const StringCoefs wanted = solve(&target, n_masses);
    if (oracle_headroom(wanted, n_masses) >= TUNING_MARGIN) {
      StringCoefs coefs = {0};
      assert_int_equal(tuning_fit(&target, n_masses, &coefs), STATUS_OK);
      assert_memory_equal(&coefs, &wanted, sizeof(coefs));
      ++n_safe;
    }
  }
  assert_true(n_safe > 1000);
}

static void string_gives_way_as_little_as_it_must(void** state) {
  (void)state;
  enum { BENDING, LOSS, BENDING_AGAIN, N_KINDS };
  int n_given[N_KINDS] = {0};
  Random random = random_start();
  for (int trial = 0; trial < 4000; ++trial) {
    uint32_t n_masses = 0;
    TuningTarget target = random_note(&random, &n_masses);
    target.tone.f0_hz *= exp2(random_between(&random, 0.0, 10.0) / 12.0);
    const StringCoefs whole = solve(&target, n_masses);
    StringCoefs coefs = {0};
    if (oracle_headroom(whole, n_masses) >= TUNING_MARGIN ||
        tuning_fit(&target, n_masses, &coefs)) {
      continue;
    }
    const Given wanted = given_of(whole, n_masses);
    const Given given = given_of(coefs, n_masses);
    if (given.loss > wanted.loss - UNDECIDED && given.bending > FIRST_STOP - UNDECIDED) {
      /* In a straight line, third with bending. */
      const double share = (given.bending - FIRST_STOP) / (wanted.bending - FIRST_STOP);
      assert_true(fabs(given.third - share * wanted.third) < UNDECIDED);
      assert_true(is_nothing_safe_between(&target, n_masses, given, wanted));
      ++n_given[BENDING];
    } else {
      const Given stop = {FIRST_STOP, 0.0, wanted.loss};
      assert_true(given.third == 0.0);
      assert_true(is_nothing_safe_between(&target, n_masses, stop, wanted));
      const bool is_again = given.bending < FIRST_STOP - UNDECIDED;
      const Given lossless = {FIRST_STOP, 0.0, 0.0};
      assert_true(fabs(is_again ? given.loss : given.bending - FIRST_STOP) < UNDECIDED);
      assert_true(is_nothing_safe_between(&target, n_masses, given, is_again ? lossless : stop));
      ++n_given[is_again ? BENDING_AGAIN : LOSS];
    }
  }
  print_message("  stiffness gave way %d times, then loss %d, then stiffness %d\n",
                n_given[BENDING], n_given[LOSS], n_given[BENDING_AGAIN]);
  assert_true(n_given[BENDING] > 300 && n_given[LOSS] > 50 && n_given[BENDING_AGAIN] > 300);
}

static StringCoefs between(StringCoefs from, StringCoefs to, double share) {
  return (StringCoefs){
      .k1 = from.k1 + share * (to.k1 - from.k1),
      .k2 = from.k2 + share * (to.k2 - from.k2),
      .z0 = from.z0 + share * (to.z0 - from.z0),
      .z1 = from.z1 + share * (to.z1 - from.z1),
      .k3 = from.k3 + share * (to.k3 - from.k3),
  };
}

/* So is what glides in a straight line from one to the other. */
static void headroom_between_two_strings_is_no_less_than_theirs(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 4000; ++trial) {
    uint32_t n_masses = 0;
    StringCoefs ends[2];
    TuningTarget target = random_note(&random, &n_masses);
    const double f0_hz = target.tone.f0_hz;
    for (int end = 0; end < 2; ++end) {
      target.tone.f0_hz = f0_hz * exp2(random_between(&random, -12.0, 7.0) / 12.0);
      target.partials = (Partials)random_below(&random, 3);
      assert_int_equal(tuning_fit(&target, n_masses, &ends[end]), STATUS_OK);
    }
    const double least =
        fmin(tuning_headroom(ends[0], n_masses), tuning_headroom(ends[1], n_masses));
    for (int step = 1; step < 8; ++step) {
      const StringCoefs coefs = between(ends[0], ends[1], 0.125 * step);
      assert_true(tuning_headroom(coefs, n_masses) >= least - 64.0 * DBL_EPSILON);
    }
  }
}

static void true_partials_cost_none_of_the_reach(void** state) {
  (void)state;
  int n_out_of_reach = 0;
  Random random = random_start();
  for (int trial = 0; trial < 20000; ++trial) {
    uint32_t n_masses = 0;
    TuningTarget target = random_note(&random, &n_masses);
    target.tone.f0_hz = fmin(target.tone.f0_hz * exp2(random_between(&random, 0.0, 1.5)), 23e3);
    /* Down to a few samples, where damping alone carries the string past its limit. */
    target.tone.tau_s = trial % 2 ? random_log_between(&random, 5e-5, 3e-3) : target.tone.tau_s;
    target.partials = PARTIALS_LUMPED;
    StringCoefs coefs = {0};
    const Status lumped = tuning_fit(&target, n_masses, &coefs);
    n_out_of_reach += lumped == STATUS_UNSTABLE;
    target.partials = PARTIALS_TRUE;
    assert_int_equal(tuning_fit(&target, n_masses, &coefs), lumped);
    target.partials = PARTIALS_TRUEST;
    assert_int_equal(tuning_fit(&target, n_masses, &coefs), lumped);
  }
  print_message("  %d of 20000 out of reach\n", n_out_of_reach);
  assert_true(n_out_of_reach > 2000);
}

static void octave_is_as_far_as_it_goes(void** state) {
  (void)state;
  for (uint32_t n_masses = 20; n_masses <= 500; n_masses += 20) {
    const double f_hz = sqrt(1.0 - TUNING_MARGIN) * 24000.0 / (n_masses + 1.5);
    TuningTarget target = {.rate_hz = 48000.0, .tone = {f_hz, HUGE_VAL}};
    assert_int_equal(tuning_max_masses(&target, MOST_MASSES), n_masses);
    const double f0_hz = target.tone.f0_hz;
    StringCoefs coefs = {1.0, 2.0, 3.0, 4.0, 5.0};
    target.tone.f0_hz = f0_hz * exp2(13.0 / 12.0);
    assert_int_equal(tuning_fit(&target, n_masses, &coefs), STATUS_UNSTABLE);
    assert_true(coefs.k1 == 1.0 && coefs.k2 == 2.0 && coefs.z0 == 3.0 && coefs.z1 == 4.0);
    assert_true(coefs.k3 == 5.0);
    target.tone.f0_hz = f0_hz * exp2(11.0 / 12.0);
    assert_int_equal(tuning_fit(&target, n_masses, &coefs), STATUS_OK);
    assert_true(oracle_headroom(coefs, n_masses) >= TUNING_MARGIN - 16.0 * DBL_EPSILON);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bent_string_keeps_pitch_and_decay_and_is_stable),
      cmocka_unit_test(string_that_is_safe_gives_nothing_way),
      cmocka_unit_test(string_gives_way_as_little_as_it_must),
      cmocka_unit_test(headroom_between_two_strings_is_no_less_than_theirs),
      cmocka_unit_test(true_partials_cost_none_of_the_reach),
      cmocka_unit_test(octave_is_as_far_as_it_goes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
