/**
   Which of the harp's strings belong to a channel.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_CHANNELS_H
#define HOOKE_CORE_HARP_HARP_CHANNELS_H

#include "core/harp/harp_state.h"

/** All channels do nothing, and their pedals are up. */
void harp_channels_reset(HarpChannel channels[HARP_CHANNELS]);

/** Whether a channel holds the key of a string down. */
bool harp_channels_holds(const HarpString* string, uint32_t channel);

/** The string that a channel holds down at a key; NULL: none. */
HarpString* harp_channels_held(Harp* harp, uint32_t channel, uint32_t key);

/** The string that a channel is to play when it takes a key.  What another channel holds, or what
 * rings with another gain, is left alone while there is a spare string; else it is shared. */
HarpString* harp_channels_take(Harp* harp, uint32_t channel, uint32_t key);

/** The channel with whose gain a string is heard. */
uint32_t harp_channels_heard(const HarpString* string);

/**
   Let a channel have a string, which may ring: what is heard of it makes no step, so that it is
   heard with the gain that it was, if the channel's is another, until it has died away.

   @param is_played  By a note, which is to be heard though nothing was of what rings
   @return What a note is to be multiplied by, to be as loud as with the channel's own gain; 4 at
   most
*/
double harp_channels_hand(const Harp* harp, HarpString* string, uint32_t channel, bool is_played);

/** The channel whose pedal lifts dampers the most. */
uint32_t harp_channels_pedal(const Harp* harp);

/** How far a damper is lifted: by the key, or by the pedals of the channel that played the string
 * last; from one that sleeps by any channel's. */
double harp_channels_lift(const Harp* harp, const HarpString* string);

/** Whether a string does what a channel does. */
bool harp_channels_follows(const HarpString* string, uint32_t channel);

/** Bring a string, and all that follow it, to what it is to be now in `n_glide` frames. */
void harp_channels_retune(Harp* harp, HarpString* string, uint32_t n_glide);

/** The same of all strings. */
void harp_channels_retune_all(Harp* harp, uint32_t n_glide);

#endif
