/**
   Where strings are read, and the fade to other places.

   A pickup does not slide: what it reads fades from the old place to the new one in a straight
   line, so that nothing clicks and nothing is bent in pitch.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_PICKUPS_H
#define HOOKE_CORE_VOICE_PICKUPS_H

#include "core/base/line.h"
#include "core/string/chain_kernel.h"
#include "core/string/pickup.h"

#include <stdbool.h>
#include <stdint.h>

enum { PICKUPS = 2 /**< Left and right, or two of a guitar */ };

/** What reads a string at one place. */
typedef struct {
  PickupType type;
  double place; /**< Fraction of the length, 0 to 1 */
} Pickup;

/** A pair of pickups; zero reads at a wall. */
typedef struct {
  Pickup heard[PICKUPS];  /**< Where strings are read, or will be once the fade is over */
  Pickup fading[PICKUPS]; /**< Where they were */
  Line fade;              /**< From `fading` to `heard`: 0 to 1 */
} Pickups;

/** What is to be read in some frames: the first `n_heard` are heard; while it fades as many follow
 * that are left behind. */
typedef struct {
  Pickup at[CHAIN_MAX_TAPS];
  uint32_t n_taps;
  uint32_t n_heard;
  bool is_fading;
} Reading;

/** Whether both read alike. */
bool pickups_are_same(const Pickup* a, const Pickup* b);

/** Read at `places` at once. */
void pickups_set(Pickups* pickups, const Pickup places[PICKUPS]);

/** Fade to `places` in `n_frames`; while a fade is under way nothing is done, to be asked for
 * again. */
void pickups_move(Pickups* pickups, const Pickup places[PICKUPS], uint32_t n_frames);

/** Frames until a fade ends; UINT32_MAX if there is none. */
uint32_t pickups_stretch(const Pickups* pickups);

/** What is to be read until then, of those pickups that are wanted: at least one. */
Reading pickups_reading(const Pickups* pickups, const bool is_wanted[PICKUPS]);

/** Fade, over as many frames as were read, from what the old places gave to what the new ones do,
 * in the buffers of the latter. */
void pickups_cross(Pickups* pickups, const Reading* reading, uint32_t n_frames, float* const* out);

#endif
