/**
   Seconds of music for an instrument, made of arbitrary bytes: a few messages of MIDI and the times
   between them, played over and over, so that what pumps has time to.

   Thread: one.
*/
#ifndef HOOKE_TESTS_FUZZ_SONG_H
#define HOOKE_TESTS_FUZZ_SONG_H

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/plug.h"

/**
   Play the bytes; then all sound off.

   The first says the rate and how many seconds it lasts, the second how many ports are moved, two
   bytes each; of what follows four are a message: the time before it, 4 ms each, and three bytes.
*/
void song_play(const PlugKind* kind, const uint8_t* bytes, size_t n_bytes);

#endif
