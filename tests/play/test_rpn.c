/* Registered parameters: which one data entry is for, and what comes of it. */
#include "tests/support/player.h"

static void the_wheels_range_is_semitones_and_cents(void** state) {
  (void)state;
  Player player = player_new();
  wheel(&player, 1, -8192);
  set_parameter(&player, 1, 0, 7);
  assert_last(&player, GESTURE_BEND, 1, -7.0);
  control(&player, 1, CC_DATA_LOWER, 50);
  assert_last(&player, GESTURE_BEND, 1, -7.5);
  control(&player, 1, CC_DATA_LOWER, 127);
  assert_last(&player, GESTURE_BEND, 1, -7.99);
  control(&player, 1, CC_DATA, 12); /* Brings the cents to nought. */
  assert_last(&player, GESTURE_BEND, 1, -12.0);
  control(&player, 1, CC_DATA, 0);
  assert_last(&player, GESTURE_BEND, 1, 0.0);
  player_free(&player);
}

static void the_wheels_range_is_96_semitones_at_most(void** state) {
  (void)state;
  Player player = player_new();
  wheel(&player, 1, -8192);
  set_parameter(&player, 1, 0, 96);
  assert_last(&player, GESTURE_BEND, 1, -96.0);
  control(&player, 1, CC_DATA_LOWER, 1);
  assert_last(&player, GESTURE_BEND, 1, -96.0);
  control(&player, 1, CC_DATA, 127);
  assert_last(&player, GESTURE_BEND, 1, -96.0);
  control(&player, 1, CC_INCREMENT, 0);
  assert_last(&player, GESTURE_BEND, 1, -96.0);
  player_free(&player);
}

static void fine_tuning_has_fourteen_bits_of_a_semitone(void** state) {
  (void)state;
  Player player = player_new();
  set_parameter(&player, 1, 1, 0);
  assert_last(&player, GESTURE_BEND, 1, -1.0);
  control(&player, 1, CC_DATA, 64);
  assert_last(&player, GESTURE_BEND, 1, 0.0);
  control(&player, 1, CC_DATA_LOWER, 1);
  assert_last(&player, GESTURE_BEND, 1, 1.0 / 8192.0);
  control(&player, 1, CC_DATA, 127);
  control(&player, 1, CC_DATA_LOWER, 127);
  assert_last(&player, GESTURE_BEND, 1, 8191.0 / 8192.0);
  player_free(&player);
}

static void coarse_tuning_is_in_semitones(void** state) {
  (void)state;
  Player player = player_new();
  set_parameter(&player, 1, 2, 52);
  assert_last(&player, GESTURE_BEND, 1, -12.0);
  control(&player, 1, CC_DATA_LOWER, 127); /* Has no lower half. */
  assert_last(&player, GESTURE_BEND, 1, -12.0);
  control(&player, 1, CC_DATA, 127);
  assert_last(&player, GESTURE_BEND, 1, 63.0);
  player_free(&player);
}

static void tunings_and_the_wheel_add_up(void** state) {
  (void)state;
  Player player = player_new();
  set_parameter(&player, 1, 0, 12);
  set_parameter(&player, 1, 1, 96);
  set_parameter(&player, 1, 2, 67);
  wheel(&player, 1, -2048);
  assert_last(&player, GESTURE_BEND, 1, 3.0 + 0.5 - 3.0);
  player_free(&player);
}

static void steps_are_a_cent_a_semitone_or_the_least(void** state) {
  (void)state;
  Player player = player_new();
  wheel(&player, 1, -8192);
  set_parameter(&player, 1, 0, 5);
  control(&player, 1, CC_DECREMENT, 0);
  assert_last(&player, GESTURE_BEND, 1, -4.99);
  control(&player, 1, CC_INCREMENT, 127);
  control(&player, 1, CC_INCREMENT, 3);
  assert_last(&player, GESTURE_BEND, 1, -5.01);
  control(&player, 1, CC_DATA, 0);
  control(&player, 1, CC_DECREMENT, 0);
  assert_last(&player, GESTURE_BEND, 1, 0.0);
  choose(&player, 1, 1);
  control(&player, 1, CC_INCREMENT, 0);
  assert_last(&player, GESTURE_BEND, 1, 1.0 / 8192.0);
  choose(&player, 1, 2);
  control(&player, 1, CC_DECREMENT, 0);
  assert_last(&player, GESTURE_BEND, 1, -1.0 + 1.0 / 8192.0);
  control(&player, 1, CC_INCREMENT, 0);
  control(&player, 1, CC_INCREMENT, 0);
  assert_last(&player, GESTURE_BEND, 1, 1.0 + 1.0 / 8192.0);
  player_free(&player);
}

/* Null, a maker's own, one that we do not know, and half of a number. */
static void data_for_no_parameter_is_ignored(void** state) {
  (void)state;
  Player player = player_new();
  wheel(&player, 1, 8191);
  for (int i = 0; i < 5; ++i) {
    choose(&player, 1, 0);
    if (i == 0) {
      choose(&player, 1, 0x3FFF);
    } else if (i == 1) {
      control(&player, 1, CC_NRPN_LOWER, 0);
    } else if (i == 2) {
      control(&player, 1, CC_NRPN_UPPER, 0);
    } else if (i == 3) {
      choose(&player, 1, 5);
    } else {
      control(&player, 1, CC_RPN_UPPER, 1);
    }
    player_forget(&player);
    control(&player, 1, CC_DATA, 24);
    control(&player, 1, CC_DATA_LOWER, 24);
    control(&player, 1, CC_INCREMENT, 0);
    assert_nothing(&player);
  }
  player_free(&player);
}

static void halves_of_a_number_come_in_any_order(void** state) {
  (void)state;
  Player player = player_new();
  control(&player, 1, CC_RPN_LOWER, 2);
  control(&player, 1, CC_DATA, 0); /* Its upper half is still none's. */
  assert_nothing(&player);
  control(&player, 1, CC_RPN_UPPER, 0);
  control(&player, 1, CC_DATA, 65);
  assert_last(&player, GESTURE_BEND, 1, 1.0);
  player_free(&player);
}

/* Two tracks that set up two channels at once must not get in each other's way. */
static void each_channel_chooses_for_itself(void** state) {
  (void)state;
  Player player = player_new();
  choose(&player, 1, 1);
  choose(&player, 2, 2);
  control(&player, 1, CC_DATA, 96);
  assert_last(&player, GESTURE_BEND, 1, 0.5);
  control(&player, 2, CC_DATA, 68);
  assert_last(&player, GESTURE_BEND, 2, 4.0);
  assert_last(&player, GESTURE_BEND, 1, 0.5);
  player_free(&player);
}

static void choosing_does_nothing_by_itself(void** state) {
  (void)state;
  Player player = player_new();
  for (unsigned parameter = 0; parameter < 8; ++parameter) {
    choose(&player, 1, parameter);
  }
  assert_nothing(&player);
  player_free(&player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_wheels_range_is_semitones_and_cents),
      cmocka_unit_test(the_wheels_range_is_96_semitones_at_most),
      cmocka_unit_test(fine_tuning_has_fourteen_bits_of_a_semitone),
      cmocka_unit_test(coarse_tuning_is_in_semitones),
      cmocka_unit_test(tunings_and_the_wheel_add_up),
      cmocka_unit_test(steps_are_a_cent_a_semitone_or_the_least),
      cmocka_unit_test(data_for_no_parameter_is_ignored),
      cmocka_unit_test(halves_of_a_number_come_in_any_order),
      cmocka_unit_test(each_channel_chooses_for_itself),
      cmocka_unit_test(choosing_does_nothing_by_itself),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
