/* How channels start afresh, and how a member lets go of what it played. */
#include "tests/support/player.h"

/* The channels, as bits, that did something. */
static uint32_t channels_that(const Player* player, uint32_t verb) {
  uint32_t channels = 0;
  for (uint32_t channel = 1; channel <= 16; ++channel) {
    channels |= count(player, verb, channel) ? 1u << (channel - 1) : 0;
  }
  return channels;
}

static void a_zone_that_is_set_up_puts_its_keys_up(void** state) {
  (void)state;
  Player player = player_new();
  on(&player, 1, 60);
  player_forget(&player);
  zone(&player, 1, 5);
  assert_int_equal(channels_that(&player, RECORD_ALL_NOTES_OFF), 0x3F);
  player_forget(&player);
  zone(&player, 1, 5); /* Again the same */
  assert_int_equal(channels_that(&player, RECORD_ALL_NOTES_OFF), 0x3F);
  player_free(&player);
}

static void the_other_zone_plays_on(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 5);
  wheel(&player, 2, -8192);
  control(&player, 1, CC_SUSTAIN, 127);
  player_forget(&player);
  zone(&player, 16, 4); /* Channels 12 to 16 */
  assert_int_equal(channels_that(&player, RECORD_ALL_NOTES_OFF), 0xF800);
  assert_int_equal(channels_that(&player, GESTURE_BEND), 0xF800);
  player_forget(&player);
  zone(&player, 16, 11); /* Leaves channels 1 to 4 to the lower zone. */
  assert_int_equal(channels_that(&player, RECORD_ALL_NOTES_OFF), 0xFFF0);
  wheel(&player, 1, -8192);
  assert_last(&player, GESTURE_BEND, 2, -50.0);
  player_free(&player);
}

static void a_zone_whose_leader_is_taken_is_gone(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 3);
  wheel(&player, 1, -8192);
  player_forget(&player);
  zone(&player, 16, 14);
  assert_int_equal(channels_that(&player, RECORD_ALL_NOTES_OFF), 0xFFFF);
  assert_last(&player, GESTURE_BEND, 1, 0.0);
  zone(&player, 16, 0);
  wheel(&player, 16, -8192);
  assert_call(&player, GESTURE_BEND, 16, 0, -2.0);
  player_free(&player);
}

/* What was said before is not heard in a zone, and neither is it after; but volumes stay. */
static void all_starts_afresh_with_a_zone_and_without(void** state) {
  (void)state;
  Player player = player_new();
  for (unsigned n = 0; n <= 5; n += 5) {
    zone(&player, 1, 5 - n);
    for (unsigned channel = 1; channel <= 16; ++channel) {
      set_parameter(&player, channel, 0, 11);
      set_parameter(&player, channel, 2, 60);
      wheel(&player, channel, -8192);
      press(&player, channel, 100);
      control(&player, channel, CC_SUSTAIN, 127);
      control(&player, channel, CC_SOSTENUTO, 127);
      control(&player, channel, CC_SOFT, 127);
      control(&player, channel, CC_VIBRATO, 127);
      control(&player, channel, CC_BREATH, 0);
      control(&player, channel, CC_BRIGHTNESS, 127);
      control(&player, channel, CC_EXPRESSION, 64);
    }
    control(&player, 1, CC_VOLUME, 64);
    player_forget(&player);
    zone(&player, 1, n);
    for (unsigned channel = 1; channel <= 6; ++channel) {
      assert_last(&player, GESTURE_BEND, channel, 0.0);
      assert_last(&player, GESTURE_PRESSURE, channel, 0.0);
      assert_last(&player, GESTURE_DAMPER, channel, 0.0);
      assert_last(&player, GESTURE_SOSTENUTO, channel, 0.0);
      assert_last(&player, GESTURE_SOFTNESS, channel, 0.0);
      assert_last(&player, GESTURE_VIBRATO, channel, 0.0);
      assert_last(&player, GESTURE_BREATH, channel, 1.0);
      assert_last(&player, GESTURE_BRIGHTNESS, channel, 0.0);
      const bool is_loud = n == 0 && channel > 1; /* Follows channel 1 no more */
      assert_last(&player, GESTURE_GAIN, channel, is_loud ? 1.0 : pow(64.0 / 127.0, 2.0));
    }
    wheel(&player, 5, -8192);
    assert_last(&player, GESTURE_BEND, 5, n ? -48.0 : -2.0);
  }
  player_free(&player);
}

/* What rings on is not to glide when its channel starts afresh. */
static void what_rings_is_let_go_before_its_channel_starts_afresh(void** state) {
  (void)state;
  Player player = player_new();
  wheel(&player, 1, -8192);
  on(&player, 1, 60);
  player_forget(&player);
  zone(&player, 1, 15);
  uint32_t up = 0;
  uint32_t gone = 0;
  uint32_t bent = 0;
  for (uint32_t i = 0; i < player.recorder->n_calls; ++i) {
    const RecordedCall* const call = &player.recorder->calls[i];
    up = call->channel == 0 && call->verb == RECORD_ALL_NOTES_OFF ? i + 1 : up;
    gone = call->channel == 0 && call->verb == RECORD_LET_GO ? i + 1 : gone;
    bent = call->channel == 0 && call->verb == GESTURE_BEND ? i + 1 : bent;
  }
  assert_true(0 < up && up < gone && gone < bent);
  player_free(&player);
}

/* One message to a member that has let its only key go; how often it then lets go. */
static uint32_t let_go_by(unsigned kind, unsigned channel, unsigned a, unsigned b) {
  Player player = player_new();
  zone(&player, 1, 5);
  on(&player, 2, 60);
  off(&player, 2, 60);
  player_forget(&player);
  send(&player, kind, channel, a, b);
  const uint32_t n = count(&player, RECORD_LET_GO, 2);
  assert_true(n == 0 || player.recorder->calls[0].verb == RECORD_LET_GO);
  player_free(&player);
  return n;
}

static void a_member_that_is_told_something_new_lets_go_first(void** state) {
  (void)state;
  assert_int_equal(let_go_by(0x90, 2, 62, 100), 1);
  assert_int_equal(let_go_by(0xE0, 2, 0, 0), 1);
  assert_int_equal(let_go_by(0xD0, 2, 9, 0), 1);
  assert_int_equal(let_go_by(0xB0, 2, CC_BRIGHTNESS, 9), 1);
}

static void what_a_member_let_ring_follows_its_leader(void** state) {
  (void)state;
  assert_int_equal(let_go_by(0xE0, 1, 0, 0), 0);
  assert_int_equal(let_go_by(0xD0, 1, 9, 0), 0);
  assert_int_equal(let_go_by(0xB0, 1, CC_SUSTAIN, 9), 0);
  assert_int_equal(let_go_by(0x90, 3, 60, 9), 0);
  assert_int_equal(let_go_by(0xE0, 3, 0, 9), 0);
  assert_int_equal(let_go_by(0x80, 2, 60, 9), 0);
}

static void a_member_holds_on_while_a_key_is_down(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 5);
  player_forget(&player);
  wheel(&player, 2, 100);
  on(&player, 2, 60);
  on(&player, 2, 70);
  off(&player, 2, 60);
  wheel(&player, 2, 1000);
  on(&player, 2, 127);
  on(&player, 2, 6);
  off(&player, 2, 127);
  off(&player, 2, 6);
  on(&player, 2, 102);
  off(&player, 2, 102); /* 32 from one that stays */
  press(&player, 2, 100);
  assert_int_equal(count(&player, RECORD_LET_GO, 2), 0);
  off(&player, 2, 70);
  assert_int_equal(count(&player, RECORD_LET_GO, 2), 0);
  wheel(&player, 2, 0);
  wheel(&player, 2, 5); /* Nothing is left. */
  on(&player, 2, 60);
  assert_int_equal(count(&player, RECORD_LET_GO, 2), 1);
  control(&player, 1, CC_NOTES_OFF, 0);
  wheel(&player, 2, 5);
  assert_int_equal(count(&player, RECORD_LET_GO, 2), 2);
  player_free(&player);
}

static void members_let_go_when_their_range_changes(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 5);
  on(&player, 2, 60);
  off(&player, 2, 60);
  on(&player, 3, 60);
  player_forget(&player);
  set_parameter(&player, 4, 0, 24);
  assert_int_equal(channels_that(&player, RECORD_LET_GO), 2);
  player_free(&player);
}

/* A leader plays chords, and so do channels outside; their wheel bends what rings. */
static void leaders_and_channels_outside_never_let_go(void** state) {
  (void)state;
  Player player = player_new();
  for (int is_zoned = 0; is_zoned <= 1; ++is_zoned) {
    zone(&player, 16, is_zoned ? 5 : 0);
    player_forget(&player);
    for (unsigned channel = 1; channel <= 16; channel += 15) {
      on(&player, channel, 60);
      off(&player, channel, 60);
      wheel(&player, channel, 500);
      on(&player, channel, 61);
    }
    assert_int_equal(channels_that(&player, RECORD_LET_GO), 0);
  }
  player_free(&player);
}

static void silence_forgets_keys_that_are_down(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 5);
  on(&player, 2, 60);
  control(&player, 1, CC_SOUND_OFF, 0);
  assert_int_equal(count(&player, RECORD_ALL_SOUND_OFF, 2), 1);
  wheel(&player, 2, 5);
  player_forget(&player);
  on(&player, 2, 62);
  off(&player, 2, 62);
  wheel(&player, 2, 5);
  assert_int_equal(count(&player, RECORD_LET_GO, 2), 1);
  player_free(&player);
}

static void reset_controllers_is_the_whole_zones(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 3);
  zone(&player, 16, 3);
  wheel(&player, 2, -8192);
  wheel(&player, 15, -8192);
  control(&player, 1, CC_SUSTAIN, 127);
  control(&player, 16, CC_SUSTAIN, 127);
  press(&player, 4, 99);
  choose(&player, 4, 0);
  choose(&player, 15, 0);
  player_forget(&player);
  control(&player, 1, CC_RESET, 0);
  assert_last(&player, GESTURE_BEND, 2, 0.0);
  assert_last(&player, GESTURE_PRESSURE, 4, 0.0);
  for (unsigned channel = 1; channel <= 4; ++channel) {
    assert_last(&player, GESTURE_DAMPER, channel, 0.0);
  }
  assert_int_equal(count(&player, GESTURE_BEND, 15) + count(&player, GESTURE_DAMPER, 16), 0);
  player_forget(&player);
  control(&player, 4, CC_DATA, 5);
  assert_nothing(&player);
  control(&player, 15, CC_DATA, 5);
  assert_last(&player, GESTURE_BEND, 15, -5.0);
  player_free(&player);
}

static void reset_controllers_is_of_one_channel_outside(void** state) {
  (void)state;
  Player player = player_new();
  zone(&player, 1, 3);
  choose(&player, 9, 0);
  choose(&player, 12, 0);
  choose(&player, 2, 0);
  control(&player, 12, CC_RESET, 0);
  player_forget(&player);
  control(&player, 12, CC_DATA, 7);
  assert_nothing(&player);
  control(&player, 9, CC_DATA, 7);
  assert_int_equal(channels_that(&player, GESTURE_BEND), 0x100);
  player_forget(&player);
  control(&player, 2, CC_DATA, 7);
  assert_int_equal(channels_that(&player, GESTURE_BEND), 0xE);
  player_free(&player);
}

/* The first channel is itself in a zone that it does not lead, and in none. */
static void a_channel_is_in_one_place_at_a_time(void** state) {
  static const Zones none = {0};
  Zones zones = {0};
  (void)state;
  zones_set(&zones, ZONES_UPPER, ZONES_MOST_MEMBERS);
  for (uint32_t channel = 0; channel < ZONES_CHANNELS; ++channel) {
    assert_true(zones_agree(&zones, &zones, channel));
    assert_false(zones_agree(&zones, &none, channel));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_zone_that_is_set_up_puts_its_keys_up),
      cmocka_unit_test(the_other_zone_plays_on),
      cmocka_unit_test(a_zone_whose_leader_is_taken_is_gone),
      cmocka_unit_test(all_starts_afresh_with_a_zone_and_without),
      cmocka_unit_test(what_rings_is_let_go_before_its_channel_starts_afresh),
      cmocka_unit_test(a_member_that_is_told_something_new_lets_go_first),
      cmocka_unit_test(what_a_member_let_ring_follows_its_leader),
      cmocka_unit_test(a_member_holds_on_while_a_key_is_down),
      cmocka_unit_test(members_let_go_when_their_range_changes),
      cmocka_unit_test(leaders_and_channels_outside_never_let_go),
      cmocka_unit_test(reset_controllers_is_the_whole_zones),
      cmocka_unit_test(reset_controllers_is_of_one_channel_outside),
      cmocka_unit_test(a_channel_is_in_one_place_at_a_time),
      cmocka_unit_test(silence_forgets_keys_that_are_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
