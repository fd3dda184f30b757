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

/* Before any note: of the channel's string, or of all that there can be; but too far for the guitar
 * is as far as it goes, whatever the wheel's range was. */
static void a_string_that_nobody_played_follows_who_moves(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 2; ++n) {
    const Player player = player_how((GuitaristHow){.has_channels = n > 0});
    const uint32_t n_moved = n > 0 ? 1 : GUITAR_STRINGS;
    guitarist_gesture(player.guitarist, 3, GESTURE_BEND, 1.5);
    guitarist_gesture(player.guitarist, 3, GESTURE_VIBRATO, 0.25);
    guitarist_gesture(player.guitarist, 9, GESTURE_BEND, n > 0 ? 1.0 : -30.0);
    assert_int_equal(player.guitar->n_calls, n > 0 ? 2 : 4 * GUITAR_STRINGS);
    for (uint32_t i = 0; i < n_moved; ++i) {
      const RecordedAct* const bend = &player.guitar->calls[i];
      const RecordedAct* const swing = &player.guitar->calls[n_moved + i];
      assert_int_equal(bend->verb, GUITAR_BEND);
      assert_int_equal(bend->string, n > 0 ? 3 : i);
      assert_true(bend->value[0] == 1.5 && bend->value[1] == 0.0);
      assert_int_equal(swing->verb, GUITAR_VIBRATO);
      assert_int_equal(swing->string, n > 0 ? 3 : i);
      assert_true(swing->value[0] == 0.25 && swing->value[1] == 5.5);
    }
    assert_near(player_last(player.guitar, GUITAR_BEND)->value[0], n > 0 ? 1.5 : -24.0);
    player_free(player);
  }
}

/* The last value of a verb on a string; NAN if there is none. */
static double value_on(Player player, uint32_t verb, uint32_t string) {
  double value = (double)NAN;
  for (uint32_t i = 0; i < player.guitar->n_calls; ++i) {
    const RecordedAct* const call = &player.guitar->calls[i];
    value = call->verb == verb && call->string == string ? call->value[0] : value;
  }
  return value;
}

/* Channels 7 to 16 as well, and in either mode. */
static void gestures_are_of_the_strings_that_play_the_channels_notes(void** state) {
  static const struct {
    Gesture gesture;
    GuitarVerb verb;
    double value, expected, other;
  } all[] = {
      {GESTURE_BEND, GUITAR_BEND, 1.998, 1.998, -1.0},
      {GESTURE_VIBRATO, GUITAR_VIBRATO, 0.3, 0.3, 0.1},
      {GESTURE_PRESSURE, GUITAR_VIBRATO, 0.5, 0.25, 0.1},
      {GESTURE_GAIN, GUITAR_GAIN, 0.25, 0.25, 0.8},
  };
  (void)state;
  for (uint32_t mode = 0; mode < 2; ++mode) {
    for (uint32_t channel = 6; channel < 16; ++channel) {
      for (size_t g = 0; g < sizeof(all) / sizeof(all[0]); ++g) {
        const Player player = player_how((GuitaristHow){.has_channels = mode > 0});
        on(player, channel, 64, HARD);
        player_run(player, 100);
        const uint32_t string = player_last(player.guitar, GUITAR_PLUCK)->string;
        on(player, channel - 1, 45, HARD);
        player_run(player, 100);
        const uint32_t other = player_last(player.guitar, GUITAR_PLUCK)->string;
        assert_int_not_equal(string, other);
        player.guitar->n_calls = 0;
        guitarist_gesture(player.guitarist, channel, all[g].gesture, all[g].value);
        assert_near(value_on(player, all[g].verb, string), all[g].expected);
        assert_true(isnan(value_on(player, all[g].verb, other)));
        player_free(player);
      }
    }
  }
}

/* What another channel played on the string before it is forgotten, and so is its touch. */
static void a_string_has_the_touch_of_who_plays_it(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  guitarist_gesture(player.guitarist, 3, GESTURE_BEND, 2.0);
  guitarist_gesture(player.guitarist, 3, GESTURE_GAIN, 0.5);
  on(player, 3, 40, HARD);
  player_run(player, 100);
  assert_near(value_on(player, GUITAR_BEND, 5), 2.0);
  on(player, 4, 41, HARD);
  player_run(player, 100);
  assert_near(value_on(player, GUITAR_BEND, 5), 0.0);
  assert_near(value_on(player, GUITAR_GAIN, 5), 1.0);
  guitarist_gesture(player.guitarist, 3, GESTURE_BEND, -1.0); /* It plays no note any more. */
  assert_near(value_on(player, GUITAR_BEND, 5), 0.0);
  guitarist_gesture(player.guitarist, 4, GESTURE_BEND, -3.0);
  assert_near(value_on(player, GUITAR_BEND, 5), -3.0);
  player_free(player);
}

/* A score may have bent a string, which no channel knows of: after all sound off its next note
 * brings all that a channel does, be it nothing. */
static void what_was_silenced_is_touched_anew(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  on(player, 3, 40, HARD);
  player_run(player, 100);
  assert_true(isnan(value_on(player, GUITAR_BEND, 5)));
  guitarist_all_sound_off(player.guitarist, 3);
  on(player, 3, 40, HARD);
  player_run(player, 100);
  assert_near(value_on(player, GUITAR_BEND, 5), 0.0);
  assert_near(value_on(player, GUITAR_VIBRATO, 5), 0.0);
  assert_near(value_on(player, GUITAR_GAIN, 5), 1.0);
  player_free(player);
}

/* A member of a zone, whose next note is to be bent and not what rings on. */
static void what_is_let_go_keeps_its_touch(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  guitarist_gesture(player.guitarist, 3, GESTURE_DAMPER, 1.0);
  on(player, 3, 64, HARD);
  on(player, 3, 45, HARD);
  player_run(player, 100);
  off(player, 3, 64);
  guitarist_let_go(player.guitarist, 3);
  guitarist_gesture(player.guitarist, 3, GESTURE_BEND, 2.0);
  assert_true(isnan(value_on(player, GUITAR_BEND, 0)));
  assert_near(value_on(player, GUITAR_BEND, 4), 2.0);
  assert_int_equal(n_damped(player), 0);
  guitarist_gesture(player.guitarist, 3, GESTURE_DAMPER, 0.0);
  assert_int_equal(n_damped(player), 1);
  player_free(player);
}

/* And so does what is let go in the frame of another note, which waits for its chord. */
static void what_is_let_go_beside_a_note_keeps_its_touch(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  guitarist_gesture(player.guitarist, 3, GESTURE_DAMPER, 1.0);
  on(player, 3, 64, HARD);
  player_run(player, 100);
  on(player, 2, 45, HARD);
  off(player, 3, 64);
  guitarist_let_go(player.guitarist, 3);
  player_run(player, 100);
  guitarist_gesture(player.guitarist, 3, GESTURE_BEND, 2.0);
  assert_true(isnan(value_on(player, GUITAR_BEND, 0)));
  player_free(player);
}

/* A key's own pressure ends with the key, be a pedal down; and it comes with its note. */
static void a_keys_pressure_is_its_own(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  guitarist_gesture(player.guitarist, 2, GESTURE_DAMPER, 1.0);
  on(player, 2, 64, HARD);
  guitarist_press_key(player.guitarist, 2, 64, 1.0);
  player_run(player, 100);
  assert_near(value_on(player, GUITAR_VIBRATO, 0), 0.5);
  off(player, 2, 64);
  player_run(player, 100);
  assert_near(value_on(player, GUITAR_VIBRATO, 0), 0.0);
  assert_int_equal(n_damped(player), 0);
  player_free(player);
}

/* In a zone of six members the first of them plays the highest string. */
static void seats_are_strings(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true});
  uint32_t from = 0;
  guitarist_seat(player.guitarist, 0, 16);
  for (uint32_t member = 0; member < PLAYER_STRINGS; ++member) {
    guitarist_seat(player.guitarist, 1 + member, member);
  }
  for (uint32_t member = 0; member < PLAYER_STRINGS; ++member) {
    on(player, 1 + member, 65, HARD);
    player_run(player, 100);
  }
  assert_done(player, &from, "f0 p0 f1 p1 f2 p2 f3 p3 f4 p4 f5 p5");
  for (uint32_t member = 0; member < PLAYER_STRINGS; ++member) {
    guitarist_gesture(player.guitarist, 1 + member, GESTURE_BEND, 1.0);
  }
  assert_done(player, &from, "b0 b1 b2 b3 b4 b5");
  off(player, 6, 65);
  on(player, 0, 45, HARD); /* Its leader finds a string. */
  player_run(player, 100);
  assert_int_equal(player_last(player.guitar, GUITAR_PLUCK)->string, 5);
  player_free(player);
}

/* Where there is one string for both; else each has its own. */
static void a_key_that_two_channels_hold_rings_until_the_last_lets_go(void** state) {
  (void)state;
  for (uint32_t first = 0; first < 2; ++first) {
    const Player player = player_how((GuitaristHow){0});
    guitarist_gesture(player.guitarist, 1, GESTURE_BEND, 0.5);
    on(player, 0, 40, HARD);
    player_run(player, 100);
    on(player, 1, 40, HARD);
    player_run(player, 100);
    assert_int_equal(player_last(player.guitar, GUITAR_PLUCK)->string, 5);
    assert_near(value_on(player, GUITAR_BEND, 5), 0.5);
    off(player, first, 40);
    assert_int_equal(n_damped(player), 0);
    assert_near(value_on(player, GUITAR_BEND, 5), first == 1 ? 0.0 : 0.5);
    off(player, 1 - first, 40);
    assert_int_equal(n_damped(player), 1);
    player_free(player);
  }
  const Player player = player_how((GuitaristHow){0});
  on(player, 0, 64, HARD);
  player_run(player, 100);
  on(player, 1, 64, HARD);
  player_run(player, 100);
  assert_int_not_equal(player_nth(player.guitar, GUITAR_PLUCK, 0)->string,
                       player_nth(player.guitar, GUITAR_PLUCK, 1)->string);
  off(player, 1, 64);
  assert_int_equal(n_damped(player), 1);
  assert_int_equal(player_last(player.guitar, GUITAR_DAMP)->string,
                   player_nth(player.guitar, GUITAR_PLUCK, 1)->string);
  player_free(player);
}

/* Of the channel's next notes: by up to 0.4, of what the force makes of the patch's hardness. */
static void brightness_is_hardness(void** state) {
  (void)state;
  static const struct {
    double brightness, hardness;
  } cases[] = {{0.5, 0.3}, {-0.5, 0.3}, {1.0, 0.9}, {-1.0, 0.2}};
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
    GuitarPatch patch = PLAYER_USUAL;
    patch.hardness = cases[i].hardness;
    const Player player = player_with(&patch);
    guitarist_gesture(player.guitarist, 2, GESTURE_BRIGHTNESS, cases[i].brightness);
    on(player, 2, 60, HARD);
    player_run(player, 100);
    const double h = cases[i].hardness;
    const double softness = 1.0 - pow(HARD / 127.0 / 0.75, 0.75);
    const double usual = fmin(fmax(h - softness * (0.2 + h), 0.0), 1.0);
    const double expected = fmin(fmax(usual + 0.4 * cases[i].brightness, 0.0), 1.0);
    assert_near(player_last(player.guitar, GUITAR_PLUCK)->value[2], expected);
    on(player, 3, 40, HARD);
    player_run(player, 100);
    assert_true(isnan(player_last(player.guitar, GUITAR_PLUCK)->value[2]));
    player_free(player);
  }
}

static void the_palm_is_the_heaviest_of_all(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  guitarist_gesture(player.guitarist, 2, GESTURE_SOFTNESS, 0.5);
  assert_near(player_last(player.guitar, GUITAR_PALM)->value[0], 0.5);
  guitarist_gesture(player.guitarist, 3, GESTURE_SOFTNESS, 0.2);
  assert_near(player_last(player.guitar, GUITAR_PALM)->value[0], 0.5);
  guitarist_gesture(player.guitarist, 2, GESTURE_SOFTNESS, 0.0);
  assert_near(player_last(player.guitar, GUITAR_PALM)->value[0], 0.2);
  player_free(player);
}

static void one_key_is_pressed_alone(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  on(player, 2, 64, HARD);
  on(player, 2, 45, HARD);
  player_run(player, 100);
  guitarist_press_key(player.guitarist, 2, 45, 0.5);
  guitarist_press_key(player.guitarist, 3, 64, 0.5);
  guitarist_press_key(player.guitarist, 2, 65, 0.5);
  assert_near(value_on(player, GUITAR_VIBRATO, 4), 0.25);
  assert_int_equal(player_count(player.guitar, GUITAR_VIBRATO), 1);
  guitarist_press_key(player.guitarist, 2, 45, 0.0);
  assert_near(value_on(player, GUITAR_VIBRATO, 4), 0.0);
  player_free(player);
}

static void all_notes_off_is_of_a_channel(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 2; ++n) {
    const Player player = player_how((GuitaristHow){.has_channels = n > 0});
    for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
      guitarist_note_on(player.guitarist, s, (uint32_t)PLAYER_USUAL.open[s], VELOCITY);
      player_run(player, 100);
    }
    guitarist_all_notes_off(player.guitarist, 2);
    assert_int_equal(n_damped(player), 1);
    assert_int_equal(player_last(player.guitar, GUITAR_DAMP)->string,
                     player_nth(player.guitar, GUITAR_PLUCK, 2)->string);
    player_free(player);
  }
}

/* With what nobody has played. */
static void all_sound_off_is_of_a_channel(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.has_channels = true});
  uint32_t from = 0;
  for (uint32_t s = 0; s < 4; ++s) {
    on(player, s, 70, VELOCITY);
  }
  player_run(player, 100);
  from = player.guitar->n_calls;
  on(player, 3, 71, VELOCITY); /* In the same frame */
  guitarist_all_sound_off(player.guitarist, 3);
  player_run(player, 100);
  assert_done(player, &from, "c3 c4 c5 c6 c7");
  off(player, 2, 70);
  player_run(player, 100);
  assert_done(player, &from, "d2");
  player_free(player);
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
  guitarist_gesture(player.guitarist, 16, GESTURE_DAMPER, 1.0);
  guitarist_gesture(player.guitarist, 16, GESTURE_BEND, 1.0);
  guitarist_gesture(player.guitarist, 16, GESTURE_VIBRATO, 1.0);
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
      cmocka_unit_test(a_string_that_nobody_played_follows_who_moves),
      cmocka_unit_test(gestures_are_of_the_strings_that_play_the_channels_notes),
      cmocka_unit_test(a_string_has_the_touch_of_who_plays_it),
      cmocka_unit_test(what_was_silenced_is_touched_anew),
      cmocka_unit_test(what_is_let_go_keeps_its_touch),
      cmocka_unit_test(what_is_let_go_beside_a_note_keeps_its_touch),
      cmocka_unit_test(a_keys_pressure_is_its_own),
      cmocka_unit_test(seats_are_strings),
      cmocka_unit_test(a_key_that_two_channels_hold_rings_until_the_last_lets_go),
      cmocka_unit_test(brightness_is_hardness),
      cmocka_unit_test(the_palm_is_the_heaviest_of_all),
      cmocka_unit_test(one_key_is_pressed_alone),
      cmocka_unit_test(all_notes_off_is_of_a_channel),
      cmocka_unit_test(all_sound_off_is_of_a_channel),
      cmocka_unit_test(nonsense_is_ignored),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
