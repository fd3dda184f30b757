/** An instrument that makes no sound and writes down how it is played. */
#ifndef HOOKE_TESTS_SUPPORT_RECORDER_H
#define HOOKE_TESTS_SUPPORT_RECORDER_H

#include "core/play/performance.h"

#include <stdint.h>

enum { RECORDER_CALLS = 4096 };

/** What can be done to it: all gestures, and: */
typedef enum {
  RECORD_NOTE_ON = N_GESTURES, /**< `value`: velocity */
  RECORD_NOTE_OFF,
  RECORD_PRESS_KEY,
  RECORD_LET_GO,
  RECORD_ALL_NOTES_OFF,
  RECORD_ALL_SOUND_OFF,
  RECORD_SEAT,
  RECORD_TUNE /**< `value`: pitch of A4 in semitones; `key`: whether it is live */
} RecordVerb;

/** Something that was done. */
typedef struct {
  uint32_t verb; /**< A Gesture or a RecordVerb */
  uint32_t channel;
  uint32_t key;
  double value;
} RecordedCall;

typedef struct {
  RecordedCall calls[RECORDER_CALLS];
  uint32_t n_calls;
} Recorder;

Performance recorder_performance(Recorder* recorder);

#endif
