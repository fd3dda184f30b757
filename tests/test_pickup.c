#include "core/pickup.h"

#include "tests/oracle.h"
#include "tests/random.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(place_of_a_mass_reads_that_mass),
      cmocka_unit_test(walls_read_nothing),
      cmocka_unit_test(reading_is_straight_between_masses),
      cmocka_unit_test(any_place_is_within_the_string),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
