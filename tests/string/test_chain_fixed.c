#include "core/string/chain_fixed.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* Some motion. */
static const ChainSums some = {1.0, 0.0, 0.1, 0.1, 0.1, 0.1};

static StringCoefs random_string(Random* random, uint32_t* n) {
  const TuningTarget target = {
      .rate_hz = random_between(random, 8000.0, 192000.0),
      .tone = {random_log_between(random, 20.0, 2000.0), random_log_between(random, 0.1, 100.0)},
      .loss = random_below(random, 4) ? random_between(random, 0.0, 1.0) : 0.0,
      .inharmonicity = random_below(random, 2) ? random_log_between(random, 1e-6, 1e-2) : 0.0,
      .partials = (Partials)random_below(random, 3),
  };
  StringCoefs coefs = {0};
  *n = tuning_max_masses(&target, 1 + random_below(random, 200));
  assert_int_equal(tuning_solve(&target, *n, &coefs), STATUS_OK);
  return coefs;
}

/* What the modes of X would be if the whole of the air could be left out; long, for a is small. */
static long double ideal_a(Pole pole, double z0) {
  const long double rho = sqrtl(1.0L - (long double)z0);
  const long double g = 1.0L - (1.0L - (long double)pole.g) / (rho * rho);
  return 2.0L - g - (2.0L - (long double)pole.a - (long double)pole.g) / rho;
}

static double cents(Pole pole, Pole truth) {
  return fabs(1200.0 * log2(pole_angle(pole) / pole_angle(truth)));
}

/* The worst of many strings. */
typedef struct {
  double first_angle;
  double radius;
  double shift;
  double partial_cents; /* Of those that ring, below half of Nyquist */
} Worst;

static void check_modes(StringCoefs coefs, const ChainFixed* whole, uint32_t n, Worst* worst) {
  for (uint32_t k = 1; k <= n; ++k) {
    const Pole truth = tuning_mode(coefs, n, k);
    const Pole pole = tuning_mode(whole->coefs, n, k);
    if (pole_is_complex(truth) && pole_is_complex(pole)) {
      const double shift = fabs(pole.a - (double)ideal_a(truth, coefs.z0)) / pole.a;
      const bool is_heard = truth.a < 2.0 && truth.g < 0.1 * sqrt(truth.a);
      const double radius = whole->fade * pole_radius(pole) / pole_radius(truth) - 1.0;
      worst->radius = fmax(worst->radius, fabs(radius));
      worst->shift = fmax(worst->shift, shift);
      worst->partial_cents = fmax(worst->partial_cents, is_heard ? cents(pole, truth) : 0.0);
      if (k == 1) {
        const double off = fabs(pole_angle(pole) - pole_angle(truth));
        worst->first_angle = fmax(worst->first_angle, off);
      }
    }
  }
}

static void modes_without_air_are_the_same(void** state) {
  (void)state;
  Random random = random_start();
  Worst worst = {0};
  double worst_a = 0.0;
  uint32_t n_taken = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    uint32_t n = 0;
    ChainFixed whole;
    const StringCoefs coefs = random_string(&random, &n);
    if (chain_fixed_design(coefs, n, some, &whole)) {
      const Pole first = tuning_mode(coefs, n, 1);
      const Pole pole = tuning_mode(whole.coefs, n, 1);
      assert_true(fabs(whole.fade * whole.fade - (1.0 - coefs.z0)) < 1e-15);
      assert_true(whole.coefs.z0 == 0.0);
      assert_true((whole.coefs.k3 == 0.0) == (coefs.k3 == 0.0));
      assert_true((whole.coefs.k2 == 0.0) == (coefs.k2 == 0.0));
      assert_true(whole.gain > 0.0 && whole.noise > 0.0);
      worst_a = fmax(worst_a, fabs(pole.a - (double)ideal_a(first, coefs.z0)));
      check_modes(coefs, &whole, n, &worst);
      ++n_taken;
    }
  }
  print_message("  %u of 20000 strings\n", n_taken);
  assert_true(n_taken > 10000);
  /* A frequency moves by half as much as its a, and at half of Nyquist by 4/π of that. */
  /* Differences of numbers near 2; an angle is a/(2 sin) of them, down to 7e-4. */
  assert_within("a of the fundamental", worst_a, 2e-15);
  assert_within("angle of the fundamental", worst.first_angle, 1e-12);
  assert_within("radius of all modes, relative", worst.radius, 1e-13);
  assert_within("a of all modes, relative", worst.shift, 1.2e-5);
  assert_within("partials, cents", worst.partial_cents, 0.0127);
}

/* It gives up where that would be heard, but not before: a string with half as much air as shifts
 * its partials by a hundredth of a cent is taken, and with twice as much it is not. */
static void air_is_left_out_until_it_is_heard(void** state) {
  (void)state;
  for (uint32_t n = 2; n <= 200; n = 2 * n + 1) {
    for (int exponent = -3; exponent <= 0; ++exponent) {
      const double k1 = 0.9 * pow(10.0, exponent);
      const double a1 = k1 * tuning_lambda(n, 1);
      /* The fundamental is (z0/2)² sharper than X without that share, and the others are not. */
      const double heard = 2.0 * sqrt(2.0 * 0.01 / 1200.0 * log(2.0) * a1);
      StringCoefs coefs = {.k1 = k1, .z0 = 0.5 * heard};
      ChainFixed whole;
      assert_true(chain_fixed_design(coefs, n, some, &whole));
      coefs.z0 = 2.0 * heard;
      assert_false(chain_fixed_design(coefs, n, some, &whole));
    }
  }
}

static void what_cannot_be_had_is_refused(void** state) {
  (void)state;
  static const StringCoefs good = {.k1 = 0.5, .k2 = 0.01, .z0 = 1e-6};
  ChainSums sums[] = {{0}, some, some};
  const StringCoefs bad[] = {
      {.k1 = 0.5},
      {.k1 = 0.5, .z0 = 0.1},
      {.k1 = 0.5, .k2 = -0.115, .z0 = 1e-6},
      {.k1 = 0.5, .k2 = -0.2, .z0 = 1e-6},
      {.k1 = 0.5, .k3 = -0.029, .z0 = 1e-6},
      {.k1 = 0.5, .k2 = -0.06, .k3 = -0.015, .z0 = 1e-6},
      {.k1 = 1.01, .z0 = 1e-6},
      {.k1 = (double)NAN, .z0 = 1e-6},
      {.k1 = 0.5, .z0 = (double)NAN},
  };
  ChainFixed whole;
  ChainFixed before;
  memset(&whole, 0x5A, sizeof(whole));
  before = whole;
  sums[1] =
      (ChainSums){(double)NAN, (double)NAN, (double)NAN, (double)NAN, (double)NAN, (double)NAN};
  sums[2].slope = HUGE_VAL;
  for (size_t s = 0; s < sizeof(sums) / sizeof(sums[0]); ++s) {
    assert_false(chain_fixed_design(good, 20, sums[s], &whole));
  }
  for (size_t b = 0; b < sizeof(bad) / sizeof(bad[0]); ++b) {
    assert_false(chain_fixed_design(bad[b], 20, some, &whole));
  }
  assert_memory_equal(&whole, &before, sizeof(whole));
  assert_true(chain_fixed_design(good, 20, some, &whole));
  assert_true(
      chain_fixed_design((StringCoefs){.k1 = 0.5, .k2 = -0.11, .z0 = 1e-6}, 20, some, &whole));
}

/* A link errs by its dither and its rounding, 0.41 of a number, and by 0.41 of its last place,
 * which is most of it on a short string; that many, at random, in the time in which a mode forgets.
 */
static void noise_is_that_of_dither_and_last_places(void** state) {
  (void)state;
  double most_places = 0.0;
  for (uint32_t n = 1; n <= 300; n = 1 + 2 * n) {
    const StringCoefs coefs = {.k1 = 0.7, .z0 = 1e-6};
    const double length = n + 1.0;
    const double a1 = 0.7 * tuning_lambda(n, 1);
    /* The fundamental alone, of size 1, at its largest. */
    const ChainSums sums = {.xx = 0.5 * length, .slope = 0.5 * length * a1 / 0.7};
    ChainFixed whole;
    assert_true(chain_fixed_design(coefs, n, sums, &whole));
    const double place = ldexp(0.7 * sqrt(0.5 * a1 / 0.7), -24);
    const double error = 0.41 * sqrt(whole.gain * whole.gain + place * place);
    const double noise = error * sqrt(2.0 / (length * 0.7 * 1e-6));
    assert_true(fabs(whole.noise / noise - 1.0) < 1e-3);
    most_places = fmax(most_places, place / whole.gain);
  }
  assert_true(most_places > 3.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(modes_without_air_are_the_same),
      cmocka_unit_test(air_is_left_out_until_it_is_heard),
      cmocka_unit_test(noise_is_that_of_dither_and_last_places),
      cmocka_unit_test(what_cannot_be_had_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
