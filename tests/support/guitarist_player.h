/** Somebody at a guitar that writes down what is done to it: for the tests of the guitarist. */
#ifndef HOOKE_TESTS_SUPPORT_GUITARIST_PLAYER_H
#define HOOKE_TESTS_SUPPORT_GUITARIST_PLAYER_H

#include "core/guitar/guitarist.h"
#include "tests/support/guitar_record.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

enum {
  PLAYER_RATE_HZ = 48000,
  PLAYER_BLOCK = 1024,
  PLAYER_STRINGS = 6,
  PLAYER_REST = 9600 /**< Frames in which a damped string comes to rest */
};

static const GuitarPatch PLAYER_USUAL = {
    .string = {.tuning_hz = 440.0},
    .open = {64.0, 59.0, 55.0, 50.0, 45.0, 40.0},
    .n_strings = PLAYER_STRINGS,
};

typedef struct {
  GuitarRecord* guitar;
  Guitarist* guitarist;
} Player;

static inline Player player_with(const GuitarPatch* patch) {
  GuitarRecord* const guitar = guitar_record_new();
  const Player player = {guitar, guitarist_new(guitar_record_seat(guitar, PLAYER_RATE_HZ))};
  assert_non_null(player.guitarist);
  guitarist_set_patch(player.guitarist, patch);
  return player;
}

static inline void player_free(Player player) {
  guitarist_free(player.guitarist);
  free(player.guitar);
}

static inline void player_run(Player player, uint32_t n_frames) {
  float left[PLAYER_BLOCK];
  float right[PLAYER_BLOCK];
  for (uint32_t done = 0; done < n_frames;) {
    const uint32_t n = n_frames - done < PLAYER_BLOCK ? n_frames - done : PLAYER_BLOCK;
    guitarist_run(player.guitarist, n, left, right);
    done += n;
  }
}

static inline uint32_t player_count(const GuitarRecord* guitar, uint32_t verb) {
  uint32_t n = 0;
  for (uint32_t i = 0; i < guitar->n_calls; ++i) {
    n += guitar->calls[i].verb == verb;
  }
  return n;
}

/* The call of a verb that came last. */
static inline const RecordedAct* player_last(const GuitarRecord* guitar, uint32_t verb) {
  const RecordedAct* last = NULL;
  for (uint32_t i = 0; i < guitar->n_calls; ++i) {
    last = guitar->calls[i].verb == verb ? &guitar->calls[i] : last;
  }
  assert_non_null(last);
  return last;
}

/* From here on what is done counts. */
static inline Player player_how(GuitaristHow how) {
  const Player player = player_with(&PLAYER_USUAL);
  guitarist_set_how(player.guitarist, how);
  player.guitar->n_calls = 0;
  return player;
}

/* The n-th call of a verb. */
static inline const RecordedAct* player_nth(const GuitarRecord* guitar, uint32_t verb, uint32_t n) {
  for (uint32_t i = 0; i < guitar->n_calls; ++i) {
    if (guitar->calls[i].verb == verb && n-- == 0) {
      return &guitar->calls[i];
    }
  }
  fail_msg("not so many calls");
  return NULL;
}

#endif
