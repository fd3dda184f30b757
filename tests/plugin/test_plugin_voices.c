/* Which strings sound, how loud, and on which side. */
#include "tests/support/loudness.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <lv2/atom/atom.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 480, N_KEYS = 128 };

/* Of the peak: some dozens of roundings to float, 6e-8 each, while coefficients stand still. */
static const double ROUNDING = 3e-6;

static void play_nonsense(Host* host) {
  static const struct {
    uint32_t size;
    uint8_t bytes[8];
  } messages[] = {
      {0, {0}},
      {1, {0x90}},
      {2, {0x90, 64}},
      {2, {0x80, 60}},
      {4, {0x80, 60, 0, 0}},
      {4, {0x90, 64, 100, 0}},
      {8, {0x90, 64, 100, 0x90, 65, 100, 0, 0}},
      {3, {0x90, 0xC0, 100}},
      {3, {0x80, 60, 0xFF}},
      {3, {0xB0, 120, 0x80}},
      {3, {60, 64, 100}},
      {3, {0x00, 120, 0}},
      {2, {0xC0, 127}},
      {3, {0xD0, 127, 0}},
      {2, {0xA0, 60}},
      {3, {0xB0, 3, 127}},
      {3, {0xB0, 9, 0}},
      {3, {0xB0, 14, 0}},
      {3, {0xB0, 85, 127}},
      {3, {0xB0, 122, 0}},
      {6, {0xF0, 0x7E, 0x7F, 0x09, 0x01, 0xF7}},
      {3, {0xF0, 0x7E, 0xF7}},
      {2, {0xF1, 1}},
      {3, {0xF2, 120, 0}},
      {1, {0xF8}},
      {1, {0xFC}},
      {1, {0xFE}},
      {1, {0xFF}},
  };
  for (uint32_t i = 0; i < sizeof(messages) / sizeof(messages[0]); ++i) {
    assert_true(host_midi(host, 1000 + 100 * i, messages[i].bytes, messages[i].size));
    assert_true(
        host_atom(host, 1050 + 100 * i, LV2_ATOM__Chunk, messages[i].bytes, messages[i].size));
  }
}

static void what_is_unknown_or_broken_is_ignored(void** state) {
  (void)state;
  Sound sounds[2] = {sound_new(RATE), sound_new(RATE)};
  for (int i = 0; i < 2; ++i) {
    Host* const host = strings_open(RATE, BLOCK);
    strings_note_on(host, 5, 60, 100);
    if (i == 1) {
      play_nonsense(host);
    }
    strings_note_off(host, RATE / 2, 60);
    strings_run(host, &sounds[i], 0, RATE, BLOCK);
    host_free(host);
  }
  assert_true(measure_peak(sounds[0].left, RATE) > 0.01);
  assert_true(sound_is_same(&sounds[0], &sounds[1]));
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
}

/* The finger stops the string first: plucked again it sounds as it did, whatever it was doing. */
static void check_second_pluck(Host* host, size_t gap) {
  enum { ONSET = RATE / 50 };
  Sound twice = sound_new(RATE);
  Sound once = sound_new(RATE);
  double worst = 0.0;
  strings_restart(host);
  strings_note_on(host, 0, 57, 90);
  strings_run(host, &once, 0, RATE, BLOCK);
  strings_restart(host);
  strings_note_on(host, 0, 57, 90);
  strings_note_on(host, gap, 57, 90);
  strings_run(host, &twice, 0, RATE, BLOCK);
  for (size_t i = gap + ONSET; i < RATE; ++i) {
    worst = fmax(worst, fabs((double)twice.left[i] - (double)once.left[i - gap]));
  }
  assert_within("plucked again against once", worst / measure_peak(once.left, RATE), ROUNDING);
  assert_true(host_get(host, "sounding") == 1.0f);
  sound_free(&twice);
  sound_free(&once);
}

static void plucking_what_rings_stops_it_first(void** state) {
  static const size_t gaps[] = {0, 1, 17, 1000, 4800, 20000};
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  for (int i = 0; i < 6; ++i) {
    check_second_pluck(host, gaps[i]);
  }
  host_free(host);
}

static void every_key_below_nyquist_has_a_string_of_its_own(void** state) {
  static const double rates_hz[] = {8000.0, 22050.0, 96000.0, 192000.0};
  (void)state;
  for (int r = 0; r < 4; ++r) {
    Host* const host = strings_open(rates_hz[r], BLOCK);
    Sound sound = sound_new(2 * BLOCK);
    unsigned n_keys = 0;
    strings_set(host, "masses", 16.0);
    strings_set(host, "tracking", 0.0);
    strings_set(host, "damping", 0.02);
    for (uint32_t key = 0; key < N_KEYS; ++key) {
      /* The topmost 0.7 % below Nyquist cannot be had. */
      const double nyquists = strings_tone(host, key, 0.0).f0_hz / (0.5 * rates_hz[r]);
      assert_true(nyquists < 0.993 || nyquists >= 1.0);
      n_keys += nyquists < 1.0;
      strings_note_on(host, key, key, 100);
    }
    strings_run(host, &sound, 0, 2 * BLOCK, BLOCK);
    print_message("%g Hz: %u strings\n", rates_hz[r], n_keys);
    assert_true(host_get(host, "sounding") == (float)n_keys);
    assert_true(n_keys == N_KEYS || rates_hz[r] < 30000.0);
    sound_free(&sound);
    host_free(host);
  }
}

static void a_key_at_or_above_nyquist_is_silent(void** state) {
  static const double rates_hz[] = {8000.0, 22050.0};
  (void)state;
  for (int r = 0; r < 2; ++r) {
    Host* const host = strings_open(rates_hz[r], BLOCK);
    Sound sound = sound_new(2 * BLOCK);
    for (uint32_t key = 0; key < N_KEYS; ++key) {
      const bool can_sound = strings_tone(host, key, 0.0).f0_hz < 0.5 * rates_hz[r];
      strings_restart(host);
      strings_note_on(host, 3, key, 127);
      strings_run(host, &sound, 0, 2 * BLOCK, BLOCK);
      assert_int_equal(measure_peak(sound.left, 2 * BLOCK) > 0.0, can_sound);
      assert_true(host_get(host, "sounding") == (can_sound ? 1.0f : 0.0f));
    }
    sound_free(&sound);
    host_free(host);
  }
}

/* Asleep is exact zeros, and it falls asleep when the asked decay has come to −120 dB. */
static void what_has_died_is_exact_zeros(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(3 * RATE);
  strings_set(host, "damping", 8.0);
  strings_set(host, "tracking", 0.0);
  strings_note_on(host, 0, 69, 127);
  strings_run(host, &sound, 0, RATE, BLOCK);
  assert_true(host_get(host, "sounding") == 1.0f);
  strings_run(host, &sound, RATE, 3 * RATE, BLOCK);
  assert_true(host_get(host, "sounding") == 0.0f);
  assert_true(host_get(host, "mass_count") == 0.0f);
  assert_true(host_get(host, "headroom") == 1.0f);
  size_t end = sound.n_frames;
  while (end > 0 && sound.left[end - 1] == 0.0f && sound.right[end - 1] == 0.0f) {
    --end;
  }
  const double decays = (double)end / RATE * 8.0; /* 120 dB are 13.8 of them */
  print_message("asleep after %g τ\n", decays);
  assert_true(decays > 13.0 && decays < 15.0);
  sound_free(&sound);
  host_free(host);
}

/* Dead long before the first look at whether they are, when nothing is left of them but the
 * smallest floats. */
static void the_shortest_notes_end_too(void** state) {
  static const double rates_hz[] = {8000.0, 44100.0, 192000.0};
  (void)state;
  for (int r = 0; r < 3; ++r) {
    Host* const host = strings_open(rates_hz[r], BLOCK);
    Sound sound = sound_new((size_t)rates_hz[r]);
    strings_set(host, "damping", 200.0);
    strings_set(host, "tracking", 1.0);
    for (uint32_t key = 30; key < N_KEYS; ++key) {
      strings_note_on(host, key, key, 1 + key % 127);
    }
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    assert_true(measure_peak(sound.left, sound.n_frames) > 0.0);
    assert_true(host_get(host, "sounding") == 0.0f);
    sound_free(&sound);
    host_free(host);
  }
}

static void masses_hold_from_the_next_pluck(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(4 * BLOCK);
  strings_set(host, "masses", 37.0);
  strings_note_on(host, 0, 40, 100);
  strings_run(host, &sound, 0, BLOCK, BLOCK);
  assert_true(host_get(host, "mass_count") == 37.0f);
  strings_set(host, "masses", 5.0);
  strings_run(host, &sound, BLOCK, 2 * BLOCK, BLOCK);
  assert_true(host_get(host, "mass_count") == 37.0f);
  strings_note_on(host, 0, 41, 100);
  strings_run(host, &sound, 2 * BLOCK, 3 * BLOCK, BLOCK);
  assert_true(host_get(host, "mass_count") == 42.0f);
  strings_note_on(host, 0, 40, 100);
  strings_run(host, &sound, 3 * BLOCK, 4 * BLOCK, BLOCK);
  assert_true(host_get(host, "mass_count") == 10.0f);
  sound_free(&sound);
  host_free(host);
}

/* One key at full velocity neither clips nor is weak: between −24 and 0 dB of full scale. */
static void a_note_is_neither_weak_nor_clipped(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(RATE / 2);
  double loudest = 0.0;
  double weakest = 1.0;
  for (uint32_t key = 33; key <= 96; ++key) {
    strings_restart(host);
    strings_note_on(host, 0, key, 127);
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    const double left = measure_peak(sound.left, sound.n_frames);
    const double right = measure_peak(sound.right, sound.n_frames);
    loudest = fmax(loudest, fmax(left, right));
    weakest = fmin(weakest, fmin(left, right));
  }
  print_message("peaks from %.1f to %.1f dB\n", 20.0 * log10(weakest), 20.0 * log10(loudest));
  assert_true(loudest < 1.0 && weakest > pow(10.0, -24.0 / 20.0));
  sound_free(&sound);
  host_free(host);
}

/* Mean frequency of the power, as rms of the slope over rms [rad per sample]. */
static double brightness(const Sound* sound) {
  double slope = 0.0;
  for (size_t i = 1; i < sound->n_frames; ++i) {
    const double difference = (double)sound->left[i] - (double)sound->left[i - 1];
    slope += difference * difference;
  }
  return sqrt(slope / (double)sound->n_frames) / measure_rms(sound->left, sound->n_frames);
}

/* To the ear, as the square of the velocity; and brighter from step to step. */
static void velocity_makes_it_louder_and_brighter(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(RATE);
  double full_before = 0.0;
  double brightness_before = 0.0;
  for (uint32_t velocity = 1; velocity <= 127; velocity += 14) {
    strings_restart(host);
    strings_note_on(host, 0, 45, velocity);
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    const double lufs = loudness_lufs(sound.left, sound.right, sound.n_frames);
    const double bright = brightness(&sound);
    print_message("velocity %3u: %.2f LUFS, brightness %.4f\n", velocity, lufs, bright);
    const double full = lufs - 40.0 * log10(velocity / 127.0);
    assert_true(bright > brightness_before);
    assert_true(velocity == 1 || fabs(full - full_before) < 0.1);
    full_before = full;
    brightness_before = bright;
  }
  sound_free(&sound);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_unknown_or_broken_is_ignored),
      cmocka_unit_test(plucking_what_rings_stops_it_first),
      cmocka_unit_test(every_key_below_nyquist_has_a_string_of_its_own),
      cmocka_unit_test(a_key_at_or_above_nyquist_is_silent),
      cmocka_unit_test(what_has_died_is_exact_zeros),
      cmocka_unit_test(the_shortest_notes_end_too),
      cmocka_unit_test(masses_hold_from_the_next_pluck),
      cmocka_unit_test(a_note_is_neither_weak_nor_clipped),
      cmocka_unit_test(velocity_makes_it_louder_and_brighter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
