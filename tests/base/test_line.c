#include "core/base/line.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void zero_is_a_line_that_stands_still(void** state) {
  (void)state;
  Line line = {0};
  for (int n = 0; n < 10; ++n) {
    assert_true(line_next(&line) == 0.0);
  }
  line_set(&line, 0.3);
  assert_true(line_next(&line) == 0.3 && line.n_left == 0);
}

static void line_is_straight_and_ends_exactly(void** state) {
  (void)state;
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 2000; ++trial) {
    const double start = random_between(&random, -10.0, 10.0);
    const double goal = random_between(&random, -10.0, 10.0);
    const uint32_t n_frames = 1 + random_below(&random, trial % 2 ? 10 : 2000);
    Line line;
    line_set(&line, start);
    line_to(&line, goal, n_frames);
    for (uint32_t n = 1; n < n_frames; ++n) {
      const double share = (double)n / n_frames;
      const double straight = start * (1.0 - share) + goal * share;
      worst = fmax(worst, fabs(line_next(&line) - straight) / n);
      assert_int_equal(line.n_left, n_frames - n);
    }
    assert_true(line_next(&line) == goal);
    assert_true(line_next(&line) == goal && line.n_left == 0);
  }
  /* A frame adds the rounding of a number up to 16, half an ε of it, and as much again of its
   * change. */
  assert_within("from the straight line, per frame", worst, 16.0 * DBL_EPSILON);
}

static void no_frames_is_at_once(void** state) {
  (void)state;
  Line line;
  line_set(&line, 1.0);
  line_to(&line, 2.0, 100);
  (void)line_next(&line);
  line_to(&line, -3.0, 0);
  assert_true(line.value == -3.0 && line.n_left == 0);
  assert_true(line_next(&line) == -3.0);
}

static void line_overtaken_goes_on_from_where_it_is(void** state) {
  (void)state;
  Line line;
  line_set(&line, 0.0);
  line_to(&line, 1.0, 64);
  for (int n = 0; n < 32; ++n) {
    (void)line_next(&line);
  }
  assert_true(line.value == 0.5);
  line_to(&line, 0.25, 16);
  /* All powers of two: every step is exact. */
  for (int n = 1; n <= 16; ++n) {
    assert_true(line_next(&line) == 0.5 - 0.25 * n / 16.0);
  }
  assert_true(line_next(&line) == 0.25);
}

/* In pieces, past its end. */
static void filled_frames_are_those_one_by_one(void** state) {
  (void)state;
  float filled[40];
  Line a;
  Line b;
  line_set(&a, 0.25);
  line_set(&b, 0.25);
  line_to(&a, -3.0, 23);
  line_to(&b, -3.0, 23);
  line_fill(&a, 7, filled);
  line_fill(&a, 0, filled + 7);
  line_fill(&a, 33, filled + 7);
  for (int n = 0; n < 40; ++n) {
    assert_true(filled[n] == (float)line_next(&b));
  }
  assert_true(a.value == -3.0 && a.n_left == 0);
}

/* Many at once are as many one by one. */
static void skipped_frames_are_those_one_by_one(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 1000; ++trial) {
    Line a;
    Line b;
    line_set(&a, random_between(&random, -10.0, 10.0));
    line_to(&a, random_between(&random, -10.0, 10.0), 1 + random_below(&random, 500));
    b = a;
    for (int part = 0; part < 5; ++part) {
      const uint32_t n_frames = random_below(&random, 200);
      line_skip(&a, n_frames);
      for (uint32_t n = 0; n < n_frames; ++n) {
        (void)line_next(&b);
      }
      worst = fmax(worst, fabs(a.value - b.value));
      assert_int_equal(a.n_left, b.n_left);
    }
    assert_true(a.n_left > 0 || (a.value == a.goal && b.value == a.goal));
  }
  assert_within("from one by one", worst, 500.0 * 16.0 * DBL_EPSILON);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(zero_is_a_line_that_stands_still),
      cmocka_unit_test(line_is_straight_and_ends_exactly),
      cmocka_unit_test(no_frames_is_at_once),
      cmocka_unit_test(line_overtaken_goes_on_from_where_it_is),
      cmocka_unit_test(skipped_frames_are_those_one_by_one),
      cmocka_unit_test(filled_frames_are_those_one_by_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
