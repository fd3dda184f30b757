/**
   What a guitarist does with one string: the notes that are held on it, the one that sounds, whose
   touch it has, and the pluck that is due.

   One note sounds, and those that it was hammered on above wait below it while their keys are down.
   A string has the touch (bend, vibrato, gain) of the channel whose note sounds.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_CORE_GUITAR_GUITARIST_STRING_H
#define HOOKE_CORE_GUITAR_GUITARIST_STRING_H

#include "core/guitar/guitar_event.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  GUITARIST_WAITING = 8,        /**< Most notes that wait; the oldest is forgotten for another */
  GUITARIST_ANY_KEY = UINT8_MAX /**< For a key: all of them */
};

/** How a string is bent and swings, and how loud it is. */
typedef struct {
  double bend;    /**< [semitones] */
  double vibrato; /**< Depth to either side [semitones] */
  double gain;
} GuitaristTouch;

/** What a channel does, see core/play/performance.h. */
typedef struct {
  double bend; /**< No more than GUITARIST_MOST_BEND */
  double vibrato;
  double pressure;
  double gain;
  double brightness;
  double softness;
  uint32_t seat; /**< Number of its own string, where each channel has one */
  bool is_pedal_down;
  bool is_sostenuto_down;
} GuitaristChannel;

/** A note on a string. */
typedef struct {
  uint32_t channel; /**< Whose touch it has */
  uint32_t holders; /**< The channels that hold its key, as bits */
  uint32_t key;
  double force;    /**< Of its pluck, 0 to 1 */
  double place;    /**< And where that is; NAN: the patch's */
  double hardness; /**< The same */
  double fret;
  double touch_s;    /**< How long a harmonic is touched [s] */
  uint32_t harmonic; /**< Touched at 1/(harmonic + 1) of the string; 0: not at all */
  bool is_hammered;  /**< It was hammered on, so that lifting its finger pulls the string */
} GuitaristNote;

/** Who keeps a string ringing. */
typedef enum {
  GUITARIST_NOBODY, /**< It is damped, or will be once it is plucked */
  GUITARIST_FOOT,   /**< A pedal; its key is up */
  GUITARIST_KEY
} GuitaristHold;

/** One that was never played is zero, but for the gain of its touch. */
typedef struct {
  GuitaristNote note; /**< The note that sounds, or did last, or is due */
  GuitaristNote waiting[GUITARIST_WAITING];
  uint32_t n_waiting;
  GuitaristHold hold;
  GuitaristTouch touch; /**< That it has */
  double leaned_on;     /**< Pressure of its key alone, 0 to 1 */
  bool has_played;      /**< It has a note's channel to follow */
  bool is_let_go;       /**< It follows its channel no more */
  bool is_caught;       /**< The sostenuto pedal of its channel holds it */
  bool is_due;          /**< It is still to be plucked */
  uint64_t due;         /**< The frame when */
  uint64_t onset;       /**< Frame of its last note */
  uint64_t played;      /**< Its last note's number among all */
} GuitaristString;

/** A string, what it is played on, and who plays. */
typedef struct {
  const GuitarSeat* seat;
  const GuitaristChannel* channels;
  uint32_t index; /**< Of the string, from 0, the highest */
  GuitaristString* string;
} GuitaristHand;

/** Whether the key of a note on the string is held by a channel. */
bool guitarist_string_has(const GuitaristString* string, uint32_t channel, uint32_t key);

/** Whether a finger can fall on a note of the string that sounds and whose key is down. */
bool guitarist_string_is_held(GuitaristHand hand);

/** Whether a pedal holds the string once its key is up. */
bool guitarist_string_is_pedalled(GuitaristHand hand);

/** Bring the string to a channel's touch. */
void guitarist_string_feel(GuitaristHand hand, uint32_t channel);

/** Play a note at the frame `due`; it ends all that the string had, but a pluck that was due
    before is not left out, and channels that hold the same key go on holding it. */
void guitarist_string_play(GuitaristHand hand, GuitaristNote note, uint64_t due);

/** Hammer a note on; the one that sounds waits for its end. */
void guitarist_string_hammer(GuitaristHand hand, GuitaristNote note);

/** Do the pluck that is due. */
void guitarist_string_pluck(GuitaristHand hand);

/**
   A channel's key is up, or with GUITARIST_ANY_KEY all of them: once nobody holds the note that
   sounds, pull off to the one that waits (if it was hammered on and `is_legato`), or let the string
   go.
*/
void guitarist_string_release(GuitaristHand hand, uint32_t channel, uint32_t key, bool is_legato);

/** Let a string go whatever keys are down: a pedal has it then, or it is damped. */
void guitarist_string_let_go(GuitaristHand hand);

/** Silence it, with nothing due and nobody at it. */
void guitarist_string_choke(GuitaristHand hand);

#endif
