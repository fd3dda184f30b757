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

enum { MOST_MASSES = 1024, MOST_DENSE = 110 };

/* Far above the rounding of a radius, and the √ε of a double pole at −1; far below what is seen of
 * a string that is `NEAREST` past its limit. */
static const double RADIUS_MARGIN = 1e-6;
static const double NEAREST = 1e-5;

/* Rounding of a radius where all poles are damped and none is double. */
static const double ON_CIRCLE = 1e-10;

static StringCoefs solve(const TuningTarget* target, uint32_t n_masses) {
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(target, n_masses, &coefs), STATUS_OK);
  return coefs;
}

/* The largest of 1 to `limit` masses that all keep `margin`, mode by mode, one number after
 * another; one mass need only keep `last_margin`. */
static uint32_t
most_masses(const TuningTarget* target, uint32_t limit, double margin, double last_margin) {
  uint32_t n_masses = 0;
  while (n_masses < limit && oracle_headroom(solve(target, n_masses + 1), n_masses + 1) >=
                                 (n_masses == 0 ? last_margin : margin)) {
    ++n_masses;
  }
  return n_masses;
}

static double radius_of(const TuningTarget* target, uint32_t n_masses) {
  return oracle_spectral_radius(solve(target, n_masses), n_masses);
}

static void largest_strings_are_those_of_the_table(void** state) {
  (void)state;
  static const struct {
    double loss;
    double inharmonicity;
    uint32_t n_masses[9]; /* From A0 to A8 */
  } rows[] = {
      {0.01, 0.0, {844, 431, 216, 108, 53, 26, 12, 5, 2}},
      {0.01, 1e-4, {351, 238, 154, 92, 50, 25, 12, 5, 2}},
      {0.01, 1e-2, {115, 81, 56, 39, 26, 17, 10, 5, 2}},
      {1.0, 0.0, {319, 269, 183, 103, 52, 26, 12, 5, 2}},
  };
  for (size_t row = 0; row < 4; ++row) {
    for (uint32_t octave = 0; octave < 9; ++octave) {
      const TuningTarget target = {
          .rate_hz = 48000.0,
          .tone = {27.5 * exp2(octave), 1.0},
          .loss = rows[row].loss,
          .inharmonicity = rows[row].inharmonicity,
      };
      const uint32_t truth = most_masses(&target, MOST_MASSES, 0.0, 0.0);
      const uint32_t found = tuning_max_masses(&target, MOST_MASSES);
      assert_int_equal(truth, rows[row].n_masses[octave]);
      assert_int_equal(found, tuning_max_masses(&target, UINT32_MAX));
      assert_int_equal(found, most_masses(&target, MOST_MASSES, TUNING_MARGIN, TUNING_LAST_MARGIN));
      /* The top of a flexible string goes with the square of its masses, of others higher. */
      assert_true(found <= truth && found + 2.0 >= sqrt(1.0 - TUNING_MARGIN) * (truth + 1.0));
      if (truth < MOST_DENSE) {
        assert_true(radius_of(&target, truth) <= 1.0 + ON_CIRCLE);
        assert_true(radius_of(&target, truth + 1) > 1.0 + ON_CIRCLE);
      }
    }
  }
}

static TuningTarget random_target(Random* random) {
  return (TuningTarget){
      .rate_hz = 48000.0,
      .tone = {random_log_between(random, 20.0, 25000.0), random_log_between(random, 1e-3, 1e2)},
      .loss = random_between(random, 0.0, 1.0),
      .inharmonicity = random_below(random, 2) ? random_log_between(random, 1e-6, 0.1) : 0.0,
      .partials = (Partials)random_below(random, 3),
  };
}

static void bisection_finds_what_counting_finds(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 3000; ++trial) {
    const TuningTarget target = random_target(&random);
    const uint32_t limit = random_below(&random, 200);
    const bool has_pitch = target.tone.f0_hz < 0.5 * target.rate_hz;
    assert_int_equal(tuning_max_masses(&target, limit),
                     has_pitch ? most_masses(&target, limit, TUNING_MARGIN, TUNING_LAST_MARGIN)
                               : 0);
  }
}

static void more_masses_have_less_headroom(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 300; ++trial) {
    TuningTarget target = random_target(&random);
    target.tone.f0_hz = fmin(target.tone.f0_hz, 23000.0);
    double before = HUGE_VAL;
    for (uint32_t n = 1; n <= MOST_MASSES; ++n) {
      const double headroom = tuning_headroom(solve(&target, n), n);
      assert_true(headroom < before);
      before = headroom;
    }
  }
}

static void note_close_below_nyquist_has_one_mass_and_above_none(void** state) {
  (void)state;
  TuningTarget target = {.rate_hz = 48000.0, .tone = {0.99 * 24000.0, HUGE_VAL}};
  assert_int_equal(tuning_max_masses(&target, MOST_MASSES), 1);
  target.tone.f0_hz = 0.9999 * 24000.0;
  assert_int_equal(tuning_max_masses(&target, MOST_MASSES), 0);
  target.tone.f0_hz = 24000.0;
  assert_int_equal(tuning_max_masses(&target, MOST_MASSES), 0);
}

/* Any coefficients whose heaviest mode has a + 2g = 4 (1 + off). */
static StringCoefs near_limit(Random* random, uint32_t n_masses, bool is_negative, double off) {
  const double b =
      is_negative ? -random_between(random, 0.0, 0.24) : random_between(random, 0.0, 2.0);
  const double d =
      random_below(random, 3) ? random_between(random, 0.0, is_negative ? 0.05 : 2.0) : 0.0;
  const double damping = random_below(random, 4) ? random_between(random, 0.0, 1.5) : 0.0;
  const double share = random_between(random, 0.0, 1.0);
  StringCoefs coefs = {1.0, b, damping * share, damping * (1.0 - share), d};
  const double load = 1.0 - oracle_headroom(coefs, n_masses);
  const double scale = (1.0 + off) / load;
  return (StringCoefs){coefs.k1 * scale, coefs.k2 * scale, coefs.z0 * scale, coefs.z1 * scale,
                       coefs.k3 * scale};
}

static void headroom_is_what_the_dense_matrix_says(void** state) {
  (void)state;
  double worst = 0.0;
  int n_stable = 0;
  enum { TRIALS = 2000 };
  Random random = random_start();
  for (int trial = 0; trial < TRIALS; ++trial) {
    const uint32_t n_masses = 1 + random_below(&random, 24);
    const double side = trial % 2 ? 1.0 : -1.0;
    const double off = side * random_log_between(&random, NEAREST, 0.5);
    const StringCoefs coefs = near_limit(&random, n_masses, false, off);
    const double headroom = tuning_headroom(coefs, n_masses);
    const bool is_stable = oracle_spectral_radius(coefs, n_masses) <= 1.0 + RADIUS_MARGIN;
    worst = fmax(worst, fabs(headroom - oracle_headroom(coefs, n_masses)));
    assert_int_equal(headroom >= 0.0, is_stable);
    assert_int_equal(is_stable, off < 0.0);
    n_stable += is_stable;
  }
  assert_int_equal(n_stable, TRIALS / 2);
  assert_within("headroom, from the smallest mode by mode", worst, 16.0 * DBL_EPSILON);
}

static void headroom_with_negative_bending_is_never_too_high(void** state) {
  (void)state;
  int n_safe = 0;
  Random random = random_start();
  for (int trial = 0; trial < 2000; ++trial) {
    const uint32_t n_masses = 1 + random_below(&random, 24);
    const double side = trial % 2 ? 1.0 : -1.0;
    const double off = side * random_log_between(&random, NEAREST, 0.5);
    const StringCoefs coefs = near_limit(&random, n_masses, true, off);
    const double headroom = tuning_headroom(coefs, n_masses);
    assert_true(headroom <= oracle_headroom(coefs, n_masses) + 16.0 * DBL_EPSILON);
    if (headroom >= 0.0) {
      assert_true(oracle_spectral_radius(coefs, n_masses) <= 1.0 + RADIUS_MARGIN);
      ++n_safe;
    }
  }
  print_message("  %d judged safe\n", n_safe);
  assert_true(n_safe > 500);
}

/* Of a string so long that its modes are all of the interval from 0 to 4, whatever k2 and k3. */
static void headroom_is_that_of_the_whole_cubic(void** state) {
  (void)state;
  enum { TRIALS = 4000, N = 1000 };
  int n_heaviest_within = 0;
  int n_not_pulled_back = 0;
  int n_mistaken = 0;
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < TRIALS; ++trial) {
    const StringCoefs coefs = {
        .k1 = 1.0,
        .k2 = random_between(&random, -1.5, 1.0),
        .z0 = random_between(&random, 0.0, 0.2),
        .z1 = random_below(&random, 2) ? random_between(&random, 0.0, 0.2) : 0.0,
        .k3 = random_below(&random, 8) ? random_between(&random, -0.2, 0.4) : 0.0,
    };
    const double truth = oracle_headroom(coefs, N);
    const double found = tuning_headroom(coefs, N);
    const Pole last = tuning_mode(coefs, N, N);
    assert_true(found <= truth + 64.0 * DBL_EPSILON);
    if (isfinite(found)) {
      worst = fmax(worst, truth - found);
      n_heaviest_within += 1.0 - 0.25 * (last.a + 2.0 * last.g) > truth + 1e-3;
    }
    n_mistaken += isfinite(found) != isfinite(truth);
    n_not_pulled_back += !isfinite(found) && last.a > 0.0;
  }
  print_message("  heaviest before the last mode %d times, not pulled back there %d times\n",
                n_heaviest_within, n_not_pulled_back);
  assert_true(n_heaviest_within > 100 && n_not_pulled_back > 100);
  /* Where the bottom is nought but for a part in a million, modes may stand on both sides of it. */
  assert_true(n_mistaken <= 2);
  /* A mode is at most π/N off the peak, where the load's second derivative is at most 8. */
  assert_within("headroom below that of the modes", worst, 1e-5);
}

static void string_that_is_not_pulled_back_has_no_headroom(void** state) {
  (void)state;
  for (uint32_t n = 2; n <= 40; ++n) {
    const double lambda = tuning_lambda(n, n);
    const StringCoefs coefs = {.k1 = 0.5, .k2 = -0.5 * 1.001 / lambda};
    assert_true(tuning_headroom(coefs, n) == -HUGE_VAL);
    assert_true(oracle_spectral_radius(coefs, n) > 1.0 + RADIUS_MARGIN);
  }
}

static void paper_strings_that_explode_are_known(void** state) {
  (void)state;
  const TuningTarget a0 = {.rate_hz = 48000.0, .tone = {27.5, 5.0}, .loss = 1.0};
  const double load = 4.0 * (1.0 - tuning_headroom(solve(&a0, 870), 870));
  assert_within("870 masses at A0: a + 2g from 9.1", fabs(load - 9.1), 0.05);
  TuningTarget high_e = {.rate_hz = 48000.0, .tone = {329.6, 5.0}, .loss = 1.0};
  assert_true(tuning_headroom(solve(&high_e, 80), 80) < 0.0);
  assert_int_equal(most_masses(&high_e, MOST_MASSES, 0.0, 0.0), 71);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(largest_strings_are_those_of_the_table),
      cmocka_unit_test(bisection_finds_what_counting_finds),
      cmocka_unit_test(more_masses_have_less_headroom),
      cmocka_unit_test(note_close_below_nyquist_has_one_mass_and_above_none),
      cmocka_unit_test(headroom_is_what_the_dense_matrix_says),
      cmocka_unit_test(headroom_with_negative_bending_is_never_too_high),
      cmocka_unit_test(headroom_is_that_of_the_whole_cubic),
      cmocka_unit_test(string_that_is_not_pulled_back_has_no_headroom),
      cmocka_unit_test(paper_strings_that_explode_are_known),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
