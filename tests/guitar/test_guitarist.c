#include "tests/support/guitarist_player.h"

/* One note and its end; where it was played. */
static RecordedAct note(Player player, uint32_t key) {
  const uint32_t n_plucks = player_count(player.guitar, GUITAR_PLUCK);
  guitarist_note_on(player.guitarist, 0, key, 90);
  player_run(player, PLAYER_REST);
  guitarist_note_off(player.guitarist, 0, key);
  player_run(player, PLAYER_REST);
  assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), n_plucks + 1);
  const RecordedAct fret = *player_last(player.guitar, GUITAR_FRET);
  assert_int_equal(fret.string, player_last(player.guitar, GUITAR_PLUCK)->string);
  return fret;
}

static double sounding(const GuitarPatch* patch, RecordedAct fret) {
  return patch->open[fret.string] + patch->capo + fret.value[0];
}

/* Every key, and every tuning: what is played is what was asked for. */
static void every_key_sounds_as_it_is_called(void** state) {
  (void)state;
  GuitarPatch patch = PLAYER_USUAL;
  patch.capo = 2.0;
  patch.open[2] = 54.63;
  patch.open[5] = 38.0;
  const Player player = player_with(&patch);
  for (uint32_t key = 0; key < PERFORMANCE_KEYS; ++key) {
    const RecordedAct fret = note(player, key);
    assert_true(fabs(sounding(&patch, fret) - key) < 1e-9);
    assert_true(key < 40 || key > 90 || (fret.value[0] > -0.5 && fret.value[0] < 24.5));
  }
  player_free(player);
}

static void a_note_below_all_is_on_the_lowest_string(void** state) {
  (void)state;
  GuitarPatch patch = PLAYER_USUAL;
  const Player player = player_with(&PLAYER_USUAL);
  assert_int_equal(note(player, 38).string, 5);
  assert_true(fabs(note(player, 28).value[0] + 12.0) < 1e-9);
  assert_int_equal(note(player, 127).string, 0);
  player_free(player);
  /* The lowest, wherever it is strung. */
  patch.open[5] = 67.0;
  const Player banjo = player_with(&patch);
  assert_int_equal(note(banjo, 44).string, 4);
  player_free(banjo);
}

/* As low as the guitar can be tuned, and not lower. */
static void no_note_is_too_low_for_the_guitar(void** state) {
  (void)state;
  GuitarPatch patch = PLAYER_USUAL;
  patch.capo = 12.0;
  const Player player = player_with(&patch);
  assert_true(fabs(note(player, 0).value[0] + 48.0) < 1e-9);
  player_free(player);
}

/* Two octaves up from the lowest string and down again: in first position all is at most at fret 4
   but the last string, and open strings are used. */
static void a_low_scale_stays_in_first_position(void** state) {
  (void)state;
  static const uint32_t scale[] = {40, 41, 43, 45, 47, 48, 50, 52, 53,
                                   55, 57, 59, 60, 62, 64, 65, 67, 69};
  enum { NOTES = sizeof scale / sizeof scale[0] };
  const Player player = player_with(&PLAYER_USUAL);
  uint32_t n_open = 0;
  for (uint32_t i = 0; i < 2 * NOTES - 1; ++i) {
    const RecordedAct fret = note(player, scale[i < NOTES ? i : 2 * NOTES - 2 - i]);
    assert_true(fret.value[0] <= (fret.string == 0 ? 5.0 : 4.0));
    n_open += fret.value[0] < 0.5;
  }
  assert_int_equal(n_open, 12);
  player_free(player);
}

/* Where the hand is led up the neck it stays there, and goes no further than it has to. */
static void a_high_scale_stays_in_its_position(void** state) {
  (void)state;
  static const uint32_t up[] = {69, 71, 72, 74, 76};
  static const uint32_t stay[] = {74, 72, 71, 69, 67, 66, 64, 62, 61, 59, 57,
                                  56, 54, 52, 54, 57, 61, 64, 69, 73, 76};
  const Player player = player_with(&PLAYER_USUAL);
  for (uint32_t i = 0; i < sizeof up / sizeof up[0]; ++i) {
    note(player, up[i]);
  }
  assert_true(fabs(player_last(player.guitar, GUITAR_FRET)->value[0] - 12.0) < 1e-9);
  for (uint32_t i = 0; i < sizeof stay / sizeof stay[0]; ++i) {
    const double fret = note(player, stay[i]).value[0];
    assert_true(fret >= 8.0 && fret <= 12.0);
  }
  player_free(player);
}

/* Seven notes on six strings: the oldest goes, and its key is then a key to nothing. */
static void the_oldest_note_gives_way(void** state) {
  (void)state;
  static const uint32_t keys[] = {64, 45, 59, 50, 55, 44};
  GuitarPatch patch = PLAYER_USUAL;
  patch.open[5] = 44.0; /* So that all strings have the seventh */
  for (uint32_t oldest = 0; oldest < PLAYER_STRINGS; ++oldest) {
    const Player player = player_with(&patch);
    for (uint32_t n = 0; n < PLAYER_STRINGS; ++n) {
      guitarist_note_on(player.guitarist, 0, keys[(oldest + n) % PLAYER_STRINGS], 90);
      player_run(player, PLAYER_REST);
    }
    const uint32_t string = player.guitar->calls[0].string;
    guitarist_note_on(player.guitarist, 0, 64 + 2, 90);
    player_run(player, PLAYER_REST);
    assert_int_equal(player_last(player.guitar, GUITAR_PLUCK)->string, string);
    guitarist_note_off(player.guitarist, 0, keys[oldest]);
    player_run(player, PLAYER_REST);
    assert_int_equal(player_count(player.guitar, GUITAR_DAMP), 0);
    guitarist_note_off(player.guitarist, 0, 66);
    player_run(player, PLAYER_REST);
    assert_int_equal(player_last(player.guitar, GUITAR_DAMP)->string, string);
    player_free(player);
  }
}

/* Only among those that can play it: a note that one string alone has takes that, however new. */
static void only_a_string_that_has_the_note_gives_way(void** state) {
  (void)state;
  const Player player = player_with(&PLAYER_USUAL);
  guitarist_note_on(player.guitarist, 0, 64, 90);
  player_run(player, PLAYER_REST);
  guitarist_note_on(player.guitarist, 0, 40, 90);
  player_run(player, PLAYER_REST);
  guitarist_note_on(player.guitarist, 0, 43, 90);
  player_run(player, PLAYER_REST);
  assert_int_equal(player_last(player.guitar, GUITAR_PLUCK)->string, 5);
  player_free(player);
}

static void a_repeated_key_stays_on_its_string(void** state) {
  (void)state;
  const Player player = player_with(&PLAYER_USUAL);
  for (uint32_t key = 45; key < 84; ++key) {
    guitarist_note_on(player.guitarist, 0, key, 90);
    player_run(player, PLAYER_REST);
    const uint32_t string = player_last(player.guitar, GUITAR_PLUCK)->string;
    const uint32_t n_plucks = player_count(player.guitar, GUITAR_PLUCK);
    guitarist_note_on(player.guitarist, 0, key, 90);
    player_run(player, PLAYER_REST);
    assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), n_plucks + 1);
    assert_int_equal(player_last(player.guitar, GUITAR_PLUCK)->string, string);
    guitarist_note_off(player.guitarist, 0, key);
    player_run(player, PLAYER_REST);
    assert_int_equal(player_last(player.guitar, GUITAR_DAMP)->string, string);
  }
  player_free(player);
}

/* With the pedal down: what rings on is left alone where another string is in reach. */
static void a_ringing_string_is_spared(void** state) {
  (void)state;
  const Player player = player_with(&PLAYER_USUAL);
  guitarist_gesture(player.guitarist, 0, GESTURE_DAMPER, 1.0);
  assert_int_equal(note(player, 60).string, 1);
  assert_int_equal(note(player, 59).string, 2);
  assert_int_equal(note(player, 60).string, 1);
  guitarist_gesture(player.guitarist, 0, GESTURE_DAMPER, 0.0);
  assert_int_equal(note(player, 59).string, 1);
  player_free(player);
}

/* More notes than strings in one frame: all are played. */
static void no_note_of_a_cluster_is_left_out(void** state) {
  (void)state;
  for (uint32_t lowest = 0; lowest < 108; ++lowest) {
    const Player player = player_with(&PLAYER_USUAL);
    for (uint32_t n = 0; n < 20; ++n) {
      guitarist_note_on(player.guitarist, 0, lowest + n, 90);
    }
    player_run(player, PLAYER_REST);
    assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), 20);
    player_free(player);
  }
}

/* So is one that the pedal takes over in this frame, or that is still to be plucked; not one that
   has died away. */
static void what_is_spared_rings_or_will(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 3; ++n) {
    const Player player = player_with(&PLAYER_USUAL);
    Guitarist* const guitarist = player.guitarist;
    guitarist_gesture(guitarist, 0, GESTURE_DAMPER, n < 2);
    guitarist_set_how(guitarist, (GuitaristHow){.strum_s = n == 2 ? 0.1 : 0.0});
    guitarist_note_on(guitarist, 0, 40, 90);
    guitarist_note_on(guitarist, 0, 45, 90);
    player_run(player, 100);
    guitarist_note_on(guitarist, 0, 60, 90);
    player_run(player, 2000);
    guitarist_set_how(guitarist, (GuitaristHow){0});
    if (n == 0) {
      guitarist_note_off(guitarist, 0, 60);
      player.guitar->strings[1].is_awake = false;
    }
    guitarist_note_on(guitarist, 0, 59, 90);
    guitarist_note_off(guitarist, 0, 60);
    player_run(player, 100);
    assert_int_equal(player_last(player.guitar, GUITAR_PLUCK)->string, n == 0 ? 1 : 2);
    player_free(player);
  }
}

/* Not the string that is played anew in the same frame, however old its note was. */
static void the_oldest_note_but_those_of_this_frame_gives_way(void** state) {
  (void)state;
  static const uint32_t keys[] = {45, 59, 50, 55, 40, 64};
  const Player player = player_with(&PLAYER_USUAL);
  for (uint32_t n = 0; n < PLAYER_STRINGS; ++n) {
    guitarist_note_on(player.guitarist, 0, keys[n], 90);
    player_run(player, PLAYER_REST);
  }
  guitarist_note_on(player.guitarist, 0, 45, 90);
  guitarist_note_on(player.guitarist, 0, 61, 90);
  player_run(player, PLAYER_REST);
  assert_int_equal(player_last(player.guitar, GUITAR_PLUCK)->string, 1);
  player_free(player);
}

/* What was struck before the modes changed is played in the old one. */
static void a_mode_begins_after_its_frame(void** state) {
  (void)state;
  const Player player = player_with(&PLAYER_USUAL);
  guitarist_note_on(player.guitarist, 3, 64, 90);
  guitarist_set_how(player.guitarist, (GuitaristHow){.has_channels = true});
  player_run(player, 100);
  assert_int_equal(player_last(player.guitar, GUITAR_PLUCK)->string, 0);
  player_free(player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_key_sounds_as_it_is_called),
      cmocka_unit_test(a_note_below_all_is_on_the_lowest_string),
      cmocka_unit_test(no_note_is_too_low_for_the_guitar),
      cmocka_unit_test(a_low_scale_stays_in_first_position),
      cmocka_unit_test(a_high_scale_stays_in_its_position),
      cmocka_unit_test(the_oldest_note_gives_way),
      cmocka_unit_test(only_a_string_that_has_the_note_gives_way),
      cmocka_unit_test(a_repeated_key_stays_on_its_string),
      cmocka_unit_test(a_ringing_string_is_spared),
      cmocka_unit_test(no_note_of_a_cluster_is_left_out),
      cmocka_unit_test(what_is_spared_rings_or_will),
      cmocka_unit_test(the_oldest_note_but_those_of_this_frame_gives_way),
      cmocka_unit_test(a_mode_begins_after_its_frame),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
