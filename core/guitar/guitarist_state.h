/** What a guitarist has in mind: for the rooms of core/guitar/guitarist.h alone. */
#ifndef HOOKE_CORE_GUITAR_GUITARIST_STATE_H
#define HOOKE_CORE_GUITAR_GUITARIST_STATE_H

#include "core/guitar/fretboard.h"
#include "core/guitar/guitar_event.h"
#include "core/guitar/guitarist_string.h"

#include "core/excite/variation.h"
#include "core/play/performance.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  GUITARIST_EVENTS = 64, /**< Most events gathered in a frame; more are decided in several lots */
  GUITARIST_NO_STRING = GUITAR_STRINGS
};

/** How it plays. */
typedef struct {
  bool has_channels;   /**< A channel for each string; false: one for all */
  double strum_s;      /**< From string to string of a chord struck together [s], 0 to 1 */
  uint32_t legato;     /**< Hardest velocity that is a hammer-on, 0: none is */
  uint32_t harmonic;   /**< Every pluck is touched at 1/(harmonic + 1) of the string: 0 (not at all)
                          to 3 */
  Variation variation; /**< How notes differ; those that are hammered on do in force alone */
} GuitaristHow;

/** The kinds of events that wait for the end of their frame. */
typedef enum {
  GUITARIST_NOTE_ON,
  GUITARIST_NOTE_OFF,  /**< Of one key or of all */
  GUITARIST_PEDAL,     /**< `value`: it is down */
  GUITARIST_SOSTENUTO, /**< The same */
  GUITARIST_PRESS_KEY, /**< `amount`: how hard */
  GUITARIST_LET_GO     /**< What it has played and whose keys are up */
} GuitaristVerb;

/** What a player did. */
typedef struct {
  GuitaristVerb verb;
  uint32_t channel;
  uint32_t key;
  uint32_t value;  /**< Velocity, or whether a pedal is down */
  uint32_t string; /**< That a note on is played on, once that is decided */
  uint32_t stroke; /**< How many strings of its strum are plucked before it */
  double amount;   /**< Pressure, 0 to 1 */
} GuitaristEvent;

/** The last chord that was struck. */
typedef struct {
  uint64_t start;
  uint32_t n_strokes;
} GuitaristStrum;

/** A guitarist, who has no more than the guitar to sound; use it through the functions of
 * core/guitar/guitarist.h. */
typedef struct {
  GuitarSeat seat;
  GuitaristHow how;
  double tuning_hz;
  double place;                /**< Where the patch plucks */
  double hardness;             /**< The patch's */
  double capo;                 /**< Its fret */
  double open[GUITAR_STRINGS]; /**< MIDI notes, with the capo */
  uint32_t n_strings;
  int32_t position; /**< Fret of the first finger, from the capo */
  GuitaristString strings[GUITAR_STRINGS];
  GuitaristChannel channels[PERFORMANCE_CHANNELS];
  double scales[PERFORMANCE_CHANNELS][PERFORMANCE_KEYS]; /**< Above A4 [semitones]; NAN: no pitch */
  GuitaristStrum strum;
  uint64_t now;      /**< In frames */
  uint64_t n_played; /**< Notes so far */
  uint32_t n_varied; /**< Of the last note, since all was still */
  GuitaristEvent events[GUITARIST_EVENTS];
  uint32_t n_events;
  uint32_t n_notes; /**< Notes on among the events, at most FRETBOARD_NOTES */
} Guitarist;

#endif
