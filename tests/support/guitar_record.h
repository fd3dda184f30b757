/**
   A guitar that makes no sound and writes down what is done to it and when, for the tests of those
   who play one.

   A string of it moves from when it is plucked or hammered until it is choked, or
   GUITAR_RECORD_RELEASE frames after it was damped.
*/
#ifndef HOOKE_TESTS_SUPPORT_GUITAR_RECORD_H
#define HOOKE_TESTS_SUPPORT_GUITAR_RECORD_H

#include "core/guitar/guitar_event.h"

#include <stdbool.h>
#include <stdint.h>

enum { GUITAR_RECORD_ACTS = 400000, GUITAR_RECORD_RELEASE = 4800 };

/** Something that was done. */
typedef struct {
  uint64_t frame;
  uint32_t verb; /**< A GuitarVerb */
  uint32_t string;
  double value[3]; /**< As GUITAR_VERBS says */
} RecordedAct;

typedef struct {
  bool is_awake;
  bool is_damped;
  uint64_t damped; /**< The frame when */
} RecordedString;

typedef struct {
  uint64_t frame;
  uint32_t n_runs; /**< How often it was run */
  RecordedString strings[GUITAR_STRINGS];
  RecordedAct calls[GUITAR_RECORD_ACTS];
  uint32_t n_calls;
} GuitarRecord;

/** For free(). */
GuitarRecord* guitar_record_new(void);

GuitarSeat guitar_record_seat(GuitarRecord* record, double rate_hz);

#endif
