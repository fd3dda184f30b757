/* Messages of the MIDI tuning standard tune keys to what their bytes say. */
#include "core/play/mts.h"

#include "tests/support/player.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_BYTES = 640, ALL = 0xFFFF };

typedef struct {
  uint8_t bytes[MOST_BYTES];
  uint32_t n;
} Message;

static void put(Message* message, uint32_t byte) {
  message->bytes[message->n++] = (uint8_t)byte;
}

static Message begin(uint32_t kind, uint32_t device, uint32_t what, uint32_t id) {
  Message message = {{0}, 0};
  put(&message, 0xF0);
  put(&message, kind);
  put(&message, device);
  put(&message, what);
  put(&message, id);
  return message;
}

static void put_name(Message* message) {
  for (int i = 0; i < 16; ++i) {
    put(message, 'a');
  }
}

/* In 1/16384 semitone above key 0. */
static void put_pitch(Message* message, uint32_t pitch) {
  put(message, pitch >> 14);
  put(message, pitch >> 7 & 0x7F);
  put(message, pitch & 0x7F);
}

static void put_sum(Message* message) {
  uint32_t sum = 0;
  for (uint32_t i = 1; i < message->n; ++i) {
    sum ^= message->bytes[i];
  }
  put(message, sum);
}

static Mts new_mts(void) {
  Mts mts;
  mts_reset(&mts);
  return mts;
}

static MtsChange end(Message* message, Mts* mts) {
  put(message, 0xF7);
  return mts_play(mts, message->bytes, message->n);
}

static void assert_change(MtsChange change, uint32_t channels, bool is_live) {
  assert_int_equal(change.channels, channels);
  assert_true(channels == 0 || change.is_live == is_live);
}

static double pitch_of(const Mts* mts, uint32_t channel, uint32_t key) {
  double semitones[PERFORMANCE_KEYS];
  mts_pitches(mts, channel, semitones);
  return semitones[key];
}

static void assert_equal_temperament(const Mts* mts) {
  for (uint32_t c = 0; c < 16; ++c) {
    for (uint32_t key = 0; key < 128; ++key) {
      assert_true(pitch_of(mts, c, key) == (double)key - 69.0);
    }
  }
}

/* Pitches in 1/16384 semitone, drawn; what is all ones is left as it was. */
static void a_bulk_dump_tunes_all_keys_to_21_bits(void** state) {
  Random random = random_start();
  (void)state;
  for (uint32_t has_bank = 0; has_bank < 2; ++has_bank) {
    Message message = begin(0x7E, 5, 8, has_bank ? 4 : 1);
    Mts mts = new_mts();
    uint32_t pitches[128];
    if (has_bank) {
      put(&message, 3);
    }
    put(&message, 0);
    put_name(&message);
    for (uint32_t key = 0; key < 128; ++key) {
      pitches[key] = key % 10 == 7 ? 0x1FFFFF : random_below(&random, 0x1FFFFF);
      put_pitch(&message, pitches[key]);
    }
    put_sum(&message);
    assert_int_equal(message.n + 1, has_bank ? 409 : 408);
    assert_change(end(&message, &mts), ALL, false);
    for (uint32_t key = 0; key < 128; ++key) {
      const double semitones = key % 10 == 7 ? (double)key : ldexp(pitches[key], -14);
      for (uint32_t c = 0; c < 16; ++c) {
        assert_true(pitch_of(&mts, c, key) == semitones - 69.0);
      }
    }
  }
}

/* The examples of the standard: middle C, A4, and the steps next to it. */
static void known_bytes_are_known_frequencies(void** state) {
  static const struct {
    uint32_t bytes[3];
    double hz;
  } known[] = {{{0x00, 0x00, 0x00}, 8.1758},    {{0x00, 0x00, 0x01}, 8.1758},
               {{0x01, 0x00, 0x00}, 8.6620},    {{0x0C, 0x00, 0x00}, 16.3516},
               {{0x3C, 0x00, 0x00}, 261.6256},  {{0x3D, 0x00, 0x00}, 277.1826},
               {{0x44, 0x7F, 0x7F}, 439.9984},  {{0x45, 0x00, 0x00}, 440.0000},
               {{0x45, 0x00, 0x01}, 440.0016},  {{0x78, 0x00, 0x00}, 8372.0181},
               {{0x7F, 0x00, 0x00}, 12543.8540}};
  (void)state;
  for (size_t i = 0; i < sizeof(known) / sizeof(*known); ++i) {
    Message message = begin(0x7F, 0x7F, 8, 2);
    Mts mts = new_mts();
    put(&message, 0);
    put(&message, 1);
    put(&message, 33);
    put(&message, known[i].bytes[0]);
    put(&message, known[i].bytes[1]);
    put(&message, known[i].bytes[2]);
    assert_change(end(&message, &mts), ALL, true);
    assert_true(fabs(440.0 * exp2(pitch_of(&mts, 9, 33) / 12.0) - known[i].hz) < 0.0006);
  }
}

static void single_notes_change_alone(void** state) {
  static const struct {
    uint32_t kind, id, has_bank;
  } kinds[] = {{0x7F, 2, 0}, {0x7F, 7, 1}, {0x7E, 7, 1}};
  (void)state;
  for (size_t i = 0; i < 3; ++i) {
    Message message = begin(kinds[i].kind, 0, 8, kinds[i].id);
    Mts mts = new_mts();
    if (kinds[i].has_bank) {
      put(&message, 0);
    }
    put(&message, 0);
    put(&message, 2);
    put(&message, 60);
    put_pitch(&message, 60 * 16384 + 8192);
    put(&message, 127);
    put_pitch(&message, 1);
    assert_change(end(&message, &mts), ALL, kinds[i].kind == 0x7F);
    assert_true(pitch_of(&mts, 0, 60) == -8.5 && pitch_of(&mts, 15, 60) == -8.5);
    assert_true(pitch_of(&mts, 0, 127) == 1.0 / 16384.0 - 69.0);
    assert_true(pitch_of(&mts, 0, 61) == -8.0);
  }
}

/* Channels 1, 7, 8, 14, 15 and 16. */
static void octaves_are_tuned_on_the_channels_that_are_named(void** state) {
  const uint32_t channels = 1u << 0 | 1u << 6 | 1u << 7 | 1u << 13 | 1u << 14 | 1u << 15;
  (void)state;
  for (uint32_t width = 1; width <= 2; ++width) {
    for (uint32_t is_live = 0; is_live < 2; ++is_live) {
      Message message = begin(is_live ? 0x7F : 0x7E, 0x7F, 8, 7 + width);
      Mts mts = new_mts();
      put(&message, 0x03);
      put(&message, 0x41);
      put(&message, 0x41);
      for (uint32_t note = 0; note < 12; ++note) {
        put(&message, 11 * note);
        if (width == 2) {
          put(&message, note);
        }
      }
      assert_change(end(&message, &mts), channels, is_live);
      for (uint32_t c = 0; c < 16; ++c) {
        for (uint32_t key = 0; key < 128; ++key) {
          const double note = key % 12;
          const double cents =
              width == 1 ? 11.0 * note - 64.0 : (11.0 * note * 128.0 + note) / 81.92 - 100.0;
          const double added = channels >> c & 1 ? cents / 100.0 : 0.0;
          assert_true(fabs(pitch_of(&mts, c, key) - ((double)key - 69.0 + added)) < 1e-12);
        }
      }
    }
  }
}

static void dumped_octaves_are_for_all_channels(void** state) {
  (void)state;
  for (uint32_t width = 1; width <= 2; ++width) {
    Message message = begin(0x7E, 1, 8, 4 + width);
    Mts mts = new_mts();
    put(&message, 0);
    put(&message, 0);
    put_name(&message);
    for (uint32_t note = 0; note < 12; ++note) {
      put(&message, 0x40 + note);
      if (width == 2) {
        put(&message, 0);
      }
    }
    put_sum(&message);
    assert_change(end(&message, &mts), ALL, false);
    for (uint32_t note = 0; note < 12; ++note) {
      const double cents = width == 1 ? note : note * 128.0 / 81.92;
      assert_true(fabs(pitch_of(&mts, 9, 60 + note) - (note - 9.0 + cents / 100.0)) < 1e-12);
    }
  }
}

static void master_tuning_is_added_to_all(void** state) {
  Mts mts = new_mts();
  (void)state;
  for (uint32_t fine = 0; fine < 0x4000; fine += 997) {
    Message message = begin(0x7F, 0x7F, 4, 3);
    put(&message, fine & 0x7F);
    put(&message, fine >> 7);
    assert_change(end(&message, &mts), ALL, true);
    for (uint32_t coarse = 0; coarse < 128; coarse += 21) {
      Message other = begin(0x7F, 0x7F, 4, 4);
      put(&other, 0);
      put(&other, coarse);
      assert_change(end(&other, &mts), ALL, true);
      const double cents = 100.0 * (coarse - 64.0) + (fine - 8192.0) * 100.0 / 8192.0;
      assert_true(fabs(pitch_of(&mts, 3, 72) - (3.0 + cents / 100.0)) < 1e-12);
    }
  }
}

static void the_last_word_counts(void** state) {
  double scale[128];
  Mts mts = new_mts();
  (void)state;
  Message octave = begin(0x7F, 0, 8, 8);
  put(&octave, 0);
  put(&octave, 0);
  put(&octave, 1);
  for (int note = 0; note < 12; ++note) {
    put(&octave, 0x4A);
  }
  put(&octave, 0xF7);
  Message note = begin(0x7F, 0, 8, 2);
  put(&note, 0);
  put(&note, 1);
  put(&note, 69);
  put_pitch(&note, 70 * 16384);
  put(&note, 0xF7);
  for (int key = 0; key < 128; ++key) {
    scale[key] = key == 70 ? (double)NAN : 0.5 * key;
  }
  assert_change(mts_set_scale(&mts, scale), ALL, true);
  assert_true(pitch_of(&mts, 0, 69) == 34.5 && isnan(pitch_of(&mts, 1, 70)));
  assert_change(mts_play(&mts, octave.bytes, octave.n), 1, true);
  assert_true(pitch_of(&mts, 0, 69) == 0.1 && pitch_of(&mts, 1, 69) == 34.5);
  assert_true(pitch_of(&mts, 0, 70) == 1.1);
  assert_change(mts_play(&mts, note.bytes, note.n), ALL, true);
  assert_true(pitch_of(&mts, 0, 69) == 1.0 && pitch_of(&mts, 1, 69) == 1.0);
  assert_true(pitch_of(&mts, 0, 68) == -0.9 && pitch_of(&mts, 1, 68) == 34.0);
  (void)mts_set_scale(&mts, scale);
  assert_true(pitch_of(&mts, 0, 69) == 34.5);
}

/* Every message cut short, one too long, with a byte above 7F, or with a wrong checksum. */
static void what_is_malformed_changes_nothing(void** state) {
  static const struct {
    uint32_t kind, what, id, n; // Bytes of its body, without the checksum
    bool has_sum;
  } kinds[] = {{0x7E, 8, 1, 401, true}, {0x7E, 8, 4, 402, true}, {0x7E, 8, 5, 30, true},
               {0x7E, 8, 6, 42, true},  {0x7F, 8, 2, 6, false},  {0x7F, 8, 7, 7, false},
               {0x7E, 8, 7, 7, false},  {0x7F, 8, 8, 15, false}, {0x7E, 8, 8, 15, false},
               {0x7F, 8, 9, 27, false}, {0x7E, 8, 9, 27, false}, {0x7F, 4, 3, 2, false},
               {0x7F, 4, 4, 2, false}};
  (void)state;
  for (size_t i = 0; i < sizeof(kinds) / sizeof(*kinds); ++i) {
    Message message = begin(kinds[i].kind, 0, kinds[i].what, kinds[i].id);
    Mts mts = new_mts();
    for (uint32_t b = 0; b < kinds[i].n; ++b) {
      put(&message, 1);
    }
    if (kinds[i].has_sum) {
      put_sum(&message);
    }
    put(&message, 0xF7);
    Message whole = message;
    assert_true(mts_play(&mts, whole.bytes, whole.n).channels != 0);
    mts_reset(&mts);
    for (uint32_t n = 0; n < whole.n; ++n) {
      Message cut = whole;
      assert_change(mts_play(&mts, cut.bytes, n), 0, false);
      if (n > 0) {
        cut.bytes[n - 1] = 0xF7;
        assert_change(mts_play(&mts, cut.bytes, n), 0, false);
      }
      cut = whole;
      cut.bytes[n] |= n > 0 && n + 1 < whole.n ? 0x80 : 0;
      cut.bytes[n] &= n == 0 || n + 1 == whole.n ? 0x7F : 0xFF;
      assert_change(mts_play(&mts, cut.bytes, whole.n), 0, false);
      cut = whole;
      if (kinds[i].has_sum && n > 0 && n + 1 < whole.n) {
        cut.bytes[n] ^= 1;
        assert_change(mts_play(&mts, cut.bytes, whole.n), 0, false);
      }
    }
    message.bytes[message.n - 1] = 1;
    put(&message, 0xF7);
    assert_change(mts_play(&mts, message.bytes, message.n), 0, false);
    assert_equal_temperament(&mts);
  }
}

static void other_messages_change_nothing(void** state) {
  Random random = random_start();
  Mts mts = new_mts();
  (void)state;
  for (int i = 0; i < 100000; ++i) {
    Message message = {{0xF0}, 1};
    const uint32_t n = random_below(&random, 40);
    const bool is_ours = random_below(&random, 2);
    for (uint32_t b = 0; b < n; ++b) {
      put(&message, random_below(&random, 128));
    }
    if (is_ours && n > 3) {
      message.bytes[1] = (uint8_t)(0x7E + random_below(&random, 2));
      message.bytes[3] = 8;
      message.bytes[4] = (uint8_t)(10 + random_below(&random, 100));
    } else if (n > 0) {
      message.bytes[1] &= 0x3F;
    }
    assert_change(end(&message, &mts), 0, false);
  }
  assert_equal_temperament(&mts);
}

/* Of the messages to an instrument, those that tune are told, channel by channel. */
static void an_instrument_is_told_its_channels(void** state) {
  Player player = player_new();
  Message octave = begin(0x7F, 0, 8, 8);
  (void)state;
  put(&octave, 0);
  put(&octave, 0);
  put(&octave, 0x24);
  for (int note = 0; note < 12; ++note) {
    put(&octave, 0x4A);
  }
  put(&octave, 0xF7);
  channels_play(&player.channels, octave.bytes, octave.n, true);
  const RecordedCall* const calls = player.recorder->calls;
  assert_int_equal(player.recorder->n_calls, 2);
  assert_true(calls[0].verb == RECORD_TUNE && calls[0].channel == 2 && calls[0].value == 0.1);
  assert_true(calls[1].verb == RECORD_TUNE && calls[1].channel == 5 && calls[1].key == 1);
  player_forget(&player);
  octave.bytes[1] = 0x7E;
  channels_play(&player.channels, octave.bytes, octave.n, false);
  assert_true(player.recorder->n_calls == 2 && calls[1].key == 0);
  channels_reset(&player.channels);
  assert_equal_temperament(&player.channels.mts);
  player_free(&player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_bulk_dump_tunes_all_keys_to_21_bits),
      cmocka_unit_test(known_bytes_are_known_frequencies),
      cmocka_unit_test(single_notes_change_alone),
      cmocka_unit_test(octaves_are_tuned_on_the_channels_that_are_named),
      cmocka_unit_test(dumped_octaves_are_for_all_channels),
      cmocka_unit_test(master_tuning_is_added_to_all),
      cmocka_unit_test(the_last_word_counts),
      cmocka_unit_test(what_is_malformed_changes_nothing),
      cmocka_unit_test(other_messages_change_nothing),
      cmocka_unit_test(an_instrument_is_told_its_channels),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
