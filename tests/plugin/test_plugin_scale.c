/* Keys sound as the player's tuning files say: through a host, measured on the sound. */
#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/scale_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 512, MOST_FRAMES = 120 * RATE, A4 = 69, N_KEYS = 128 };

static const char WHITE_KEYS[] = "white-keys.kbm";

static Host* open_plain(void) {
  Host* const host = strings_open(RATE, BLOCK);
  strings_set_plain(host);
  strings_set(host, "tracking", 0.0);
  return host;
}

/* Decays of 12 periods and more can be measured. */
static ToneError measure_key(Host* host, Sound* sound, uint32_t key, double f0_hz) {
  const double tau_s = fmax(1.0, 16.0 / f0_hz);
  const size_t skip = (size_t)(2.0 * RATE / f0_hz);
  const size_t n_frames = skip + (size_t)(RATE * fmax(0.5, 30.0 / f0_hz));
  assert_true(n_frames <= sound->n_frames);
  strings_set(host, "damping", 1.0 / tau_s);
  strings_restart(host);
  strings_note_on(host, 0, key, 127);
  strings_run(host, sound, 0, n_frames, BLOCK);
  return strings_measure(sound, RATE, skip, n_frames, (Tone){f0_hz, tau_s});
}

static bool is_silent(Host* host, Sound* sound, uint32_t key) {
  strings_restart(host);
  strings_note_on(host, 0, key, 127);
  strings_run(host, sound, 0, 4000, BLOCK);
  return measure_peak(sound->left, 4000) == 0.0 && measure_peak(sound->right, 4000) == 0.0 &&
         host_get(host, "sounding") == 0.0f;
}

/* All keys; how many are silent because the map says so. */
static int check_keys(const char* scale, const char* mapping, double a4_hz) {
  double hz[N_KEYS];
  int n_unmapped = 0;
  ToneError worst = {0};
  Sound sound = sound_new(MOST_FRAMES);
  Host* const host = open_plain();
  strings_set(host, "tuning", a4_hz);
  scale_use(host, scale, mapping);
  scale_expected(scale, mapping, a4_hz, hz);
  for (uint32_t key = 0; key < N_KEYS; ++key) {
    if (isnan(hz[key]) || hz[key] >= 0.5 * RATE) {
      assert_true(is_silent(host, &sound, key));
      n_unmapped += isnan(hz[key]) ? 1 : 0;
    } else if (hz[key] < 0.48 * RATE) {
      worst = strings_worse(worst, measure_key(host, &sound, key, hz[key]));
    }
  }
  strings_assert_exact(scale ? scale : "equal", worst);
  host_free(host);
  sound_free(&sound);
  return n_unmapped;
}

static void every_key_is_as_the_files_say(void** state) {
  static const char* const scales[] = {"just-major.scl", "19-equal.scl", "bohlen-pierce.scl"};
  (void)state;
  for (size_t s = 0; s < 3; ++s) {
    assert_int_equal(check_keys(scales[s], NULL, 440.0), 0);
    /* C sharp, E flat, F sharp, G sharp and B flat, up to G9. */
    assert_int_equal(check_keys(scales[s], WHITE_KEYS, s == 1 ? 466.0 : 440.0), 53);
  }
  assert_int_equal(check_keys(NULL, WHITE_KEYS, 415.0), 53);
}

/* Without reading the file: what its name says. */
static void nineteen_equal_notes_are_so(void** state) {
  (void)state;
  ToneError worst = {0};
  Sound sound = sound_new(MOST_FRAMES);
  Host* const host = open_plain();
  strings_set(host, "tuning", 432.0);
  scale_use(host, "19-equal.scl", NULL);
  for (uint32_t key = 40; key < 100; key += 3) {
    const double hz = 432.0 * exp2(((double)key - A4) / 19.0);
    worst = strings_worse(worst, measure_key(host, &sound, key, hz));
  }
  strings_assert_exact("19 equal notes", worst);
  host_free(host);
  sound_free(&sound);
}

/* What rings when the files come, when A4 moves, and when they go; and bent. */
static void what_rings_goes_to_the_new_pitch(void** state) {
  enum { KEY = 62, STRETCH = RATE };
  double hz[4][N_KEYS];
  ToneError worst = {0};
  (void)state;
  Sound sound = sound_new(4 * STRETCH);
  Host* const host = open_plain();
  strings_set(host, "damping", 0.5);
  scale_expected("19-equal.scl", NULL, 440.0, hz[0]);
  scale_expected("19-equal.scl", WHITE_KEYS, 440.0, hz[1]);
  scale_expected("19-equal.scl", WHITE_KEYS, 415.0, hz[2]);
  scale_expected(NULL, NULL, 415.0, hz[3]);
  strings_note_on(host, 0, KEY, 127);
  for (size_t i = 0; i < 4; ++i) {
    const ScalePath paths[2] = {scale_path("19-equal.scl"), scale_path(WHITE_KEYS)};
    if (i != 2) {
      scale_set(host, SCALE_PARAMETER, i < 3 ? paths[0].text : "");
      scale_set(host, MAPPING_PARAMETER, i == 1 ? paths[1].text : "");
    }
    strings_set(host, "tuning", i < 2 ? 440.0 : 415.0);
    strings_run(host, &sound, i * STRETCH, (i + 1) * STRETCH, BLOCK);
    const Tone asked = {hz[i][KEY], 2.0};
    /* A block until it is there, and a gesture of 4 ms. */
    const size_t from = i * STRETCH + 2 * BLOCK + RATE / 100;
    worst = strings_worse(worst, strings_measure(&sound, RATE, from, (i + 1) * STRETCH, asked));
  }
  strings_assert_exact("what rings", worst);
  host_free(host);
  sound_free(&sound);
}

static void what_loses_its_key_falls_silent(void** state) {
  (void)state;
  Sound sound = sound_new(RATE);
  Host* const host = open_plain();
  strings_note_on(host, 0, 61, 127);
  strings_run(host, &sound, 0, 4096, BLOCK);
  assert_true(host_get(host, "sounding") == 1.0f);
  const ScalePath path = scale_path(WHITE_KEYS);
  scale_set(host, MAPPING_PARAMETER, path.text);
  strings_run(host, &sound, 4096, RATE / 4, BLOCK);
  assert_true(host_get(host, "sounding") == 0.0f);
  host_free(host);
  sound_free(&sound);
}

/* The sound of an instrument that never heard of scales. */
static void without_files_it_sounds_as_ever(void** state) {
  (void)state;
  Sound sounds[3];
  for (int i = 0; i < 3; ++i) {
    Host* const host = strings_open(RATE, BLOCK);
    sounds[i] = sound_new(8192);
    if (i > 0) {
      scale_use(host, i == 1 ? "just-major.scl" : NULL, i == 1 ? WHITE_KEYS : NULL);
      scale_use(host, NULL, NULL);
      strings_restart(host);
    }
    strings_bend(host, 100, 0.7);
    for (uint32_t key = 20; key < 120; key += 9) {
      strings_note_on(host, key, key, 100);
    }
    strings_run(host, &sounds[i], 0, 8192, BLOCK);
    assert_true(sound_is_same(&sounds[0], &sounds[i]));
    host_free(host);
  }
  for (int i = 0; i < 3; ++i) {
    sound_free(&sounds[i]);
  }
}

/* Stop, start and bypass are no reason to forget. */
static void it_keeps_its_scale_when_it_is_restarted(void** state) {
  double hz[N_KEYS];
  (void)state;
  Sound sound = sound_new(MOST_FRAMES);
  Host* const host = open_plain();
  scale_use(host, "bohlen-pierce.scl", NULL);
  scale_expected("bohlen-pierce.scl", NULL, 440.0, hz);
  for (int i = 0; i < 3; ++i) {
    strings_restart(host);
    strings_set(host, "enabled", i == 1 ? 0.0 : 1.0);
    assert_true(host_run(host, 0) && host_run(host, 64));
  }
  strings_assert_exact("after a restart", measure_key(host, &sound, 75, hz[75]));
  host_free(host);
  sound_free(&sound);
}

/* Asked in the run in which the worker reads another, it tells of what is heard. */
static void what_is_played_is_not_written_over(void** state) {
  (void)state;
  Host* const host = open_plain();
  host_worker(host)->mode = HOST_WORK_IN_RUN;
  scale_use(host, "19-equal.scl", NULL);
  for (int i = 0; i < 4; ++i) {
    const ScalePath heard = scale_path(i % 2 ? "meantone.scl" : "19-equal.scl");
    const ScalePath wanted = scale_path(i % 2 ? "19-equal.scl" : "meantone.scl");
    ScalePath told;
    scale_set(host, SCALE_PARAMETER, wanted.text);
    scale_get(host, SCALE_PARAMETER);
    assert_true(host_run(host, BLOCK));
    assert_true(scale_told(host, SCALE_PARAMETER, &told));
    assert_string_equal(told.text, heard.text);
    assert_true(host_run(host, BLOCK));
    assert_true(scale_told(host, SCALE_PARAMETER, &told));
    assert_string_equal(told.text, wanted.text);
  }
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_key_is_as_the_files_say),
      cmocka_unit_test(nineteen_equal_notes_are_so),
      cmocka_unit_test(what_rings_goes_to_the_new_pitch),
      cmocka_unit_test(what_loses_its_key_falls_silent),
      cmocka_unit_test(without_files_it_sounds_as_ever),
      cmocka_unit_test(what_is_played_is_not_written_over),
      cmocka_unit_test(it_keeps_its_scale_when_it_is_restarted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
