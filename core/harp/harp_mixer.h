/**
   The way from the strings of the harp to its two outputs: which are run, where they are read, and
   the level.  harp_run() is here.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_MIXER_H
#define HOOKE_CORE_HARP_HARP_MIXER_H

#include "core/harp/harp.h"

/** Read at the places of the patch at once. */
void harp_mixer_place_pickups(Harp* harp);

#endif
