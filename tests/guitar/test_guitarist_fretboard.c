#include "core/guitar/fretboard.h"

#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { ROUNDS = 3000, NOBODY = GUITAR_STRINGS };

static Fretboard random_board(Random* random, uint32_t n_strings) {
  Fretboard board = {.n_strings = n_strings};
  for (uint32_t s = 0; s < n_strings; ++s) {
    const bool is_usual = random_below(random, 4) > 0;
    const double usual = 64.0 - 4.9 * s;
    board.strings[s].open = is_usual ? round(usual) : random_between(random, 30.0, 70.0);
    board.strings[s].fret = random_below(random, 12);
    board.strings[s].use = (FretboardUse)random_below(random, 3);
    board.strings[s].played = random_below(random, 100);
  }
  return board;
}

/* Different keys. */
static void
random_keys(Random* random, uint32_t* keys, uint32_t n_keys, uint32_t from, uint32_t n) {
  for (uint32_t i = 0; i < n_keys;) {
    keys[i] = from + random_below(random, n);
    bool is_new = true;
    for (uint32_t j = 0; j < i; ++j) {
      is_new = is_new && keys[j] != keys[i];
    }
    i += is_new;
  }
}

static int32_t off_the_neck(int32_t finger) {
  return finger < 0 ? -finger : finger > 24 ? finger - 24 : 0;
}

/* What a string costs for one note, as the header says; INFINITY where the note is not on it. */
static double cost_of_note(const Fretboard* board, uint32_t s, uint32_t key) {
  const FretboardString* const string = &board->strings[s];
  const int32_t finger = (int32_t)lround(key - string->open);
  double cost = finger > 0 ? 1.0 + 0.05 * finger : 0.0;
  if (string->use == FRETBOARD_TAKEN) {
    cost += 1000.0;
    for (uint32_t i = 0; i < board->n_strings; ++i) {
      const FretboardString* const other = &board->strings[i];
      cost += other->use == FRETBOARD_TAKEN && other->played < string->played ? 100.0 : 0.0;
    }
  } else if (string->use == FRETBOARD_RINGING && fabs(key - string->open - string->fret) >= 0.5) {
    cost += 1.0;
  }
  return off_the_neck(finger) == 0 ? cost : (double)INFINITY;
}

/* Strings below one, that of the higher number being below where two are tuned alike. */
static uint32_t place_of(const Fretboard* board, uint32_t s) {
  uint32_t place = 0;
  for (uint32_t i = 0; i < board->n_strings; ++i) {
    const double open = board->strings[i].open;
    place += open < board->strings[s].open || (open == board->strings[s].open && i > s);
  }
  return place;
}

/* As little as it must: the nearest position from which all is in reach. */
static int32_t where_the_hand_goes(int32_t from, int32_t lowest, int32_t highest) {
  int32_t best = lowest;
  for (int32_t to = 1; to < 30 && highest <= lowest + 4; ++to) {
    const bool is_in_reach = to <= lowest && highest <= to + 4;
    best = is_in_reach && abs(to - from) < abs(best - from) ? to : best;
  }
  return best;
}

/* What a way to play keys, the lowest first, costs, as the header says. */
static double
cost_of(const Fretboard* board, int32_t from, const uint32_t* keys, const uint32_t* s, uint32_t n) {
  double cost = 0.0;
  int32_t lowest = 100;
  int32_t highest = 0;
  uint32_t n_open = 0;
  for (uint32_t i = 0; i < n; ++i) {
    const int32_t finger = (int32_t)lround(keys[i] - board->strings[s[i]].open);
    cost += cost_of_note(board, s[i], keys[i]);
    if (finger > 0) {
      lowest = finger < lowest ? finger : lowest;
      highest = finger > highest ? finger : highest;
    } else {
      ++n_open;
    }
    for (uint32_t j = 0; j < i; ++j) {
      const bool is_crossed = place_of(board, s[j]) > place_of(board, s[i]);
      cost += is_crossed ? 20.0 : 0.0;
    }
    if (i > 0 && place_of(board, s[i]) > place_of(board, s[i - 1])) {
      cost += 0.5 * (place_of(board, s[i]) - place_of(board, s[i - 1]) - 1.0);
    }
  }
  int32_t to = from;
  if (highest > 0) {
    cost += 0.25 * (highest - lowest) + 10.0 * fmax(highest - lowest - 4.0, 0.0);
    to = where_the_hand_goes(from, lowest, highest);
  }
  return cost + abs(to - from) + 0.25 * to * n_open;
}

/* The cheapest of all ways to play keys on strings of their own. */
static double least_cost(const Fretboard* board, int32_t from, const uint32_t* keys, uint32_t n) {
  double least = (double)INFINITY;
  uint32_t n_ways = 1;
  for (uint32_t i = 0; i < n; ++i) {
    n_ways *= board->n_strings;
  }
  for (uint32_t way = 0; way < n_ways; ++way) {
    uint32_t s[FRETBOARD_NOTES];
    uint32_t used = 0;
    bool is_shared = false;
    for (uint32_t i = 0, rest = way; i < n; ++i, rest /= board->n_strings) {
      s[i] = rest % board->n_strings;
      is_shared = is_shared || used >> s[i] & 1;
      used |= UINT32_C(1) << s[i];
    }
    least = is_shared ? least : fmin(least, cost_of(board, from, keys, s, n));
  }
  return least;
}

static int compare(const void* a, const void* b) {
  const uint32_t left = *(const uint32_t*)a;
  const uint32_t right = *(const uint32_t*)b;
  return (left > right) - (left < right);
}

/* Against all ways there are, weighed a second time by the header's words. */
static void a_grip_is_the_cheapest_there_is(void** state) {
  (void)state;
  Random random = random_start();
  uint32_t n_whole = 0;
  for (uint32_t turn = 0; turn < ROUNDS; ++turn) {
    const Fretboard board = random_board(&random, 1 + random_below(&random, 6));
    const uint32_t most = board.n_strings < 5 ? board.n_strings : 5;
    const uint32_t n = 1 + random_below(&random, most);
    const int32_t from = 1 + (int32_t)random_below(&random, 12);
    uint32_t keys[FRETBOARD_NOTES];
    random_keys(&random, keys, n, 36 + random_below(&random, 36), 24);
    const FretboardGrip grip = fretboard_grip(&board, from, keys, n);
    uint32_t sorted[FRETBOARD_NOTES];
    uint32_t s[FRETBOARD_NOTES];
    for (uint32_t i = 0; i < n; ++i) {
      sorted[i] = keys[i];
    }
    qsort(sorted, n, sizeof sorted[0], compare);
    for (uint32_t i = 0; i < n; ++i) {
      for (uint32_t j = 0; j < n; ++j) {
        s[i] = keys[j] == sorted[i] ? grip.string[j] : s[i];
      }
    }
    const double least = least_cost(&board, from, sorted, n);
    if (least < (double)INFINITY) {
      ++n_whole;
      assert_true(fabs(cost_of(&board, from, sorted, s, n) - least) < 1e-9);
    }
  }
  printf("%u of %u chords could be played as they are\n", n_whole, (uint32_t)ROUNDS);
  assert_true(n_whole > ROUNDS / 4);
}

static bool has_key(const FretboardString* string, uint32_t key) {
  return off_the_neck((int32_t)lround(key - string->open)) == 0;
}

/* Whatever is asked for, a string of the guitar is the answer, and work and hand stay in bounds. */
static void work_is_bounded(void** state) {
  (void)state;
  Random random = random_start();
  uint32_t most_free = 0;
  uint32_t most = 0;
  for (uint32_t turn = 0; turn < 4 * ROUNDS; ++turn) {
    Fretboard board = random_board(&random, 1 + random_below(&random, GUITAR_STRINGS));
    const bool is_free = random_below(&random, 2) > 0;
    for (uint32_t s = 0; s < board.n_strings && is_free; ++s) {
      board.strings[s].open = round(64.0 - 4.9 * s);
      board.strings[s].use = FRETBOARD_FREE;
    }
    const uint32_t n = random_below(&random, FRETBOARD_NOTES + 1);
    uint32_t keys[FRETBOARD_NOTES];
    random_keys(&random, keys, n, random_below(&random, 90), 12 + random_below(&random, 26));
    const int32_t from = 1 + (int32_t)random_below(&random, 20);
    const FretboardGrip grip = fretboard_grip(&board, from, keys, n);
    most = grip.n_tries > most ? grip.n_tries : most;
    most_free = is_free && grip.n_tries > most_free ? grip.n_tries : most_free;
    assert_in_range(grip.position, 1, 24);
    for (uint32_t i = 0; i < n; ++i) {
      assert_in_range(grip.string[i], 0, board.n_strings - 1);
      for (uint32_t s = 0; s < board.n_strings; ++s) {
        assert_true(!has_key(&board.strings[s], keys[i]) ||
                    has_key(&board.strings[grip.string[i]], keys[i]));
      }
    }
  }
  printf("at most %u tries, %u on free strings\n", most, most_free);
  assert_true(most <= FRETBOARD_TRIES);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_grip_is_the_cheapest_there_is),
      cmocka_unit_test(work_is_bounded),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
