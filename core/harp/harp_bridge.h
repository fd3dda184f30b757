/**
   The strings of the harp that are tied to its bridge (core/voice/bridge.h): they are stepped side
   by side, frame by frame, and those that sleep with nothing on them wake when the bridge moves.

   A string is tied while it is played or its damper is lifted and the patch has resonance; one
   whose damper has fallen is let go, and is stepped as if there were no bridge.  Where none is
   tied, nothing of this is computed.  All that happens here in the harp's own time happens on a
   grid of HARP_BRIDGE_FRAMES from the moment on at which the first string was tied.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_BRIDGE_H
#define HOOKE_CORE_HARP_HARP_BRIDGE_H

#include "core/harp/harp_state.h"

#include <stdint.h>

/** A bridge at rest. */
void harp_bridge_init(HarpBridge* bridge, double rate_hz);

/** Put it onto the body of the patch: at once where no string is tied; else the strings are let go
 * first, and tied again after that. */
void harp_bridge_move(Harp* harp);

/** The first `n_tied` strings that are run are tied. */
void harp_bridge_gather(Harp* harp, uint32_t n_tied);

/** Frames, at most `n_frames`, after which harp_bridge_pass() is to be told. */
uint32_t harp_bridge_stretch(const Harp* harp, uint32_t n_frames);

/** Run the strings that are tied at most `n_frames`, add them to their buses, and tell them; how
 * many they were, which is less where a hammer or a bow has left a string, or is followed by ear.
 */
uint32_t harp_bridge_run(Harp* harp, uint32_t n_frames, const Reading* reading);

/** After those frames: on the grid, see who is to wake, and who may sleep. */
void harp_bridge_pass(Harp* harp, uint32_t n_frames);

/** A bridge that moves by what is not a number is at rest. */
void harp_bridge_mend(Harp* harp);

/** See bridge_headroom(); 1 where no string is tied. */
double harp_bridge_headroom(const Harp* harp);

#endif
