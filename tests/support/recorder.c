#include "tests/support/recorder.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

static void note(void* instrument, uint32_t verb, uint32_t channel, uint32_t key, double value) {
  Recorder* const recorder = instrument;
  assert_true(recorder->n_calls < RECORDER_CALLS);
  assert_true(channel < PERFORMANCE_CHANNELS && key < PERFORMANCE_KEYS);
  recorder->calls[recorder->n_calls++] = (RecordedCall){verb, channel, key, value};
}

static void note_on(void* recorder, uint32_t channel, uint32_t key, uint32_t velocity) {
  note(recorder, RECORD_NOTE_ON, channel, key, velocity);
}

static void note_off(void* recorder, uint32_t channel, uint32_t key) {
  note(recorder, RECORD_NOTE_OFF, channel, key, 0.0);
}

static void gesture(void* recorder, uint32_t channel, Gesture what, double value) {
  note(recorder, what, channel, 0, value);
}

static void press_key(void* recorder, uint32_t channel, uint32_t key, double pressure) {
  note(recorder, RECORD_PRESS_KEY, channel, key, pressure);
}

static void let_go(void* recorder, uint32_t channel) {
  note(recorder, RECORD_LET_GO, channel, 0, 0.0);
}

static void all_notes_off(void* recorder, uint32_t channel) {
  note(recorder, RECORD_ALL_NOTES_OFF, channel, 0, 0.0);
}

static void all_sound_off(void* recorder, uint32_t channel) {
  note(recorder, RECORD_ALL_SOUND_OFF, channel, 0, 0.0);
}

static void seat(void* recorder, uint32_t channel, uint32_t number) {
  note(recorder, RECORD_SEAT, channel, 0, number);
}

static void
tune(void* recorder, uint32_t channel, const double semitones[PERFORMANCE_KEYS], bool is_live) {
  note(recorder, RECORD_TUNE, channel, is_live, semitones[69]);
}

Performance recorder_performance(Recorder* recorder) {
  static const PerformanceKind kind = {note_on,       note_off,      gesture, press_key, let_go,
                                       all_notes_off, all_sound_off, seat,    tune};
  return (Performance){&kind, recorder};
}
