/**
   Which of the harp's strings belong to a hand.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_HANDS_H
#define HOOKE_CORE_HARP_HARP_HANDS_H

#include "core/harp/harp.h"

/** All hands do nothing, and their pedals are up. */
void harp_hands_reset(HarpHand hands[HARP_HANDS]);

/** The string that a hand holds down at a key; NULL: none. */
HarpString* harp_hands_held(Harp* harp, uint32_t hand, uint32_t key);

/** The string that a hand is to play when it takes a key. */
HarpString* harp_hands_take(Harp* harp, uint32_t hand, uint32_t key);

/** Whether a string does what a hand does. */
bool harp_hands_follows(const HarpString* string, uint32_t hand);

#endif
