/* Zones: which channels follow which, and who hears what. */
#include "tests/support/player.h"

/* A member hears its leader's wheel; nobody else does. */
static void assert_follows(Player* player, unsigned leader, unsigned from, unsigned to) {
  player_forget(player);
  wheel(player, leader, 100);
  for (unsigned channel = 1; channel <= 16; ++channel) {
    const bool hears = channel == leader || (channel >= from && channel <= to);
    assert_int_equal(count(player, GESTURE_BEND, channel), hears);
  }
  wheel(player, leader, 0);
}

static void every_size_of_zone_is_its_leader_and_its_members(void** state) {
  (void)state;
  Player player = player_new();
  for (unsigned n = 1; n <= 15; ++n) {
    zone(&player, 1, n);
    assert_follows(&player, 1, 2, n + 1);
    zone(&player, 1, 0);
    zone(&player, 16, n);
    assert_follows(&player, 16, 16 - n, 15);
    zone(&player, 16, 0);
    assert_follows(&player, 1, 1, 1);
    assert_follows(&player, 16, 16, 16);
  }
  player_free(&player);
}

static void a_later_zone_takes_channels_from_the_other(void** state) {
  (void)state;
  Player player = player_new();
  for (unsigned upper = 1; upper <= 15; ++upper) {
    channels_reset(&player.channels);
    zone(&player, 1, 7);
    zone(&player, 16, upper);
    const unsigned left = upper >= 14 ? 0 : 14 - upper < 7 ? 14 - upper : 7;
    assert_follows(&player, 16, 16 - upper, 15);
    if (upper < 15) {
      assert_follows(&player, 1, 2, 1 + left);
    }
    channels_reset(&player.channels);
    zone(&player, 16, 7);
    zone(&player, 1, upper);
    assert_follows(&player, 1, 2, 1 + upper);
    if (upper < 15) {
      assert_follows(&player, 16, 16 - left, 15);
    }
  }
  player_free(&player);
}

/* On other channels, of more members than there are, or by anything but the upper half. */
static void a_zone_that_cannot_be_is_ignored(void** state) {
  (void)state;
  Player player = player_new();
  for (unsigned channel = 2; channel <= 15; ++channel) {
    zone(&player, channel, 5);
  }
  zone(&player, 1, 16);
  zone(&player, 16, 127);
  control(&player, 1, CC_DATA_LOWER, 5);
  control(&player, 1, CC_INCREMENT, 5);
  assert_nothing(&player);
  zone(&player, 1, 0);
  assert_nothing(&player);
  player_free(&player);
}

static void a_members_wheel_bends_by_48_and_its_leaders_by_two_more(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 15);
  wheel(&player, 3, 4096);
  assert_last(&player, GESTURE_BEND, 3, 24.0);
  wheel(&player, 1, -8192);
  assert_last(&player, GESTURE_BEND, 3, 22.0);
  assert_last(&player, GESTURE_BEND, 4, -2.0);
  assert_last(&player, GESTURE_BEND, 1, -2.0);
  wheel(&player, 4, -8192);
  assert_last(&player, GESTURE_BEND, 4, -50.0);
  player_free(&player);
}

static void a_members_range_is_every_members(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 4);
  zone(&player, 16, 4);
  set_parameter(&player, 3, 0, 24);
  control(&player, 3, CC_DATA_LOWER, 50);
  for (unsigned channel = 2; channel <= 5; ++channel) {
    wheel(&player, channel, -8192);
    assert_last(&player, GESTURE_BEND, channel, -24.5);
  }
  wheel(&player, 15, -8192);
  assert_last(&player, GESTURE_BEND, 15, -48.0);
  wheel(&player, 1, -8192);
  assert_last(&player, GESTURE_BEND, 1, -2.0);
  wheel(&player, 9, -8192);
  assert_last(&player, GESTURE_BEND, 9, -2.0);
  player_free(&player);
}

static void a_leaders_range_is_its_own(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 4);
  set_parameter(&player, 1, 0, 12);
  wheel(&player, 2, -8192);
  assert_last(&player, GESTURE_BEND, 2, -48.0);
  wheel(&player, 1, 4096);
  assert_last(&player, GESTURE_BEND, 2, -42.0);
  assert_last(&player, GESTURE_BEND, 5, 6.0);
  player_free(&player);
}

static void tunings_are_the_zones(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 4);
  set_parameter(&player, 1, 2, 66);
  set_parameter(&player, 1, 1, 32);
  for (unsigned channel = 1; channel <= 5; ++channel) {
    assert_last(&player, GESTURE_BEND, channel, 1.5);
  }
  player_forget(&player);
  set_parameter(&player, 2, 2, 70); /* A member has none of its own. */
  set_parameter(&player, 2, 1, 70);
  assert_nothing(&player);
  player_free(&player);
}

static void pressure_is_that_of_whoever_presses_harder(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 16, 3);
  press(&player, 15, 80);
  assert_last(&player, GESTURE_PRESSURE, 15, 80.0 / 127.0);
  press(&player, 16, 50);
  assert_last(&player, GESTURE_PRESSURE, 15, 80.0 / 127.0);
  assert_last(&player, GESTURE_PRESSURE, 14, 50.0 / 127.0);
  assert_last(&player, GESTURE_PRESSURE, 16, 50.0 / 127.0);
  press(&player, 16, 127);
  assert_last(&player, GESTURE_PRESSURE, 15, 1.0);
  press(&player, 16, 0);
  assert_last(&player, GESTURE_PRESSURE, 15, 80.0 / 127.0);
  assert_true(isnan(last(&player, GESTURE_PRESSURE, 12)));
  player_free(&player);
}

static void brightness_adds_up(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 3);
  control(&player, 2, CC_BRIGHTNESS, 85);
  assert_last(&player, GESTURE_BRIGHTNESS, 2, 1.0 / 3.0);
  control(&player, 1, CC_BRIGHTNESS, 43);
  assert_last(&player, GESTURE_BRIGHTNESS, 2, 0.0);
  assert_last(&player, GESTURE_BRIGHTNESS, 3, -1.0 / 3.0);
  assert_last(&player, GESTURE_BRIGHTNESS, 1, -1.0 / 3.0);
  control(&player, 1, CC_BRIGHTNESS, 127);
  assert_last(&player, GESTURE_BRIGHTNESS, 2, 1.0);
  control(&player, 2, CC_BRIGHTNESS, 0);
  assert_last(&player, GESTURE_BRIGHTNESS, 2, 0.0);
  control(&player, 1, CC_BRIGHTNESS, 0);
  assert_last(&player, GESTURE_BRIGHTNESS, 2, -1.0);
  player_free(&player);
}

static void a_leaders_pedals_vibrato_and_breath_are_the_zones(void** state) {
  static const struct {
    unsigned number;
    uint32_t verb;
    double value; /* Of 64 */
  } all[] = {
      {CC_VIBRATO, GESTURE_VIBRATO, 32.0 / 127.0}, {CC_BREATH, GESTURE_BREATH, 64.0 / 127.0},
      {CC_SUSTAIN, GESTURE_DAMPER, 1.0},           {CC_SOSTENUTO, GESTURE_SOSTENUTO, 1.0},
      {CC_SOFT, GESTURE_SOFTNESS, 64.0 / 127.0},   {CC_NOTES_OFF, RECORD_ALL_NOTES_OFF, 0.0},
  };
  (void)state;
  Player player = player_new();
  zone(&player, 1, 5);
  zone(&player, 16, 2);
  for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); ++i) {
    player_forget(&player);
    control(&player, 1, all[i].number, 64);
    for (unsigned channel = 1; channel <= 6; ++channel) {
      assert_last(&player, all[i].verb, channel, all[i].value);
    }
    assert_int_equal(player.recorder->n_calls, 6);
  }
  player_free(&player);
}

static void a_member_has_no_word_in_what_is_its_zones(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 5);
  on(&player, 3, 60);
  player_forget(&player);
  for (unsigned number = 0; number < 128; ++number) {
    const bool is_data = number == CC_DATA || number == CC_DATA_LOWER ||
                         (number >= CC_INCREMENT && number <= CC_RPN_UPPER);
    if (number != CC_BRIGHTNESS && !is_data) {
      control(&player, 3, number, 127);
      control(&player, 3, number, 0);
    }
  }
  send(&player, 0xA0, 3, 60, 100);
  send(&player, 0xC0, 3, 60, 0);
  assert_nothing(&player);
  player_free(&player);
}

static void a_leaders_volume_and_expression_are_the_zones(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 5);
  control(&player, 1, CC_VOLUME, 64);
  control(&player, 1, CC_EXPRESSION, 64);
  control(&player, 9, CC_EXPRESSION, 32);
  for (unsigned channel = 1; channel <= 6; ++channel) {
    assert_last(&player, GESTURE_GAIN, channel, pow(64.0 / 127.0, 4.0));
  }
  assert_last(&player, GESTURE_GAIN, 9, pow(32.0 / 127.0, 2.0));
  player_free(&player);
}

static void a_leaders_all_sound_off_is_the_zones(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 5);
  zone(&player, 16, 2);
  control(&player, 16, CC_SOUND_OFF, 0);
  for (unsigned channel = 1; channel <= 16; ++channel) {
    assert_int_equal(count(&player, RECORD_ALL_SOUND_OFF, channel), channel >= 14);
  }
  player_free(&player);
}

/* Counted from the leader; what is in no zone, or leads one, has none among members. */
static void members_are_seated_in_their_order(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 6);
  zone(&player, 16, 3);
  for (unsigned seat = 0; seat < 6; ++seat) {
    assert_last(&player, RECORD_SEAT, 2 + seat, seat);
  }
  for (unsigned seat = 0; seat < 3; ++seat) {
    assert_last(&player, RECORD_SEAT, 15 - seat, seat);
  }
  assert_last(&player, RECORD_SEAT, 1, 16.0);
  assert_last(&player, RECORD_SEAT, 16, 16.0);
  assert_true(isnan(last(&player, RECORD_SEAT, 9)));
  zone(&player, 1, 0);
  for (unsigned channel = 1; channel <= 7; ++channel) {
    assert_last(&player, RECORD_SEAT, channel, channel - 1.0);
  }
  player_free(&player);
}

static void a_leader_presses_keys_of_its_own(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 16, 5);
  send(&player, 0xA0, 16, 50, 127);
  assert_call(&player, RECORD_PRESS_KEY, 16, 50, 1.0);
  player_free(&player);
}

static void channels_outside_play_alone_and_hear_no_zone(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 3);
  zone(&player, 16, 3);
  player_forget(&player);
  wheel(&player, 8, -8192);
  assert_call(&player, GESTURE_BEND, 8, 0, -2.0);
  control(&player, 12, CC_SUSTAIN, 127);
  assert_call(&player, GESTURE_DAMPER, 12, 0, 1.0);
  press(&player, 7, 127);
  assert_call(&player, GESTURE_PRESSURE, 7, 0, 1.0);
  send(&player, 0xA0, 7, 50, 127);
  assert_call(&player, RECORD_PRESS_KEY, 7, 50, 1.0);
  control(&player, 6, CC_NOTES_OFF, 0);
  assert_call(&player, RECORD_ALL_NOTES_OFF, 6, 0, 0.0);
  assert_int_equal(player.recorder->n_calls, 5);
  player_free(&player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_size_of_zone_is_its_leader_and_its_members),
      cmocka_unit_test(a_later_zone_takes_channels_from_the_other),
      cmocka_unit_test(a_zone_that_cannot_be_is_ignored),
      cmocka_unit_test(a_members_wheel_bends_by_48_and_its_leaders_by_two_more),
      cmocka_unit_test(a_members_range_is_every_members),
      cmocka_unit_test(a_leaders_range_is_its_own),
      cmocka_unit_test(tunings_are_the_zones),
      cmocka_unit_test(pressure_is_that_of_whoever_presses_harder),
      cmocka_unit_test(brightness_adds_up),
      cmocka_unit_test(a_leaders_pedals_vibrato_and_breath_are_the_zones),
      cmocka_unit_test(a_member_has_no_word_in_what_is_its_zones),
      cmocka_unit_test(a_leaders_volume_and_expression_are_the_zones),
      cmocka_unit_test(a_leaders_all_sound_off_is_the_zones),
      cmocka_unit_test(members_are_seated_in_their_order),
      cmocka_unit_test(a_leader_presses_keys_of_its_own),
      cmocka_unit_test(channels_outside_play_alone_and_hear_no_zone),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
