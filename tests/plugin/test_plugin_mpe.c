/* Zones, ranges and tunings through a host: every pitch that they ask for is measured. */
#include "tests/support/measure.h"
#include "tests/support/mpe_files.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Of a member at first, in semitones. */
static double member_bend(int wheel) {
  return 48.0 * wheel / 8192.0;
}

/* One of two tones whose lowest partials are `spacing_hz` apart at least. */
static double
cents_among(const Sound* sound, double from_s, double to_s, Tone asked, double spacing_hz) {
  const size_t from = (size_t)lround((from_s + 0.05) * MPE_RATE);
  const size_t to = (size_t)lround(to_s * MPE_RATE);
  Tone heard = {0};
  assert_true(measure_partial(sound->left + from, to - from, MPE_RATE, asked, spacing_hz, &heard));
  return fabs(measure_cents(heard.f0_hz, asked.f0_hz));
}

/* They are 3.498 and −2.25 semitones from the key: the lower one's second partial and first are 0.4
 * and 0.6 of its fundamental from the higher one's. */
static void one_key_on_two_channels_has_two_pitches(void** state) {
  (void)state;
  Host* const host = mpe_open();
  Sound sound = mpe_play(host, "apart", 4.25, MPE_BLOCK);
  const Tone high = strings_tone(host, 60, member_bend(597));
  const Tone low = strings_tone(host, 60, member_bend(-384));
  const double spacing_hz = high.f0_hz - low.f0_hz;
  for (int part = 0; part < 2; ++part) {
    const double from_s = part ? 2.25 : 0.25;
    const double to_s = part ? 4.25 : 2.25;
    assert_within("high [cents]", cents_among(&sound, from_s, to_s, high, spacing_hz), 0.005);
    assert_within("low [cents]", cents_among(&sound, from_s, to_s, low, spacing_hz), 0.005);
  }
  sound_free(&sound);
  host_free(host);
}

/* How exact a note is that rings from `from_s` on, bent by `bend`.  What is bent down by octaves
 * while it rings swings wider, and the limiter would have a word in it. */
static void check_bent(const char* name, uint32_t key, double bend, double from_s, double to_s) {
  Host* const host = mpe_open();
  strings_set(host, "damping", 0.2);
  strings_set(host, "loss", 1e-5);
  strings_set(host, "limiter", 0.0);
  Sound sound = mpe_play(host, name, to_s, MPE_BLOCK);
  const ToneError error = mpe_measure(&sound, from_s, to_s, strings_tone(host, key, bend));
  strings_assert_exact(name, error);
  sound_free(&sound);
  host_free(host);
}

static void members_bend_exactly_by_48_semitones(void** state) {
  (void)state;
  check_bent("wide", 60, member_bend(8191), 0.5, 1.5);
  check_bent("wide", 60, member_bend(-3072) - 2.0, 1.5, 5.5);
  check_bent("deep", 79, -48.0, 0.5, 4.5);
}

static void members_bend_exactly_by_96_semitones(void** state) {
  (void)state;
  check_bent("widest", 21, 96.0 * 8191.0 / 8192.0, 1.0, 4.0);
  check_bent("deepest", 124, -96.0, 0.125, 4.0);
}

static void ranges_and_tunings_are_exact(void** state) {
  (void)state;
  const double range = 0.5 * 7.25;
  const double fine = (84 * 128 + 17 - 8192) / 8192.0;
  check_bent("tuned", 60, 1.0, 0.0625, 1.0);
  check_bent("tuned", 60, range, 1.0, 2.0);
  check_bent("tuned", 60, range + fine, 2.0, 3.0);
  check_bent("tuned", 60, range + fine - 5.0, 3.0, 5.0);
}

/* It is the fourth below the new note then, and was bent up before. */
static void what_the_pedal_holds_keeps_its_bend(void** state) {
  (void)state;
  Host* const host = mpe_open();
  Sound sound = mpe_play(host, "held", 3.0, MPE_BLOCK);
  const Tone held = strings_tone(host, 50, member_bend(256));
  const Tone new = strings_tone(host, 57, member_bend(-512));
  assert_within("held, alone [cents]", mpe_measure(&sound, 0.5, 1.0, held).cents, 0.005);
  const double spacing_hz = new.f0_hz - held.f0_hz;
  assert_within("held [cents]", cents_among(&sound, 1.0, 3.0, held, spacing_hz), 0.005);
  assert_within("new [cents]", cents_among(&sound, 1.0, 3.0, new, spacing_hz), 0.005);
  sound_free(&sound);
  host_free(host);
}

/* What is left of a tuning would be heard as soon as the wheel moves. */
static void a_restart_forgets_what_was_said(void** state) {
  (void)state;
  Host* const host = mpe_open();
  Sound first = mpe_play(host, "tuned", 4.0, MPE_BLOCK);
  Sound again = mpe_play(host, "tuned", 4.0, MPE_BLOCK);
  assert_true(sound_is_same(&first, &again));
  sound_free(&first);
  sound_free(&again);
  host_free(host);
}

/* What was down when all was choked is not; so the wheel is for the next note, not for the one that
 * the pedal holds. */
static void keys_are_up_once_the_plugin_was_off(void** state) {
  (void)state;
  Host* const host = mpe_open();
  Sound sound = mpe_play(host, "zone", 0.5, MPE_BLOCK);
  strings_midi(host, 0, 0x91, 60, 100);
  strings_run(host, &sound, 0, MPE_BLOCK, MPE_BLOCK);
  strings_set(host, "enabled", 0.0);
  strings_run(host, &sound, 0, 20 * MPE_BLOCK, MPE_BLOCK);
  strings_set(host, "enabled", 1.0);
  strings_run(host, &sound, 0, MPE_BLOCK, MPE_BLOCK);
  sound_free(&sound);
  sound = sound_new(MPE_RATE);
  strings_controller(host, 0, STRINGS_PEDAL, 127);
  strings_midi(host, 1, 0x91, 62, 100);
  strings_midi(host, 2, 0x81, 62, 64);
  strings_midi(host, 3, 0xE1, 0, 80);
  strings_run(host, &sound, 0, sound.n_frames, MPE_BLOCK);
  strings_assert_exact("held", mpe_measure(&sound, 0.0, 1.0, strings_tone(host, 62, 0.0)));
  sound_free(&sound);
  host_free(host);
}

static void gestures_fall_on_their_frames_in_any_block(void** state) {
  static const uint32_t blocks[] = {1, 64, 333};
  (void)state;
  Host* const host = mpe_open();
  Sound usual = mpe_play(host, "all", 2.0, MPE_BLOCK);
  assert_true(measure_peak(usual.left, usual.n_frames) > 0.01);
  for (int i = 0; i < 3; ++i) {
    Sound sound = mpe_play(host, "all", 2.0, blocks[i]);
    assert_true(sound_is_same(&usual, &sound));
    sound_free(&sound);
  }
  sound_free(&usual);
  host_free(host);
}

/* To the last bit, as far as the program plays on. */
static void hooke_render_plays_the_same(void** state) {
  static const char* const names[] = {"apart", "wide", "sostenuto", "tuned", "soft", "all"};
  (void)state;
  Host* const host = mpe_open();
  for (int i = 0; i < 6; ++i) {
    Sound rendered = mpe_render(names[i]);
    Sound played = mpe_play(host, names[i], (double)rendered.n_frames / MPE_RATE, MPE_BLOCK);
    assert_true(rendered.n_frames > MPE_RATE);
    rendered.n_frames = played.n_frames;
    assert_true(sound_is_same(&rendered, &played));
    sound_free(&rendered);
    sound_free(&played);
  }
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_key_on_two_channels_has_two_pitches),
      cmocka_unit_test(members_bend_exactly_by_48_semitones),
      cmocka_unit_test(members_bend_exactly_by_96_semitones),
      cmocka_unit_test(ranges_and_tunings_are_exact),
      cmocka_unit_test(what_the_pedal_holds_keeps_its_bend),
      cmocka_unit_test(a_restart_forgets_what_was_said),
      cmocka_unit_test(keys_are_up_once_the_plugin_was_off),
      cmocka_unit_test(gestures_fall_on_their_frames_in_any_block),
      cmocka_unit_test(hooke_render_plays_the_same),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
