/**
   MIDI messages to the harp.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_PLUGIN_STRINGS_MIDI_H
#define HOOKE_PLUGIN_STRINGS_MIDI_H

#include "core/harp.h"

#include <stdint.h>

/**
   Do what one complete MIDI message says: note on and off, sustain pedal (64), all sound off (120),
   reset controllers (121), all notes off (123 and the mode messages after it), pitch bend of ±2
   semitones; all channels alike.  What is unknown, cut short or out of range is ignored.

   @param bytes     `n_bytes` of them
   @param is_muted  Whether to ignore keys that go down
*/
void strings_midi_play(Harp* harp, const uint8_t* bytes, uint32_t n_bytes, bool is_muted);

#endif
