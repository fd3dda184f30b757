/* The gain of a string is its own, and moves without a step. */
#include "core/voice/voice.h"
#include "tests/support/guitars.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { RATE = 48000, N = RATE / 4, AT = 3000 };

/* A string that comes to a gain on the way, and maybe another; `n_block` frames at a time. */
static void play(float* left, double gain, bool is_alone, uint32_t n_block) {
  static float right[N];
  const GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitars_new(RATE, &patch);
  guitars_pluck(guitar, 1, 0.5);
  guitars_pluck(guitar, 4, is_alone ? 0.0 : 0.5);
  for (uint32_t done = 0; done < N;) {
    const uint32_t most = done < AT ? AT - done : N - done;
    const uint32_t n = n_block < most ? n_block : most;
    if (done == AT) {
      guitar_set_gain(guitar, 1, gain);
    }
    guitar_run(guitar, n, left + done, right + done);
    done += n;
  }
  guitar_free(guitar);
}

/* By a half of what takes it all away, where it is not alone. */
static void a_gain_is_of_its_string_alone(void** state) {
  static float whole[N];
  static float none[N];
  static float half[N];
  (void)state;
  play(whole, 1.0, false, N);
  play(none, 0.0, false, N);
  play(half, 0.5, false, N);
  double worst = 0.0;
  for (size_t n = 0; n < N; ++n) {
    worst = fmax(worst, fabs((double)half[n] - 0.5 * ((double)whole[n] + (double)none[n])));
  }
  assert_within("of a half", worst, 1e-6);
  assert_true(measure_rms(none + N / 2, N / 2) > 0.01);
  assert_true(measure_rms(none + N / 2, N / 2) < 0.9 * measure_rms(whole + N / 2, N / 2));
}

static void a_gain_moves_in_a_straight_line(void** state) {
  static float whole[N];
  static float none[N];
  (void)state;
  const double n_gesture = voice_gesture_frames(RATE);
  play(whole, 1.0, true, N);
  play(none, 0.0, true, N);
  double worst = 0.0;
  for (size_t n = 0; n < N; ++n) {
    const double gain = fmin(fmax(1.0 - ((double)n - AT + 1.0) / n_gesture, 0.0), 1.0);
    worst = fmax(worst, fabs((double)none[n] - gain * (double)whole[n]));
  }
  assert_within("from a line", worst, 1e-5);
}

static void blocks_do_not_change_it(void** state) {
  static float whole[N];
  static float cut[N];
  (void)state;
  play(whole, 0.3, false, N);
  play(cut, 0.3, false, 7);
  assert_memory_equal(whole, cut, sizeof(whole));
}

/* One that is asleep has its gain before it is plucked; a reset brings it back. */
static void a_gain_waits_for_its_pluck(void** state) {
  static float sounds[3][N];
  (void)state;
  const GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitars_new(RATE, &patch);
  for (int i = 0; i < 3; ++i) {
    guitar_reset(guitar);
    guitar_set_patch(guitar, &patch, 0);
    if (i == 1) {
      guitar_set_gain(guitar, 2, 0.5);
      guitar_set_gain(guitar, GUITAR_STRINGS, 0.0); /* None */
    }
    guitars_pluck(guitar, 2, 1.0);
    guitars_run(guitar, N, sounds[i]);
  }
  for (size_t n = 0; n < N; ++n) {
    assert_true(sounds[1][n] == 0.5f * sounds[0][n]);
  }
  assert_memory_equal(sounds[0], sounds[2], sizeof(sounds[0]));
  guitar_free(guitar);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_gain_is_of_its_string_alone),
      cmocka_unit_test(a_gain_moves_in_a_straight_line),
      cmocka_unit_test(blocks_do_not_change_it),
      cmocka_unit_test(a_gain_waits_for_its_pluck),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
