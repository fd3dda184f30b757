/**
   What a key plays: up to HARP_UNISONS strings, each of which may move in two directions.

   Strings in unison lie evenly from −d/2 to d/2 about the key's pitch.  A string that moves in two
   directions is two strings with amplitudes 1 and m: the first, with the pitch −c m²/(1 + m²) and
   the decay that is set, and the second, with c/(1 + m²), that dies by itself.  So the mean of the
   pitches [cents], each weighed by the energy that it is played with, is the key's own: that is
   what is exact of a group.  All begin in step, and their shares of the amplitude add up to 1.

   Of one partial at ν Hz what is heard of two with shares p ≥ q, c cents apart, beats at
   ν (2^(c/1200) − 1) Hz between p e^(−t/τp) ± q e^(−t/τq).

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_MEMBERS_H
#define HOOKE_CORE_HARP_HARP_MEMBERS_H

#include "core/harp/harp_patch.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  HARP_UNISONS = 3,
  HARP_MEMBERS = 2 * HARP_UNISONS /**< First the strings, and then the second direction of each */
};

/** How a key was played; zero is alone, as one is. */
typedef struct {
  uint32_t n_unisons; /**< Its strings, 0 to HARP_UNISONS */
  double second;      /**< m, 0 to 1; 0: there is no second direction */
} HarpGroup;

/** One direction of one string. */
typedef struct {
  double share; /**< Of the amplitude; 0: it is not played */
  double cents; /**< From the key's pitch */
  double decay; /**< τ over the key's own */
} HarpMember;

/** What the patch plays a key as.  A bow is drawn in one direction, so it plays no second; nor is
 * one played that is 80 dB below the first. */
HarpGroup harp_members_group(const HarpPatch* patch);

/** Whether there is but one member. */
static inline bool harp_members_is_alone(HarpGroup group) {
  return group.n_unisons <= 1 && group.second == 0.0;
}

/** Where the patch has the members of a group now. */
void harp_members_place(const HarpPatch* patch, HarpGroup group, HarpMember members[HARP_MEMBERS]);

/** Whether what rings, however it was played, lies alike under both. */
bool harp_members_lie_alike(const HarpPatch* a, const HarpPatch* b);

/**
   Mean power of a partial of all members in a time, over what it has where they are in step: of
   those that die from there on, and of what does not die about such a moment.  Of members i and k
   that is a share's product times

       Re (1 − e^(−s))/s,   s = fall/τi + fall/τk + i turn (ci − ck) ln 2/1200.

   @param fall  What the key's own amplitude loses in it: its logarithm, ≥ 0; 0: it does not die
   @param turn  What the key's own partial turns by in it [rad]
*/
double harp_members_kept(const HarpMember members[HARP_MEMBERS], double fall, double turn);

#endif
