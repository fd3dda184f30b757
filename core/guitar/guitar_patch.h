/** What the player of a guitar sets: the whole contract between the panel and the sound. */
#ifndef HOOKE_CORE_GUITAR_GUITAR_PATCH_H
#define HOOKE_CORE_GUITAR_GUITAR_PATCH_H

#include "core/bank/bodies.h"
#include "core/voice/string_patch.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  GUITAR_STRINGS = 8, /**< Most strings, or courses */
  GUITAR_PICKUPS = 2,
  GUITAR_MAX_MASSES = 256, /**< Of a string */
};

/** What reads all strings at one place. */
typedef struct {
  double place; /**< Fraction of the open string's length from the bridge, 0 to 1 */
  double gain;  /**< 0: not read at all; negative: out of phase */
} GuitarPickup;

/** Every value must be in its range and a number: who fills a patch in clamps it. */
typedef struct {
  StringPatch string; /**< Of every string.  The damping is that of the note that is fretted, and
                         the masses are those of an open string */
  double level;       /**< Gain, ≥ 0 */
  double pluck;       /**< Where strings are plucked, fraction of the open string's length from the
                         bridge, 0 to 1 */
  double hardness;    /**< Of what plucks, 0 to 1 */
  GuitarPickup pickups[GUITAR_PICKUPS];
  double open[GUITAR_STRINGS]; /**< MIDI note of each open string, the highest string first */
  uint32_t n_strings;          /**< How many there are, 1 to GUITAR_STRINGS */
  double capo;    /**< Fret that the capo is at, ≥ 0; the others are counted from there */
  double palm;    /**< How heavily the palm lies on the strings, 0 to 1: see GUITAR_PALM_PER_S */
  double course;  /**< Loudness of the string beside each, 0 to 1; 0: there is none */
  double noise;   /**< How loud fingers and picks are themselves, 0 to 1 */
  double width;   /**< How far the strings are spread from left to right, 0 to 1 */
  BodyPatch body; /**< What radiates beside the pickups */
  bool is_uncorrected; /**< Frets stop a mass and nothing else, as in [MQ09]: out of tune */
} GuitarPatch;

/** How a string is plucked. */
typedef struct {
  double force; /**< −1 to 1; the sign is the direction: 1 is the hardest stroke down */
  double
      place; /**< Fraction of the open string's length from the bridge, 0 to 1; NAN: the patch's */
  double hardness; /**< 0: a wide, soft finger; 1: a narrow, hard pick; NAN: the patch's,
                      harder for a stronger pluck */
} GuitarPluck;

#endif
