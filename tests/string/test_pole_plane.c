/* The plane of analog eigenvalues: edges and lines against the poles themselves. */

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
static const double HALF_DIGIT_4 = 0.5e-4;

static void corners_are_those_of_section_3_7(void** state) {
  (void)state;
  assert_within("0.1", fabs(pole_edge_vibrating(0.1) + 0.1954), HALF_DIGIT_4);
  assert_within("0.1", fabs(pole_edge_turning(0.1) + 0.7292), HALF_DIGIT_4);
  assert_within("0.8", fabs(pole_edge_vibrating(0.8) + 0.4983), HALF_DIGIT_4);
  assert_within("0.8", fabs(pole_edge_turning(0.8) + 0.5362), HALF_DIGIT_4);
  assert_within("0.87", fabs(pole_edge_turning(0.87) + 0.4977), HALF_DIGIT_4);
}

static void edges_meet_at_the_singular_point(void** state) {
  (void)state;
  const double mu_h = POLE_SINGULAR_MU_H;
  const Pole pole = pole_from_eigenvalue(1.0, POLE_SINGULAR_SIGMA_H, mu_h);
  assert_within("a and g from 1", fmax(fabs(pole.a - 1.0), fabs(pole.g - 1.0)), 2.0 * DBL_EPSILON);
  /* The vibrating edge is flat there: σh + ½ = ½ (u − 1)². */
  assert_within("vibrating", fabs(pole_edge_vibrating(mu_h) - POLE_SINGULAR_SIGMA_H), DBL_EPSILON);
  assert_within("turning", fabs(pole_edge_turning(mu_h) - POLE_SINGULAR_SIGMA_H),
                2.0 * DBL_EPSILON);
}

static void pole_of_an_eigenvalue_has_it(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int n = 0; n < 10000; ++n) {
    const double rate_hz = random_log_between(&random, 100.0, 1e6);
    const double sigma = -random_log_between(&random, 1e-3, 1e6);
    const double mu = random_log_between(&random, 1e-3, 1e6);
    const Pole pole = pole_from_eigenvalue(rate_hz, sigma, mu);
    const Pole other = pole_from_analog(rate_hz, hypot(sigma, mu), -2.0 * sigma);
    worst = fmax(worst, fabs(pole.a / other.a - 1.0));
    worst = fmax(worst, fabs(pole.g / other.g - 1.0));
  }
  assert_within("relative", worst, 8.0 * DBL_EPSILON);
}

/* Just right of each edge, something holds that does not just left of it. */
static void edges_divide_the_plane(void** state) {
  (void)state;
  for (double mu_h = 0.001; mu_h < 1.9995; mu_h += 0.001) {
    const double step = 1e-6;
    const double vibrating = pole_edge_vibrating(mu_h);
    assert_true(pole_is_complex(pole_from_eigenvalue(1.0, vibrating + step, mu_h)));
    assert_false(pole_is_complex(pole_from_eigenvalue(1.0, vibrating - step, mu_h)));
    const bool is_below = mu_h < POLE_SINGULAR_MU_H;
    if (fabs(mu_h - POLE_SINGULAR_MU_H) > 0.01 && vibrating - step > pole_edge_stable(mu_h)) {
      assert_int_equal(pole_region(pole_from_eigenvalue(1.0, vibrating - step, mu_h)),
                       is_below ? POLE_REAL_AT_ZERO : POLE_REAL_AT_PI);
    }
    const double turning = pole_edge_turning(mu_h);
    if (mu_h <= sqrt(2.0)) {
      assert_true(pole_angle(pole_from_eigenvalue(1.0, turning + step, mu_h)) < 0.5 * PI);
      assert_true(pole_angle(pole_from_eigenvalue(1.0, turning - step, mu_h)) > 0.5 * PI);
    } else {
      assert_true(isnan(turning));
    }
    const double stable = pole_edge_stable(mu_h);
    assert_true(pole_is_stable(pole_from_eigenvalue(1.0, stable + step, mu_h)));
    assert_false(pole_is_stable(pole_from_eigenvalue(1.0, stable - step, mu_h)));
  }
  assert_true(isnan(pole_edge_vibrating(2.001)) && isnan(pole_edge_stable(2.001)));
  assert_true(isnan(pole_edge_vibrating(-0.1)) && isnan(pole_edge_stable(-0.1)));
  assert_true(isnan(pole_edge_turning(-0.1)) && isnan(pole_edge_turning((double)NAN)));
  assert_true(isnan(pole_edge_vibrating((double)NAN)) && isnan(pole_edge_stable((double)NAN)));
  assert_true(pole_edge_vibrating(2.0) == 0.0 && pole_edge_stable(2.0) == 0.0);
}

static void lines_of_frequency_keep_it(void** state) {
  (void)state;
  double worst = 0.0;
  int n_points = 0;
  for (double angle = 0.05; angle < PI; angle += 0.05) {
    for (double sigma_h = -0.499; sigma_h <= 0.0; sigma_h += 0.001) {
      const double mu_h = pole_line_of_frequency(sigma_h, angle);
      if (!isnan(mu_h)) {
        const Pole pole = pole_from_eigenvalue(1.0, sigma_h, mu_h);
        assert_true(pole_is_complex(pole));
        worst =
            fmax(worst, fabs(pole_angle(pole) - angle) * sin(angle) * sqrt(1.0 + 2.0 * sigma_h));
        ++n_points;
      }
    }
  }
  /* The cosine is what is met to rounding. */
  assert_within("angle", worst, 16.0 * DBL_EPSILON);
  assert_true(n_points > 20000);
  assert_within("undamped: 2 sin(θ/2)", fabs(pole_line_of_frequency(0.0, 1.0) - 2.0 * sin(0.5)),
                2.0 * DBL_EPSILON);
  assert_true(isnan(pole_line_of_frequency(-0.5, 1.0)) && isnan(pole_line_of_frequency(0.1, 1.0)));
  assert_true(isnan(pole_line_of_frequency(-0.1, 3.2)) &&
              isnan(pole_line_of_frequency(-0.1, -0.1)));
}

static void lines_of_damping_keep_it(void** state) {
  (void)state;
  double worst = 0.0;
  int n_pairs = 0;
  int n_real[2] = {0};
  for (double radius = 0.05; radius < 1.0; radius += 0.05) {
    const double line = pole_line_of_damping(radius);
    for (double mu_h = 0.001; mu_h < 2.0; mu_h += 0.001) {
      const Pole pole = pole_from_eigenvalue(1.0, line, mu_h);
      if (pole_is_complex(pole)) {
        worst = fmax(worst, fabs(pole_radius(pole) - radius));
        ++n_pairs;
      }
    }
    for (double sigma_h = -1.0; sigma_h <= 0.0; sigma_h += 0.001) {
      for (int at_pi = 0; at_pi < 2; ++at_pi) {
        const double mu_h = pole_branch_of_damping(sigma_h, radius, at_pi);
        const Pole pole = pole_from_eigenvalue(1.0, sigma_h, mu_h);
        /* Where the two poles meet, theirs is the root of a rounding. */
        if (!isnan(mu_h) && fabs(sigma_h - line) > 1e-3) {
          worst = fmax(worst, 1e-3 * fabs(pole_radius(pole) - radius));
          assert_int_equal(pole_region(pole), at_pi ? POLE_REAL_AT_PI : POLE_REAL_AT_ZERO);
          ++n_real[at_pi];
        }
      }
    }
  }
  assert_within("radius", worst, 16.0 * DBL_EPSILON);
  assert_true(n_pairs > 10000 && n_real[0] > 500 && n_real[1] > 500);
  assert_true(isnan(pole_line_of_damping(0.0)) && isnan(pole_line_of_damping(1.1)));
  assert_true(isnan(pole_branch_of_damping(0.1, 0.5, false)) &&
              isnan(pole_branch_of_damping(-0.1, -0.5, false)));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(corners_are_those_of_section_3_7),
      cmocka_unit_test(edges_meet_at_the_singular_point),
      cmocka_unit_test(pole_of_an_eigenvalue_has_it),
      cmocka_unit_test(edges_divide_the_plane),
      cmocka_unit_test(lines_of_frequency_keep_it),
      cmocka_unit_test(lines_of_damping_keep_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
