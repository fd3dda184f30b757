/* MIDI tuning is obeyed by both instruments: measured on their sound, to a thousandth of a cent. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"
#include "tests/support/scale_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256, N_FRAMES = RATE, LATER = RATE / 4, MOST_BYTES = 512 };

static const double MOST_CENTS = 1e-3;

/* Which instrument, by a function that opens it. */
static Host* open_plain(bool is_guitar) {
  Host* const host = is_guitar ? guitar_open(RATE, BLOCK) : strings_open(RATE, BLOCK);
  (is_guitar ? guitar_set_plain : strings_set_plain)(host);
  strings_set(host, "tracking", 0.0);
  strings_set(host, "damping", 1.0);
  return host;
}

static void send(Host* host, size_t frame, const uint8_t* bytes, size_t n) {
  assert_true(host_midi(host, (uint32_t)frame, bytes, (uint32_t)n));
}

/* One key's new pitch in 1/16384 semitone above key 0. */
static void send_note(Host* host, size_t frame, bool is_live, uint32_t key, uint32_t pitch) {
  const uint8_t bytes[] = {0xF0,
                           is_live ? 0x7F : 0x7E,
                           0x10,
                           0x08,
                           0x07,
                           0,
                           0,
                           1,
                           (uint8_t)key,
                           (uint8_t)(pitch >> 14),
                           (uint8_t)(pitch >> 7 & 0x7F),
                           (uint8_t)(pitch & 0x7F),
                           0xF7};
  send(host, frame, bytes, sizeof(bytes));
}

static void send_dump(Host* host, const uint32_t pitches[128]) {
  uint8_t bytes[MOST_BYTES] = {0xF0, 0x7E, 0x7F, 0x08, 0x01, 0x00};
  size_t n = 6;
  for (int i = 0; i < 16; ++i) {
    bytes[n++] = ' ';
  }
  for (int key = 0; key < 128; ++key) {
    bytes[n++] = (uint8_t)(pitches[key] >> 14);
    bytes[n++] = (uint8_t)(pitches[key] >> 7 & 0x7F);
    bytes[n++] = (uint8_t)(pitches[key] & 0x7F);
  }
  uint8_t sum = 0;
  for (size_t i = 1; i < n; ++i) {
    sum ^= bytes[i];
  }
  bytes[n++] = sum;
  bytes[n++] = 0xF7;
  assert_int_equal(n, 408);
  send(host, 0, bytes, n);
}

static double hz_of(double pitch) {
  return 440.0 * exp2((pitch - 69.0) / 12.0);
}

/* Fail unless a stretch of the sound has that pitch, in semitones above key 0. */
static void assert_pitch(const Sound* sound, size_t from, size_t to, double pitch) {
  const Tone asked = {hz_of(pitch), 1.0};
  assert_within("pitch [cents]", strings_measure(sound, RATE, from, to, asked).cents, MOST_CENTS);
}

static void every_key_is_as_it_was_dumped(void** state) {
  Random random = random_start();
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    Host* const host = open_plain(is_guitar);
    uint32_t pitches[128];
    for (int key = 0; key < 128; ++key) {
      pitches[key] = 45 * 16384 + random_below(&random, 40 * 16384);
    }
    for (uint32_t key = 40; key < 86; key += 5) {
      Sound sound = sound_new(N_FRAMES);
      strings_restart(host);
      send_dump(host, pitches);
      strings_note_on(host, 0, key, 127);
      strings_run(host, &sound, 0, N_FRAMES, BLOCK);
      assert_pitch(&sound, RATE / 20, N_FRAMES, pitches[key] / 16384.0);
      sound_free(&sound);
    }
    host_free(host);
  }
}

/* What is real-time moves the note that sounds; what is not leaves it, and the next has it. */
static void real_time_moves_what_sounds_and_the_rest_does_not(void** state) {
  const uint32_t pitch = 61 * 16384 + 5461;
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    for (int is_live = 0; is_live < 2; ++is_live) {
      Host* const host = open_plain(is_guitar);
      Sound sound = sound_new(2 * N_FRAMES);
      strings_restart(host);
      strings_note_on(host, 0, 60, 127);
      send_note(host, LATER, is_live, 60, pitch);
      strings_midi(host, N_FRAMES, 0x80, 60, 0);
      strings_note_on(host, N_FRAMES, 60, 127);
      strings_run(host, &sound, 0, 2 * N_FRAMES, BLOCK);
      assert_pitch(&sound, RATE / 20, LATER, 60.0);
      assert_pitch(&sound, LATER + RATE / 20, N_FRAMES, is_live ? pitch / 16384.0 : 60.0);
      assert_pitch(&sound, N_FRAMES + RATE / 4, 2 * N_FRAMES, pitch / 16384.0);
      sound_free(&sound);
      host_free(host);
    }
  }
}

/* Twelve cents more to A, on channels 1 and 3; channel 2 has none, though it holds the same key. */
static void octaves_are_their_channels(void** state) {
  const uint8_t bytes[] = {0xF0, 0x7F, 0x7F, 0x08, 0x08, 0,  0,  5,  64, 64,  64,
                           64,   64,   64,   64,   64,   64, 76, 64, 64, 0xF7};
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    Host* const host = open_plain(is_guitar);
    for (unsigned channel = 0; channel < 3; ++channel) {
      Sound sound = sound_new(N_FRAMES);
      strings_restart(host);
      send(host, 0, bytes, sizeof(bytes));
      strings_midi(host, 0, 0x90 + channel, 57, 127);
      strings_run(host, &sound, 0, N_FRAMES, BLOCK);
      assert_pitch(&sound, RATE / 20, N_FRAMES, channel == 1 ? 57.0 : 57.12);
      sound_free(&sound);
    }
    host_free(host);
  }
}

static void master_tuning_moves_everything(void** state) {
  const uint8_t fine[] = {0xF0, 0x7F, 0x7F, 0x04, 0x03, 0x21, 0x13, 0xF7};
  const uint8_t coarse[] = {0xF0, 0x7F, 0x7F, 0x04, 0x04, 0, 0x3B, 0xF7};
  const double pitch = 62.0 - 5.0 + ((0x13 << 7 | 0x21) - 8192) / 8192.0;
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    Host* const host = open_plain(is_guitar);
    Sound sound = sound_new(N_FRAMES);
    strings_restart(host);
    strings_note_on(host, 0, 62, 127);
    send(host, LATER, fine, sizeof(fine));
    send(host, LATER, coarse, sizeof(coarse));
    strings_run(host, &sound, 0, N_FRAMES, BLOCK);
    assert_pitch(&sound, RATE / 20, LATER, 62.0);
    assert_pitch(&sound, LATER + RATE / 20, N_FRAMES, pitch);
    sound_free(&sound);
    host_free(host);
  }
}

static void play(Host* host, Sound* sound) {
  strings_note_on(host, 0, 64, 127);
  strings_run(host, sound, 0, N_FRAMES, BLOCK);
  strings_controller(host, 0, STRINGS_SOUND_OFF, 0);
}

/* A file, then a message; a message, then a file; activated anew the file is what is left. */
static void the_last_word_counts_be_it_a_file_or_a_message(void** state) {
  double hz[128];
  (void)state;
  scale_expected("pythagorean.scl", NULL, 440.0, hz);
  const double of_file = 69.0 + 12.0 * log2(hz[64] / 440.0);
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    const char* const parameter = is_guitar ? GUITAR_URI "#scale" : SCALE_PARAMETER;
    const double pitches[] = {of_file, 64.25, of_file, 64.25, of_file};
    Host* const host = open_plain(is_guitar);
    for (int i = 0; i < 5; ++i) {
      Sound sound = sound_new(N_FRAMES);
      if (i == 4) {
        strings_restart(host);
      } else if (i % 2) {
        send_note(host, 0, true, 64, 64 * 16384 + 4096);
      } else {
        scale_set(host, parameter, scale_path("pythagorean.scl").text);
      }
      assert_true(host_run(host, BLOCK) && host_run(host, BLOCK));
      play(host, &sound);
      assert_pitch(&sound, RATE / 20, N_FRAMES, pitches[i]);
      sound_free(&sound);
    }
    host_free(host);
  }
}

/* A body is no new tuning. */
static void a_body_leaves_what_a_message_tuned(void** state) {
  const ScalePath directory = scale_new_directory();
  const ScalePath path = scale_write_body(&directory, "a.body", BODIES_HARP);
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    Host* const host = open_plain(is_guitar);
    Sound sound = sound_new(N_FRAMES);
    send_note(host, 0, true, 64, 64 * 16384 + 4096);
    assert_true(host_run(host, BLOCK));
    assert_true(host_set_file(host, is_guitar ? GUITAR_URI "#body" : BODY_PARAMETER, path.text));
    play(host, &sound);
    assert_pitch(&sound, RATE / 20, N_FRAMES, 64.25);
    sound_free(&sound);
    host_free(host);
  }
  scale_remove_directory(&directory);
}

/* What is malformed, a request, and other makers' messages leave every bit as it was. */
static void what_tunes_nothing_changes_no_bit(void** state) {
  static const uint8_t messages[][16] = {
      {0xF0, 0x7F, 0x7F, 0x08, 0x02, 0, 1, 64, 70, 0, 0x80, 0xF7},
      {0xF0, 0x7F, 0x7F, 0x08, 0x02, 0, 2, 64, 70, 0, 0, 0xF7},
      {0xF0, 0x7E, 0x7F, 0x08, 0x02, 0, 1, 64, 70, 0, 0, 0xF7},
      {0xF0, 0x7E, 0x7F, 0x08, 0x00, 0, 0xF7},
      {0xF0, 0x41, 0x10, 0x42, 0x12, 0x40, 0, 0x7F, 0, 0x41, 0xF7},
      {0xF0, 0x7E, 0x7F, 0x09, 0x01, 0xF7},
  };
  (void)state;
  for (int is_guitar = 0; is_guitar < 2; ++is_guitar) {
    Host* const host = open_plain(is_guitar);
    Sound sounds[2] = {sound_new(N_FRAMES), sound_new(N_FRAMES)};
    for (int i = 0; i < 2; ++i) {
      strings_restart(host);
      for (size_t m = 0; i > 0 && m < sizeof(messages) / sizeof(*messages); ++m) {
        const uint8_t* const end = memchr(messages[m], 0xF7, sizeof(messages[m]));
        send(host, 0, messages[m], (size_t)(end - messages[m]) + 1);
      }
      strings_note_on(host, 0, 64, 100);
      strings_run(host, &sounds[i], 0, N_FRAMES, BLOCK);
    }
    assert_true(sound_is_same(&sounds[0], &sounds[1]));
    sound_free(&sounds[0]);
    sound_free(&sounds[1]);
    host_free(host);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_key_is_as_it_was_dumped),
      cmocka_unit_test(real_time_moves_what_sounds_and_the_rest_does_not),
      cmocka_unit_test(octaves_are_their_channels),
      cmocka_unit_test(master_tuning_moves_everything),
      cmocka_unit_test(the_last_word_counts_be_it_a_file_or_a_message),
      cmocka_unit_test(a_body_leaves_what_a_message_tuned),
      cmocka_unit_test(what_tunes_nothing_changes_no_bit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
