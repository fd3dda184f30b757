/* Every preset of Hooke Guitar loads, says what it is, is about as loud as the others, and sounds
 * like no other. */
#include "tests/support/guitar_host.h"
#include "tests/support/loudness.h"
#include "tests/support/measure.h"
#include "tests/support/presets.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 1024, LEAST_PRESETS = 8, MOST_PRESETS = 64, N_FRAMES = 2 * RATE };

/* From the loudest preset to the quietest. */
static const double MOST_DB = 6.0;

static Host* open_host(void) {
  return guitar_open(RATE, BLOCK);
}

static void every_preset_says_what_it_is_and_is_in_range(void** state) {
  (void)state;
  presets_check_all(open_host, LEAST_PRESETS);
}

static void each_preset_is_in_a_bank(void** state) {
  (void)state;
  Host* const host = open_host();
  presets_check_banks(host);
  host_free(host);
}

/* All open strings of its own tuning. */
static Sound strum(Host* host, uint32_t preset, uint32_t velocity) {
  static const char* const strings[] = {"string1", "string2", "string3",
                                        "string4", "string5", "string6"};
  Sound sound = sound_new(N_FRAMES);
  assert_true(host_preset(host, host_preset_uri(host, preset)));
  host_set(host, "mode", 1.0f);
  host_set(host, "limiter", 0.0f);
  strings_restart(host);
  for (uint32_t s = 0; s < 6; ++s) {
    const uint32_t note = (uint32_t)(host_get(host, strings[s]) + host_get(host, "capo"));
    strings_midi(host, 600 * s, 0x90 + s, note, velocity);
  }
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  return sound;
}

/* And six strings at once, as hard as can be, do not clip. */
static void presets_are_about_as_loud(void** state) {
  (void)state;
  Host* const host = open_host();
  double quietest = HUGE_VAL;
  double loudest = -HUGE_VAL;
  for (uint32_t i = 0; i < host_n_presets(host); ++i) {
    Sound usual = strum(host, i, 90);
    Sound hardest = strum(host, i, 127);
    const double peak =
        fmax(measure_peak(hardest.left, N_FRAMES), measure_peak(hardest.right, N_FRAMES));
    const double db = loudness_lufs(usual.left, usual.right, N_FRAMES);
    print_message("%-24s %6.1f LUFS, hardest peak %5.1f dB\n", host_preset_label(host, i), db,
                  20.0 * log10(peak));
    assert_true(peak < 1.0);
    quietest = fmin(quietest, db);
    loudest = fmax(loudest, db);
    sound_free(&usual);
    sound_free(&hardest);
  }
  assert_true(loudest - quietest < MOST_DB);
  host_free(host);
}

static void no_two_presets_sound_alike(void** state) {
  (void)state;
  Host* const host = open_host();
  Sound sounds[MOST_PRESETS];
  const uint32_t n = host_n_presets(host);
  double least = 2.0;
  assert_true(n <= MOST_PRESETS);
  for (uint32_t i = 0; i < n; ++i) {
    sounds[i] = strum(host, i, 100);
    for (uint32_t k = 0; k < i; ++k) {
      least = fmin(least, sound_distance(&sounds[i], &sounds[k]));
    }
  }
  print_message("the nearest two correlate to %g\n", 1.0 - least);
  assert_true(least > 0.01);
  for (uint32_t i = 0; i < n; ++i) {
    sound_free(&sounds[i]);
  }
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_preset_says_what_it_is_and_is_in_range),
      cmocka_unit_test(each_preset_is_in_a_bank),
      cmocka_unit_test(presets_are_about_as_loud),
      cmocka_unit_test(no_two_presets_sound_alike),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
