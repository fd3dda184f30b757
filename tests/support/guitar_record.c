#include "tests/support/guitar_record.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

static void act(void* guitar, const GuitarAct* act) {
  GuitarRecord* const record = guitar;
  assert_true(record->n_calls < GUITAR_RECORD_ACTS && act->string < GUITAR_STRINGS);
  const double* const v = act->value;
  record->calls[record->n_calls++] =
      (RecordedAct){record->frame, act->verb, act->string, {v[0], v[1], v[2]}};
  RecordedString* const string = &record->strings[act->string];
  if (act->verb == GUITAR_PLUCK || act->verb == GUITAR_HAMMER) {
    *string = (RecordedString){.is_awake = true};
  } else if (act->verb == GUITAR_DAMP) {
    string->is_damped = true;
    string->damped = record->frame;
  } else if (act->verb == GUITAR_CHOKE) {
    string->is_awake = false;
  }
}

static bool is_awake(const void* guitar, uint32_t string) {
  const GuitarRecord* const record = guitar;
  const RecordedString* const at = &record->strings[string];
  return at->is_awake && !(at->is_damped && record->frame - at->damped > GUITAR_RECORD_RELEASE);
}

static void run(void* guitar, uint32_t n_frames, float* left, float* right) {
  GuitarRecord* const record = guitar;
  (void)left;
  (void)right;
  ++record->n_runs;
  record->frame += n_frames;
}

GuitarRecord* guitar_record_new(void) {
  GuitarRecord* const record = calloc(1, sizeof(GuitarRecord));
  assert_non_null(record);
  return record;
}

GuitarSeat guitar_record_seat(GuitarRecord* record, double rate_hz) {
  return (GuitarSeat){record, rate_hz, act, is_awake, run, NULL};
}
