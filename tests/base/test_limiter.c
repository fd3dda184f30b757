/* The limiter keeps all below full scale, and its hands off what is. */
#include "core/base/limiter.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, N = RATE };

static const double PI = 3.14159265358979323846;

static float left[N];
static float right[N];
static float was_left[N];
static float was_right[N];

static Limiter make(bool is_on) {
  Limiter limiter;
  limiter_init(&limiter, RATE);
  limiter_turn(&limiter, is_on, 0);
  return limiter;
}

static void tones(double amplitude) {
  for (size_t i = 0; i < N; ++i) {
    const double t = (double)i / RATE;
    left[i] = was_left[i] = (float)(amplitude * sin(2.0 * PI * 220.0 * t));
    right[i] = was_right[i] = (float)(0.5 * amplitude * sin(2.0 * PI * 331.0 * t + 1.0));
  }
}

static bool is_as_it_was(void) {
  return !memcmp(left, was_left, sizeof(left)) && !memcmp(right, was_right, sizeof(right));
}

static void what_is_below_the_knee_is_not_touched(void** state) {
  (void)state;
  Limiter limiter = make(true);
  tones(0.999 * LIMITER_KNEE);
  limiter_run(&limiter, N, left, right);
  assert_true(is_as_it_was());
}

static void off_it_touches_nothing(void** state) {
  (void)state;
  Limiter limiter = make(false);
  tones(30.0);
  limiter_run(&limiter, N, left, right);
  assert_true(is_as_it_was());
}

static void nothing_leaves_it_above_full_scale(void** state) {
  (void)state;
  Random random = random_start();
  for (int i = 0; i < 200; ++i) {
    Limiter limiter = make(true);
    const double most = pow(10.0, random_between(&random, -1.0, 38.0));
    for (size_t n = 0; n < 1000; ++n) {
      left[n] = (float)random_between(&random, -most, most);
      right[n] = (float)random_between(&random, -most, most);
    }
    limiter_run(&limiter, 1000, left, right);
    for (size_t n = 0; n < 1000; ++n) {
      assert_true(fabsf(left[n]) <= 1.0f && fabsf(right[n]) <= 1.0f);
    }
  }
}

/* And what is louder stays louder. */
static void it_bends_over_towards_full_scale(void** state) {
  (void)state;
  float last = 0.0f;
  for (double in = 0.1; in < 4.0; in *= 1.1) {
    Limiter limiter = make(true);
    left[0] = right[0] = (float)in;
    limiter_run(&limiter, 1, left, right);
    assert_true(left[0] >= last && left[0] <= 1.0f);
    assert_true(in > LIMITER_KNEE || left[0] == (float)in);
    last = left[0];
  }
  assert_true(last > 0.999f);
}

/* "would be bent over towards 1 along a hyperbolic tangent", from 1.9 dB below full scale on: its
 * slope there is 1, and so is its height in the end. */
static void it_bends_along_a_hyperbolic_tangent(void** state) {
  (void)state;
  double worst = 0.0;
  for (double in = 0.5; in < 1e3; in *= 1.03) {
    Limiter limiter = make(true);
    left[0] = (float)in;
    right[0] = (float)(-0.25 * in);
    limiter_run(&limiter, 1, left, right);
    const double over = fmax(0.0, ((double)(float)in - 0.8) / 0.2);
    const double printed =
        fmin((double)(float)in, 0.8) + 0.2 * (1.0 - 2.0 / (1.0 + exp(2.0 * over)));
    worst = fmax(worst, fabs((double)left[0] - printed));
    worst = fmax(worst, fabs((double)right[0] + 0.25 * printed));
  }
  assert_within("off the curve", worst, (double)FLT_EPSILON);
  assert_within("knee [dB]", fabs(20.0 * log10(LIMITER_KNEE) + 1.9), 0.05);
}

static void both_sides_keep_their_balance(void** state) {
  (void)state;
  Limiter limiter = make(true);
  tones(5.0);
  limiter_run(&limiter, N, left, right);
  for (size_t i = 0; i < N; ++i) {
    const double cross = (double)left[i] * (double)was_right[i];
    assert_true(fabs(cross - (double)right[i] * (double)was_left[i]) < 1e-6);
  }
}

/* The gain rises as slowly as what is followed falls, and is 1 at last. */
static void it_lets_go_slowly_and_wholly(void** state) {
  (void)state;
  Limiter limiter = make(true);
  double last = 0.0;
  for (size_t i = 0; i < N; ++i) {
    left[i] = right[i] = i == 0 ? 10.0f : 0.5f;
  }
  limiter_run(&limiter, N, left, right);
  for (size_t i = 1; i < N; ++i) {
    const double gain = (double)left[i] / 0.5;
    assert_true(gain >= last && (i == 1 || gain - last < 2e-4));
    last = gain;
  }
  assert_true(left[1] < 0.06f && left[N - 1] == 0.5f);
}

/* It is the size that is followed, whichever the side and sign. */
static void each_side_and_sign_counts_alike(void** state) {
  (void)state;
  static const float sides[][2] = {{3.0f, 0.1f}, {-3.0f, 0.1f}, {0.1f, 3.0f}, {0.1f, -3.0f}};
  for (size_t i = 0; i < 4; ++i) {
    Limiter limiter = make(true);
    left[0] = sides[i][0];
    right[0] = sides[i][1];
    limiter_run(&limiter, 1, left, right);
    assert_true(fabs(fmax(fabs((double)left[0]), fabs((double)right[0])) - 1.0) < 1e-4);
  }
}

static void it_is_turned_on_and_off_without_a_step(void** state) {
  (void)state;
  Limiter limiter = make(false);
  for (size_t i = 0; i < N; ++i) {
    left[i] = right[i] = 2.0f;
  }
  limiter_turn(&limiter, true, 240);
  limiter_run(&limiter, N / 2, left, right);
  limiter_turn(&limiter, true, 240);
  limiter_turn(&limiter, false, 240);
  limiter_run(&limiter, N / 2, left + N / 2, right + N / 2);
  for (size_t i = 1; i < N; ++i) {
    assert_true(fabsf(left[i] - left[i - 1]) < 0.006f);
  }
  assert_true(left[N / 2 - 1] <= 1.0f && left[N - 1] == 2.0f);
}

static void the_cut_into_blocks_does_not_matter(void** state) {
  (void)state;
  Limiter whole = make(true);
  Limiter cut = make(true);
  tones(3.0);
  limiter_run(&whole, N, left, right);
  for (size_t done = 0, n = 1; done < N; done += n, n = n % 97 + 1) {
    n = n < N - done ? n : N - done;
    limiter_run(&cut, (uint32_t)n, was_left + done, was_right + done);
  }
  assert_true(is_as_it_was());
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_below_the_knee_is_not_touched),
      cmocka_unit_test(off_it_touches_nothing),
      cmocka_unit_test(nothing_leaves_it_above_full_scale),
      cmocka_unit_test(it_bends_over_towards_full_scale),
      cmocka_unit_test(it_bends_along_a_hyperbolic_tangent),
      cmocka_unit_test(both_sides_keep_their_balance),
      cmocka_unit_test(it_lets_go_slowly_and_wholly),
      cmocka_unit_test(each_side_and_sign_counts_alike),
      cmocka_unit_test(it_is_turned_on_and_off_without_a_step),
      cmocka_unit_test(the_cut_into_blocks_does_not_matter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
