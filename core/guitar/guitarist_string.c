#include "core/guitar/guitarist_string.h"

#include <math.h>

/* A pull-off is weaker than the stroke of the key that it lifts. */
static const double PULL_OFF = 0.5;

static bool is_of(const GuitaristNote* note, uint32_t channel, uint32_t key) {
  return (note->channel == channel || channel == GUITARIST_ANY_CHANNEL) &&
         (note->key == key || key == GUITARIST_ANY_KEY);
}

static void forget(GuitaristString* string, uint32_t first) {
  --string->n_waiting;
  for (uint32_t i = first; i < string->n_waiting; ++i) {
    string->waiting[i] = string->waiting[i + 1];
  }
}

static void forget_key(GuitaristString* string, uint32_t channel, uint32_t key) {
  for (uint32_t i = string->n_waiting; i-- > 0;) {
    if (is_of(&string->waiting[i], channel, key)) {
      forget(string, i);
    }
  }
}

bool guitarist_string_has(const GuitaristString* string, uint32_t channel, uint32_t key) {
  bool has = is_of(&string->note, channel, key);
  for (uint32_t i = 0; i < string->n_waiting; ++i) {
    has = has || is_of(&string->waiting[i], channel, key);
  }
  return string->hold == GUITARIST_KEY && has;
}

bool guitarist_string_is_held(GuitaristHand hand) {
  return hand.string->hold == GUITARIST_KEY && !hand.string->is_due &&
         guitar_is_awake(hand.guitar, hand.index);
}

void guitarist_string_play(GuitaristHand hand, GuitaristNote note, uint64_t due) {
  GuitaristString* const string = hand.string;
  if (string->is_due) {
    guitarist_string_pluck(hand);
  }
  string->note = note;
  string->n_waiting = 0;
  string->hold = GUITARIST_KEY;
  string->is_due = true;
  string->due = due;
}

void guitarist_string_hammer(GuitaristHand hand, GuitaristNote note) {
  GuitaristString* const string = hand.string;
  forget_key(string, note.channel, note.key);
  if (string->n_waiting == GUITARIST_WAITING) {
    forget(string, 0);
  }
  string->waiting[string->n_waiting++] = string->note;
  string->note = note;
  string->note.is_hammered = true;
  guitar_hammer(hand.guitar, hand.index, note.fret, guitar_force(note.velocity));
}

void guitarist_string_pluck(GuitaristHand hand) {
  GuitaristString* const string = hand.string;
  const GuitaristNote* const note = &string->note;
  string->is_due = false;
  guitar_fret(hand.guitar, hand.index, note->fret);
  const double as_the_patch = (double)NAN;
  guitar_pluck(hand.guitar, hand.index,
               (GuitarPluck){guitar_force(note->velocity), as_the_patch, as_the_patch});
  if (note->harmonic > 0) {
    guitar_touch(hand.guitar, hand.index, 1.0 / (note->harmonic + 1), note->touch_s);
  }
  if (string->hold == GUITARIST_NOBODY) {
    guitar_damp(hand.guitar, hand.index, (double)INFINITY);
  }
}

static void pull_off(GuitaristHand hand) {
  GuitaristString* const string = hand.string;
  const double force = PULL_OFF * guitar_force(string->note.velocity);
  string->note = string->waiting[--string->n_waiting];
  guitar_hammer(hand.guitar, hand.index, string->note.fret, force);
}

void guitarist_string_release(
    GuitaristHand hand, uint32_t channel, uint32_t key, bool is_legato, bool is_pedal) {
  GuitaristString* const string = hand.string;
  if (string->hold != GUITARIST_KEY) {
    return;
  }
  if (!is_of(&string->note, channel, key)) {
    forget_key(string, channel, key);
  } else if (is_legato && string->note.is_hammered && string->n_waiting > 0) {
    pull_off(hand);
  } else {
    guitarist_string_let_go(hand, is_pedal);
  }
}

void guitarist_string_let_go(GuitaristHand hand, bool is_pedal) {
  GuitaristString* const string = hand.string;
  string->n_waiting = 0;
  if (string->hold != GUITARIST_NOBODY) {
    string->hold = is_pedal ? GUITARIST_PEDAL : GUITARIST_NOBODY;
    if (!is_pedal && !string->is_due) {
      guitar_damp(hand.guitar, hand.index, (double)INFINITY);
    }
  }
}
