/* What is not a number is heard by nobody, and is gone with the next note. */
#include "core/harp/harp_state.h"

#include "tests/support/harps.h"
#include "tests/support/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

enum { RATE = 48000, KEY = 57, N = 4800 };

static float left[N];
static float right[N];
static float as_new[N];

static bool are_finite(const float* samples) {
  for (int n = 0; n < N; ++n) {
    if (!isfinite(samples[n])) {
      return false;
    }
  }
  return true;
}

/* Whatever plays and is heard, alone and with all strings on a bridge that moves. */
static void what_is_no_number_leaves_no_harp(void** state) {
  static const float others[] = {NAN, INFINITY, -INFINITY};
  (void)state;
  for (uint32_t way = 0; way < HARPS_N_WAYS; ++way) {
    for (int i = 0; i < 3; ++i) {
      HarpPatch patch = harps_patch(way);
      patch.resonance = i / 2.0;
      Harp* const harp = harps_new(RATE, &patch);
      harp_note_on(harp, 0, KEY, 100);
      harps_run(harp, N, as_new, NULL);
      harps_restart(harp, &patch);
      harp_pedal(harp, 0, 1.0);
      harp_note_on(harp, 0, KEY - 12, 100);
      harps_run(harp, N, left, right);
      chain_place(&harp->strings[KEY - 12].voice.chain, 5, others[i], others[i]);
      for (int block = 0; block < 4; ++block) {
        harps_run(harp, N, left, right);
        assert_true(are_finite(left) && are_finite(right));
      }
      assert_true(measure_peak(left, N) < 1.0);
      harp_silence(harp);
      for (int block = 0; block < 4; ++block) {
        harps_run(harp, N, left, right);
      }
      harp_note_on(harp, 0, KEY, 100);
      harps_run(harp, N, left, right);
      assert_true(are_finite(left));
      const double decibels = 20.0 * log10(measure_peak(left, N) / measure_peak(as_new, N));
      assert_true(fabs(decibels) < 1.0);
      harp_free(harp);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_no_number_leaves_no_harp),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
