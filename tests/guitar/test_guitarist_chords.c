#include "tests/support/guitarist_player.h"

#include <stdio.h>
#include <string.h>

/* What was plucked since `from`, as a chord's name in a book: low string first, x for none, and -
   for one that was plucked twice. */
static const char* shape_since(const GuitarRecord* guitar, uint32_t from, char* shape) {
  double fret[GUITAR_STRINGS] = {0};
  strcpy(shape, "xxxxxx");
  for (uint32_t i = from; i < guitar->n_calls; ++i) {
    const RecordedAct* const call = &guitar->calls[i];
    if (call->verb == GUITAR_FRET) {
      fret[call->string] = call->value[0];
    } else if (call->verb == GUITAR_PLUCK) {
      char* const at = &shape[PLAYER_STRINGS - 1 - call->string];
      const int n = (int)lround(fret[call->string]);
      *at = *at != 'x' || n < 0 ? '-' : (char)(n < 10 ? '0' + n : 'a' + n - 10);
    }
  }
  return shape;
}

/* Keys down together and up again. */
static const char* chord(Player player, const uint32_t* keys, char* shape) {
  const uint32_t from = player.guitar->n_calls;
  for (uint32_t n = 0; keys[n] > 0; ++n) {
    guitarist_note_on(player.guitarist, 0, keys[n], 90);
  }
  player_run(player, PLAYER_REST);
  for (uint32_t n = 0; keys[n] > 0; ++n) {
    guitarist_note_off(player.guitarist, 0, keys[n]);
  }
  player_run(player, PLAYER_REST);
  return shape_since(player.guitar, from, shape);
}

typedef struct {
  const char* name;
  uint32_t keys[GUITAR_STRINGS + 1];
  const char* shape;
} Book;

/* Chords as they stand in every book. */
static const Book BOOK[] = {
    {"E", {40, 47, 52, 56, 59, 64}, "022100"},  {"A", {45, 52, 57, 61, 64}, "x02220"},
    {"D", {50, 57, 62, 66}, "xx0232"},          {"G", {43, 47, 50, 55, 59, 67}, "320003"},
    {"C", {48, 52, 55, 60, 64}, "x32010"},      {"Am", {45, 52, 57, 60, 64}, "x02210"},
    {"Em", {40, 47, 52, 55, 59, 64}, "022000"}, {"Dm", {50, 57, 62, 65}, "xx0231"},
    {"B7", {47, 51, 57, 59, 66}, "x21202"},     {"E7", {40, 47, 50, 56, 59, 64}, "020100"},
    {"A7", {45, 52, 55, 61, 64}, "x02020"},     {"D7", {50, 57, 60, 66}, "xx0212"},
    {"F", {41, 48, 53, 57, 60, 65}, "133211"},  {"Bm", {47, 54, 59, 62, 66}, "x24432"},
    {"F#", {42, 49, 54, 58, 61, 66}, "244322"}, {"Cm", {48, 55, 60, 63, 67}, "x35543"},
};
enum { BOOKS = sizeof BOOK / sizeof BOOK[0] };

static void chords_come_out_as_in_the_book(void** state) {
  (void)state;
  for (size_t i = 0; i < BOOKS; ++i) {
    char shape[GUITAR_STRINGS + 1];
    const Player player = player_with(&PLAYER_USUAL);
    printf("%s ", BOOK[i].name);
    assert_string_equal(chord(player, BOOK[i].keys, shape), BOOK[i].shape);
    player_free(player);
  }
}

/* One after the other, so that the hand comes from elsewhere, and the keys the other way round. */
static void chords_come_out_so_in_a_song(void** state) {
  (void)state;
  const Player player = player_with(&PLAYER_USUAL);
  for (size_t i = 0; i < 5 * BOOKS; ++i) {
    const Book* const book = &BOOK[i * 7 % BOOKS];
    uint32_t keys[GUITAR_STRINGS + 1] = {0};
    uint32_t n = 0;
    while (book->keys[n] > 0) {
      ++n;
    }
    for (uint32_t k = 0; k < n; ++k) {
      keys[k] = book->keys[n - 1 - k];
    }
    char shape[GUITAR_STRINGS + 1];
    printf("%s ", book->name);
    assert_string_equal(chord(player, keys, shape), book->shape);
  }
  player_free(player);
}

/* The keys of the next chord go down in the frame in which those of the last go up, or before. */
static void chord_changes_may_overlap_in_a_frame(void** state) {
  (void)state;
  const Player player = player_with(&PLAYER_USUAL);
  for (size_t i = 0; i < 2 * BOOKS; ++i) {
    const Book* const last = &BOOK[(i + BOOKS - 1) % BOOKS];
    const Book* const next = &BOOK[i % BOOKS];
    const uint32_t from = player.guitar->n_calls;
    char shape[GUITAR_STRINGS + 1];
    /* A key of both chords goes up first, as one finger has to. */
    for (uint32_t n = 0; next->keys[n] > 0; ++n) {
      guitarist_note_off(player.guitarist, 0, next->keys[n]);
    }
    for (uint32_t n = 0; next->keys[n] > 0; ++n) {
      guitarist_note_on(player.guitarist, 0, next->keys[n], 90);
    }
    for (uint32_t n = 0; i > 0 && last->keys[n] > 0; ++n) {
      bool is_kept = false;
      for (uint32_t m = 0; next->keys[m] > 0; ++m) {
        is_kept = is_kept || next->keys[m] == last->keys[n];
      }
      if (!is_kept) {
        guitarist_note_off(player.guitarist, 0, last->keys[n]);
      }
    }
    player_run(player, PLAYER_REST);
    printf("%s ", next->name);
    assert_string_equal(shape_since(player.guitar, from, shape), next->shape);
  }
  player_free(player);
}

static void a_capo_moves_the_shapes(void** state) {
  (void)state;
  GuitarPatch patch = PLAYER_USUAL;
  patch.capo = 3.0;
  for (size_t i = 0; i < BOOKS; ++i) {
    uint32_t keys[GUITAR_STRINGS + 1] = {0};
    for (uint32_t n = 0; BOOK[i].keys[n] > 0; ++n) {
      keys[n] = BOOK[i].keys[n] + 3;
    }
    char shape[GUITAR_STRINGS + 1];
    const Player player = player_with(&patch);
    assert_string_equal(chord(player, keys, shape), BOOK[i].shape);
    player_free(player);
  }
}

/* The keys of a chord one after the other, all held: never two on a string that others could have.
 */
static void held_notes_spread_over_the_strings(void** state) {
  (void)state;
  for (size_t i = 0; i < BOOKS; ++i) {
    char shape[GUITAR_STRINGS + 1];
    const Player player = player_with(&PLAYER_USUAL);
    uint32_t n = 0;
    for (; BOOK[i].keys[n] > 0; ++n) {
      guitarist_note_on(player.guitarist, 0, BOOK[i].keys[n], 90);
      player_run(player, PLAYER_REST);
    }
    shape_since(player.guitar, 0, shape);
    printf("%s %s ", BOOK[i].name, shape);
    assert_null(strchr(shape, '-'));
    assert_int_equal(player_count(player.guitar, GUITAR_PLUCK), n);
    player_free(player);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(chords_come_out_as_in_the_book),
      cmocka_unit_test(chords_come_out_so_in_a_song),
      cmocka_unit_test(chord_changes_may_overlap_in_a_frame),
      cmocka_unit_test(a_capo_moves_the_shapes),
      cmocka_unit_test(held_notes_spread_over_the_strings),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
