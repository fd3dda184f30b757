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
  guitarist_pedal(player.guitarist, 3, true); /* Any channel's, and two feet */
  guitarist_pedal(player.guitarist, 4, true);
  guitarist_note_off(player.guitarist, 0, 52);
  guitarist_all_notes_off(player.guitarist, 7);
  assert_int_equal(n_damped(player), 1);
  guitarist_pedal(player.guitarist, 4, false);
  guitarist_pedal(player.guitarist, 5, false);
  guitarist_note_on(player.guitarist, 0, 55, VELOCITY);
  assert_int_equal(n_damped(player), 1);
  guitarist_pedal(player.guitarist, 3, false);
  assert_int_equal(n_damped(player), NOTES - 1);
  guitarist_note_off(player.guitarist, 0, 55);
  assert_int_equal(n_damped(player), NOTES);
  player_free(player);
}

static void with_channels_each_string_has_its_pedal(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true});
  for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
    guitarist_note_on(player.guitarist, s, 70, VELOCITY);
  }
  player_run(player, 100);
  guitarist_pedal(player.guitarist, 2, true);
  guitarist_pedal(player.guitarist, 3, true);
  for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
    guitarist_note_off(player.guitarist, s, 70);
  }
  assert_int_equal(n_damped(player), 4);
  guitarist_pedal(player.guitarist, 2, false);
  assert_int_equal(n_damped(player), 5);
  assert_int_equal(player_last(player.guitar, GUITAR_DAMP)->string, 2);
  /* With one channel for all the foot is still down; and up again it was the one of all. */
  guitarist_set_how(player.guitarist, (GuitaristHow){0});
  assert_int_equal(n_damped(player), 5);
  guitarist_pedal(player.guitarist, 3, false);
  assert_int_equal(n_damped(player), 6);
  player_free(player);
}

/* What the pedal of another channel held is let go when channels come to matter. */
static void a_pedal_that_is_nobodys_holds_nothing(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  guitarist_pedal(player.guitarist, 3, true);
  guitarist_note_on(player.guitarist, 0, 60, VELOCITY);
  player_run(player, 100);
  guitarist_note_off(player.guitarist, 0, 60);
  assert_int_equal(n_damped(player), 0);
  guitarist_set_how(player.guitarist, (GuitaristHow){.has_channels = true});
  assert_int_equal(n_damped(player), 1);
  player_free(player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_pedal_holds_what_keys_let_go),
      cmocka_unit_test(with_channels_each_string_has_its_pedal),
      cmocka_unit_test(a_pedal_that_is_nobodys_holds_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
