/**
   What the hands do, as data: the events of the paper's script, and the acts of a guitarist.

   An event is sent to the plugin as the body of an atom of type GUITAR_EVENT_URI, and acts at its
   frame.  An act is what is done in the end, in doubles.

   Thread: any; what plays, as the guitar.
*/
#ifndef HOOKE_CORE_GUITAR_GUITAR_EVENT_H
#define HOOKE_CORE_GUITAR_GUITAR_EVENT_H

#include "core/guitar/guitar.h"

#include <stdbool.h>
#include <stdint.h>

/** The type of the atoms that hold a GuitarEvent. */
#define GUITAR_EVENT_URI "urn:hooke:guitar#event"

/**
   X(VERB, value 0, value 1, value 2): all events and what their values are; none is "".  They are
   those of the functions of core/guitar/guitar.h of the same name.
*/
#define GUITAR_VERBS(X)                                                                            \
  X(PLUCK, "force", "place", "hardness")                                                           \
  X(FRET, "fret", "", "")                                                                          \
  X(HAMMER, "fret", "force", "")                                                                   \
  X(SLIDE, "fret", "time", "")                                                                     \
  X(BEND, "semitones", "time", "")                                                                 \
  X(VIBRATO, "depth", "rate", "")                                                                  \
  X(DAMP, "time", "", "")                                                                          \
  X(LET_RING, "", "", "")                                                                          \
  X(TOUCH, "place", "time", "")                                                                    \
  X(PALM, "weight", "", "")

#define GUITAR_VERB_ENUM(verb, a, b, c) GUITAR_##verb,
typedef enum {
  GUITAR_VERBS(GUITAR_VERB_ENUM) GUITAR_N_VERBS, /**< Those of events; and acts that are none: */
  GUITAR_CHOKE = GUITAR_N_VERBS,                 /**< Silence the string in a moment */
  GUITAR_GAIN                                    /**< Bring it to a gain, value 0 */
} GuitarVerb;
#undef GUITAR_VERB_ENUM

/** One event; what it does not use is 0. */
typedef struct {
  uint32_t verb;   /**< A GuitarVerb */
  uint32_t string; /**< From 0, the highest */
  float value[3];  /**< As GUITAR_VERBS says; times in seconds; NAN where the function takes it */
} GuitarEvent;

/** Something that is done to a string, in doubles. */
typedef struct {
  GuitarVerb verb;
  uint32_t string;
  double value[3];  /**< As GUITAR_VERBS says */
  uint32_t channel; /**< Whose pitches frets have; 0 in a score */
} GuitarAct;

/** A guitar under somebody's hands: one that sounds, or one that writes down what is done to it. */
typedef struct {
  void* guitar;
  double rate_hz;
  void (*act)(void* guitar, const GuitarAct* act);
  bool (*is_awake)(const void* guitar, uint32_t string);
  void (*run)(void* guitar, uint32_t n_frames, float* left, float* right);

  /** As guitar_set_scale(); NULL: it does not matter. */
  void (*tune)(void* guitar,
               uint32_t channel,
               const double semitones[PERFORMANCE_KEYS],
               bool is_live);
} GuitarSeat;

/** The seat at a guitar that sounds; it must outlive who sits there. */
GuitarSeat guitar_seat(Guitar* guitar);

/**
   Do what an event says.  GUITAR_PALM is of all strings.

   @return false, and nothing done, if it is of no known verb, of no string that there can be, or a
   value is out of the range of its function
*/
bool guitar_event_play(Guitar* guitar, const GuitarEvent* event);

#endif
