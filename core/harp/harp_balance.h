/**
   How hard a string is to be played, so that it is as loud as any other.

   What is heard depends on where a string is played and with what, on where and how it is read, and
   on its key.  A player makes up for that; so does this room, with a prediction from the modes:
   mode k, of amplitude X_k (core/excite/spectrum.h), is read by each pickup as X_k (w0 sin(kφ i) +
   w1 sin(kφ (i + 1))), φ = π/(N + 1), for velocity times √a_k.  Weighed as ITU-R BS.1770 does at
   its frequency, and averaged over 0.4 s of its decay, its square adds to the power of the sound.

   The first modes are taken one by one, the rest by samples of ever more.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_BALANCE_H
#define HOOKE_CORE_HARP_HARP_BALANCE_H

#include "core/excite/pluck.h"
#include "core/harp/harp_members.h"
#include "core/harp/harp_patch.h"
#include "core/string/tuning.h"

#include <stdint.h>

/** Most that a string is played harder or softer by, on a wall or a node. */
#define HARP_BALANCE_MOST 8.0

/** Most that those which are played together are played harder or softer by, for what is heard of
 * them is not in step. */
#define HARP_BALANCE_OTHERS 2.5

/** The string that is to be played. */
typedef struct {
  TuningTarget target;       /**< Its own pitch and decay, no damper at it */
  uint32_t n_masses;         /**< N ≥ 1 */
  uint32_t key;              /**< Whose usual pitch pickups of velocity are weighed for */
  double hammer_mass;        /**< Of what strikes it, as a share of its own */
  const HarpMember* members; /**< What is played with it, HARP_MEMBERS, itself the first; NULL: it
                                is alone */
} HarpBalance;

/**
   What `pluck`'s amplitude is to be multiplied by, for the patch's exciter, pickup type, pickup and
   spread.

   Then the loudest 0.4 s have the same K-weighted power for every key, place, exciter and pickup
   type: half the amplitude's square, both sides taken together, times what a fundamental as damped
   as that of key 60 keeps of its own in 0.4 s.  So strings that are all damped more are all softer;
   of what one dies faster than that, at most 10 dB are made up for.

   @param pluck  As it is given to harp_group_play()
   @return 1/HARP_BALANCE_MOST to HARP_BALANCE_MOST; of what is played with others, at most
   HARP_BALANCE_OTHERS times as much or as little
*/
double harp_balance_gain(const HarpPatch* patch, const HarpBalance* string, Pluck pluck);

#endif
