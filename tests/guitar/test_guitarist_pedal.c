#include "tests/support/guitarist_player.h"

enum { VELOCITY = 100 };

static const uint32_t C_MAJOR[] = {64, 48, 60, 52, 55};
enum { NOTES = 5 };

static void keys_down(Player player) {
  for (uint32_t n = 0; n < NOTES; ++n) {
    guitarist_note_on(player.guitarist, 0, C_MAJOR[n], VELOCITY);
  }
}

static uint32_t n_damped(Player player) {
  player_run(player, 100);
  return player_count(player.guitar, GUITAR_DAMP);
}

static void the_pedal_holds_what_keys_let_go(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  keys_down(player);
  player_run(player, 100);
  guitarist_note_off(player.guitarist, 0, 48);
  assert_int_equal(n_damped(player), 1);
  guitarist_gesture(player.guitarist, 0, GESTURE_DAMPER, 1.0);
  guitarist_note_off(player.guitarist, 0, 52);
  guitarist_all_notes_off(player.guitarist, 0);
  assert_int_equal(n_damped(player), 1);
  guitarist_note_on(player.guitarist, 0, 55, VELOCITY);
  assert_int_equal(n_damped(player), 1);
  guitarist_gesture(player.guitarist, 0, GESTURE_DAMPER, 0.0);
  assert_int_equal(n_damped(player), NOTES - 1);
  guitarist_note_off(player.guitarist, 0, 55);
  assert_int_equal(n_damped(player), NOTES);
  player_free(player);
}

/* In either mode, and in the other after it. */
static void a_pedal_holds_its_own_channels_notes_alone(void** state) {
  (void)state;
  for (uint32_t mode = 0; mode < 2; ++mode) {
    const Player player = player_how((GuitaristHow){.has_channels = mode > 0});
    for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
      guitarist_note_on(player.guitarist, s, (uint32_t)PLAYER_USUAL.open[s], VELOCITY);
      player_run(player, 100);
    }
    guitarist_gesture(player.guitarist, 2, GESTURE_DAMPER, 1.0);
    guitarist_gesture(player.guitarist, 3, GESTURE_DAMPER, 1.0);
    guitarist_gesture(player.guitarist, 4, GESTURE_DAMPER, 0.9); /* Not down yet */
    for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
      guitarist_note_off(player.guitarist, s, (uint32_t)PLAYER_USUAL.open[s]);
    }
    assert_int_equal(n_damped(player), 4);
    guitarist_gesture(player.guitarist, 2, GESTURE_DAMPER, 0.0);
    assert_int_equal(n_damped(player), 5);
    assert_int_equal(player_last(player.guitar, GUITAR_DAMP)->string,
                     player_nth(player.guitar, GUITAR_PLUCK, 2)->string);
    guitarist_set_how(player.guitarist, (GuitaristHow){.has_channels = mode == 0});
    assert_int_equal(n_damped(player), 5);
    guitarist_gesture(player.guitarist, 3, GESTURE_DAMPER, 0.0);
    assert_int_equal(n_damped(player), 6);
    player_free(player);
  }
}

/* Keys of its channel, not those that come after; until it is up, or another note is played there.
 */
static void sostenuto_holds_what_is_down(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  guitarist_note_on(player.guitarist, 0, 64, VELOCITY);
  player_run(player, 100);
  guitarist_note_on(player.guitarist, 1, 40, VELOCITY);
  player_run(player, 100);
  guitarist_gesture(player.guitarist, 0, GESTURE_SOSTENUTO, 1.0);
  guitarist_note_on(player.guitarist, 0, 45, VELOCITY);
  player_run(player, 100);
  guitarist_note_off(player.guitarist, 0, 45);
  assert_int_equal(n_damped(player), 1);
  assert_int_equal(player_last(player.guitar, GUITAR_DAMP)->string, 4);
  guitarist_note_off(player.guitarist, 1, 40);
  assert_int_equal(n_damped(player), 2);
  guitarist_note_off(player.guitarist, 0, 64);
  assert_int_equal(n_damped(player), 2);
  guitarist_note_on(player.guitarist, 0, 64, VELOCITY); /* The same again is still held. */
  player_run(player, 100);
  guitarist_note_off(player.guitarist, 0, 64);
  guitarist_gesture(player.guitarist, 0, GESTURE_SOSTENUTO, 1.0);
  assert_int_equal(n_damped(player), 2);
  guitarist_gesture(player.guitarist, 0, GESTURE_SOSTENUTO, 0.0);
  assert_int_equal(n_damped(player), 3);
  player_free(player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_pedal_holds_what_keys_let_go),
      cmocka_unit_test(a_pedal_holds_its_own_channels_notes_alone),
      cmocka_unit_test(sostenuto_holds_what_is_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
