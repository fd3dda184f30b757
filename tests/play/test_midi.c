/* A message is what its bytes say, or nothing. */
#include "core/play/midi.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static MidiMessage read_bytes(unsigned status, unsigned first, unsigned second, uint32_t n) {
  const uint8_t bytes[4] = {(uint8_t)status, (uint8_t)first, (uint8_t)second, 0};
  return midi_read(bytes, n);
}

static void check(MidiMessage read, MidiKind kind, uint32_t number, uint32_t value) {
  assert_int_equal(read.kind, kind);
  assert_int_equal(read.number, number);
  assert_int_equal(read.value, value);
}

static void every_kind_has_its_number_and_its_value(void** state) {
  (void)state;
  check(read_bytes(0x80, 60, 64, 3), MIDI_NOTE_OFF, 60, 64);
  check(read_bytes(0x90, 61, 1, 3), MIDI_NOTE_ON, 61, 1);
  check(read_bytes(0x90, 61, 0, 3), MIDI_NOTE_OFF, 61, 0);
  check(read_bytes(0xA0, 62, 127, 3), MIDI_KEY_PRESSURE, 62, 127);
  check(read_bytes(0xA0, 62, 0, 3), MIDI_KEY_PRESSURE, 62, 0);
  check(read_bytes(0xB0, 74, 5, 3), MIDI_CONTROLLER, 74, 5);
  check(read_bytes(0xC0, 127, 0, 2), MIDI_PROGRAM, 127, 0);
  check(read_bytes(0xD0, 101, 0, 2), MIDI_CHANNEL_PRESSURE, 0, 101);
}

static void every_kind_has_its_channel(void** state) {
  (void)state;
  for (uint32_t channel = 0; channel < 16; ++channel) {
    for (uint32_t status = 0x80; status < 0xF0; status += 0x10) {
      const uint32_t n = status == 0xC0 || status == 0xD0 ? 2 : 3;
      const MidiMessage read = read_bytes(status | channel, 1, 1, n);
      assert_true(read.kind != MIDI_OTHER);
      assert_int_equal(read.channel, channel);
    }
  }
}

/* 1/8192 and its multiples are exact in doubles. */
static void the_wheel_has_fourteen_bits(void** state) {
  (void)state;
  assert_true(read_bytes(0xE0, 0, 0, 3).bend == -1.0);
  assert_true(read_bytes(0xE0, 0, 64, 3).bend == 0.0);
  assert_true(read_bytes(0xE0, 1, 64, 3).bend == 1.0 / 8192.0);
  assert_true(read_bytes(0xE0, 127, 63, 3).bend == -1.0 / 8192.0);
  assert_true(read_bytes(0xE0, 127, 127, 3).bend == 8191.0 / 8192.0);
  assert_true(read_bytes(0xB0, 1, 127, 3).bend == 0.0);
}

/* However many bytes follow, and whichever of them is no data byte. */
static void what_is_too_long_too_short_or_no_data_is_nothing(void** state) {
  (void)state;
  for (uint32_t status = 0; status < 0x100; ++status) {
    const uint32_t kind = status & 0xF0u;
    const uint32_t right = kind == 0xC0 || kind == 0xD0 ? 2 : 3;
    for (uint32_t n = 0; n <= 4; ++n) {
      const bool is_known = kind >= 0x80 && kind < 0xF0 && n == right;
      assert_int_equal(read_bytes(status, 60, 100, n).kind != MIDI_OTHER, is_known);
      assert_int_equal(read_bytes(status, 0x80, 100, n).kind, MIDI_OTHER);
      assert_int_equal(read_bytes(status, 0xFF, 100, n).kind, MIDI_OTHER);
      assert_true(n == 2 || read_bytes(status, 60, 0x80, n).kind == MIDI_OTHER);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_kind_has_its_number_and_its_value),
      cmocka_unit_test(every_kind_has_its_channel),
      cmocka_unit_test(the_wheel_has_fourteen_bits),
      cmocka_unit_test(what_is_too_long_too_short_or_no_data_is_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
