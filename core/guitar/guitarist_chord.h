/**
   What a guitarist decides of the notes of a frame: which strings they are played on, whether a
   finger is hammered onto them, and in which order they are struck.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_CORE_GUITAR_GUITARIST_CHORD_H
#define HOOKE_CORE_GUITAR_GUITARIST_CHORD_H

#include "core/guitar/guitarist_state.h"

/** The string of the guitarist and of the guitar. */
GuitaristHand guitarist_chord_hand(Guitarist* guitarist, uint32_t string);

/** The fret of a key on a string; one that is too low for any fret gets the lowest. */
double guitarist_chord_fret(const Guitarist* guitarist, uint32_t string, uint32_t key);

/** Whether a note on is so soft, and its string sounds so, that it is hammered on. */
bool guitarist_chord_is_hammered(Guitarist* guitarist, const GuitaristEvent* event);

/** Frames from one stroke of a strum to the next. */
double guitarist_chord_strum_frames(const Guitarist* guitarist);

/** Give all notes on among the events their string and their stroke. */
void guitarist_chord_decide(Guitarist* guitarist);

#endif
