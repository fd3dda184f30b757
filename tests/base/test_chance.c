#include "core/base/chance.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { N = 100000, BINS = 100, ROWS = 300, COLUMNS = 300, NEAR = 3 };

/* Computed by itself, in whole numbers without end. */
static void it_is_the_same_on_every_machine(void** state) {
  (void)state;
  assert_true(chance_bits(0, 0) == UINT64_C(0xa706dd2f4d197e6f));
  assert_true(chance_bits(1, 0) == UINT64_C(0x5e41ab087439611e));
  assert_true(chance_bits(1, 1) == UINT64_C(0xf18d6ce93d6cf1ee));
  assert_true(chance_bits(999, 12345) == UINT64_C(0x2f1a29ab08abd9a6));
  assert_true(chance_bits(UINT64_MAX, UINT64_MAX) == UINT64_C(0x445018e305810b78));
  assert_true(chance_even(0, 0) == 0.3048969727480644);
  assert_true(chance_even(1, 1) == 0.8871284617297088);
}

/* χ² of as many bins has the mean BINS − 1 and the deviation √(2 (BINS − 1)), 14. */
static void it_is_even(void** state) {
  (void)state;
  for (uint64_t seed = 0; seed < 5; ++seed) {
    uint32_t counts[BINS] = {0};
    for (uint64_t n = 0; n < N; ++n) {
      const double value = chance_even(seed, n);
      assert_true(value >= -1.0 && value < 1.0);
      ++counts[(int)((value + 1.0) * 0.5 * BINS)];
    }
    double chi = 0.0;
    for (int b = 0; b < BINS; ++b) {
      const double off = counts[b] - (double)N / BINS;
      chi += off * off * BINS / N;
    }
    print_message("χ² %.1f\n", chi);
    assert_within("χ² from its mean", fabs(chi - (BINS - 1.0)), 4.0 * sqrt(2.0 * (BINS - 1.0)));
  }
}

/* Nearby numbers of a row, and those of nearby rows, by up to NEAR steps of either. */
static void neighbours_know_nothing_of_each_other(void** state) {
  (void)state;
  double worst = 0.0;
  for (uint64_t row = 0; row <= NEAR; ++row) {
    for (uint64_t column = 0; column <= 2 * NEAR; ++column) {
      double sum = 0.0;
      for (uint64_t i = 0; i < (uint64_t)ROWS * COLUMNS; ++i) {
        const uint64_t seed = i / COLUMNS;
        const uint64_t n = i % COLUMNS;
        sum += chance_even(seed, n + NEAR) * chance_even(seed + row, n + column);
      }
      const double correlation = 3.0 * sum / ((double)ROWS * COLUMNS);
      if (row == 0 && column == NEAR) {
        assert_within("with itself, from 1", fabs(correlation - 1.0), 0.02);
      } else {
        worst = fmax(worst, fabs(correlation));
      }
    }
  }
  assert_within("correlation", worst, 4.0 / sqrt((double)ROWS * COLUMNS));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_is_the_same_on_every_machine),
      cmocka_unit_test(it_is_even),
      cmocka_unit_test(neighbours_know_nothing_of_each_other),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
