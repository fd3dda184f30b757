#include "core/guitar/guitarist_chord.h"

#include <math.h>

/* A note that follows another this soon was meant to be struck with it. */
static const double LEGATO_S = 0.05;
static const double JOIN_S = 0.03;
/* How far a note may be from another for a finger to hammer it, in frets: chords that are played
 * note by note, and held, go in wider steps. */
static const double LEGATO_FRETS = 2.0;

static const double MOST_STRUM_S = 1.0;
static const double LOWEST_FRET = -48.0;

GuitaristHand guitarist_chord_hand(Guitarist* guitarist, uint32_t string) {
  return (GuitaristHand){&guitarist->seat, guitarist->channels, string,
                         &guitarist->strings[string]};
}

static bool has_own_string(const Guitarist* guitarist, uint32_t channel) {
  return guitarist->how.has_channels && guitarist->channels[channel].seat < guitarist->n_strings;
}

double guitarist_chord_fret(const Guitarist* guitarist, uint32_t string, uint32_t key) {
  return fmax(key - guitarist->open[string], LOWEST_FRET);
}

bool guitarist_chord_is_hammered(Guitarist* guitarist, const GuitaristEvent* event) {
  const uint32_t string = event->string;
  const GuitaristString* const on = &guitarist->strings[string];
  if (event->value > guitarist->how.legato || on->note.key == event->key ||
      !guitarist_string_is_held(guitarist_chord_hand(guitarist, string))) {
    return false;
  }
  if (has_own_string(guitarist, event->channel)) {
    return true;
  }
  const double fret = guitarist_chord_fret(guitarist, string, event->key);
  return guitarist->n_notes == 1 && lround(fret) >= 0 && lround(fret) <= FRETBOARD_FRETS &&
         fabs(fret - on->note.fret) <= LEGATO_FRETS &&
         (double)(guitarist->now - on->onset) > LEGATO_S * guitarist->seat.rate_hz;
}

/* The string whose key went down last of those that are down. */
static uint32_t last_held(const Guitarist* guitarist) {
  uint32_t last = GUITARIST_NO_STRING;
  for (uint32_t s = 0; s < guitarist->n_strings; ++s) {
    const GuitaristString* const string = &guitarist->strings[s];
    if (string->hold == GUITARIST_KEY &&
        (last == GUITARIST_NO_STRING || string->played > guitarist->strings[last].played)) {
      last = s;
    }
  }
  return last;
}

/* The string that a note has to be played on, or GUITARIST_NO_STRING. */
static uint32_t only_string(Guitarist* guitarist, GuitaristEvent* event) {
  if (has_own_string(guitarist, event->channel)) {
    return guitarist->channels[event->channel].seat;
  }
  for (uint32_t s = 0; s < guitarist->n_strings; ++s) {
    if (guitarist_string_has(&guitarist->strings[s], event->channel, event->key)) {
      return s;
    }
  }
  event->string = last_held(guitarist);
  const bool is_on_last =
      event->string != GUITARIST_NO_STRING && guitarist_chord_is_hammered(guitarist, event);
  return is_on_last ? event->string : GUITARIST_NO_STRING;
}

/* Whether the key that holds a string goes up in this frame, and no other has it then. */
static bool is_being_let_go(const Guitarist* guitarist, const GuitaristString* string) {
  bool is_let_go = false;
  for (uint32_t i = 0; i < guitarist->n_events; ++i) {
    const GuitaristEvent* const event = &guitarist->events[i];
    const bool is_alone = string->note.holders == UINT32_C(1) << event->channel;
    const bool is_last = is_alone && (string->n_waiting == 0 || event->key == GUITARIST_ANY_KEY);
    is_let_go = is_let_go || (event->verb == GUITARIST_NOTE_OFF && is_last &&
                              guitarist_string_has(string, event->channel, event->key));
  }
  return is_let_go;
}

static FretboardUse use_of(Guitarist* guitarist, uint32_t string) {
  const GuitaristHand hand = guitarist_chord_hand(guitarist, string);
  const GuitaristString* const on = hand.string;
  if (on->hold == GUITARIST_KEY && !is_being_let_go(guitarist, on)) {
    return FRETBOARD_TAKEN;
  }
  const bool is_kept = on->hold == GUITARIST_FOOT ||
                       (on->hold == GUITARIST_KEY && guitarist_string_is_pedalled(hand));
  const bool is_ringing = is_kept && hand.seat->is_awake(hand.seat->guitar, string);
  return is_ringing || on->is_due ? FRETBOARD_RINGING : FRETBOARD_FREE;
}

static Fretboard fretboard_of(Guitarist* guitarist) {
  Fretboard board = {.n_strings = guitarist->n_strings};
  for (uint32_t s = 0; s < guitarist->n_strings; ++s) {
    const GuitaristString* const string = &guitarist->strings[s];
    board.strings[s] = (FretboardString){guitarist->open[s], string->note.fret,
                                         use_of(guitarist, s), string->played};
  }
  return board;
}

/* Where a key is among those of a chord, to which it is added if it is new. */
static uint32_t index_of(uint32_t* keys, uint32_t* n_keys, uint32_t key) {
  uint32_t i = 0;
  while (i < *n_keys && keys[i] != key) {
    ++i;
  }
  if (i == *n_keys) {
    keys[(*n_keys)++] = key;
  }
  return i;
}

/* The hand goes where a note is played that it had no choice of. */
static void follow(Guitarist* guitarist, const Fretboard* board, const GuitaristEvent* event) {
  const int32_t finger = fretboard_finger(&board->strings[event->string], event->key);
  if (!has_own_string(guitarist, event->channel) && finger > 0 && finger <= FRETBOARD_FRETS) {
    guitarist->position = fretboard_reach(guitarist->position, finger, finger);
  }
}

/* Give the notes of a frame strings: first those that have no choice, then the rest as a chord. */
static void choose_strings(Guitarist* guitarist) {
  Fretboard board = fretboard_of(guitarist);
  uint32_t keys[FRETBOARD_NOTES];
  uint32_t n_keys = 0;
  uint32_t index[GUITARIST_EVENTS];
  for (uint32_t i = 0; i < guitarist->n_events; ++i) {
    GuitaristEvent* const event = &guitarist->events[i];
    if (event->verb == GUITARIST_NOTE_ON) {
      event->string = only_string(guitarist, event);
      if (event->string == GUITARIST_NO_STRING) {
        index[i] = index_of(keys, &n_keys, event->key);
      } else {
        follow(guitarist, &board, event);
        board.strings[event->string].use = FRETBOARD_TAKEN;
        board.strings[event->string].played = UINT64_MAX;
      }
    }
  }
  const FretboardGrip grip = fretboard_grip(&board, guitarist->position, keys, n_keys);
  guitarist->position = grip.position;
  for (uint32_t i = 0; i < guitarist->n_events; ++i) {
    GuitaristEvent* const event = &guitarist->events[i];
    if (event->verb == GUITARIST_NOTE_ON && event->string == GUITARIST_NO_STRING) {
      event->string = grip.string[index[i]];
    }
  }
}

/* The notes of a frame that are plucked. */
static uint32_t gather_strokes(Guitarist* guitarist, GuitaristEvent** strokes) {
  uint32_t n_strokes = 0;
  for (uint32_t i = 0; i < guitarist->n_events; ++i) {
    GuitaristEvent* const event = &guitarist->events[i];
    if (event->verb == GUITARIST_NOTE_ON && !guitarist_chord_is_hammered(guitarist, event)) {
      strokes[n_strokes++] = event;
    }
  }
  return n_strokes;
}

/* Whether a note is struck before another of its chord: that of the lower string is. */
static bool
is_before(const Guitarist* guitarist, const GuitaristEvent* a, const GuitaristEvent* b) {
  const double open_a = guitarist->open[a->string];
  const double open_b = guitarist->open[b->string];
  if (open_a != open_b) {
    return open_a < open_b;
  }
  return a->string != b->string ? a->string > b->string : a < b;
}

double guitarist_chord_strum_frames(const Guitarist* guitarist) {
  return fmin(fmax(guitarist->how.strum_s, 0.0), MOST_STRUM_S) * guitarist->seat.rate_hz;
}

/* Whether strokes go on with the strum that is under way. */
static bool is_joining(const Guitarist* guitarist, uint32_t n_strokes) {
  const GuitaristStrum* const strum = &guitarist->strum;
  const double elapsed = (double)(guitarist->now - strum->start);
  return strum->n_strokes + n_strokes <= guitarist->n_strings &&
         elapsed <= JOIN_S * guitarist->seat.rate_hz &&
         elapsed < (strum->n_strokes - 1.0) * guitarist_chord_strum_frames(guitarist);
}

/* Put the plucks of a frame in order, from the lowest string to the highest. */
static void order_strokes(Guitarist* guitarist) {
  GuitaristEvent* strokes[FRETBOARD_NOTES];
  const uint32_t n_strokes = gather_strokes(guitarist, strokes);
  if (n_strokes == 0) {
    return;
  }
  if (!is_joining(guitarist, n_strokes)) {
    guitarist->strum = (GuitaristStrum){.start = guitarist->now};
  }
  for (uint32_t i = 0; i < n_strokes; ++i) {
    strokes[i]->stroke = guitarist->strum.n_strokes;
    for (uint32_t j = 0; j < n_strokes; ++j) {
      strokes[i]->stroke += is_before(guitarist, strokes[j], strokes[i]);
    }
  }
  guitarist->strum.n_strokes += n_strokes;
}

void guitarist_chord_decide(Guitarist* guitarist) {
  choose_strings(guitarist);
  order_strokes(guitarist);
}
