#include "tests/support/guitarist_player.h"

enum { VELOCITY = 100, FIRST = 1000 };

static const uint32_t C_MAJOR[] = {64, 48, 60, 52, 55};
enum { NOTES = 5 };

static const double STRUM_S = 0.0123456;

static void run_in_blocks(Player player, uint32_t n_frames, uint32_t n_block) {
  for (uint32_t done = 0; done < n_frames;) {
    const uint32_t n = n_frames - done < n_block ? n_frames - done : n_block;
    player_run(player, n);
    done += n;
  }
}

static void keys_down(Player player) {
  for (uint32_t n = 0; n < NOTES; ++n) {
    guitarist_note_on(player.guitarist, 0, C_MAJOR[n], VELOCITY);
  }
}

static void keys_up(Player player) {
  for (uint32_t n = 0; n < NOTES; ++n) {
    guitarist_note_off(player.guitarist, 0, C_MAJOR[n]);
  }
}

static uint32_t n_damped(Player player) {
  player_run(player, 100);
  return player_count(player.guitar, GUITAR_DAMP);
}

/* From the lowest string to the highest, each at its own frame, however the frames are cut. */
static void a_strum_goes_down_at_its_frames(void** state) {
  (void)state;
  static const uint32_t blocks[] = {1, 7, 64, 1000};
  for (size_t b = 0; b < sizeof blocks / sizeof blocks[0]; ++b) {
    const Player player = player_how((GuitaristHow){.strum_s = STRUM_S});
    player_run(player, FIRST);
    keys_down(player);
    run_in_blocks(player, 5000, blocks[b]);
    assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), NOTES);
    for (uint32_t n = 0; n < NOTES; ++n) {
      const RecordedAct* const pluck = player_nth(player.guitar, GUITAR_PLUCK, n);
      assert_int_equal(pluck->string, 4 - n);
      assert_int_equal(pluck->frame, FIRST + (uint64_t)round(n * STRUM_S * PLAYER_RATE_HZ));
      assert_int_equal(player_nth(player.guitar, GUITAR_FRET, n)->frame, pluck->frame);
      assert_true(pluck->value[0] > 0.0);
    }
    player_free(player);
  }
}

static void with_no_strum_nothing_is_late(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){0});
  player_run(player, FIRST);
  keys_down(player);
  player_run(player, 5000);
  for (uint32_t n = 0; n < NOTES; ++n) {
    assert_int_equal(player_nth(player.guitar, GUITAR_PLUCK, n)->frame, FIRST);
  }
  player_free(player);
}

/* A channel for each string, so that strings are given; they are struck in their own order. */
static void a_strum_goes_down_over_channels(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.strum_s = STRUM_S, .has_channels = true});
  for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
    guitarist_note_on(player.guitarist, s, 70, VELOCITY);
  }
  player_run(player, 5000);
  for (uint32_t n = 0; n < PLAYER_STRINGS; ++n) {
    assert_int_equal(player_nth(player.guitar, GUITAR_PLUCK, n)->string, 5 - n);
    assert_int_equal(player_nth(player.guitar, GUITAR_PLUCK, n)->frame,
                     (uint64_t)round(n * STRUM_S * PLAYER_RATE_HZ));
  }
  player_free(player);
}

/* Where a note comes after the first of a strum, and when it is plucked: after the last if the
   strum is under way and it is within 30 ms, else at once. */
static void a_late_note_joins_the_strum(void** state) {
  (void)state;
  static const struct {
    double strum_s;
    uint32_t late;
    uint64_t plucked;
  } cases[] = {
      {0.01, 10, 5 * 480},    {0.01, 1440, 5 * 480}, {0.01, 1441, 1441},
      {0.007, 1343, 5 * 336}, {0.007, 1344, 1344},   {0.0, 10, 10},
  };
  for (size_t c = 0; c < sizeof cases / sizeof cases[0]; ++c) {
    const Player player = player_how((GuitaristHow){.strum_s = cases[c].strum_s});
    keys_down(player);
    player_run(player, cases[c].late);
    guitarist_note_on(player.guitarist, 0, 43, VELOCITY);
    player_run(player, 5000);
    uint64_t found = 0;
    for (uint32_t n = 0; n < NOTES + 1; ++n) {
      const RecordedAct* const pluck = player_nth(player.guitar, GUITAR_PLUCK, n);
      found = pluck->string == 5 ? pluck->frame : found;
    }
    assert_int_equal(found, cases[c].plucked);
    player_free(player);
  }
}

/* A strum has as many strokes as there are strings; what comes then begins another. */
static void a_strum_has_an_end(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.strum_s = 0.1});
  for (uint32_t n = 0; n < 1000; ++n) {
    guitarist_note_on(player.guitarist, 0, 40 + n % 40, VELOCITY);
    player_run(player, n == 0 ? 0 : 1); /* The first two are a chord */
  }
  player_run(player, 6 * 4800);
  assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), 1000);
  for (uint32_t n = 0; n < 1000; ++n) {
    assert_true(player_nth(player.guitar, GUITAR_PLUCK, n)->frame < 1000 + 5 * 4800 + 1);
  }
  player_free(player);
}

/* Up before it is plucked: it is plucked in its time, and then damped. */
static void a_key_up_early_lets_its_string_be_plucked(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.strum_s = STRUM_S});
  keys_down(player);
  player_run(player, 100);
  keys_up(player);
  player_run(player, 5000);
  assert_int_equal(player_count(player.guitar, GUITAR_DAMP), NOTES);
  for (uint32_t n = 0; n < NOTES; ++n) {
    const RecordedAct* const pluck = player_nth(player.guitar, GUITAR_PLUCK, n);
    const RecordedAct* const damp = player_nth(player.guitar, GUITAR_DAMP, n);
    assert_int_equal(damp->string, pluck->string);
    assert_int_equal(damp->frame, n == 0 ? 100 : pluck->frame);
    assert_true(damp > pluck);
  }
  player_free(player);
}

/* A new note for a string that is not plucked yet does not swallow the old one. */
static void a_string_taken_early_is_plucked_first(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.strum_s = 0.01, .has_channels = true});
  guitarist_note_on(player.guitarist, 5, 40, VELOCITY);
  guitarist_note_on(player.guitarist, 0, 64, VELOCITY);
  player_run(player, 100);
  guitarist_note_on(player.guitarist, 0, 69, VELOCITY);
  player_run(player, 5000);
  assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), 3);
  assert_int_equal(player_nth(player.guitar, GUITAR_PLUCK, 1)->frame, 100);
  assert_int_equal(player_nth(player.guitar, GUITAR_PLUCK, 2)->frame, 960);
  assert_true(player_nth(player.guitar, GUITAR_FRET, 2)->value[0] > 4.5);
  player_free(player);
}

static void a_note_of_no_length_sounds(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 2; ++n) {
    const Player player = player_how((GuitaristHow){.has_channels = n > 0});
    guitarist_note_on(player.guitarist, 1, 60, VELOCITY);
    guitarist_note_off(player.guitarist, 1, 60);
    guitarist_note_on(player.guitarist, 1, 60, VELOCITY);
    guitarist_note_on(player.guitarist, 1, 60, 0);
    player_run(player, 100);
    static const uint32_t verbs[] = {GUITAR_FRET, GUITAR_PLUCK, GUITAR_DAMP};
    assert_int_equal(player.guitar->n_calls, 6);
    for (uint32_t i = 0; i < 6; ++i) {
      assert_int_equal(player.guitar->calls[i].verb, verbs[i % 3]);
      assert_int_equal(player.guitar->calls[i].string, 1);
    }
    player_free(player);
  }
}

/* A pedal that goes up before the pluck, and one that stays. */
static void the_pedal_waits_for_the_strum(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.strum_s = STRUM_S});
  guitarist_gesture(player.guitarist, 0, GESTURE_DAMPER, 1.0);
  keys_down(player);
  player_run(player, 100);
  keys_up(player);
  player_run(player, 5000);
  assert_int_equal(n_damped(player), 0);
  assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), NOTES);
  keys_down(player);
  player_run(player, 10);
  keys_up(player);
  guitarist_gesture(player.guitarist, 0, GESTURE_DAMPER, 0.0);
  assert_int_equal(n_damped(player), 1);
  player_run(player, 5000);
  assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), 2 * NOTES);
  assert_int_equal(n_damped(player), NOTES);
  player_free(player);
}

static void all_sound_off_leaves_nothing_due(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.strum_s = STRUM_S});
  guitarist_gesture(player.guitarist, 0, GESTURE_DAMPER, 1.0);
  keys_down(player);
  player_run(player, 100);
  guitarist_note_on(player.guitarist, 0, 70, VELOCITY);
  guitarist_all_sound_off(player.guitarist, 0);
  player_run(player, 5000);
  assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), 1);
  assert_int_equal(player_count(player.guitar, GUITAR_CHOKE), GUITAR_STRINGS);
  /* The pedal is up. */
  guitarist_note_on(player.guitarist, 0, 60, VELOCITY);
  player_run(player, 5000);
  guitarist_note_off(player.guitarist, 0, 60);
  assert_int_equal(n_damped(player), 1);
  player_free(player);
}

/* Of strings tuned alike the one that lies lower is the lower. */
static void strings_tuned_alike_are_struck_as_they_lie(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.strum_s = STRUM_S, .has_channels = true});
  GuitarPatch patch = PLAYER_USUAL;
  patch.open[1] = patch.open[0];
  guitarist_set_patch(player.guitarist, &patch);
  guitarist_note_on(player.guitarist, 0, 70, VELOCITY);
  guitarist_note_on(player.guitarist, 1, 70, VELOCITY);
  player_run(player, 5000);
  assert_int_equal(player_nth(player.guitar, GUITAR_PLUCK, 0)->string, 1);
  player_free(player);
}

static void no_note_joins_a_strum_that_was_stopped(void** state) {
  (void)state;
  const Player player = player_how((GuitaristHow){.strum_s = STRUM_S});
  keys_down(player);
  player_run(player, 100);
  guitarist_all_sound_off(player.guitarist, 0);
  guitarist_note_on(player.guitarist, 0, 43, VELOCITY);
  player_run(player, 100);
  assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), 2);
  player_free(player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_strum_goes_down_at_its_frames),
      cmocka_unit_test(with_no_strum_nothing_is_late),
      cmocka_unit_test(a_strum_goes_down_over_channels),
      cmocka_unit_test(a_late_note_joins_the_strum),
      cmocka_unit_test(a_strum_has_an_end),
      cmocka_unit_test(a_key_up_early_lets_its_string_be_plucked),
      cmocka_unit_test(a_string_taken_early_is_plucked_first),
      cmocka_unit_test(a_note_of_no_length_sounds),
      cmocka_unit_test(the_pedal_waits_for_the_strum),
      cmocka_unit_test(all_sound_off_leaves_nothing_due),
      cmocka_unit_test(strings_tuned_alike_are_struck_as_they_lie),
      cmocka_unit_test(no_note_joins_a_strum_that_was_stopped),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
