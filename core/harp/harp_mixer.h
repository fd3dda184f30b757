/**
   The way from the strings of the harp to its two outputs: which are run, where they are read, and
   the level.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_MIXER_H
#define HOOKE_CORE_HARP_HARP_MIXER_H

#include "core/harp/harp_state.h"

/** What a group does, if it rings, is to end at once: let nobody hear a step. */
void harp_mixer_hide_end(Harp* harp, const HarpString* leader);

/** What slept is at once where it is, at rest: the same. */
void harp_mixer_hide_start(Harp* harp, const HarpString* leader);

/** See harp_run(). */
void harp_mixer_run(Harp* harp, uint32_t n_frames, float* left, float* right);

/** Read at the places of the patch at once. */
void harp_mixer_place_pickups(Harp* harp);

#endif
