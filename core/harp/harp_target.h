/**
   What the patch, the damper and the channel ask of a string of the harp: its pitch and decay, and
   how the bridge holds it.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_HARP_TARGET_H
#define HOOKE_CORE_HARP_HARP_TARGET_H

#include "core/harp/harp_string.h"

/**
   What a string is to be at a pitch.  Its damper, lifted in part, takes its string by the same
   share of the way on a scale of octaves of τ.  The lever is the square of the resonance, so that
   half of it leaves the pitch of what is heard, and a damper takes it as it takes the string's
   motion.
*/
VoiceAim harp_target(const HarpString* string, double f0_hz);

#endif
