/**
   A guitar that makes no sound and writes down what is done to it and when: for the tests of those
   who play one.  It defines all functions of core/guitar/guitar.h, so a program has either this or
   the real one.

   A string of it moves from when it is plucked or hammered until it is choked, or FAKE_RELEASE
   frames after it was damped.
*/
#ifndef HOOKE_TESTS_SUPPORT_GUITAR_FAKE_H
#define HOOKE_TESTS_SUPPORT_GUITAR_FAKE_H

#include "core/guitar/guitar.h"
#include "core/guitar/guitar_event.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

enum { FAKE_CALLS = 400000, FAKE_RELEASE = 4800, FAKE_CHOKE = GUITAR_N_VERBS };

/** Something that was done. */
typedef struct {
  uint64_t frame;
  uint32_t verb; /**< A GuitarVerb or FAKE_CHOKE */
  uint32_t string;
  double value[3]; /**< As GUITAR_VERBS says */
} FakeCall;

typedef struct {
  bool is_awake;
  bool is_damped;
  uint64_t damped; /**< The frame when */
  double fret;
} FakeString;

struct Guitar {
  double rate_hz;
  uint64_t frame;
  uint32_t n_runs; /**< Calls of guitar_run() */
  FakeString strings[GUITAR_STRINGS];
  FakeCall calls[FAKE_CALLS];
  uint32_t n_calls;
};

static inline void
fake_note(Guitar* guitar, uint32_t verb, uint32_t string, double a, double b, double c) {
  assert(guitar->n_calls < FAKE_CALLS);
  guitar->calls[guitar->n_calls++] = (FakeCall){guitar->frame, verb, string, {a, b, c}};
}

static inline void fake_wake(Guitar* guitar, uint32_t string) {
  if (string < GUITAR_STRINGS) {
    guitar->strings[string].is_awake = true;
    guitar->strings[string].is_damped = false;
  }
}

static inline void fake_stop(Guitar* guitar, uint32_t string, double fret) {
  if (string < GUITAR_STRINGS) {
    guitar->strings[string].fret = fret;
  }
}

double guitar_force(uint32_t velocity) {
  return (velocity / 127.0) * (velocity / 127.0);
}

Guitar* guitar_new(double rate_hz) {
  Guitar* const guitar = calloc(1, sizeof(Guitar));
  assert(guitar);
  guitar->rate_hz = rate_hz;
  return guitar;
}

void guitar_free(Guitar* guitar) {
  free(guitar);
}

double guitar_rate_hz(const Guitar* guitar) {
  return guitar->rate_hz;
}

void guitar_reset(Guitar* guitar) {
  (void)guitar;
}

void guitar_set_patch(Guitar* guitar, const GuitarPatch* patch, uint32_t n_frames) {
  (void)guitar;
  (void)patch;
  (void)n_frames;
}

void guitar_pluck(Guitar* guitar, uint32_t string, GuitarPluck pluck) {
  fake_note(guitar, GUITAR_PLUCK, string, pluck.force, pluck.place, pluck.hardness);
  fake_wake(guitar, string);
}

void guitar_fret(Guitar* guitar, uint32_t string, double fret) {
  fake_note(guitar, GUITAR_FRET, string, fret, 0.0, 0.0);
  fake_stop(guitar, string, fret);
}

void guitar_hammer(Guitar* guitar, uint32_t string, double fret, double force) {
  fake_note(guitar, GUITAR_HAMMER, string, fret, force, 0.0);
  fake_wake(guitar, string);
  fake_stop(guitar, string, fret);
}

void guitar_slide(Guitar* guitar, uint32_t string, double fret, double time_s) {
  fake_note(guitar, GUITAR_SLIDE, string, fret, time_s, 0.0);
}

void guitar_bend(Guitar* guitar, uint32_t string, double semitones, double time_s) {
  fake_note(guitar, GUITAR_BEND, string, semitones, time_s, 0.0);
}

void guitar_vibrato(Guitar* guitar, uint32_t string, double depth, double rate_hz) {
  fake_note(guitar, GUITAR_VIBRATO, string, depth, rate_hz, 0.0);
}

void guitar_damp(Guitar* guitar, uint32_t string, double time_s) {
  fake_note(guitar, GUITAR_DAMP, string, time_s, 0.0, 0.0);
  if (string < GUITAR_STRINGS) {
    guitar->strings[string].is_damped = true;
    guitar->strings[string].damped = guitar->frame;
  }
}

void guitar_let_ring(Guitar* guitar, uint32_t string) {
  fake_note(guitar, GUITAR_LET_RING, string, 0.0, 0.0, 0.0);
}

void guitar_touch(Guitar* guitar, uint32_t string, double place, double time_s) {
  fake_note(guitar, GUITAR_TOUCH, string, place, time_s, 0.0);
}

void guitar_palm(Guitar* guitar, double weight) {
  fake_note(guitar, GUITAR_PALM, 0, weight, 0.0, 0.0);
}

void guitar_choke(Guitar* guitar) {
  fake_note(guitar, FAKE_CHOKE, 0, 0.0, 0.0, 0.0);
  for (uint32_t s = 0; s < GUITAR_STRINGS; ++s) {
    guitar->strings[s].is_awake = false;
  }
}

bool guitar_is_awake(const Guitar* guitar, uint32_t string) {
  const FakeString* const at = &guitar->strings[string];
  return at->is_awake && !(at->is_damped && guitar->frame - at->damped > FAKE_RELEASE);
}

double guitar_fretted(const Guitar* guitar, uint32_t string) {
  return guitar->strings[string].fret;
}

GuitarReport guitar_report(const Guitar* guitar) {
  (void)guitar;
  return (GuitarReport){0};
}

void guitar_run(Guitar* guitar, uint32_t n_frames, float* left, float* right) {
  (void)left;
  (void)right;
  ++guitar->n_runs;
  guitar->frame += n_frames;
}

#endif
