/* Every preset loads, says what it is, is in range and in tune, and sounds like no other; and what
 * a session saves is what it gets back. */
#include "tests/support/host_inside.h"
#include "tests/support/host_state.h"
#include "tests/support/loudness.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/presets.h"
#include "tests/support/random.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 1024, LEAST_PRESETS = 32, MOST_PRESETS = 64, N_FRAMES = 2 * RATE };

static const uint32_t keys[] = {40, 60, 76};

static Host* open_host(void) {
  return strings_open(RATE, BLOCK);
}

static bool is_struck(const Host* host) {
  return host_get(host, "exciter") == 1.0f;
}

static bool is_bowed(const Host* host) {
  return host_get(host, "exciter") == 2.0f;
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

static Sound play(Host* host, uint32_t key, uint32_t velocity) {
  Sound sound = sound_new(N_FRAMES);
  strings_restart(host);
  strings_note_on(host, 0, key, velocity);
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  return sound;
}

/* A label and a URI load the same. */
static void label_and_uri_name_the_same_preset(void** state) {
  (void)state;
  Host* const by_label = open_host();
  Host* const by_uri = open_host();
  for (uint32_t i = 0; i < host_n_presets(by_uri); ++i) {
    assert_true(host_preset(by_label, host_preset_label(by_label, i)));
    assert_true(host_preset(by_uri, host_preset_uri(by_uri, i)));
    Sound a = play(by_label, 50, 100);
    Sound b = play(by_uri, 50, 100);
    assert_true(sound_is_same(&a, &b));
    sound_free(&a);
    sound_free(&b);
  }
  host_free(by_label);
  host_free(by_uri);
}

static void note_peaks(const Sound* sound, double* quietest, double* loudest) {
  const double left = measure_peak(sound->left, sound->n_frames);
  const double right = measure_peak(sound->right, sound->n_frames);
  *quietest = fmin(*quietest, fmin(left, right));
  *loudest = fmax(*loudest, fmax(left, right));
  assert_true(isfinite(left) && isfinite(right));
}

/* What measure_tone() needs is 12 periods in a decay. */
static ToneError check_key(Host* host, uint32_t key, double* quietest, double* loudest) {
  const Tone asked = strings_tone(host, key, 0.0);
  const size_t from = (size_t)(2.0 * RATE / asked.f0_hz) + (is_struck(host) ? RATE / 8 : 0);
  Sound sound = play(host, key, 127);
  note_peaks(&sound, quietest, loudest);
  assert_true(asked.f0_hz * asked.tau_s >= 12.0);
  const ToneError error = strings_measure(&sound, RATE, from, N_FRAMES, asked);
  sound_free(&sound);
  return error;
}

/* While a bow is drawn there is no decay, and the pitch is within three cents; once it is lifted,
 * with the pedal down, both are exact. */
static ToneError check_bowed_key(Host* host, uint32_t key, double* quietest, double* loudest) {
  const Tone asked = strings_tone(host, key, 0.0);
  const Tone bowed = {asked.f0_hz, 1e3};
  Tone heard = {0};
  Sound sound = sound_new(2 * N_FRAMES);
  strings_restart(host);
  strings_controller(host, 0, STRINGS_PEDAL, 127);
  strings_note_on(host, 0, key, 127);
  strings_note_off(host, N_FRAMES, key);
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  note_peaks(&sound, quietest, loudest);
  assert_true(measure_tone(sound.left + RATE / 2, N_FRAMES - RATE / 2, RATE, bowed, &heard));
  const double cents = fabs(measure_cents(heard.f0_hz, asked.f0_hz));
  print_message("  key %u is bowed", key);
  assert_within(", cents", cents, 3.0);
  assert_true(measure_rms(sound.left + N_FRAMES - RATE / 4, RATE / 4) >
              0.9 * measure_rms(sound.left + RATE / 2, RATE / 4));
  const ToneError error =
      strings_measure(&sound, RATE, N_FRAMES + RATE / 16, sound.n_frames, asked);
  sound_free(&sound);
  return error;
}

/* One string of each key, in one direction, not stretched, and without what rings of its body: what
 * is exact of a group is its mean. */
static void play_one_string(Host* host) {
  strings_set(host, "unisons", 1.0);
  strings_set(host, "second", 0.0);
  strings_set(host, "tension", 0.0);
  strings_set(host, "body_mix", 0.0);
}

/* Audible, above −40 dB, and not clipped: below 0 dB. */
static void every_preset_sounds_and_is_in_tune(void** state) {
  (void)state;
  Host* const host = open_host();
  ToneError worst = {0};
  for (uint32_t i = 0; i < host_n_presets(host); ++i) {
    double quietest = HUGE_VAL;
    double loudest = 0.0;
    ToneError own = {0};
    assert_true(host_preset(host, host_preset_uri(host, i)));
    play_one_string(host);
    for (int k = 0; k < 3; ++k) {
      const ToneError error = is_bowed(host) ? check_bowed_key(host, keys[k], &quietest, &loudest)
                                             : check_key(host, keys[k], &quietest, &loudest);
      own = strings_worse(own, error);
    }
    worst = strings_worse(worst, own);
    print_message("%-20s %5.1f to %5.1f dB, %.1e cents, τ %.1e\n", host_preset_label(host, i),
                  20.0 * log10(quietest), 20.0 * log10(loudest), own.cents, own.decay);
    assert_true(quietest > 0.01 && loudest < 1.0);
  }
  strings_assert_exact("all presets", worst);
  host_free(host);
}

/* A chord as it is usually played. */
static void presets_are_about_as_loud(void** state) {
  (void)state;
  static const uint32_t chord[] = {48, 55, 60, 64};
  double quietest = HUGE_VAL;
  double loudest = -HUGE_VAL;
  Host* const host = open_host();
  for (uint32_t i = 0; i < host_n_presets(host); ++i) {
    Sound sound = sound_new(N_FRAMES);
    assert_true(host_preset(host, host_preset_uri(host, i)));
    strings_restart(host);
    for (size_t k = 0; k < sizeof(chord) / sizeof(chord[0]); ++k) {
      strings_note_on(host, 0, chord[k], 90);
    }
    strings_run(host, &sound, 0, N_FRAMES, BLOCK);
    const double lufs = loudness_lufs(sound.left, sound.right, N_FRAMES);
    print_message("%-20s %5.1f LUFS\n", host_preset_label(host, i), lufs);
    quietest = fmin(quietest, lufs);
    loudest = fmax(loudest, lufs);
    sound_free(&sound);
  }
  host_free(host);
  assert_within("dB from the middle", 0.5 * (loudest - quietest), 3.0);
}

static void no_two_presets_sound_alike(void** state) {
  (void)state;
  Host* const host = open_host();
  Sound sounds[MOST_PRESETS];
  const uint32_t n = host_n_presets(host);
  uint32_t nearest[2] = {0};
  double least = 2.0;
  assert_true(n <= MOST_PRESETS);
  for (uint32_t i = 0; i < n; ++i) {
    assert_true(host_preset(host, host_preset_uri(host, i)));
    sounds[i] = play(host, 52, 100);
    for (uint32_t k = 0; k < i; ++k) {
      const double distance = sound_distance(&sounds[i], &sounds[k]);
      nearest[0] = distance < least ? i : nearest[0];
      nearest[1] = distance < least ? k : nearest[1];
      least = fmin(least, distance);
    }
  }
  print_message("the nearest two, %s and %s, correlate to %g\n",
                host_preset_label(host, nearest[0]), host_preset_label(host, nearest[1]),
                1.0 - least);
  assert_true(least > 0.01);
  for (uint32_t i = 0; i < n; ++i) {
    sound_free(&sounds[i]);
  }
  host_free(host);
}

static void set_at_random(Host* host, Random* random) {
  HostRange range;
  for (uint32_t i = 0; i < host_n_ports(host); ++i) {
    const char* const symbol = host_port_symbol(host, i);
    if (host_range(host, symbol, &range) && strcmp(symbol, "enabled") != 0) {
      const double value = random_between(random, (double)range.min, (double)range.max);
      const double digits = range.is_integer ? 1.0 : 1e6; /* Turtle has eight behind the point */
      strings_set(host, symbol, round(value * digits) / digits);
    }
  }
  strings_set(host, "pickup", 0.3);
  strings_set(host, "level", -3.0);
}

/* From the one instance to another, as text. */
static void a_saved_state_sounds_the_same(void** state) {
  (void)state;
  Random random = random_start();
  for (int i = 0; i < 5; ++i) {
    Host* const first = open_host();
    Host* const second = open_host();
    set_at_random(first, &random);
    LilvState* const saved = host_save_state(first);
    assert_non_null(saved);
    char* const turtle = host_state_to_string(first, saved);
    assert_non_null(turtle);
    LilvState* const read = host_state_from_string(second, turtle);
    assert_non_null(read);
    host_restore_state(second, read);
    Sound a = play(first, 57, 90);
    Sound b = play(second, 57, 90);
    assert_true(measure_peak(a.left, N_FRAMES) > 1e-3);
    assert_true(sound_is_same(&a, &b));
    sound_free(&a);
    sound_free(&b);
    lilv_free(turtle);
    lilv_state_free(saved);
    lilv_state_free(read);
    host_free(first);
    host_free(second);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_preset_says_what_it_is_and_is_in_range),
      cmocka_unit_test(each_preset_is_in_a_bank),
      cmocka_unit_test(label_and_uri_name_the_same_preset),
      cmocka_unit_test(every_preset_sounds_and_is_in_tune),
      cmocka_unit_test(presets_are_about_as_loud),
      cmocka_unit_test(no_two_presets_sound_alike),
      cmocka_unit_test(a_saved_state_sounds_the_same),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
