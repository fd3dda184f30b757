#include "tests/support/guitarist_hands.h"

enum { HARD = 100, SOFT = 40, LEGATO = 64 };
enum { VELOCITY = HARD };

static void a_channel_is_a_string(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true});
  uint32_t from = 0;
  for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
    on(player, s, 65, HARD);
    player_run(player, 100);
    assert_near(player_last(player.guitar, GUITAR_FRET)->value[0], 65.0 - PLAYER_USUAL.open[s]);
  }
  assert_done(player, &from, "f0 p0 f1 p1 f2 p2 f3 p3 f4 p4 f5 p5");
  assert_near(player_last(player.guitar, GUITAR_PLUCK)->value[0], guitar_force(HARD));
  assert_true(isnan(player_last(player.guitar, GUITAR_PLUCK)->value[1]));
  assert_true(isnan(player_last(player.guitar, GUITAR_PLUCK)->value[2]));
  off(player, 3, 65);
  player_run(player, 100);
  assert_done(player, &from, "d3");
  assert_true(isinf(player_last(player.guitar, GUITAR_DAMP)->value[0]));
  on(player, 0, 60, HARD); /* A string tuned down */
  player_run(player, 100);
  assert_last(player, GUITAR_FRET, 0, -4.0, 0.0);
  player_free(player);
}

/* Nobody's channel: a free string is found. */
static void a_channel_without_a_string_is_played_too(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true});
  uint32_t from = 0;
  on(player, 0, 64, HARD);
  on(player, 9, 66, HARD);
  on(player, 6, 65, HARD);
  player_run(player, 100);
  assert_done(player, &from, "f0 p0 f1 p1 f2 p2");
  off(player, 6, 66); /* Another's key */
  player_run(player, 100);
  assert_done(player, &from, "");
  off(player, 9, 66);
  guitarist_all_notes_off(player.guitarist, 6);
  player_run(player, 100);
  assert_done(player, &from, "d1 d2");
  player_free(player);
}

static void a_new_note_ends_the_one_of_its_string(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true, .legato = LEGATO});
  uint32_t from = 0;
  on(player, 1, 60, HARD);
  player_run(player, 5000);
  on(player, 1, 62, HARD);
  player_run(player, 5000);
  assert_done(player, &from, "f1 p1 f1 p1");
  off(player, 1, 60);
  player_run(player, 100);
  assert_done(player, &from, "");
  off(player, 1, 62);
  player_run(player, 100);
  assert_done(player, &from, "d1");
  player_free(player);
}

/* 20 periods, at least 30 and at most 400 ms. */
static void harmonics_are_touched_for_their_time(void** state) {
  (void)state;
  static const double periods_s[] = {0.4, 20.0 / 220.0, 0.03};
  static const uint32_t keys[] = {28, 57, 81};
  for (uint32_t h = 1; h < 4; ++h) {
    const Player player = player_how((GuitaristHow){.harmonic = h, .legato = LEGATO});
    for (uint32_t i = 0; i < 3; ++i) {
      on(player, 0, keys[i], HARD);
      player_run(player, 4800);
      const uint32_t string = player_last(player.guitar, GUITAR_PLUCK)->string;
      assert_last(player, GUITAR_TOUCH, string, 1.0 / (h + 1.0), periods_s[i]);
      assert_int_equal(player.guitar->calls[player.guitar->n_calls - 1].verb, GUITAR_TOUCH);
    }
    assert_int_equal(player_count(player.guitar, GUITAR_TOUCH), 3);
    on(player, 0, 83, SOFT); /* A hammered note is not touched */
    player_run(player, 100);
    assert_int_equal(player_count(player.guitar, GUITAR_TOUCH), 3);
    assert_int_equal(player_count(player.guitar, GUITAR_HAMMER), 1);
    player_free(player);
  }
  /* In another tuning other periods. */
  GuitarPatch patch = PLAYER_USUAL;
  patch.string.tuning_hz = 400.0;
  patch.capo = 2.0;
  const Player player = player_with(&patch);
  guitarist_set_how(player.guitarist, (GuitaristHow){.harmonic = 1});
  on(player, 0, 57, HARD);
  player_run(player, 100);
  assert_near(player_last(player.guitar, GUITAR_TOUCH)->value[1], 20.0 / 200.0);
  player_free(player);
}

static uint32_t n_damped(Player player) {
  player_run(player, 100);
  return player_count(player.guitar, GUITAR_DAMP);
}

/* Wheels: of the channel's string, or of all that there can be. */
static void wheels_move_their_strings(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 2; ++n) {
    const Player player = player_how((GuitaristHow){.has_channels = n > 0});
    const uint32_t first = player.guitar->n_calls;
    const uint32_t n_moved = n > 0 ? 1 : GUITAR_STRINGS;
    guitarist_bend(player.guitarist, 3, 1.5);
    guitarist_vibrato(player.guitarist, 3, 0.25);
    guitarist_bend(player.guitarist, 9, n > 0 ? 1.0 : 1.5);
    assert_int_equal(player.guitar->n_calls - first, n > 0 ? 2 : 3 * GUITAR_STRINGS);
    for (uint32_t i = 0; i < n_moved; ++i) {
      const FakeCall* const bend = &player.guitar->calls[first + i];
      const FakeCall* const swing = &player.guitar->calls[first + n_moved + i];
      assert_int_equal(bend->verb, GUITAR_BEND);
      assert_int_equal(bend->string, n > 0 ? 3 : i);
      assert_true(bend->value[0] == 1.5 && bend->value[1] == 0.0);
      assert_int_equal(swing->verb, GUITAR_VIBRATO);
      assert_int_equal(swing->string, n > 0 ? 3 : i);
      assert_true(swing->value[0] == 0.25 && swing->value[1] == 5.5);
    }
    /* In the other mode wheels are in their middle. */
    const uint32_t n_bends = player_count(player.guitar, GUITAR_BEND);
    guitarist_set_how(player.guitarist, (GuitaristHow){.has_channels = n > 0, .legato = 1});
    assert_int_equal(player_count(player.guitar, GUITAR_BEND), n_bends);
    guitarist_set_how(player.guitarist, (GuitaristHow){.has_channels = n == 0});
    assert_int_equal(player_count(player.guitar, GUITAR_BEND), n_bends + GUITAR_STRINGS);
    assert_true(player_last(player.guitar, GUITAR_BEND)->value[0] == 0.0);
    assert_true(player_last(player.guitar, GUITAR_VIBRATO)->value[0] == 0.0);
    player_free(player);
  }
}

static void all_notes_off_is_of_a_channel_or_of_all(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 2; ++n) {
    const Player player = player_how((GuitaristHow){.has_channels = n > 0});
    for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
      guitarist_note_on(player.guitarist, s, 60 + s, VELOCITY);
    }
    player_run(player, 100);
    guitarist_all_notes_off(player.guitarist, 2);
    assert_int_equal(n_damped(player), n > 0 ? 1 : PLAYER_STRINGS);
    assert_int_equal(player_last(player.guitar, GUITAR_DAMP)->string, n > 0 ? 2 : 5);
    player_free(player);
  }
}

/* What is not of MIDI, an empty frame, and nobody. */
static void nonsense_is_ignored(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true});
  const uint32_t from = player.guitar->n_calls;
  guitarist_note_on(player.guitarist, 16, 60, VELOCITY);
  guitarist_note_on(player.guitarist, 0, 128, VELOCITY);
  guitarist_note_on(player.guitarist, 0, UINT8_MAX, 0);
  guitarist_note_off(player.guitarist, UINT8_MAX, UINT8_MAX);
  guitarist_pedal(player.guitarist, 16, true);
  guitarist_bend(player.guitarist, 16, 1.0);
  guitarist_vibrato(player.guitarist, 16, 1.0);
  guitarist_all_notes_off(player.guitarist, 16);
  player_run(player, 100);
  assert_int_equal(player.guitar->n_calls, from);
  guitarist_note_on(player.guitarist, 0, 70, 1000);
  float none[1];
  guitarist_run(player.guitarist, 0, none, none);
  assert_int_equal(player.guitar->n_calls, from);
  player_run(player, 100);
  assert_true(player_last(player.guitar, GUITAR_PLUCK)->value[0] == 1.0);
  guitarist_free(NULL);
  player_free(player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_channel_is_a_string),
      cmocka_unit_test(a_channel_without_a_string_is_played_too),
      cmocka_unit_test(a_new_note_ends_the_one_of_its_string),
      cmocka_unit_test(harmonics_are_touched_for_their_time),
      cmocka_unit_test(wheels_move_their_strings),
      cmocka_unit_test(all_notes_off_is_of_a_channel_or_of_all),
      cmocka_unit_test(nonsense_is_ignored),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
