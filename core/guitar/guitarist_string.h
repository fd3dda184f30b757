/**
   What a guitarist does with one string: the notes that are held on it, the one that sounds, and
   the pluck that is due.

   One note sounds, and those that it was hammered on above wait below it while their keys are down.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_CORE_GUITAR_GUITARIST_STRING_H
#define HOOKE_CORE_GUITAR_GUITARIST_STRING_H

#include "core/guitar/guitar.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  GUITARIST_WAITING = 8, /**< Most notes that wait; the oldest is forgotten for another */
  GUITARIST_ANY_CHANNEL = UINT8_MAX, /**< For a channel: all of them */
  GUITARIST_ANY_KEY = UINT8_MAX      /**< For a key: all of them */
};

/** A note on a string. */
typedef struct {
  uint32_t channel;
  uint32_t key;
  uint32_t velocity; /**< 1 to 127 */
  double fret;
  double touch_s;    /**< How long a harmonic is touched [s] */
  uint32_t harmonic; /**< Touched at 1/(harmonic + 1) of the string; 0: not at all */
  bool is_hammered;  /**< It was hammered on, so that lifting its finger pulls the string */
} GuitaristNote;

/** Who keeps a string ringing. */
typedef enum {
  GUITARIST_NOBODY, /**< It is damped, or will be once it is plucked */
  GUITARIST_PEDAL,  /**< Its key is up */
  GUITARIST_KEY
} GuitaristHold;

/** Zero is one that was never played. */
typedef struct {
  GuitaristNote note; /**< The note that sounds, or did last, or is due */
  GuitaristNote waiting[GUITARIST_WAITING];
  uint32_t n_waiting;
  GuitaristHold hold;
  bool is_due;     /**< It is still to be plucked */
  uint64_t due;    /**< The frame when */
  uint64_t onset;  /**< Frame of its last note */
  uint64_t played; /**< Its last note's number among all */
} GuitaristString;

/** A string and what it is played on. */
typedef struct {
  Guitar* guitar;
  uint32_t index; /**< Of the string, from 0, the highest */
  GuitaristString* string;
} GuitaristHand;

/** Whether the key of a note on the string is down. */
bool guitarist_string_has(const GuitaristString* string, uint32_t channel, uint32_t key);

/** Whether a finger can fall on a note of the string that sounds and whose key is down. */
bool guitarist_string_is_held(GuitaristHand hand);

/** Play a note at the frame `due`; it ends all that the string had, but a pluck that was due
    before is not left out. */
void guitarist_string_play(GuitaristHand hand, GuitaristNote note, uint64_t due);

/** Hammer a note on; the one that sounds waits for its end. */
void guitarist_string_hammer(GuitaristHand hand, GuitaristNote note);

/** Do the pluck that is due. */
void guitarist_string_pluck(GuitaristHand hand);

/**
   A key is up, or GUITARIST_ANY_KEY: if its note sounds, pull off to the one that waits (if it was
   hammered on and `is_legato`), or let the string go.

   @param is_pedal  The pedal is down, and holds the string
*/
void guitarist_string_release(
    GuitaristHand hand, uint32_t channel, uint32_t key, bool is_legato, bool is_pedal);

/** Let a string go whatever keys are down: the pedal has it then, or it is damped. */
void guitarist_string_let_go(GuitaristHand hand, bool is_pedal);

#endif
