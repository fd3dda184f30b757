/* What is not a number is heard by nobody, and is gone with the next pluck. */
#include "core/guitar/guitar_mixer.h"

#include "tests/support/guitars.h"
#include "tests/support/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { RATE = 48000, N = 4800, ROOM = 1 << 15 };

static _Alignas(CHAIN_ALIGNMENT) char memory[2 * GUITAR_VOICES * ROOM];
static GuitarString strings[GUITAR_VOICES];
static GuitarString tails[GUITAR_VOICES];
static float left[N];
static float right[N];

static double peak_after(GuitarMixer* mixer) {
  guitar_mixer_run(mixer, strings, tails, N, left, right);
  for (int n = 0; n < N; ++n) {
    assert_true(isfinite(left[n]) && isfinite(right[n]));
  }
  return measure_peak(left, N);
}

static void what_is_no_number_leaves_no_string(void** state) {
  static const float others[] = {NAN, INFINITY, -INFINITY};
  (void)state;
  static GuitarMixer mixer;
  const GuitarPatch patch = guitars_patch();
  assert_true(chain_size(GUITAR_MAX_MASSES) <= ROOM);
  guitar_mixer_init(&mixer, RATE);
  guitar_mixer_set(&mixer, &patch, 0);
  for (uint32_t w = 0; w < GUITAR_VOICES; ++w) {
    guitar_string_init(&strings[w], &patch, RATE, w, memory + (size_t)2 * w * ROOM);
    guitar_string_init(&tails[w], &patch, RATE, w, memory + (size_t)(2 * w + 1) * ROOM);
    strings[w].open = 45.0 + 5.0 * (w % GUITAR_STRINGS);
  }
  guitar_string_pluck(&strings[0], (Pluck){0.13, 0.5, 0.25, 0.0});
  const double as_new = peak_after(&mixer);
  assert_true(as_new > 0.01);
  for (int i = 0; i < 3; ++i) {
    chain_place(&strings[0].voice.chain, 5, others[i], others[i]);
    guitar_string_pluck(&strings[1], (Pluck){0.13, 0.5, 0.25, 0.0});
    assert_true(peak_after(&mixer) > 0.01); /* The others go on */
    assert_false(strings[0].voice.is_awake);
    guitar_string_reset(&strings[1]);
    guitar_string_pluck(&strings[0], (Pluck){0.13, 0.5, 0.25, 0.0});
    assert_true(fabs(peak_after(&mixer) / as_new - 1.0) < 1e-3);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_no_number_leaves_no_string),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
