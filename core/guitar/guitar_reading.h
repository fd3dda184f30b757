/**
   How the pickups read a string of the guitar.

   A pickup stays where it is while strings are fretted, so it reads another part of what sounds. It
   does not slide there: what it reads fades from the old place to the new one in a straight line,
   so that nothing clicks and nothing is bent in pitch.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_GUITAR_GUITAR_READING_H
#define HOOKE_CORE_GUITAR_GUITAR_READING_H

#include "core/base/ramp.h"
#include "core/guitar/guitar_patch.h"
#include "core/string/chain.h"

#include <stdbool.h>
#include <stdint.h>

enum { GUITAR_MIX_FRAMES = 256 /**< Frames that are mixed at a time */ };

/** Where the pickups read a string, as fractions of its sounding length; zero reads at the bridge.
 */
typedef struct {
  double heard[GUITAR_PICKUPS];  /**< Now, or once the fade is over */
  double fading[GUITAR_PICKUPS]; /**< Before */
  Ramp fade;                     /**< 0 to 1 */
} GuitarReading;

/** Gains of the pickups over at most GUITAR_MIX_FRAMES frames. */
typedef struct {
  bool is_read[GUITAR_PICKUPS]; /**< false: its gain is 0 in all of them */
  float gain[GUITAR_PICKUPS][GUITAR_MIX_FRAMES];
} GuitarGains;

/** Read at `places` at once. */
void guitar_reading_set(GuitarReading* reading, const double places[GUITAR_PICKUPS]);

/** Fade to `places` in `n_frames`; while a fade is under way nothing is done, to be asked for
 * again. */
void guitar_reading_move(GuitarReading* reading,
                         const double places[GUITAR_PICKUPS],
                         uint32_t n_frames);

/** Frames until a fade ends; UINT32_MAX if there is none. */
uint32_t guitar_reading_stretch(const GuitarReading* reading);

/**
   Step a chain, and add what the pickups read of it to `out`.

   @param from      Frame of `gains` that is the first; from + n_frames is at most GUITAR_MIX_FRAMES
   @param n_frames  At most the stretches of the reading and of the chain
*/
void guitar_reading_run(GuitarReading* reading,
                        Chain* chain,
                        const GuitarGains* gains,
                        uint32_t from,
                        uint32_t n_frames,
                        float* out);

#endif
