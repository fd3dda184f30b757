/**
   A harp that makes no sound and writes down what its hands do, and somebody who sends it MIDI: for
   the tests of what comes of messages.  It defines the functions of core/harp/harp.h that play, so
   a program has either this or the real one.
*/
#ifndef HOOKE_TESTS_SUPPORT_HARP_FAKE_H
#define HOOKE_TESTS_SUPPORT_HARP_FAKE_H

#include "core/harp/harp.h"
#include "plugin/strings_midi.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

enum { FAKE_CALLS = 4096 };

/** What can be done to a harp. */
typedef enum {
  FAKE_NOTE_ON, /**< `value`: velocity */
  FAKE_NOTE_OFF,
  FAKE_LET_GO,
  FAKE_PEDAL,
  FAKE_SOSTENUTO,
  FAKE_SOFTEN,
  FAKE_BEND,
  FAKE_VIBRATO,
  FAKE_PRESS,
  FAKE_PRESS_KEY,
  FAKE_BRIGHTEN,
  FAKE_BREATHE,
  FAKE_SWELL, /**< Of hand 0, as the last one is */
  FAKE_ALL_NOTES_OFF,
  FAKE_ALL_SOUND_OFF
} FakeVerb;

/** Something that was done. */
typedef struct {
  FakeVerb verb;
  uint32_t hand;
  uint32_t key;
  double value;
} FakeCall;

/** The harp, and what was done to it. */
typedef struct {
  Harp harp; /* First, so that one is the other. */
  FakeCall calls[FAKE_CALLS];
  uint32_t n_calls;
} HarpFake;

static inline void fake_note(Harp* harp, FakeVerb verb, uint32_t hand, uint32_t key, double value) {
  HarpFake* const fake = (HarpFake*)harp;
  assert(fake->n_calls < FAKE_CALLS && hand < HARP_CHANNELS && key < HARP_KEYS);
  fake->calls[fake->n_calls++] = (FakeCall){verb, hand, key, value};
}

void harp_note_on(Harp* harp, uint32_t hand, uint32_t key, uint32_t velocity) {
  fake_note(harp, FAKE_NOTE_ON, hand, key, velocity);
}

void harp_note_off(Harp* harp, uint32_t hand, uint32_t key) {
  fake_note(harp, FAKE_NOTE_OFF, hand, key, 0.0);
}

void harp_let_go(Harp* harp, uint32_t hand) {
  fake_note(harp, FAKE_LET_GO, hand, 0, 0.0);
}

void harp_pedal(Harp* harp, uint32_t hand, double lift) {
  fake_note(harp, FAKE_PEDAL, hand, 0, lift);
}

void harp_sostenuto(Harp* harp, uint32_t hand, bool is_down) {
  fake_note(harp, FAKE_SOSTENUTO, hand, 0, is_down);
}

void harp_soften(Harp* harp, uint32_t hand, double softness) {
  fake_note(harp, FAKE_SOFTEN, hand, 0, softness);
}

void harp_bend(Harp* harp, uint32_t hand, double semitones) {
  fake_note(harp, FAKE_BEND, hand, 0, semitones);
}

void harp_vibrato(Harp* harp, uint32_t hand, double semitones) {
  fake_note(harp, FAKE_VIBRATO, hand, 0, semitones);
}

void harp_press(Harp* harp, uint32_t hand, double pressure) {
  fake_note(harp, FAKE_PRESS, hand, 0, pressure);
}

void harp_press_key(Harp* harp, uint32_t hand, uint32_t key, double pressure) {
  fake_note(harp, FAKE_PRESS_KEY, hand, key, pressure);
}

void harp_brighten(Harp* harp, uint32_t hand, double brightness) {
  fake_note(harp, FAKE_BRIGHTEN, hand, 0, brightness);
}

void harp_breathe(Harp* harp, uint32_t hand, double breath) {
  fake_note(harp, FAKE_BREATHE, hand, 0, breath);
}

void harp_set_gain(Harp* harp, uint32_t channel, double gain) {
  if (channel == 0) {
    fake_note(harp, FAKE_SWELL, 0, 0, gain);
  }
}

void harp_all_notes_off(Harp* harp, uint32_t hand) {
  fake_note(harp, FAKE_ALL_NOTES_OFF, hand, 0, 0.0);
}

void harp_silence(Harp* harp) {
  fake_note(harp, FAKE_ALL_SOUND_OFF, 0, 0, 0.0);
}

#endif
