/* Strings are spread from the lowest on the left to the highest on the right, and are as loud in
 * any place. */
#include "tests/support/guitars.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, N = RATE / 4, N_STRINGS = 6 };

static float left[N];
static float right[N];

static void play(double width, uint32_t string) {
  GuitarPatch patch = guitars_patch();
  patch.width = width;
  Guitar* const guitar = guitars_new(RATE, &patch);
  guitars_pluck(guitar, string, 1.0);
  guitar_run(guitar, N, left, right);
  guitar_free(guitar);
}

static double power(const float* samples) {
  double sum = 0.0;
  for (size_t i = 0; i < N; ++i) {
    sum += (double)samples[i] * (double)samples[i];
  }
  return sum;
}

static void without_width_both_sides_are_one(void** state) {
  (void)state;
  for (uint32_t string = 0; string < N_STRINGS; ++string) {
    play(0.0, string);
    assert_true(power(left) > 0.0);
    assert_memory_equal(left, right, sizeof(left));
  }
}

static void the_outer_strings_reach_the_sides(void** state) {
  (void)state;
  play(1.0, 0);
  assert_true(power(left) == 0.0 && power(right) > 0.0);
  play(1.0, N_STRINGS - 1);
  assert_true(power(right) == 0.0 && power(left) > 0.0);
}

static void strings_lie_in_their_order(void** state) {
  (void)state;
  double last = HUGE_VAL;
  for (uint32_t string = 0; string < N_STRINGS; ++string) {
    play(0.5, string);
    const double balance = power(right) / power(left);
    assert_true(balance < last);
    last = balance;
  }
}

static void width_makes_nothing_louder(void** state) {
  (void)state;
  for (uint32_t string = 0; string < N_STRINGS; ++string) {
    play(0.0, string);
    const double narrow = power(left) + power(right);
    play(0.7, string);
    assert_true(fabs((power(left) + power(right)) / narrow - 1.0) < 1e-5);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_width_both_sides_are_one),
      cmocka_unit_test(the_outer_strings_reach_the_sides),
      cmocka_unit_test(strings_lie_in_their_order),
      cmocka_unit_test(width_makes_nothing_louder),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
