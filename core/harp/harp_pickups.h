/**
   The pickups that all strings of the harp share, and their fade to another place.

   A pickup does not slide: what it reads fades from the old place to the new one in a straight
   line, so that nothing clicks and nothing is bent in pitch.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_PICKUPS_H
#define HOOKE_CORE_HARP_HARP_PICKUPS_H

#include "core/base/ramp.h"
#include "core/harp/harp_patch.h"
#include "core/string/chain_kernel.h"

#include <stdbool.h>
#include <stdint.h>

/** Where strings are read, and what is heard of them. */
typedef struct {
  PickupType pickup_type;
  double place;  /**< Fraction of the length, 0 to 1 */
  double spread; /**< Between left and right, 0 to 0.5; 0: one pickup.  Past an end, folded back */
} HarpPlaces;

/** Zero reads at a wall. */
typedef struct {
  HarpPlaces heard;  /**< Where strings are read, or will be once the fade is over */
  HarpPlaces fading; /**< Where they were */
  Ramp fade;         /**< From `fading` to `heard`: 0 to 1 */
} HarpPickups;

/** One tap of every string. */
typedef struct {
  PickupType pickup_type;
  double place; /**< Fraction of the length, 0 to 1 */
  bool is_far;  /**< On the right */
} HarpEar;

/** What is to be read now: nothing that is not heard. */
typedef struct {
  HarpEar
      ears[CHAIN_MAX_TAPS]; /**< Left and right, or the one that is both; then those that fade */
  uint32_t n_taps;
  uint32_t n_sides; /**< 1 where left and right are one */
  bool is_fading;
} HarpReading;

/** Read at `places` at once. */
void harp_pickups_set(HarpPickups* pickups, HarpPlaces places);

/** Fade to `places` in `n_frames`; while a fade is under way nothing is done, to be asked for
 * again. */
void harp_pickups_move(HarpPickups* pickups, HarpPlaces places, uint32_t n_frames);

/** What is to be read until the fade, if there is one, is over. */
HarpReading harp_pickups_reading(const HarpPickups* pickups);

/** Whether both read alike. */
bool harp_pickups_are_same(const HarpReading* a, const HarpReading* b);

#endif
