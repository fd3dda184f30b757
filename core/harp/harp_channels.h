/**
   Which of the harp's strings belong to a channel.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_CHANNELS_H
#define HOOKE_CORE_HARP_HARP_CHANNELS_H

#include "core/harp/harp.h"

/** All channels do nothing, and their pedals are up. */
void harp_channels_reset(HarpChannel channels[HARP_CHANNELS]);

/** Whether a channel holds the key of a string down. */
bool harp_channels_holds(const HarpString* string, uint32_t channel);

/** The string that a channel holds down at a key; NULL: none. */
HarpString* harp_channels_held(Harp* harp, uint32_t channel, uint32_t key);

/** The string that a channel is to play when it takes a key. */
HarpString* harp_channels_take(Harp* harp, uint32_t channel, uint32_t key);

/** Whether a string does what a channel does. */
bool harp_channels_follows(const HarpString* string, uint32_t channel);

#endif
