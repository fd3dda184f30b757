#include "tests/support/guitarist_hands.h"

enum { HARD = 100, SOFT = 40, LEGATO = 64 };

static void a_soft_note_is_hammered_on(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 2; ++n) {
    const bool has_channels = n > 0;
    const uint32_t channel = n;
    const Player player =
        player_how((GuitaristHow){.has_channels = has_channels, .legato = LEGATO});
    uint32_t from = 0;
    on(player, channel, 60, HARD);
    player_run(player, 2401);
    on(player, channel, 62, LEGATO);
    player_run(player, 100);
    assert_done(player, &from, "f1 p1 h1");
    assert_last(player, GUITAR_HAMMER, 1, 3.0, guitar_force(LEGATO));
    off(player, channel, 62);
    player_run(player, 100);
    assert_done(player, &from, "h1");
    assert_last(player, GUITAR_HAMMER, 1, 1.0, 0.5 * guitar_force(LEGATO));
    off(player, channel, 60);
    player_run(player, 100);
    assert_done(player, &from, "d1");
    on(player, channel, 60, SOFT); /* There is nothing to hammer onto */
    player_run(player, 5000);
    on(player, channel, 62, LEGATO + 1);
    player_run(player, 100);
    assert_done(player, &from, has_channels ? "f1 p1 f1 p1" : "f1 p1 f2 p2");
    player_free(player);
  }
}

/* Each of what makes a hammer-on with one channel, just missed. */
static void other_soft_notes_are_plucked(void** state) {
  (void)state;
  const GuitaristHow how = {.legato = LEGATO};
  uint32_t from = 0;
  Player player = player_how(how);
  player_run(player, 10000);
  on(player, 0, 60, SOFT); /* Alone */
  player_run(player, 2400);
  on(player, 0, 62, SOFT); /* Too soon */
  player_run(player, 2401);
  assert_done(player, &from, "f1 p1 f2 p2");
  on(player, 0, 64, SOFT); /* With another */
  on(player, 0, 50, SOFT);
  player_run(player, 4800);
  assert_done(player, &from, "f0 p0 f3 p3");
  on(player, 0, 50, SOFT); /* Again */
  player_run(player, 100);
  assert_done(player, &from, "f3 p3");
  player_free(player);
  player = player_how(how);
  from = 0;
  on(player, 0, 60, SOFT);
  player_run(player, 4800);
  on(player, 0, 62, SOFT); /* Two frets */
  player_run(player, 4800);
  assert_done(player, &from, "f1 p1 h1");
  on(player, 0, 65, SOFT); /* Three */
  player_run(player, 4800);
  assert_done(player, &from, "f0 p0");
  on(player, 0, 63, SOFT); /* Below the nut, and no string in reach of the first finger */
  player_run(player, 4800);
  assert_done(player, &from, "f2 p2");
  player_free(player);
}

/* A string that died away under its key cannot be hammered on, nor one that only the pedal has. */
static void a_silent_string_is_plucked(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true, .legato = LEGATO});
  uint32_t from = 0;
  on(player, 1, 60, HARD);
  player_run(player, 4800);
  player.guitar->strings[1].is_awake = false;
  on(player, 1, 62, SOFT);
  player_run(player, 4800);
  assert_done(player, &from, "f1 p1 f1 p1");
  guitarist_gesture(player.guitarist, 1, GESTURE_DAMPER, 1.0);
  off(player, 1, 62);
  on(player, 1, 64, SOFT);
  player_run(player, 4800);
  assert_done(player, &from, "f1 p1");
  player_free(player);
}

static void a_trill_takes_one_pluck(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 2; ++n) {
    const Player player = player_how((GuitaristHow){.has_channels = n > 0, .legato = LEGATO});
    on(player, 1, 60, HARD);
    player_run(player, 3000);
    for (uint32_t i = 0; i < 50; ++i) {
      on(player, 1, 62, SOFT);
      player_run(player, 1500);
      off(player, 1, 62);
      player_run(player, 1500);
    }
    assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), 1);
    assert_int_equal(player_count(player.guitar, GUITAR_HAMMER), 100);
    assert_int_equal(player_count(player.guitar, GUITAR_DAMP), 0);
    assert_last(player, GUITAR_HAMMER, 1, 1.0, 0.5 * guitar_force(SOFT));
    off(player, 1, 60);
    player_run(player, 1);
    assert_int_equal(player_count(player.guitar, GUITAR_DAMP), 1);
    player_free(player);
  }
}

/* Three fingers down: each that lifts pulls off to the highest that is left, and one that lifts
   below the one that sounds is not heard. */
static void fingers_lift_in_any_order(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true, .legato = LEGATO});
  uint32_t from = 0;
  for (uint32_t key = 60; key < 64; ++key) {
    on(player, 1, key, key == 60 ? HARD : SOFT);
    player_run(player, 3000);
  }
  off(player, 1, 61);
  player_run(player, 100);
  assert_done(player, &from, "f1 p1 h1 h1 h1");
  off(player, 1, 63);
  player_run(player, 100);
  assert_last(player, GUITAR_HAMMER, 1, 3.0, 0.5 * guitar_force(SOFT));
  off(player, 1, 62);
  player_run(player, 100);
  assert_last(player, GUITAR_HAMMER, 1, 1.0, 0.5 * guitar_force(SOFT));
  assert_done(player, &from, "h1 h1");
  guitarist_all_notes_off(player.guitarist, 1);
  off(player, 1, 60);
  player_run(player, 100);
  assert_done(player, &from, "d1");
  player_free(player);
}

/* Of ten fingers the oldest two are forgotten, and nothing else. */
static void many_fingers_wait(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true, .legato = LEGATO});
  for (uint32_t key = 60; key < 71; ++key) {
    on(player, 1, key, SOFT);
    player_run(player, 3000);
  }
  for (uint32_t key = 70; key > 62; --key) {
    off(player, 1, key);
    player_run(player, 3000);
    assert_last(player, GUITAR_HAMMER, 1, key - 60.0, 0.5 * guitar_force(SOFT));
    assert_int_equal(player_count(player.guitar, GUITAR_DAMP), 0);
  }
  off(player, 1, 62);
  player_run(player, 100);
  assert_int_equal(player_count(player.guitar, GUITAR_DAMP), 1);
  player_free(player);
}

static void without_legato_nothing_pulls_off(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true, .legato = LEGATO});
  uint32_t from = 0;
  on(player, 1, 60, HARD);
  player_run(player, 3000);
  on(player, 1, 62, SOFT);
  player_run(player, 3000);
  guitarist_set_how(player.guitarist, (GuitaristHow){.has_channels = true});
  off(player, 1, 62);
  player_run(player, 3000);
  assert_done(player, &from, "f1 p1 h1 d1");
  off(player, 1, 60);
  player_run(player, 3000);
  assert_done(player, &from, "");
  player_free(player);
}

/* A chord that is played softly, key by key, and held. */
static void an_arpeggio_rings_on(void** state) {
  (void)state;
  static const uint32_t keys[] = {48, 52, 55, 60, 64, 67};
  const Player player = player_how((GuitaristHow){.legato = LEGATO});
  for (size_t i = 0; i < sizeof(keys) / sizeof(keys[0]); ++i) {
    on(player, 0, keys[i], SOFT);
    player_run(player, 9600);
  }
  assert_int_equal(player_count(player.guitar, GUITAR_HAMMER), 0);
  assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), 6);
  assert_int_equal(player_count(player.guitar, GUITAR_DAMP), 0);
  player_free(player);
}

/* Neither below the nut nor above the last fret is there a place to hammer. */
static void there_is_no_hammering_off_the_neck(void** state) {
  (void)state;
  static const uint32_t keys[][2] = {{65, 63}, {88, 90}};
  for (uint32_t n = 0; n < 2; ++n) {
    const Player player = player_how((GuitaristHow){.legato = LEGATO});
    on(player, 0, keys[n][0], HARD);
    player_run(player, 4800);
    on(player, 0, keys[n][1], SOFT);
    player_run(player, 4800);
    assert_int_equal(player_count(player.guitar, GUITAR_HAMMER), 0);
    player_free(player);
  }
}

static void the_hand_goes_with_the_finger_that_hammers(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.legato = LEGATO});
  uint32_t from = 0;
  on(player, 0, 60, HARD);
  player_run(player, 4800);
  for (uint32_t key = 62; key <= 66; key += 2) {
    on(player, 0, key, SOFT);
    player_run(player, 4800);
  }
  guitarist_all_notes_off(player.guitarist, 0);
  on(player, 0, 66, HARD); /* Nearer than the second fret of the next string now */
  player_run(player, 4800);
  assert_done(player, &from, "f1 p1 h1 h1 h1 d1 f1 p1");
  player_free(player);
}

/* A finger that falls again where it waits is one finger. */
static void a_finger_waits_once(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true, .legato = LEGATO});
  uint32_t from = 0;
  on(player, 1, 60, HARD);
  player_run(player, 3000);
  on(player, 1, 62, SOFT);
  player_run(player, 3000);
  on(player, 1, 60, SOFT);
  player_run(player, 3000);
  off(player, 1, 60);
  off(player, 1, 62);
  player_run(player, 100);
  assert_done(player, &from, "f1 p1 h1 h1 h1 d1");
  player_free(player);
}

/* What rings on is not the note that is due. */
static void nothing_is_hammered_onto_a_note_that_is_due(void** state) {
  (void)state;
  const Player player =
      player_how((GuitaristHow){.has_channels = true, .legato = LEGATO, .strum_s = 0.02});
  uint32_t from = 0;
  on(player, 0, 64, HARD);
  player_run(player, 4800);
  on(player, 5, 40, HARD);
  on(player, 0, 65, HARD);
  player_run(player, 100);
  on(player, 0, 67, SOFT);
  player_run(player, 4800);
  assert_done(player, &from, "f0 p0 f5 p5 f0 p0 f0 p0");
  player_free(player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_soft_note_is_hammered_on),
      cmocka_unit_test(other_soft_notes_are_plucked),
      cmocka_unit_test(a_silent_string_is_plucked),
      cmocka_unit_test(a_trill_takes_one_pluck),
      cmocka_unit_test(fingers_lift_in_any_order),
      cmocka_unit_test(many_fingers_wait),
      cmocka_unit_test(without_legato_nothing_pulls_off),
      cmocka_unit_test(an_arpeggio_rings_on),
      cmocka_unit_test(there_is_no_hammering_off_the_neck),
      cmocka_unit_test(the_hand_goes_with_the_finger_that_hammers),
      cmocka_unit_test(a_finger_waits_once),
      cmocka_unit_test(nothing_is_hammered_onto_a_note_that_is_due),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
