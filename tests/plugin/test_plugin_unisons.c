/* Strings in unison and two directions through a host: what the ports of the group Unison do. */
#include "tests/support/loudness.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 512, KEY = 69, WINDOW = 960, N_FRAMES = 5 * RATE / 2 };

static const double PI = 3.14159265358979323846;

static Sound play(Host* host, uint32_t block) {
  Sound sound = sound_new(N_FRAMES);
  strings_restart(host);
  strings_note_on(host, 0, KEY, 100);
  strings_run(host, &sound, 0, N_FRAMES, block);
  return sound;
}

static double sounding_with(Host* host, double unisons, double second, double exciter) {
  strings_set(host, "unisons", unisons);
  strings_set(host, "second", second);
  strings_set(host, "exciter", exciter);
  strings_restart(host);
  strings_note_on(host, 0, KEY, 100);
  assert_true(host_run(host, BLOCK));
  return (double)host_get(host, "sounding");
}

static void strings_are_as_many_as_the_ports_say(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  for (double n = 1.0; n <= 3.0; n += 1.0) {
    assert_true(sounding_with(host, n, 0.0, 0.0) == n);
    assert_true(sounding_with(host, n, 0.4, 0.0) == 2.0 * n);
    assert_true(sounding_with(host, n, 0.4, 1.0) == 2.0 * n);
    assert_true(sounding_with(host, n, 0.4, 2.0) == n); /* A bow is drawn one way */
  }
  host_free(host);
}

/* With one string that moves one way they say nothing. */
static void detunes_and_decay_of_none_do_nothing(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound before = play(host, BLOCK);
  strings_set(host, "unison_detune", 20.0);
  strings_set(host, "second_detune", 30.0);
  strings_set(host, "second_decay", 4.0);
  Sound after = play(host, BLOCK);
  assert_true(sound_is_same(&before, &after));
  sound_free(&before);
  sound_free(&after);
  host_free(host);
}

/* Strings in unison that are not detuned are one string of their pitch and decay. */
static void unisons_without_a_detune_are_in_tune(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  strings_set_plain(host);
  strings_set(host, "unison_detune", 0.0);
  for (double n = 2.0; n <= 3.0; n += 1.0) {
    strings_set(host, "unisons", n);
    Sound sound = play(host, BLOCK);
    strings_assert_exact("unisons", strings_measure(&sound, RATE, RATE / 20, N_FRAMES,
                                                    strings_tone(host, KEY, 0.0)));
    sound_free(&sound);
  }
  host_free(host);
}

/* Two strings d cents apart are silent together, over and over, and swell with half their beat:
 * what is heard is A cos(π b t) e^(−t/τ) at their mean pitch, b = 440 (2^(d/2400) − 2^(−d/2400)).
 */
static void two_strings_beat_about_the_pitch_of_the_key(void** state) {
  (void)state;
  static const double detunes[] = {2.0, 4.0, 12.0};
  Host* const host = strings_open(RATE, BLOCK);
  strings_set_plain(host);
  strings_set(host, "unisons", 2.0);
  for (int i = 0; i < 3; ++i) {
    strings_set(host, "unison_detune", detunes[i]);
    Sound sound = play(host, BLOCK);
    const double beat_hz = 440.0 * 2.0 * sinh(detunes[i] * log(2.0) / 2400.0);
    const size_t bottom = (size_t)(0.5 / beat_hz * RATE);
    const double loud = measure_near(sound.left + RATE / 20, WINDOW, RATE, 440.0);
    const double soft = measure_near(sound.left + bottom - WINDOW / 2, WINDOW, RATE, 440.0);
    const double again = measure_near(sound.left + 2 * bottom - WINDOW / 2, WINDOW, RATE, 440.0);
    const double middle_s = 0.05 + 0.5 * WINDOW / RATE;
    const double begun = cos(PI * beat_hz * middle_s) * exp(-0.6 * middle_s);
    print_message("  %4.1f cents: %.2f Hz, %.3f at the bottom\n", detunes[i], beat_hz, soft / loud);
    assert_within("left at the bottom of a beat", soft / loud, 0.01);
    assert_within("after it [dB]", fabs(20.0 * log10(again / loud / exp(-0.6 / beat_hz) * begun)),
                  0.1);
    sound_free(&sound);
  }
  host_free(host);
}

static void groups_are_as_loud_as_one(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  double worst = 0.0;
  double alone = 0.0;
  for (int i = 0; i < 4; ++i) {
    strings_set(host, "unisons", i == 0 ? 1.0 : i);
    strings_set(host, "unison_detune", 7.0 * i);
    strings_set(host, "second", 0.3 * i);
    strings_set(host, "second_detune", 10.0 * i);
    Sound sound = play(host, BLOCK);
    const double lufs = loudness_lufs(sound.left, sound.right, sound.n_frames);
    alone = i == 0 ? lufs : alone;
    worst = fmax(worst, fabs(lufs - alone));
    sound_free(&sound);
  }
  assert_within("dB", worst, 1.0);
  host_free(host);
}

static void blocks_do_not_change_the_sound(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  strings_set(host, "unisons", 3.0);
  strings_set(host, "second", 0.5);
  strings_set(host, "second_decay", 3.0);
  Sound large = play(host, BLOCK);
  Sound small = play(host, 7);
  assert_true(sound_is_same(&large, &small));
  sound_free(&large);
  sound_free(&small);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strings_are_as_many_as_the_ports_say),
      cmocka_unit_test(detunes_and_decay_of_none_do_nothing),
      cmocka_unit_test(unisons_without_a_detune_are_in_tune),
      cmocka_unit_test(two_strings_beat_about_the_pitch_of_the_key),
      cmocka_unit_test(groups_are_as_loud_as_one),
      cmocka_unit_test(blocks_do_not_change_the_sound),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
