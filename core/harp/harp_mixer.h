/**
   The way from the strings of the harp to its two outputs: which are run, where they are read, and
   the level.  harp_run() is here.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_MIXER_H
#define HOOKE_CORE_HARP_HARP_MIXER_H

#include "core/harp/harp.h"

/** Where a patch has strings read. */
HarpPlaces harp_mixer_places(const HarpPatch* patch);

#endif
