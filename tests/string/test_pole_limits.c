#include "core/string/pole.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static Pole solve(double rate_hz, double f0_hz, double tau_s) {
  Pole pole = {0};
  assert_int_equal(pole_solve(rate_hz, (Tone){f0_hz, tau_s}, &pole), STATUS_OK);
  return pole;
}

static double relative(double value, double truth) {
  return fabs(value - truth) / fabs(truth);
}

static void slip_3_would_allow_steps_that_explode(void** state) {
  (void)state;
  const double omega0 = 2.0 * PI * 125.0;
  const double gamma = 50.0;
  const double printed = gamma + sqrt(gamma * gamma + 4.0 / (omega0 * omega0));
  const double corrected = pole_largest_step_s(omega0, gamma);
  assert_within(
      "corrected, relative",
      relative(corrected, (-gamma + sqrt(gamma * gamma + 4.0 * omega0 * omega0)) / omega0 / omega0),
      8.0 * DBL_EPSILON);
  assert_true(printed > 1e4 * corrected);
  assert_int_equal(pole_region(pole_from_analog(1.0 / printed, omega0, gamma)), POLE_UNSTABLE);
}

static void largest_step_brackets_stability(void** state) {
  (void)state;
  Random random = random_start();
  const double around = 1e-6;
  for (int n = 0; n < 5000; ++n) {
    const double omega0 = random_log_between(&random, 1.0, 1e5);
    const double gamma = n % 10 == 0 ? 0.0 : omega0 * random_log_between(&random, 1e-3, 1e3);
    const double h = pole_largest_step_s(omega0, gamma);
    for (int side = -1; side <= 1; side += 2) {
      const Pole pole = pole_from_analog(1.0 / (h * (1.0 + side * around)), omega0, gamma);
      double complex z[2];
      oracle_mass_poles(pole.a, pole.g, z);
      assert_int_equal(pole_is_stable(pole), side < 0);
      /* Beyond the border the radius is above 1 by at least half of `around`. */
      assert_int_equal(fmax(cabs(z[0]), cabs(z[1])) <= 1.0 + 0.1 * around, side < 0);
    }
  }
}

/* The larger root of the characteristic polynomial, in extended precision where there is any. */
static long double spectral_radius(Pole pole) {
  const long double a = (long double)pole.a;
  const long double g = (long double)pole.g;
  const long double half = 0.5L * (a + g - 2.0L);
  const long double square = half * half - (1.0L - g);
  return square < 0.0L ? sqrtl(1.0L - g) : fabsl(half) + sqrtl(square);
}

static void verdict_is_the_spectral_radius(void** state) {
  (void)state;
  enum { TRIALS = 200000 };
  /* What a verdict in double can be wrong by: the rounding of a + 2g, up to 8. */
  const long double margin = 1e-14L;
  int n_judged = 0;
  int n_stable = 0;
  Random random = random_start();
  for (int n = 0; n < TRIALS; ++n) {
    const double side = random_below(&random, 2) ? 1.0 : -1.0;
    const double off = side * random_log_between(&random, 1e-13, 1.0);
    Pole pole = {random_between(&random, -1.0, 6.0), random_between(&random, -1.0, 3.0)};
    switch (n % 5) {
    case 1:
      pole.a = 4.0 - 2.0 * pole.g + off;
      break;
    case 2:
      pole.a = off;
      break;
    case 3:
      pole.g = off;
      break;
    case 4:
      pole.g = 2.0 + off;
      break;
    default:
      break;
    }
    const long double radius = spectral_radius(pole);
    if (fabsl(radius - 1.0L) > margin) {
      assert_int_equal(pole_is_stable(pole), radius < 1.0L);
      assert_int_equal(pole_region(pole) != POLE_UNSTABLE, radius < 1.0L);
      ++n_judged;
      n_stable += radius < 1.0L;
    }
  }
  print_message("  %d judged, %d of them stable\n", n_judged, n_stable);
  assert_true(n_judged > 100000 && n_stable > 20000 && n_judged - n_stable > 20000);
}

static void borders_belong_to_the_stable(void** state) {
  (void)state;
  for (int step = 0; step <= 32; ++step) {
    const double a = 0.125 * step;
    assert_true(pole_is_stable((Pole){a, 0.0}));
    assert_true(pole_is_stable((Pole){a, 0.5 * (4.0 - a)}) == (a > 0.0));
  }
  assert_false(pole_is_stable((Pole){(double)NAN, 0.1}));
  assert_false(pole_is_stable((Pole){1.0, (double)NAN}));
  assert_false(pole_is_stable((Pole){HUGE_VAL, 0.1}));
}

/* The mass whose eigenvalue is (σ ± jμ), times h. */
static Pole at(double sigma_h, double mu_h) {
  return pole_from_analog(1.0, sqrt(sigma_h * sigma_h + mu_h * mu_h), -2.0 * sigma_h);
}

static bool creeps_not(Pole pole) {
  return pole_is_complex(pole);
}

static bool turns_under_half_pi(Pole pole) {
  return pole_angle(pole) < 0.5 * PI;
}

/* σh between `high` and `low` where what holds at `high` ceases. */
static double corner(bool (*holds)(Pole), double mu_h, double high, double low) {
  assert_true(holds(at(high, mu_h)) && !holds(at(low, mu_h)));
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (high + low);
    *(holds(at(middle, mu_h)) ? &high : &low) = middle;
  }
  return high;
}

static void corners_of_section_3_7_are_where_they_should_be(void** state) {
  (void)state;
  const double half_digit = 0.5e-4;
  assert_within("0.1: ceases to vibrate", fabs(corner(creeps_not, 0.1, -0.01, -0.5) + 0.1954),
                half_digit);
  assert_within("0.1: begins to flip", fabs(corner(turns_under_half_pi, 0.1, -0.5, -0.8) + 0.7292),
                half_digit);
  assert_within("0.8: ceases to vibrate", fabs(corner(creeps_not, 0.8, -0.01, -0.52) + 0.4983),
                half_digit);
  assert_within("0.8: begins to flip", fabs(corner(turns_under_half_pi, 0.8, -0.52, -0.6) + 0.5362),
                half_digit);
  assert_within("0.87: turns past π/2",
                fabs(corner(turns_under_half_pi, 0.87, -0.01, -0.499) + 0.4977), half_digit);
  assert_int_equal(pole_region(at(-0.5, 0.1)), POLE_REAL_AT_ZERO);
  assert_int_equal(pole_region(at(-0.8, 0.1)), POLE_REAL_AT_PI);
  assert_int_equal(pole_region(at(-0.01, 0.1)), POLE_COMPLEX);
  assert_int_equal(pole_region(at(-1.5, 0.1)), POLE_UNSTABLE);
}

static void angle_passes_half_pi_without_a_jump(void** state) {
  (void)state;
  const double before = pole_angle(at(-0.49769, 0.87));
  const double past = pole_angle(at(-0.49771, 0.87));
  /* The angle moves as σh/sin θ here; the arc tangent of a quotient falls by π. */
  assert_within("angle over 1e-5 of σh", fabs(past - before), 1e-3);
  assert_true(before < 0.5 * PI && past > 0.5 * PI);
}

static void both_poles_vanish_at_the_singular_point(void** state) {
  (void)state;
  const Pole pole = at(-0.5, sqrt(0.75));
  assert_within("a from 1", fabs(pole.a - 1.0), 4.0 * DBL_EPSILON);
  /* A double root: rounding of the polynomial is felt as its square root. */
  assert_within("radius", pole_radius(pole), 4.0 * sqrt(DBL_EPSILON));
}

static void regions_have_texts(void** state) {
  (void)state;
  for (int r = 0; r <= POLE_REGION_COUNT; ++r) {
    assert_non_null(pole_region_text((PoleRegion)r));
  }
  assert_string_not_equal(pole_region_text(POLE_COMPLEX), pole_region_text(POLE_UNSTABLE));
}

static void every_tone_in_range_is_stable(void** state) {
  (void)state;
  Random random = random_start();
  for (int n = 0; n < 20000; ++n) {
    const double share = 0.5 - random_log_between(&random, 1e-9, 0.4999999);
    assert_true(
        pole_is_stable(solve(48000.0, 48000.0 * share, random_log_between(&random, 1e-6, 1e9))));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(slip_3_would_allow_steps_that_explode),
      cmocka_unit_test(largest_step_brackets_stability),
      cmocka_unit_test(verdict_is_the_spectral_radius),
      cmocka_unit_test(borders_belong_to_the_stable),
      cmocka_unit_test(corners_of_section_3_7_are_where_they_should_be),
      cmocka_unit_test(angle_passes_half_pi_without_a_jump),
      cmocka_unit_test(both_poles_vanish_at_the_singular_point),
      cmocka_unit_test(regions_have_texts),
      cmocka_unit_test(every_tone_in_range_is_stable),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
