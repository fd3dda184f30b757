/* Each channel is a player of its own, by ear and in both plugins: what it does is heard of its own
 * notes, and of no other's. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/plugins.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { RATE = PLUGINS_RATE, BLOCK = PLUGINS_BLOCK, N_FRAMES = 3 * RATE, FIRST = 4, SECOND = 9 };

/* The keys of the two channels; the guitar has them on different strings. */
enum { LOW = 45, HIGH = 64 };

static Host* open(int plugin) {
  Host* const host = plugins_open(plugin);
  strings_set(host, "limiter", 0.0);
  strings_set(host, "release", 0.05);
  return host;
}

static Sound play(Host* host) {
  Sound sound = sound_new(N_FRAMES);
  strings_run(host, &sound, 0, N_FRAMES, BLOCK);
  host_free(host);
  return sound;
}

/* One channel's note, and what it does. */
static void queue(Host* host, unsigned channel, unsigned key, unsigned number, unsigned value) {
  if (number > 0) {
    strings_midi(host, RATE / 2, 0xB0 | channel, number, value);
  }
  strings_midi(host, 100, 0x90 | channel, key, 100);
}

static Sound play_alone(int plugin, unsigned channel, unsigned key) {
  Host* const host = open(plugin);
  queue(host, channel, key, 0, 0);
  return play(host);
}

static void volume_and_expression_are_of_their_channel(void** state) {
  static const unsigned numbers[] = {7, 11};
  (void)state;
  for (int i = 0; i < 2 * N_PLUGINS; ++i) {
    const double gain = pow(40.0 / 127.0, 2.0);
    Host* const host = open(i / 2);
    queue(host, FIRST, LOW, 0, 0);
    queue(host, SECOND, HIGH, numbers[i % 2], 40);
    Sound both = play(host);
    Sound low = play_alone(i / 2, FIRST, LOW);
    Sound high = play_alone(i / 2, SECOND, HIGH);
    double worst = 0.0;
    for (size_t n = RATE / 2 + RATE / 50; n < N_FRAMES; ++n) {
      const double expected = (double)low.left[n] + gain * (double)high.left[n];
      worst = fmax(worst, fabs((double)both.left[n] - expected));
    }
    assert_true(measure_peak(high.left + RATE, RATE) > 1e-2);
    assert_within("of the sum", worst, 1e-6);
    sound_free(&both);
    sound_free(&low);
    sound_free(&high);
  }
}

/* Of the second half of the sound, in dB of the one of a key that is simply held. */
static double held_db(int plugin, Sound sound) {
  Sound held = play_alone(plugin, FIRST, HIGH);
  const double db = 20.0 * log10(measure_rms(sound.left + N_FRAMES / 2, N_FRAMES / 2) /
                                 measure_rms(held.left + N_FRAMES / 2, N_FRAMES / 2));
  sound_free(&held);
  sound_free(&sound);
  print_message("  %.1f dB\n", db);
  return db;
}

static void a_pedal_holds_the_notes_of_its_channel(void** state) {
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    for (unsigned channel = FIRST; channel <= FIRST + 1; ++channel) {
      Host* const host = open(plugin);
      queue(host, FIRST, HIGH, 0, 0);
      strings_midi(host, RATE / 2, 0xB0 | channel, STRINGS_PEDAL, 127);
      strings_midi(host, RATE, 0x80 | FIRST, HIGH, 64);
      const double db = held_db(plugin, play(host));
      assert_true(channel == FIRST ? fabs(db) < 0.1 : db < -60.0);
    }
  }
}

/* In a way that both orders are heard, and on a key that the guitar has on one string only. */
static void a_key_sounds_until_the_last_channel_lets_go(void** state) {
  static const unsigned keys[] = {HIGH, 40};
  (void)state;
  for (int i = 0; i < 4 * N_PLUGINS; ++i) {
    const unsigned key = keys[i / 2 % 2];
    const unsigned first = i % 2 ? FIRST : SECOND;
    const unsigned second = i % 2 ? SECOND : FIRST;
    Host* const host = open(i / 4);
    Host* const other = open(i / 4);
    for (int k = 0; k < 2; ++k) {
      Host* const each = k ? other : host;
      strings_midi(each, 100, 0x90 | first, key, 100);
      strings_midi(each, RATE / 2, 0x90 | second, key, 90);
      strings_midi(each, RATE / 2 + 4000, 0x80 | second, key, 64);
    }
    strings_midi(other, RATE, 0x80 | first, key, 64);
    Sound held = play(host);
    Sound gone = play(other);
    const double rms = measure_rms(held.left + 2 * RATE, RATE);
    assert_true(rms > 1e-5);
    assert_true(measure_rms(gone.left + 2 * RATE, RATE) < 1e-3 * rms);
    sound_free(&held);
    sound_free(&gone);
  }
}

static void all_sound_off_is_of_its_channel(void** state) {
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    for (unsigned channel = FIRST; channel <= FIRST + 1; ++channel) {
      Host* const host = open(plugin);
      queue(host, FIRST, HIGH, 0, 0);
      strings_midi(host, RATE, 0xB0 | channel, 120, 0);
      const double db = held_db(plugin, play(host));
      assert_true(channel == FIRST ? db < -100.0 : fabs(db) < 0.1);
    }
  }
}

/* Its members' wheels are ±48 semitones wide; each has a string of its own in either mode, and only
 * its own wheel, beside its leader's, bends it. */
static void a_zone_of_six_members_is_a_guitar(void** state) {
  static const unsigned open_keys[] = {64, 59, 55, 50, 45, 40};
  (void)state;
  for (unsigned i = 0; i < 12; ++i) {
    const unsigned member = i / 2;
    const double semitones = 48.0 * (300.0 - 100.0 * member) / 8192.0 + 2.0 * 1024 / 8192.0;
    Host* const host = open(1);
    guitar_set_plain(host);
    strings_set(host, "mode", i % 2);
    strings_set(host, "limiter", 0.0);
    strings_restart(host);
    strings_controller(host, 0, 101, 0);
    strings_controller(host, 0, 100, 6);
    strings_controller(host, 0, 6, 6);
    strings_midi(host, 1, 0xE0, 0, 72);
    for (unsigned m = 0; m < 6; ++m) {
      const unsigned wheel = 8192 + 300 - 100 * m;
      strings_midi(host, 1, 0xE1 + m, wheel & 127, wheel >> 7);
    }
    strings_midi(host, 10, 0x91 + member, open_keys[member], 100);
    const Tone straight = strings_tone(host, open_keys[member], 0.0);
    const Tone bent = {strings_tone(host, open_keys[member], semitones).f0_hz, straight.tau_s};
    Sound sound = sound_new(N_FRAMES);
    strings_run(host, &sound, 0, N_FRAMES, BLOCK);
    assert_within("pitch [cents]", strings_measure(&sound, RATE, RATE / 20, 2 * RATE, bent).cents,
                  0.005);
    sound_free(&sound);
    host_free(host);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(volume_and_expression_are_of_their_channel),
      cmocka_unit_test(a_pedal_holds_the_notes_of_its_channel),
      cmocka_unit_test(a_key_sounds_until_the_last_channel_lets_go),
      cmocka_unit_test(all_sound_off_is_of_its_channel),
      cmocka_unit_test(a_zone_of_six_members_is_a_guitar),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
