/* What MIDI says to the guitar is what its guitarist is told. */
#include "tests/support/orders.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* Two strings ring before the order, and a third is plucked after it; the order matters, or the
 * sound would not say whether it was understood. */
static void check_order(const char* what, const uint8_t bytes[3], Order order, bool matters) {
  const Step steps[] = {
      {10, {0x91, 62, 100}, {ON, 1, 62, 100}},       {11, {0x93, 55, 90}, {ON, 3, 55, 90}},
      {5000, {bytes[0], bytes[1], bytes[2]}, order}, {9000, {0x81, 62, 64}, {OFF, 1, 62, 0}},
      {9001, {0x94, 48, 110}, {ON, 4, 48, 110}},
  };
  Step other[5];
  for (int i = 0; i < 5; ++i) {
    other[i] = steps[i];
  }
  other[2].order.verb = END;
  print_message("%s\n", what);
  Host* const host = orders_open();
  assert_true(orders_are_told(host, steps, 5));
  assert_int_equal(orders_are_told(host, other, 5), !matters);
  host_free(host);
}

static void messages_are_the_guitarists_orders(void** state) {
  (void)state;
  check_order("note on", (uint8_t[]){0x90, 70, 3}, (Order){ON, 0, 70, 3}, true);
  check_order("note off", (uint8_t[]){0x83, 55, 3}, (Order){OFF, 3, 55, 0}, true);
  check_order("of velocity nought", (uint8_t[]){0x93, 55, 0}, (Order){OFF, 3, 55, 0}, true);
  check_order("wheel up", (uint8_t[]){0xE1, 127, 127}, (Order){BEND, 1, 2.0 * 8191 / 8192, 0},
              true);
  check_order("wheel down", (uint8_t[]){0xE3, 0, 0}, (Order){BEND, 3, -2.0, 0}, true);
  check_order("wheel", (uint8_t[]){0xE3, 5, 96}, (Order){BEND, 3, 2.0 * 4101 / 8192, 0}, true);
  check_order("pedal down", (uint8_t[]){0xB1, 64, 64}, (Order){PEDAL, 1, 1, 0}, true);
  check_order("vibrato", (uint8_t[]){0xB1, 1, 127}, (Order){VIBRATO, 1, 0.5, 0}, true);
  check_order("less", (uint8_t[]){0xB3, 1, 20}, (Order){VIBRATO, 3, 0.5 * 20 / 127.0, 0}, true);
  check_order("palm", (uint8_t[]){0xB9, 67, 127}, (Order){PALM, 0, 1.0, 0}, true);
  check_order("lightly", (uint8_t[]){0xB0, 67, 30}, (Order){PALM, 0, 30 / 127.0, 0}, true);
  check_order("volume", (uint8_t[]){0xB1, 7, 64}, (Order){GAIN, 1, pow(64 / 127.0, 2.0), 0}, true);
  check_order("expression", (uint8_t[]){0xB3, 11, 0}, (Order){GAIN, 3, 0, 0}, true);
  check_order("pressure", (uint8_t[]){0xD3, 90, 0}, (Order){PRESSURE, 3, 90 / 127.0, 0}, true);
  check_order("of a key", (uint8_t[]){0xA1, 62, 90}, (Order){KEY_PRESSURE, 1, 62, 90 / 127.0},
              true);
  check_order("brightness", (uint8_t[]){0xB4, 74, 0}, (Order){BRIGHTNESS, 4, -1.0, 0}, true);
  check_order("sostenuto", (uint8_t[]){0xB1, 66, 64}, (Order){SOSTENUTO, 1, 1.0, 0}, true);
  check_order("all sound off", (uint8_t[]){0xB3, 120, 0}, (Order){SOUND_OFF, 3, 0, 0}, true);
  check_order("another's", (uint8_t[]){0xB8, 120, 0}, (Order){SOUND_OFF, 8, 0, 0}, false);
  for (uint8_t cc = 123; cc <= 127; ++cc) {
    check_order("all notes off", (uint8_t[]){0xB3, cc, 0}, (Order){NOTES_OFF, 3, 0, 0}, true);
  }
}

/* The pedal is up at 63. */
static void the_pedal_is_down_in_its_upper_half(void** state) {
  static const Step steps[] = {
      {0, {0xB1, 64, 127}, {PEDAL, 1, 1, 0}},   {10, {0x91, 62, 100}, {ON, 1, 62, 100}},
      {2000, {0x81, 62, 64}, {OFF, 1, 62, 0}},  {6000, {0xB1, 64, 64}, {END, 0, 0, 0}},
      {9000, {0xB1, 64, 63}, {PEDAL, 1, 0, 0}},
  };
  (void)state;
  Host* const host = orders_open();
  assert_true(orders_are_told(host, steps, 5));
  host_free(host);
}

static void reset_controllers_lifts_all_but_the_bends_range(void** state) {
  static const Step steps[] = {
      {0, {0xB1, CC_UPPER, 0}, {END, 0, 0, 0}},
      {0, {0xB1, CC_LOWER, 0}, {END, 0, 0, 0}},
      {0, {0xB1, CC_DATA_UPPER, 7}, {END, 0, 0, 0}},
      {0, {0xB1, 64, 127}, {PEDAL, 1, 1, 0}},
      {0, {0xB1, CC_VIBRATO, 127}, {VIBRATO, 1, 0.5, 0}},
      {0, {0xB1, CC_PALM, 60}, {PALM, 0, 60 / 127.0, 0}},
      {0, {0xE1, 0, 96}, {BEND, 1, 3.5, 0}},
      {10, {0x91, 62, 100}, {ON, 1, 62, 100}},
      {2000, {0x81, 62, 64}, {OFF, 1, 62, 0}},
      {6000, {0xB1, 121, 0}, {PEDAL, 1, 0, 0}},
      {6000, {0, 0, 0}, {VIBRATO, 1, 0, 0}},
      {6000, {0, 0, 0}, {PALM, 0, 0, 0}},
      {6000, {0, 0, 0}, {BEND, 1, 0, 0}},
      {6500, {0xB1, CC_DATA_UPPER, 3}, {END, 0, 0, 0}}, /* For no parameter */
      {7000, {0x91, 64, 100}, {ON, 1, 64, 100}},
      {9000, {0xE1, 0, 96}, {BEND, 1, 3.5, 0}},
  };
  (void)state;
  Host* const host = orders_open();
  assert_true(orders_are_told(host, steps, sizeof(steps) / sizeof(steps[0])));
  host_free(host);
}

static Sound play_odd(Host* host, const uint8_t* bytes, uint32_t n_bytes) {
  Sound sound = sound_new(ORDERS_FRAMES);
  strings_restart(host);
  strings_note_on(host, 0, 62, 100);
  if (bytes) {
    assert_true(host_midi(host, 3000, bytes, n_bytes));
  }
  strings_bend(host, 6000, 1.0);
  strings_note_on(host, 6001, 50, 100);
  strings_run(host, &sound, 0, ORDERS_FRAMES, ORDERS_BLOCK);
  return sound;
}

static void what_is_malformed_or_unknown_is_ignored(void** state) {
  static const struct {
    uint8_t bytes[6];
    uint32_t n_bytes;
  } odd[] = {
      {{0}, 0},
      {{0x80}, 1},
      {{0x90, 64}, 2},
      {{0x80, 62}, 2},
      {{0xB0, 120}, 2},
      {{0xE0, 0}, 2},
      {{0x90, 64, 100, 0}, 4},
      {{0xB0, 120, 0, 0}, 4},
      {{0x90, 0x80, 100}, 3},
      {{0x90, 64, 0x80}, 3},
      {{0xB0, 0xF8, 0}, 3},
      {{0xB0, 120, 0xFF}, 3},
      {{0xE0, 0xFF, 0}, 3},
      {{0xA0, 61, 100}, 3},
      {{0xC0, 5, 0}, 3},
      {{0xD0, 100, 0}, 3},
      {{0xF2, 62, 0}, 3},
      {{0xFF, 0, 0}, 3},
      {{0x10, 62, 100}, 3},
      {{0xF0, 0x7E, 0x7F, 9, 1, 0xF7}, 6},
      {{0xB0, 96, 0}, 3},
      {{0xB0, 97, 0}, 3},
      {{0xB0, 2, 0}, 3},
      {{0xB0, 65, 127}, 3},
      {{0xB0, 122, 0}, 3},
      {{0xB0, CC_DATA_UPPER, 12}, 3},
  };
  (void)state;
  Host* const host = guitar_open(ORDERS_RATE, ORDERS_BLOCK);
  Sound clean = play_odd(host, NULL, 0);
  for (size_t i = 0; i < sizeof(odd) / sizeof(odd[0]); ++i) {
    print_message("%02X %u\n", odd[i].bytes[0], odd[i].n_bytes);
    Sound sound = play_odd(host, odd[i].bytes, odd[i].n_bytes);
    assert_true(sound_is_same(&clean, &sound));
    sound_free(&sound);
  }
  sound_free(&clean);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(messages_are_the_guitarists_orders),
      cmocka_unit_test(the_pedal_is_down_in_its_upper_half),
      cmocka_unit_test(reset_controllers_lifts_all_but_the_bends_range),
      cmocka_unit_test(what_is_malformed_or_unknown_is_ignored),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
