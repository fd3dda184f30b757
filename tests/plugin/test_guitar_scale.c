/* Strings and frets are tuned as their keys are: through a host, measured on the sound. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/scale_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256, N_FRAMES = RATE, N_STRINGS = 6 };

static const double MOST_CENTS = 1e-3;
static const uint32_t open_notes[N_STRINGS] = {64, 59, 55, 50, 45, 40};

static Host* open_tuned(const char* scale, const char* mapping) {
  Host* const host = guitar_open(RATE, BLOCK);
  guitar_set_plain(host);
  strings_set(host, "tracking", 0.0);
  strings_set(host, "damping", 1.0);
  if (scale) {
    scale_set(host, GUITAR_URI "#scale", scale_path(scale).text);
  }
  if (mapping) {
    scale_set(host, GUITAR_URI "#mapping", scale_path(mapping).text);
  }
  assert_true(host_run(host, BLOCK) && host_run(host, BLOCK));
  return host;
}

static void assert_hz(const Sound* sound, size_t from, size_t to, double hz) {
  const Tone asked = {hz, 1.0};
  assert_within("pitch [cents]", strings_measure(sound, RATE, from, to, asked).cents, MOST_CENTS);
}

/* Each string by its channel, open and at every third fret; with a capo, too. */
static void every_fret_has_the_pitch_of_its_key(void** state) {
  static const char* const scales[] = {"pythagorean.scl", "19-equal.scl", "bohlen-pierce.scl"};
  (void)state;
  for (size_t i = 0; i < 3; ++i) {
    double hz[128];
    Host* const host = open_tuned(scales[i], NULL);
    scale_expected(scales[i], NULL, 440.0, hz);
    strings_set(host, "mode", 1.0);
    for (uint32_t string = 0; string < N_STRINGS; ++string) {
      for (uint32_t fret = 0; fret < 16; fret += 3) {
        const uint32_t key = open_notes[string] + fret;
        Sound sound = sound_new(N_FRAMES);
        strings_set(host, "capo", fret % 2 ? 2.0 : 0.0);
        strings_restart(host);
        strings_midi(host, 0, 0x90 + string, key, 127);
        strings_run(host, &sound, 0, N_FRAMES, BLOCK);
        assert_hz(&sound, RATE / 20, N_FRAMES, hz[key]);
        sound_free(&sound);
      }
    }
    host_free(host);
  }
}

/* All keys an octave up: an open string is then as one that is tuned so, to the last bit, and has
 * all of its masses. */
static void an_open_string_is_tuned_and_not_stopped(void** state) {
  Sound sounds[2] = {sound_new(N_FRAMES), sound_new(N_FRAMES)};
  const ScalePath directory = scale_new_directory();
  const ScalePath mapping = scale_write(&directory, "a.kbm", "0\n0\n127\n60\n69\n880\n0\n");
  (void)state;
  for (uint32_t i = 0; i < 2; ++i) {
    Host* const host = open_tuned(NULL, NULL);
    strings_set(host, "mode", 1.0);
    if (i == 0) {
      scale_set(host, GUITAR_URI "#mapping", mapping.text);
      assert_true(host_run(host, BLOCK) && host_run(host, BLOCK));
    } else {
      strings_set(host, "string6", 52.0);
    }
    strings_restart(host);
    strings_midi(host, 0, 0x95, i == 0 ? 40 : 52, 127);
    strings_run(host, &sounds[i], 0, N_FRAMES, BLOCK);
    host_free(host);
  }
  assert_true(sound_is_same(&sounds[0], &sounds[1]));
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
  scale_remove_directory(&directory);
}

/* With mode 0 the guitarist finds the string; the black keys play nothing. */
static void keys_without_a_pitch_play_nothing(void** state) {
  double hz[128];
  (void)state;
  Host* const host = open_tuned("just-major.scl", "white-keys.kbm");
  scale_expected("just-major.scl", "white-keys.kbm", 440.0, hz);
  for (uint32_t key = 40; key < 76; key += 5) {
    Sound sound = sound_new(N_FRAMES);
    strings_restart(host);
    strings_note_on(host, 0, key, 127);
    strings_run(host, &sound, 0, N_FRAMES, BLOCK);
    if (isnan(hz[key])) {
      assert_true(measure_peak(sound.left, N_FRAMES) == 0.0);
    } else {
      assert_hz(&sound, RATE / 20, N_FRAMES, hz[key]);
    }
    sound_free(&sound);
  }
  host_free(host);
}

static double between(const double hz[128], double note) {
  const int below = (int)floor(note);
  return hz[below] * pow(hz[below + 1] / hz[below], note - below);
}

/* What a score's hands do: fretted, half a fret up, slid and bent; the string is G. */
static void hands_of_a_score_find_the_frets_of_the_scale(void** state) {
  static const struct {
    uint32_t verb;
    float a, b;
    double key, bend;
  } acts[] = {
      {GUITAR_FRET, 5.0f, 0.0f, 60.0, 0.0},   {GUITAR_FRET, 0.0f, 0.0f, 55.0, 0.0},
      {GUITAR_FRET, 2.5f, 0.0f, 57.5, 0.0},   {GUITAR_SLIDE, 7.0f, 0.05f, 62.0, 0.0},
      {GUITAR_HAMMER, 4.0f, 0.8f, 59.0, 0.0}, {GUITAR_BEND, 1.5f, 0.02f, 55.0, 1.5},
  };
  double hz[128];
  (void)state;
  scale_expected("pythagorean.scl", NULL, 440.0, hz);
  Host* const host = open_tuned("pythagorean.scl", NULL);
  for (size_t i = 0; i < sizeof(acts) / sizeof(*acts); ++i) {
    Sound sound = sound_new(N_FRAMES);
    strings_restart(host);
    guitar_send(host, 0, (GuitarEvent){GUITAR_PLUCK, 2, {1.0f, 0.45f, 0.0f}});
    guitar_send(host, 100, (GuitarEvent){acts[i].verb, 2, {acts[i].a, acts[i].b, 0.0f}});
    strings_run(host, &sound, 0, N_FRAMES, BLOCK);
    assert_hz(&sound, RATE / 5, N_FRAMES, between(hz, acts[i].key) * exp2(acts[i].bend / 12.0));
    sound_free(&sound);
  }
  host_free(host);
}

/* A harmonic at the twelfth fret is an octave above the string, whatever the scale. */
static void a_harmonic_is_of_the_string_as_it_is_tuned(void** state) {
  double hz[128];
  Sound sound = sound_new(N_FRAMES);
  (void)state;
  scale_expected("pythagorean.scl", NULL, 440.0, hz);
  Host* const host = open_tuned("pythagorean.scl", NULL);
  guitar_send(host, 0, (GuitarEvent){GUITAR_PLUCK, 4, {1.0f, 0.25f, 0.5f}});
  guitar_send(host, 1, (GuitarEvent){GUITAR_TOUCH, 4, {0.5f, 0.2f, 0.0f}});
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  assert_within("an octave [cents]",
                strings_measure(&sound, RATE, RATE / 3, N_FRAMES, (Tone){2.0 * hz[45], 1.0}).cents,
                3.0);
  sound_free(&sound);
  host_free(host);
}

/* It is chosen while a note sounds, which goes there; and taken away, which brings it back. */
static void what_sounds_follows_the_file(void** state) {
  double hz[128];
  Sound sound = sound_new(3 * N_FRAMES);
  (void)state;
  scale_expected("19-equal.scl", NULL, 440.0, hz);
  Host* const host = open_tuned(NULL, NULL);
  strings_set(host, "damping", 0.3);
  strings_note_on(host, 0, 57, 127);
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  scale_set(host, GUITAR_URI "#scale", scale_path("19-equal.scl").text);
  strings_run(host, &sound, N_FRAMES, 2 * N_FRAMES, BLOCK);
  scale_set(host, GUITAR_URI "#scale", "");
  strings_run(host, &sound, 2 * N_FRAMES, 3 * N_FRAMES, BLOCK);
  assert_hz(&sound, RATE / 20, N_FRAMES, 220.0);
  assert_hz(&sound, N_FRAMES + RATE / 20, 2 * N_FRAMES, hz[57]);
  assert_hz(&sound, 2 * N_FRAMES + RATE / 20, 3 * N_FRAMES, 220.0);
  sound_free(&sound);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_fret_has_the_pitch_of_its_key),
      cmocka_unit_test(an_open_string_is_tuned_and_not_stopped),
      cmocka_unit_test(keys_without_a_pitch_play_nothing),
      cmocka_unit_test(hands_of_a_score_find_the_frets_of_the_scale),
      cmocka_unit_test(a_harmonic_is_of_the_string_as_it_is_tuned),
      cmocka_unit_test(what_sounds_follows_the_file),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
