/**
   Registered parameters of MIDI (RPN): which one is chosen, and the values that data entry gives
   it.

   Controllers 101 and 100 choose one; 6 and 38 enter the upper and the lower half of its value, and
   96 and 97 step it up and down.  Values are counted in the unit of the lower half.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_PLAY_RPN_H
#define HOOKE_CORE_PLAY_RPN_H

#include <stdbool.h>
#include <stdint.h>

/** Their numbers, of 14 bits. */
enum {
  RPN_BEND_RANGE = 0, /**< Semitones above cents */
  RPN_FINE = 1,       /**< 1/8192 of 100 cents; 8192 is in tune */
  RPN_COARSE = 2,     /**< 1/128 semitone, of which whole semitones count; 8192 is in tune */
  RPN_ZONE = 6,       /**< Number of a zone's members, see core/play/zones.h */
  RPN_NONE = 0x3FFF
};

enum {
  RPN_CENTRE = 8192,         /**< Of both tunings */
  RPN_MOST_BEND_CENTS = 9600 /**< Widest range of a wheel */
};

/** Whether `controller` chooses a parameter, registered or not. */
bool rpn_is_choice(uint32_t controller);

/** Whether `controller` enters data, or steps it. */
bool rpn_is_entry(uint32_t controller);

/**
   The parameter that is chosen after `controller`.

   @param chosen      The one before
   @param controller  Half of a number (101, 100), or of one that is not registered (99, 98): then
   none is; others change nothing
*/
uint32_t rpn_choose(uint32_t chosen, uint32_t controller, uint32_t value);

/**
   The value of `parameter`, one of the first three, after data entry.

   The upper half brings the lower one to nought, as for every pair of controllers.  A step is one
   cent of a bend's range, the least there is of fine tuning, and a semitone of coarse tuning.  What
   would leave the range stops at its end.

   @param old         Its value before
   @param controller  6, 38, 96 or 97; others change nothing
*/
uint32_t rpn_enter(uint32_t parameter, uint32_t old, uint32_t controller, uint32_t value);

#endif
