#include "core/string/chain_dither.h"

#include "core/base/complex_of.h"
#include "tests/support/oracle.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { PERIOD = CHAIN_DITHER_PERIOD, LANES = CHAIN_MAX_LANES };

static double value(uint32_t place, uint32_t lane) {
  return (double)chain_dither[place][lane];
}

static void each_lane_has_every_value_once_a_period(void** state) {
  (void)state;
  for (uint32_t lane = 0; lane < LANES; ++lane) {
    bool is_found[PERIOD] = {false};
    double sum = 0.0;
    for (uint32_t place = 0; place < PERIOD; ++place) {
      const double which = (value(place, lane) + 0.5) * PERIOD - 0.5;
      assert_true(which >= 0.0 && which < PERIOD && which == floor(which));
      assert_false(is_found[(uint32_t)which]);
      is_found[(uint32_t)which] = true;
      sum += value(place, lane);
    }
    assert_true(sum == 0.0);
  }
}

static void second_period_repeats_the_first(void** state) {
  (void)state;
  assert_int_equal(CHAIN_DITHER_PLACES, 2 * PERIOD);
  assert_int_equal((uintptr_t)chain_dither % CHAIN_ALIGNMENT, 0);
  for (uint32_t place = 0; place < PERIOD; ++place) {
    for (uint32_t lane = 0; lane < LANES; ++lane) {
      assert_true(value(place, lane) == value(place + PERIOD, lane));
    }
  }
}

/* (1 − 2⁻¹⁶)/12 */
static double power(void) {
  return (1.0 - 1.0 / ((double)PERIOD * PERIOD)) / 12.0;
}

static double complex line(uint32_t lane, uint32_t k) {
  double complex sum = 0.0;
  for (uint32_t place = 0; place < PERIOD; ++place) {
    const double angle = 2.0 * PI * k * place / PERIOD;
    sum += value(place, lane) * complex_of(cos(angle), sin(angle));
  }
  return sum;
}

/* Of 128 lines of noise the strongest is 5.4 times the mean as a rule; these orders were chosen. */
static void no_frequency_stands_out(void** state) {
  (void)state;
  double worst = 0.0;
  for (uint32_t lane = 0; lane < LANES; ++lane) {
    for (uint32_t k = 1; k <= PERIOD / 2; ++k) {
      const double size = cabs(line(lane, k));
      worst = fmax(worst, size * size / (PERIOD * power()));
    }
  }
  assert_within("strongest line over the mean", worst, 4.0);
}

static double correlation(uint32_t lane, uint32_t other, uint32_t distance) {
  double sum = 0.0;
  for (uint32_t place = 0; place < PERIOD; ++place) {
    sum += value(place, lane) * value(place + distance, other);
  }
  return sum / (PERIOD * power());
}

/* Chance gives each 1/16, and the largest of 9000 a quarter. */
static void lanes_do_not_know_each_other(void** state) {
  (void)state;
  double worst_lanes = 0.0;
  double worst_places = 0.0;
  for (uint32_t lane = 0; lane < LANES; ++lane) {
    for (uint32_t distance = 0; distance < PERIOD; ++distance) {
      for (uint32_t other = 0; other < lane; ++other) {
        worst_lanes = fmax(worst_lanes, fabs(correlation(lane, other, distance)));
      }
      worst_places = fmax(worst_places, distance > 0 ? fabs(correlation(lane, lane, distance)) : 0);
    }
  }
  assert_within("correlation of two lanes at any distance", worst_lanes, 0.18);
  assert_within("correlation of a lane with itself later", worst_places, 0.21);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_lane_has_every_value_once_a_period),
      cmocka_unit_test(second_period_repeats_the_first),
      cmocka_unit_test(no_frequency_stands_out),
      cmocka_unit_test(lanes_do_not_know_each_other),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
