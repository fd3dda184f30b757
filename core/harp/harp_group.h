/**
   The strings that one key plays together, see core/harp/harp_members.h: a leader, which is the
   key's own, and those that follow it, each with a voice of its own.

   Followers sound as long as they ring, whether the leader does or not, and all that is done to the
   leader is done to them: who plays it, where it is heard, its pitch, touch and damper are the
   leader's.  The bridge is the leader's alone.  How many there are, and how strong the second
   direction is, is what the key was played with last; one that was played with more before has
   those ring out where they are.

   A leader without followers in memory plays alone.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_GROUP_H
#define HOOKE_CORE_HARP_HARP_GROUP_H

#include "core/harp/harp_string.h"

#include <stdbool.h>
#include <stdint.h>

enum {
  HARP_FOLLOWERS = HARP_MEMBERS - 1,
  HARP_FOLLOWER_MASSES = 256, /**< Most masses of one: a harp is to be made soon, and to be small */
};

/** Bytes of memory that the followers of one leader need. */
size_t harp_group_size(void);

/** Give a leader that is at rest HARP_FOLLOWERS others, at rest over harp_group_size() bytes that
 * are aligned to CHAIN_ALIGNMENT. */
void harp_group_init(HarpString* leader, HarpString* followers, void* memory);

/** Whether any of them moves. */
bool harp_group_is_awake(const HarpString* leader);

/** The `i`-th that follows it, if it moves; else NULL. */
HarpString* harp_group_awake(const HarpString* leader, uint32_t i);

/** Where none that follows it moves any more, forget them: then they cost nothing.
 * @return Whether there is none */
bool harp_group_forget(HarpString* leader);

/** Put all of them to sleep at once. */
void harp_group_sleep(HarpString* leader);

/** See harp_string_rest(). */
void harp_group_rest(HarpString* leader);

/**
   Play them with the patch's exciter: while one rings the motion adds to its own.  A string whose
   pitch is at or above Nyquist stays silent.

   @param pluck  As loud as a strike or a bow is to be, and all of them together; its hardness is
   the hammer's, or the bow's pressure
*/
void harp_group_play(HarpString* leader, Pluck pluck, uint32_t n_glide);

/** See harp_string_lift(). */
void harp_group_lift(HarpString* leader);

/** See harp_string_retune(). */
void harp_group_retune(HarpString* leader, uint32_t n_glide);

/** See harp_string_choke(). */
void harp_group_choke(HarpString* leader, uint32_t n_glide);

/** See harp_string_wake(): the leader wakes, and no other. */
bool harp_group_wake(HarpString* leader, uint32_t n_glide);

/** Add those that follow it to what is sounding. */
void harp_group_report(const HarpString* leader, VoiceReport* report);

#endif
