#include "core/guitar/guitarist_string.h"

#include <math.h>

/* A pull-off is weaker than the stroke of the key that it lifts. */
static const double PULL_OFF = 0.5;

static const double VIBRATO_HZ = 5.5;

/* Unlike every touch that there is: a script may have bent the string, too. */
static const GuitaristTouch anything = {(double)NAN, (double)NAN, (double)NAN};

static uint32_t bit(uint32_t channel) {
  return UINT32_C(1) << channel;
}

static void act(GuitaristHand hand, GuitarVerb verb, double a, double b, double c) {
  const GuitarAct exact = {verb, hand.index, {a, b, c}, hand.string->note.channel};
  hand.seat->act(hand.seat->guitar, &exact);
}

static void damp(GuitaristHand hand) {
  act(hand, GUITAR_DAMP, (double)INFINITY, 0.0, 0.0);
}

static bool is_of(const GuitaristNote* note, uint32_t channel, uint32_t key) {
  return (note->holders & bit(channel)) && (note->key == key || key == GUITARIST_ANY_KEY);
}

/* A channel lets go of a note; another that still holds it has it then. */
static void leave(GuitaristNote* note, uint32_t channel) {
  note->holders &= ~bit(channel);
  if (note->channel == channel && note->holders) {
    note->channel = 0;
    while (!(note->holders & bit(note->channel))) {
      ++note->channel;
    }
  }
}

static void forget(GuitaristString* string, uint32_t first) {
  --string->n_waiting;
  for (uint32_t i = first; i < string->n_waiting; ++i) {
    string->waiting[i] = string->waiting[i + 1];
  }
}

static void forget_key(GuitaristString* string, uint32_t channel, uint32_t key) {
  for (uint32_t i = string->n_waiting; i-- > 0;) {
    GuitaristNote* const note = &string->waiting[i];
    if (is_of(note, channel, key)) {
      leave(note, channel);
      if (!note->holders) {
        forget(string, i);
      }
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
         hand.seat->is_awake(hand.seat->guitar, hand.index);
}

bool guitarist_string_is_pedalled(GuitaristHand hand) {
  return hand.string->is_caught || hand.channels[hand.string->note.channel].is_pedal_down;
}

void guitarist_string_feel(GuitaristHand hand, uint32_t channel) {
  const GuitaristChannel* const c = &hand.channels[channel];
  const double pressure = fmax(c->pressure, hand.string->leaned_on);
  const GuitaristTouch touch = {c->bend, c->vibrato + VOICE_PRESSED_VIBRATO * pressure, c->gain};
  GuitaristTouch* const has = &hand.string->touch;
  if (touch.bend != has->bend) {
    act(hand, GUITAR_BEND, touch.bend, 0.0, 0.0);
  }
  if (touch.vibrato != has->vibrato) {
    act(hand, GUITAR_VIBRATO, touch.vibrato, VIBRATO_HZ, 0.0);
  }
  if (touch.gain != has->gain) {
    act(hand, GUITAR_GAIN, touch.gain, 0.0, 0.0);
  }
  *has = touch;
}

static void begin(GuitaristString* string, GuitaristNote note) {
  string->is_caught =
      string->is_caught && string->note.channel == note.channel && string->note.key == note.key;
  string->note = note;
  string->has_played = true;
  string->is_let_go = false;
  string->leaned_on = 0.0;
}

void guitarist_string_play(GuitaristHand hand, GuitaristNote note, uint64_t due) {
  GuitaristString* const string = hand.string;
  if (string->is_due) {
    guitarist_string_pluck(hand);
  }
  if (string->hold == GUITARIST_KEY && string->note.key == note.key) {
    note.holders |= string->note.holders;
  }
  begin(string, note);
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
  begin(string, note);
  string->note.is_hammered = true;
  guitarist_string_feel(hand, string->note.channel);
  act(hand, GUITAR_HAMMER, note.fret, note.force, 0.0);
}

void guitarist_string_pluck(GuitaristHand hand) {
  GuitaristString* const string = hand.string;
  const GuitaristNote* const note = &string->note;
  string->is_due = false;
  guitarist_string_feel(hand, string->note.channel);
  act(hand, GUITAR_FRET, note->fret, 0.0, 0.0);
  act(hand, GUITAR_PLUCK, note->force, note->place, note->hardness);
  if (note->harmonic > 0) {
    act(hand, GUITAR_TOUCH, 1.0 / (note->harmonic + 1), note->touch_s, 0.0);
  }
  if (string->hold == GUITARIST_NOBODY) {
    damp(hand);
  }
}

static void pull_off(GuitaristHand hand) {
  GuitaristString* const string = hand.string;
  const double force = PULL_OFF * string->note.force;
  begin(string, string->waiting[--string->n_waiting]);
  guitarist_string_feel(hand, string->note.channel);
  act(hand, GUITAR_HAMMER, string->note.fret, force, 0.0);
}

void guitarist_string_release(GuitaristHand hand, uint32_t channel, uint32_t key, bool is_legato) {
  GuitaristString* const string = hand.string;
  if (string->hold != GUITARIST_KEY) {
    return;
  }
  if (!is_of(&string->note, channel, key)) {
    forget_key(string, channel, key);
    return;
  }
  leave(&string->note, channel);
  if (string->note.holders) {
    guitarist_string_feel(hand, string->note.channel);
  } else if (is_legato && string->note.is_hammered && string->n_waiting > 0) {
    pull_off(hand);
  } else {
    string->leaned_on = 0.0;
    guitarist_string_feel(hand, string->note.channel);
    guitarist_string_let_go(hand);
  }
}

void guitarist_string_let_go(GuitaristHand hand) {
  GuitaristString* const string = hand.string;
  string->n_waiting = 0;
  if (string->hold != GUITARIST_NOBODY) {
    const bool is_pedalled = guitarist_string_is_pedalled(hand);
    string->hold = is_pedalled ? GUITARIST_FOOT : GUITARIST_NOBODY;
    if (!is_pedalled && !string->is_due) {
      damp(hand);
    }
  }
}

/* A score may have bent it, which nobody here knows of: its next note brings all of its touch. */
void guitarist_string_choke(GuitaristHand hand) {
  *hand.string = (GuitaristString){.touch = anything};
  act(hand, GUITAR_CHOKE, 0.0, 0.0, 0.0);
}
