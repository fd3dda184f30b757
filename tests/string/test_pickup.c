#include "core/string/pickup.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* What the tap reads of a string whose mass i (from 0) is at x[i]. */
static double read(ChainTap tap, const double* x) {
  return (double)tap.weight[0] * x[tap.mass[0]] + (double)tap.weight[1] * x[tap.mass[1]];
}

static void place_of_a_mass_reads_that_mass(void** state) {
  (void)state;
  static double x[CHAIN_MAX_MASSES];
  double worst = 0.0;
  for (uint32_t n = 1; n <= CHAIN_MAX_MASSES; n += n < 100 ? 1 : 77) {
    for (uint32_t i = 0; i < n; ++i) {
      x[i] = 1.0;
      worst = fmax(worst, fabs(read(pickup_tap(n, (i + 1.0) / (n + 1.0)), x) - 1.0));
      if (n > 1) {
        x[i] = 0.0;
        x[(i + 1) % n] = 1.0;
        worst = fmax(worst, fabs(read(pickup_tap(n, (i + 1.0) / (n + 1.0)), x)));
        x[(i + 1) % n] = 0.0;
      }
      x[i] = 0.0;
    }
  }
  /* i/(N + 1) times N + 1 is i to the rounding of a number up to 1025, and a weight is a float. */
  assert_within("weight, from 1 and 0", worst, 1025.0 * DBL_EPSILON + (double)FLT_EPSILON);
}

static void walls_read_nothing(void** state) {
  (void)state;
  for (uint32_t n = 1; n <= CHAIN_MAX_MASSES; n += n < 100 ? 1 : 77) {
    for (int end = 0; end < 2; ++end) {
      const ChainTap tap = pickup_tap(n, end);
      assert_true(tap.weight[0] == 0.0f && tap.weight[1] == 0.0f);
    }
  }
}

/* The string's own shape between masses is a straight line, the walls included. */
static void reading_is_straight_between_masses(void** state) {
  (void)state;
  static double x[CHAIN_MAX_MASSES + 2];
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 20000; ++trial) {
    const uint32_t n = 1 + random_below(&random, trial % 2 ? 5 : CHAIN_MAX_MASSES);
    for (uint32_t i = 1; i <= n; ++i) {
      x[i] = random_between(&random, -1.0, 1.0);
    }
    x[n + 1] = 0.0;
    const double place = random_between(&random, 0.0, 1.0);
    const double at = place * (n + 1.0);
    const uint32_t i = (uint32_t)fmin(floor(at), n);
    const ChainTap tap = pickup_tap(n, place);
    assert_true(tap.mass[0] < n && tap.mass[1] < n);
    const double straight = x[i] + (at - i) * (x[i + 1] - x[i]);
    worst = fmax(worst, fabs(read(tap, x + 1) - straight));
  }
  assert_within("reading, from the straight line", worst, 2.0 * (double)FLT_EPSILON);
}

static void any_place_is_within_the_string(void** state) {
  (void)state;
  for (uint32_t n = 1; n <= CHAIN_MAX_MASSES; ++n) {
    for (int step = 0; step <= 4; ++step) {
      const double place = step == 4 ? nextafter(1.0, 0.0) : step * 0x1p-52;
      const ChainTap tap = pickup_tap(n, place);
      assert_true(tap.mass[0] < n && tap.mass[1] < n);
      assert_true(tap.weight[0] >= 0.0f && tap.weight[1] >= 0.0f);
      assert_true((double)tap.weight[0] + (double)tap.weight[1] <= 1e-9);
    }
  }
}

/* The tap for displacement, so much heavier that a difference has the fundamental's size again. */
static void velocity_has_the_place_and_a_weight(void** state) {
  (void)state;
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 10000; ++trial) {
    const uint32_t n = 1 + random_below(&random, trial % 2 ? 5 : CHAIN_MAX_MASSES);
    const double place = random_between(&random, 0.0, 1.0);
    const double angle1 = random_log_between(&random, 1e-4, 3.1);
    const ChainTap plain = pickup_tap(n, place);
    const ChainTap tap = pickup_tap_of_type(PICKUP_VELOCITY, n, place, angle1);
    /* |1 − e^{−iω}|, of a difference at ω. */
    const double gain = 0.24 / hypot(1.0 - cos(angle1), sin(angle1));
    for (int k = 0; k < 2; ++k) {
      assert_int_equal(tap.mass[k], plain.mass[k]);
      const double wanted = gain * (double)plain.weight[k];
      worst = fmax(worst, fabs((double)tap.weight[k] - wanted) / gain);
    }
  }
  /* 1 − cos ω has lost half of its digits where ω is small. */
  assert_within("weight, relative", worst, 1e-6);
}

/* A string of shape sin(πx) pulls with its slope there, π, at its end. */
static void force_is_the_slope_at_the_end(void** state) {
  (void)state;
  static double x[CHAIN_MAX_MASSES];
  double worst = 0.0;
  for (uint32_t n = 50; n <= CHAIN_MAX_MASSES; n += 77) {
    for (uint32_t i = 0; i < n; ++i) {
      x[i] = sin(3.14159265358979323846 * (i + 1.0) / (n + 1.0));
    }
    for (int step = 0; step <= 4; ++step) {
      const double place = 0.25 * step;
      const double force = read(pickup_tap_of_type(PICKUP_FORCE, n, place, 0.1), x);
      worst = fmax(worst, fabs(force / 0.18 - 1.0));
    }
  }
  /* sin(φ)/φ is φ²/6 short of 1, and φ at most π/51. */
  assert_within("force, relative", worst, 7e-4);
}

static void displacement_is_read_as_ever(void** state) {
  (void)state;
  const ChainTap tap = pickup_tap_of_type(PICKUP_DISPLACEMENT, 9, 0.33, 0.1);
  const ChainTap plain = pickup_tap(9, 0.33);
  assert_memory_equal(&tap, &plain, sizeof(tap));
}

static void magnet_reads_velocity_at_the_place(void** state) {
  (void)state;
  const ChainTap tap = pickup_tap_of_type(PICKUP_MAGNET, 9, 0.33, 0.1);
  ChainTap plain = pickup_tap(9, 0.33);
  plain.is_velocity = true;
  assert_memory_equal(&tap, &plain, sizeof(tap));
}

/* Whatever the cuts, and from the sample before on. */
static void a_difference_is_from_each_sample_to_the_next(void** state) {
  (void)state;
  enum { N = 100 };
  float samples[N];
  float before = 7.0f;
  for (int i = 0; i < N; ++i) {
    samples[i] = (float)(i * i);
  }
  pickup_differentiate(samples, 0, &before);
  assert_true(before == 7.0f);
  pickup_differentiate(samples, 33, &before);
  pickup_differentiate(samples + 33, N - 33, &before);
  assert_true(samples[0] == -7.0f && before == (float)((N - 1) * (N - 1)));
  for (int i = 1; i < N; ++i) {
    assert_true(samples[i] == (float)(2 * i - 1));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(place_of_a_mass_reads_that_mass),
      cmocka_unit_test(walls_read_nothing),
      cmocka_unit_test(reading_is_straight_between_masses),
      cmocka_unit_test(any_place_is_within_the_string),
      cmocka_unit_test(velocity_has_the_place_and_a_weight),
      cmocka_unit_test(force_is_the_slope_at_the_end),
      cmocka_unit_test(displacement_is_read_as_ever),
      cmocka_unit_test(magnet_reads_velocity_at_the_place),
      cmocka_unit_test(a_difference_is_from_each_sample_to_the_next),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
