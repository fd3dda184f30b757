/**
   Which string a guitarist plays a note on, and which ones a chord.

   The hand is at a position, the fret of its first finger, and reaches FRETBOARD_REACH frets from
   there; it moves as little as it must.  All ways to give the notes strings are weighed, and the
   cheapest is taken:

   - a fretted note costs 1 and a little for each fret up the neck; an open string costs a quarter
     of the position, so low down it is cheaper than a finger, and high up dearer;
   - a fret that the hand moves costs 1, one that it stretches beyond its reach 10;
   - a chord is the dearer the more frets it spans and the more strings it leaves out in between;
     a note on a string below that of a lower note costs 20;
   - a string that rings of another note with its key up costs 1, and one that is taken 1000 and 100
     for each that was taken longer ago, so the oldest note goes first, and only in need.

   Work: at most FRETBOARD_TRIES tries to give one note a string, then the best way so far.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_GUITAR_FRETBOARD_H
#define HOOKE_CORE_GUITAR_FRETBOARD_H

#include "core/guitar/guitar_patch.h"

#include <stdint.h>

enum {
  FRETBOARD_NOTES = 8,   /**< Most notes of a chord */
  FRETBOARD_FRETS = 24,  /**< The highest that a finger is put on */
  FRETBOARD_REACH = 4,   /**< Frets from the first finger to the last */
  FRETBOARD_TRIES = 5000 /**< Most tries for a chord */
};

/** What a string is doing. */
typedef enum {
  FRETBOARD_FREE,    /**< Nothing that would be missed */
  FRETBOARD_RINGING, /**< It sounds, but no key holds it */
  FRETBOARD_TAKEN    /**< A key holds it */
} FretboardUse;

/** A string. */
typedef struct {
  double open;      /**< MIDI note with no finger on it, the capo's if there is one */
  double fret;      /**< Where it is stopped now */
  FretboardUse use; /**< What it is doing */
  uint64_t played;  /**< When it was last played, in any order that grows */
} FretboardString;

/** All strings. */
typedef struct {
  FretboardString strings[GUITAR_STRINGS];
  uint32_t n_strings; /**< 1 to GUITAR_STRINGS */
} Fretboard;

/** Where a chord is played. */
typedef struct {
  uint32_t string[FRETBOARD_NOTES]; /**< Of each note, in the order given */
  int32_t position;                 /**< Of the hand, ≥ 1 */
  uint32_t n_tries;                 /**< What it took to find */
} FretboardGrip;

/** The finger's fret for a MIDI note on a string: the nearest whole one; < 0: below the string. */
int32_t fretboard_finger(const FretboardString* string, uint32_t key);

/** Where the hand goes for fingers from fret `lowest` to `highest`, both ≥ 1: no further than it
    must. */
int32_t fretboard_reach(int32_t position, int32_t lowest, int32_t highest);

/**
   Find a string for each of `n_keys` different MIDI notes.

   A note that no string has between its ends is given to the one that comes nearest.  Notes share a
   string only where there are no others for them.

   @param position  Where the hand is, ≥ 1
   @param keys      MIDI notes in any order
   @param n_keys    0 to FRETBOARD_NOTES
*/
FretboardGrip
fretboard_grip(const Fretboard* board, int32_t position, const uint32_t* keys, uint32_t n_keys);

#endif
