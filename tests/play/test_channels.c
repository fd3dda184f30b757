/* What MIDI says to an instrument where there are no zones: each channel is a player of its own. */
#include "tests/support/player.h"

static void keys_are_their_channels(void** state) {
  (void)state;
  Player player = player_new();
  for (unsigned channel = 1; channel <= 16; ++channel) {
    send(&player, 0x90, channel, 40 + channel, 7 * channel);
    assert_call(&player, RECORD_NOTE_ON, channel, 40 + channel, 7 * channel);
    send(&player, 0x80, channel, 40 + channel, 64);
    assert_call(&player, RECORD_NOTE_OFF, channel, 40 + channel, 0.0);
  }
  assert_int_equal(player.recorder->n_calls, 32);
  player_free(&player);
}

static void muted_keys_go_up_but_not_down(void** state) {
  static const uint8_t down[] = {0x90, 60, 100};
  static const uint8_t up[] = {0x80, 60, 64};
  static const uint8_t bend[] = {0xE0, 0, 96};
  (void)state;
  Player player = player_new();
  channels_play(&player.channels, down, 3, true);
  assert_nothing(&player);
  channels_play(&player.channels, up, 3, true);
  assert_call(&player, RECORD_NOTE_OFF, 1, 60, 0.0);
  channels_play(&player.channels, bend, 3, true);
  assert_call(&player, GESTURE_BEND, 1, 0, 1.0);
  player_free(&player);
}

static void the_wheel_bends_by_two_semitones(void** state) {
  (void)state;
  Player player = player_new();
  wheel(&player, 3, -8192);
  assert_call(&player, GESTURE_BEND, 3, 0, -2.0);
  wheel(&player, 9, 8191);
  assert_call(&player, GESTURE_BEND, 9, 0, 2.0 * 8191 / 8192);
  wheel(&player, 1, 1);
  assert_call(&player, GESTURE_BEND, 1, 0, 2.0 / 8192);
  assert_int_equal(player.recorder->n_calls, 3);
  player_free(&player);
}

/* A number of 0 to 127 for each gesture, and what comes of it. */
static void check_controller(unsigned number, unsigned value, uint32_t verb, double expected) {
  Player player = player_new();
  control(&player, 5, number, value);
  assert_int_equal(player.recorder->n_calls, 1);
  assert_call(&player, verb, 5, 0, expected);
  player_free(&player);
}

static void vibrato_is_at_most_half_a_semitone(void** state) {
  (void)state;
  check_controller(CC_VIBRATO, 0, GESTURE_VIBRATO, 0.0);
  check_controller(CC_VIBRATO, 127, GESTURE_VIBRATO, 0.5);
  check_controller(CC_VIBRATO, 50, GESTURE_VIBRATO, 25.0 / 127.0);
}

static void breath_is_a_share_of_the_force(void** state) {
  (void)state;
  check_controller(CC_BREATH, 0, GESTURE_BREATH, 0.0);
  check_controller(CC_BREATH, 100, GESTURE_BREATH, 100.0 / 127.0);
  check_controller(CC_BREATH, 127, GESTURE_BREATH, 1.0);
}

static void the_sustain_pedal_lifts_in_part_below_64(void** state) {
  (void)state;
  check_controller(CC_SUSTAIN, 0, GESTURE_DAMPER, 0.0);
  check_controller(CC_SUSTAIN, 1, GESTURE_DAMPER, 1.0 / 64.0);
  check_controller(CC_SUSTAIN, 32, GESTURE_DAMPER, 0.5);
  check_controller(CC_SUSTAIN, 63, GESTURE_DAMPER, 63.0 / 64.0);
  check_controller(CC_SUSTAIN, 64, GESTURE_DAMPER, 1.0);
  check_controller(CC_SUSTAIN, 127, GESTURE_DAMPER, 1.0);
}

static void sostenuto_is_down_in_its_upper_half(void** state) {
  (void)state;
  check_controller(CC_SOSTENUTO, 63, GESTURE_SOSTENUTO, 0.0);
  check_controller(CC_SOSTENUTO, 64, GESTURE_SOSTENUTO, 1.0);
}

static void the_soft_pedal_softens_by_degrees(void** state) {
  (void)state;
  check_controller(CC_SOFT, 0, GESTURE_SOFTNESS, 0.0);
  check_controller(CC_SOFT, 30, GESTURE_SOFTNESS, 30.0 / 127.0);
  check_controller(CC_SOFT, 127, GESTURE_SOFTNESS, 1.0);
}

static void brightness_is_neutral_at_64(void** state) {
  (void)state;
  check_controller(CC_BRIGHTNESS, 64, GESTURE_BRIGHTNESS, 0.0);
  check_controller(CC_BRIGHTNESS, 127, GESTURE_BRIGHTNESS, 1.0);
  check_controller(CC_BRIGHTNESS, 1, GESTURE_BRIGHTNESS, -1.0);
  check_controller(CC_BRIGHTNESS, 0, GESTURE_BRIGHTNESS, -1.0);
  check_controller(CC_BRIGHTNESS, 85, GESTURE_BRIGHTNESS, 1.0 / 3.0);
}

static void volume_and_expression_are_one_gain(void** state) {
  (void)state;
  check_controller(CC_VOLUME, 127, GESTURE_GAIN, 1.0);
  check_controller(CC_EXPRESSION, 127, GESTURE_GAIN, 1.0);
  check_controller(CC_EXPRESSION, 0, GESTURE_GAIN, 0.0);
  Player player = player_new();
  control(&player, 1, CC_VOLUME, 100);
  assert_last(&player, GESTURE_GAIN, 1, pow(100.0 / 127.0, 2.0));
  control(&player, 1, CC_EXPRESSION, 64);
  assert_last(&player, GESTURE_GAIN, 1, pow(100.0 * 64.0 / (127.0 * 127.0), 2.0));
  control(&player, 1, CC_VOLUME, 127);
  assert_last(&player, GESTURE_GAIN, 1, pow(64.0 / 127.0, 2.0));
  player_free(&player);
}

static void pressure_is_of_all_keys_or_of_one(void** state) {
  (void)state;
  Player player = player_new();
  press(&player, 4, 127);
  assert_call(&player, GESTURE_PRESSURE, 4, 0, 1.0);
  press(&player, 2, 20);
  assert_call(&player, GESTURE_PRESSURE, 2, 0, 20.0 / 127.0);
  send(&player, 0xA0, 7, 61, 99);
  assert_call(&player, RECORD_PRESS_KEY, 7, 61, 99.0 / 127.0);
  send(&player, 0xA0, 7, 127, 0);
  assert_call(&player, RECORD_PRESS_KEY, 7, 127, 0.0);
  assert_int_equal(player.recorder->n_calls, 4);
  player_free(&player);
}

static void mode_messages_are_all_notes_off(void** state) {
  (void)state;
  for (unsigned number = CC_NOTES_OFF; number <= 127; ++number) {
    check_controller(number, 0, RECORD_ALL_NOTES_OFF, 0.0);
  }
}

static void all_sound_off_is_the_channels(void** state) {
  (void)state;
  check_controller(CC_SOUND_OFF, 0, RECORD_ALL_SOUND_OFF, 0.0);
}

static void what_is_unknown_or_malformed_does_nothing(void** state) {
  static const uint8_t odd[][6] = {
      {0x90, 60},          {0xB0, 64},           {0xD0},        {0x90, 60, 100, 0}, {0xD0, 5, 0},
      {0xC0, 5, 0},        {0xE0, 0x80, 0},      {0xA0, 60},    {0xF0, 0x7E, 0x7F}, {0xFE},
      {0xB0, 64, 0x80, 0}, {0x40, 60, 100},      {0xC0, 9},     {0xB0, 0, 1},       {0xB0, 32, 1},
      {0xB0, 122, 0},      {0xB0, CC_DATA, 12},  {0xB0, 96, 0}, {0xB0, 97, 0},      {0xB0, 65, 127},
      {0xB0, 10, 3},       {0xB0, CC_RPN_UPPER}, {0xB0, 91, 3}, {0xB0, 119, 3},
  };
  static const uint32_t sizes[] = {2, 2, 1, 4, 3, 3, 3, 2, 3, 1, 4, 3,
                                   2, 3, 3, 3, 3, 3, 3, 3, 3, 2, 3, 3};
  (void)state;
  Player player = player_new();
  for (size_t i = 0; i < sizeof(odd) / sizeof(odd[0]); ++i) {
    channels_play(&player.channels, odd[i], sizes[i], false);
    assert_nothing(&player);
  }
  channels_play(&player.channels, odd[0], 0, false);
  assert_nothing(&player);
  player_free(&player);
}

/* Whatever a channel says, in whichever order, nothing is done by another. */
static void no_channel_speaks_for_another(void** state) {
  (void)state;
  for (unsigned channel = 1; channel <= 16; ++channel) {
    Player player = player_new();
    on(&player, channel, 60);
    wheel(&player, channel, 1000);
    press(&player, channel, 100);
    set_parameter(&player, channel, 0, 12);
    set_parameter(&player, channel, 1, 12);
    set_parameter(&player, channel, 2, 12);
    send(&player, 0xA0, channel, 60, 90);
    for (unsigned number = 7; number < 128; ++number) {
      control(&player, channel, number, 100);
    }
    off(&player, channel, 60);
    for (uint32_t i = 0; i < player.recorder->n_calls; ++i) {
      assert_int_equal(player.recorder->calls[i].channel, channel - 1);
    }
    assert_true(player.recorder->n_calls > 20);
    player_free(&player);
  }
}

/* Each has its wheel, range and all else, and none hears of another's. */
static void each_channel_remembers_its_own(void** state) {
  (void)state;
  Player player = player_new();
  for (unsigned channel = 1; channel <= 16; ++channel) {
    set_parameter(&player, channel, 0, channel);
    control(&player, channel, CC_VOLUME, 8 * channel - 1);
  }
  for (unsigned channel = 1; channel <= 16; ++channel) {
    wheel(&player, channel, -8192);
    control(&player, channel, CC_EXPRESSION, 64);
  }
  for (unsigned channel = 1; channel <= 16; ++channel) {
    assert_last(&player, GESTURE_BEND, channel, -(double)channel);
    assert_last(&player, GESTURE_GAIN, channel,
                pow((8.0 * channel - 1.0) * 64.0 / (127.0 * 127.0), 2.0));
  }
  player_free(&player);
}

/* Whatever was done; a message after it does what it did at first. */
static void after_a_reset_all_is_as_at_first(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 5);
  set_parameter(&player, 1, 0, 12);
  set_parameter(&player, 1, 2, 70);
  wheel(&player, 1, 4096);
  press(&player, 1, 100);
  control(&player, 1, CC_VOLUME, 3);
  control(&player, 1, CC_EXPRESSION, 3);
  control(&player, 1, CC_BRIGHTNESS, 100);
  choose(&player, 9, 0);
  channels_reset(&player.channels);
  player_forget(&player);
  control(&player, 9, CC_DATA, 5);
  assert_nothing(&player);
  wheel(&player, 3, -8192);
  assert_call(&player, GESTURE_BEND, 3, 0, -2.0);
  control(&player, 3, CC_VOLUME, 127);
  assert_call(&player, GESTURE_GAIN, 3, 0, 1.0);
  player_free(&player);
}

static void reset_controllers_puts_gestures_at_rest(void** state) {
  (void)state;
  Player player = player_new();
  control(&player, 1, CC_VIBRATO, 100);
  control(&player, 1, CC_BREATH, 10);
  control(&player, 1, CC_SUSTAIN, 127);
  control(&player, 1, CC_SOSTENUTO, 127);
  control(&player, 1, CC_SOFT, 127);
  control(&player, 1, CC_EXPRESSION, 10);
  press(&player, 1, 90);
  send(&player, 0xA0, 1, 60, 90);
  send(&player, 0xA0, 1, 100, 90);
  send(&player, 0xA0, 1, 61, 0);
  wheel(&player, 1, 4000);
  player_forget(&player);
  control(&player, 1, CC_RESET, 0);
  assert_last(&player, GESTURE_VIBRATO, 1, 0.0);
  assert_last(&player, GESTURE_BREATH, 1, 1.0);
  assert_last(&player, GESTURE_DAMPER, 1, 0.0);
  assert_last(&player, GESTURE_SOSTENUTO, 1, 0.0);
  assert_last(&player, GESTURE_SOFTNESS, 1, 0.0);
  assert_last(&player, GESTURE_GAIN, 1, 1.0);
  assert_last(&player, GESTURE_PRESSURE, 1, 0.0);
  assert_last(&player, GESTURE_BEND, 1, 0.0);
  assert_last(&player, RECORD_PRESS_KEY, 1, 0.0);
  assert_int_equal(count(&player, RECORD_PRESS_KEY, 1), 2);
  assert_int_equal(count(&player, RECORD_ALL_NOTES_OFF, 1), 0);
  player_free(&player);
}

static void reset_controllers_leaves_volume_brightness_ranges_and_tunings(void** state) {
  (void)state;
  Player player = player_new();
  set_parameter(&player, 1, 0, 12);
  set_parameter(&player, 1, 2, 69);
  control(&player, 1, CC_VOLUME, 64);
  control(&player, 1, CC_EXPRESSION, 64);
  control(&player, 1, CC_BRIGHTNESS, 127);
  control(&player, 1, CC_RESET, 0);
  assert_last(&player, GESTURE_GAIN, 1, pow(64.0 / 127.0, 2.0));
  assert_last(&player, GESTURE_BRIGHTNESS, 1, 1.0);
  assert_last(&player, GESTURE_BEND, 1, 5.0);
  wheel(&player, 1, 4096);
  assert_last(&player, GESTURE_BEND, 1, 11.0);
  player_forget(&player);
  control(&player, 1, CC_DATA, 3);
  assert_nothing(&player);
  player_free(&player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(keys_are_their_channels),
      cmocka_unit_test(muted_keys_go_up_but_not_down),
      cmocka_unit_test(the_wheel_bends_by_two_semitones),
      cmocka_unit_test(vibrato_is_at_most_half_a_semitone),
      cmocka_unit_test(breath_is_a_share_of_the_force),
      cmocka_unit_test(the_sustain_pedal_lifts_in_part_below_64),
      cmocka_unit_test(sostenuto_is_down_in_its_upper_half),
      cmocka_unit_test(the_soft_pedal_softens_by_degrees),
      cmocka_unit_test(brightness_is_neutral_at_64),
      cmocka_unit_test(volume_and_expression_are_one_gain),
      cmocka_unit_test(pressure_is_of_all_keys_or_of_one),
      cmocka_unit_test(mode_messages_are_all_notes_off),
      cmocka_unit_test(all_sound_off_is_the_channels),
      cmocka_unit_test(what_is_unknown_or_malformed_does_nothing),
      cmocka_unit_test(no_channel_speaks_for_another),
      cmocka_unit_test(each_channel_remembers_its_own),
      cmocka_unit_test(after_a_reset_all_is_as_at_first),
      cmocka_unit_test(reset_controllers_puts_gestures_at_rest),
      cmocka_unit_test(reset_controllers_leaves_volume_brightness_ranges_and_tunings),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
