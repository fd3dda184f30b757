#include "tests/support/guitarist_player.h"
#include "tests/support/random.h"

#include <string.h>

enum { EVENTS = 1500, STORMS = 16, FIRST_KEY = 30, KEYS = 65 };

typedef enum { ON, OFF, PEDAL, BEND, VIBRATO, NOTES_OFF, SOUND_OFF, HOW, PATCH, N_KINDS } Kind;

/* Something that comes `wait` frames after what came before. */
typedef struct {
  Kind kind;
  uint32_t wait;
  uint32_t channel;
  uint32_t key;
  uint32_t value;
} Event;

static uint32_t random_wait(Random* random) {
  static const uint32_t waits[] = {0, 0, 0, 1, 60, 300, 3000, 9000};
  return random_below(random, 1 + waits[random_below(random, 8)]);
}

/* Mostly notes, that end by any means. */
static Kind random_kind(Random* random) {
  static const Kind rare[] = {BEND, VIBRATO, NOTES_OFF, SOUND_OFF, HOW, PATCH};
  const uint32_t n = random_below(random, 100);
  return n < 50 ? ON : n < 85 ? OFF : n < 94 ? PEDAL : rare[n - 94];
}

static void make_storm(Random* random, Event* events, uint32_t n_keys) {
  for (uint32_t i = 0; i < EVENTS; ++i) {
    events[i] = (Event){random_kind(random), random_wait(random), random_below(random, 9),
                        FIRST_KEY + random_below(random, n_keys), 1 + random_below(random, 127)};
  }
}

static GuitaristHow how_of(uint32_t value) {
  static const double strums_s[] = {0.0, 0.004, 0.02, 0.1};
  const Variation variation = {value % 3 / 2.0, value};
  return (GuitaristHow){value % 2 > 0, strums_s[value / 2 % 4], value / 8 % 2 * 80, value / 16 % 4,
                        variation};
}

static GuitarPatch patch_of(uint32_t value) {
  GuitarPatch patch = PLAYER_USUAL;
  patch.n_strings = 1 + value % GUITAR_STRINGS;
  patch.capo = value / 8 % 5;
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    patch.open[s] = 64.0 - 5.0 * s + 0.1 * (value % 7);
  }
  return patch;
}

static void act(Player player, const Event* event) {
  Guitarist* const guitarist = player.guitarist;
  const GuitarPatch patch = patch_of(event->value);
  switch (event->kind) {
  case ON:
    guitarist_note_on(guitarist, event->channel, event->key, event->value);
    break;
  case OFF:
    guitarist_note_off(guitarist, event->channel, event->key);
    break;
  case PEDAL:
    guitarist_gesture(guitarist, event->channel, GESTURE_DAMPER, event->value > 80);
    break;
  case BEND:
    guitarist_gesture(guitarist, event->channel, GESTURE_BEND, event->value / 64.0 - 1.0);
    break;
  case VIBRATO:
    guitarist_gesture(guitarist, event->channel, GESTURE_VIBRATO, event->value / 127.0);
    break;
  case NOTES_OFF:
    guitarist_all_notes_off(guitarist, event->channel);
    break;
  case SOUND_OFF:
    guitarist_all_sound_off(guitarist, event->channel);
    break;
  case HOW:
    guitarist_set_how(guitarist, how_of(event->value));
    break;
  case PATCH:
    guitarist_set_patch(guitarist, &patch);
    break;
  case N_KINDS:
    break;
  }
}

/* Play a storm, no more than `n_block` frames at a time; 0: any number of them. */
static Player play(const Event* events, GuitaristHow how, uint32_t n_block, Random* random) {
  const Player player = player_how(how);
  for (uint32_t i = 0; i < EVENTS; ++i) {
    for (uint32_t done = 0; done < events[i].wait;) {
      const uint32_t most = n_block > 0 ? n_block : 1 + random_below(random, 2000);
      const uint32_t left = events[i].wait - done;
      const uint32_t n = left < most ? left : most;
      player_run(player, n);
      done += n;
    }
    act(player, &events[i]);
  }
  return player;
}

static void the_same_is_done_in_any_blocks(void** state) {
  (void)state;
  static const uint32_t blocks[] = {1, 7, 64, 0};
  static Event events[EVENTS];
  Random random = random_start();
  for (uint32_t storm = 0; storm < STORMS; ++storm) {
    make_storm(&random, events, KEYS);
    const GuitaristHow how = how_of(storm);
    const Player once = play(events, how, 1000, &random);
    assert_true(once.guitar->n_calls > EVENTS / 2);
    for (size_t b = 0; b < sizeof blocks / sizeof blocks[0]; ++b) {
      const Player again = play(events, how, blocks[b], &random);
      assert_int_equal(again.guitar->n_calls, once.guitar->n_calls);
      assert_memory_equal(again.guitar->calls, once.guitar->calls,
                          once.guitar->n_calls * sizeof(RecordedAct));
      player_free(again);
    }
    player_free(once);
  }
}

/* Whether a string sounds at the end and nothing will damp it. */
static bool is_stuck(const GuitarRecord* guitar, uint32_t string) {
  bool is_stuck = false;
  for (uint32_t i = 0; i < guitar->n_calls; ++i) {
    const RecordedAct* const call = &guitar->calls[i];
    if (call->verb == GUITAR_CHOKE || (call->string == string && call->verb == GUITAR_DAMP)) {
      is_stuck = false;
    } else if (call->string == string &&
               (call->verb == GUITAR_PLUCK || call->verb == GUITAR_HAMMER)) {
      is_stuck = true;
    }
  }
  return is_stuck;
}

/* All keys and feet up after any storm; by each key's own end or all at once. */
static void a_storm_leaves_nothing_stuck(void** state) {
  (void)state;
  static Event events[EVENTS];
  Random random = random_start();
  for (uint32_t storm = 0; storm < 4 * STORMS; ++storm) {
    make_storm(&random, events, KEYS);
    const Player player = play(events, how_of(storm), 1000, &random);
    for (uint32_t channel = 0; channel < PERFORMANCE_CHANNELS; ++channel) {
      if (storm % 2 > 0) {
        guitarist_all_notes_off(player.guitarist, channel);
      }
      for (uint32_t key = 0; key < PERFORMANCE_KEYS && storm % 2 == 0; ++key) {
        guitarist_note_off(player.guitarist, channel, key);
      }
      guitarist_gesture(player.guitarist, channel, GESTURE_DAMPER, 0.0);
    }
    player_run(player, 2 * PLAYER_RATE_HZ);
    for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
      assert_false(is_stuck(player.guitar, s));
    }
    player_free(player);
  }
}

/* A note for a note, whatever else goes on. */
static void no_note_of_a_storm_is_left_out(void** state) {
  (void)state;
  static Event events[EVENTS];
  Random random = random_start();
  for (uint32_t storm = 0; storm < STORMS; ++storm) {
    uint32_t n_notes = 0;
    make_storm(&random, events, KEYS);
    for (uint32_t i = 0; i < EVENTS; ++i) {
      const bool is_other = events[i].kind == HOW || events[i].kind == SOUND_OFF;
      events[i].kind = is_other ? BEND : events[i].kind;
      n_notes += events[i].kind == ON;
    }
    const Player player = play(events, how_of(storm % 8), 1000, &random);
    player_run(player, PLAYER_RATE_HZ);
    assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), n_notes);
    player_free(player);
  }
}

/* Whether a string that no key holds could have been found for a key. */
static bool is_one_free(const uint32_t* held, uint32_t key) {
  bool is_one = false;
  for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
    const double fret = key - PLAYER_USUAL.open[s];
    is_one = is_one || (held[s] == 0 && fret >= 0.0 && fret <= 24.0);
  }
  return is_one;
}

/* Note by note, with what is held written down here: a held string is taken only in need, or for
   its own key again. */
static void a_held_string_is_taken_only_in_need(void** state) {
  (void)state;
  static Event events[EVENTS];
  Random random = random_start();
  const Player player = player_how((GuitaristHow){0});
  uint32_t held[PLAYER_STRINGS] = {0};
  uint32_t n_taken = 0;
  make_storm(&random, events, 50);
  for (uint32_t i = 0; i < EVENTS; ++i) {
    const uint32_t key = 10 + events[i].key;
    if (events[i].kind == ON) {
      guitarist_note_on(player.guitarist, 0, key, 90);
      player_run(player, 64);
      const uint32_t string = player_last(player.guitar, GUITAR_PLUCK)->string;
      if (held[string] > 0 && held[string] != key) {
        assert_false(is_one_free(held, key));
        ++n_taken;
      }
      held[string] = key;
    } else {
      guitarist_note_off(player.guitarist, 0, key);
      for (uint32_t s = 0; s < PLAYER_STRINGS; ++s) {
        held[s] = held[s] == key ? 0 : held[s];
      }
    }
    player_run(player, 64);
  }
  assert_in_range(n_taken, EVENTS / 20, EVENTS / 2);
  player_free(player);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_same_is_done_in_any_blocks),
      cmocka_unit_test(a_storm_leaves_nothing_stuck),
      cmocka_unit_test(no_note_of_a_storm_is_left_out),
      cmocka_unit_test(a_held_string_is_taken_only_in_need),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
