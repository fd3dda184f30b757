#include "core/base/ramp.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void zero_is_a_ramp_that_stands_still(void** state) {
  (void)state;
  Ramp ramp = {0};
  for (int n = 0; n < 10; ++n) {
    assert_true(ramp_next(&ramp) == 0.0f);
  }
  ramp_init(&ramp, 0.3f);
  assert_true(ramp_next(&ramp) == 0.3f && ramp.n_left == 0);
}

static void ramp_is_straight_and_ends_exactly(void** state) {
  (void)state;
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 2000; ++trial) {
    const float start = (float)random_between(&random, -10.0, 10.0);
    const float goal = (float)random_between(&random, -10.0, 10.0);
    const uint32_t n_frames = 1 + random_below(&random, trial % 2 ? 10 : 2000);
    Ramp ramp;
    ramp_init(&ramp, start);
    ramp_to(&ramp, goal, n_frames);
    for (uint32_t n = 1; n < n_frames; ++n) {
      const double share = (double)n / n_frames;
      const double straight = (double)start * (1.0 - share) + (double)goal * share;
      worst = fmax(worst, fabs((double)ramp_next(&ramp) - straight) / n);
      assert_int_equal(ramp.n_left, n_frames - n);
    }
    assert_true(ramp_next(&ramp) == goal);
    assert_true(ramp_next(&ramp) == goal && ramp.n_left == 0);
  }
  /* A frame adds the rounding of a number up to 16, half an ε of it, and as much again of its
   * change. */
  assert_within("from the straight line, per frame", worst, 16.0 * (double)FLT_EPSILON);
}

static void no_frames_is_at_once(void** state) {
  (void)state;
  Ramp ramp;
  ramp_init(&ramp, 1.0f);
  ramp_to(&ramp, 2.0f, 100);
  (void)ramp_next(&ramp);
  ramp_to(&ramp, -3.0f, 0);
  assert_true(ramp.value == -3.0f && ramp.n_left == 0);
  assert_true(ramp_next(&ramp) == -3.0f);
}

static void ramp_overtaken_goes_on_from_where_it_is(void** state) {
  (void)state;
  Ramp ramp;
  ramp_init(&ramp, 0.0f);
  ramp_to(&ramp, 1.0f, 64);
  for (int n = 0; n < 32; ++n) {
    (void)ramp_next(&ramp);
  }
  assert_true(ramp.value == 0.5f);
  ramp_to(&ramp, 0.25f, 16);
  /* All powers of two: every step is exact. */
  for (int n = 1; n <= 16; ++n) {
    assert_true(ramp_next(&ramp) == 0.5f - 0.25f * (float)n / 16.0f);
  }
  assert_true(ramp_next(&ramp) == 0.25f);
}

/* In pieces, past its end. */
static void filled_frames_are_those_one_by_one(void** state) {
  (void)state;
  float filled[40];
  Ramp a;
  Ramp b;
  ramp_init(&a, 0.25f);
  ramp_init(&b, 0.25f);
  ramp_to(&a, -3.0f, 23);
  ramp_to(&b, -3.0f, 23);
  ramp_fill(&a, 7, filled);
  ramp_fill(&a, 0, filled + 7);
  ramp_fill(&a, 33, filled + 7);
  for (int n = 0; n < 40; ++n) {
    assert_true(filled[n] == ramp_next(&b));
  }
  assert_true(a.value == -3.0f && a.n_left == 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(zero_is_a_ramp_that_stands_still),
      cmocka_unit_test(ramp_is_straight_and_ends_exactly),
      cmocka_unit_test(no_frames_is_at_once),
      cmocka_unit_test(ramp_overtaken_goes_on_from_where_it_is),
      cmocka_unit_test(filled_frames_are_those_one_by_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
