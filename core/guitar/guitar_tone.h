/**
   What a string of the guitar is to sound like, as it is fretted, bent and damped now.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_GUITAR_GUITAR_TONE_H
#define HOOKE_CORE_GUITAR_GUITAR_TONE_H

#include "core/guitar/guitar_string.h"

/** Frets from the nut of one that is counted from the capo; at least 0. */
double guitar_tone_frets(const GuitarPatch* patch, double fret);

/** Of the open string, with no hand on it. */
TuningTarget guitar_tone_open(const GuitarString* string);

/**
   Of the string as it is.  The damping is that of the note that is fretted, damping ·
   2^(tracking (note − 69)/12); a palm adds GUITAR_PALM_PER_S palm², and a finger that damps leaves
   no more than the release.
*/
VoiceAim guitar_tone(const GuitarString* string);

#endif
