/**
   Where a string is read.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_STRING_PICKUP_H
#define HOOKE_CORE_STRING_PICKUP_H

#include "core/string/chain.h"

/** What pickups hear of a string; about as loud in all. */
typedef enum {
  PICKUP_DISPLACEMENT, /**< How far it is from rest */
  PICKUP_VELOCITY, /**< How fast it moves, as a magnet with a coil does: brighter by 6 dB an octave
                    */
  PICKUP_FORCE,    /**< How it pulls at the bridge, as a piezo does; wherever the pickup is */
  PICKUP_MAGNET    /**< Velocity as it is [per frame], for who weighs each string by itself */
} PickupType;

/**
   The tap that reads a string at `place`, in a straight line between the two masses beside it; the
   walls read 0.

   @param n_masses  N ≥ 1; mass i (from 1) is at place i/(N + 1)
   @param place     Fraction of the length, 0 to 1
*/
ChainTap pickup_tap(uint32_t n_masses, double place);

/**
   The tap for a type of pickup.  That of velocity reads x/(2 sin(ω/2)), which is to be
   differentiated, a sample less the one before, and that of force reads (N + 1)/π times the mass at
   the end at place 0: so the fundamental would be as large as in the displacement.  Both are
   weakened by as much as their upper partials make them louder.  That of a magnet reads u.

   @param angle1  ω, the fundamental's digital angular frequency [rad per sample], > 0
*/
ChainTap pickup_tap_of_type(PickupType type, uint32_t n_masses, double place, double angle1);

/** Differentiate what a tap for PICKUP_VELOCITY has read.  @param before  The sample before the
 * first; then the last. */
void pickup_differentiate(float* samples, uint32_t n_frames, float* before);

#endif
