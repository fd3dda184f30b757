/**
   MIDI messages to the guitarist.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_PLUGIN_GUITAR_MIDI_H
#define HOOKE_PLUGIN_GUITAR_MIDI_H

#include "core/guitar/guitarist.h"

#include <stdbool.h>
#include <stdint.h>

/** Widest range of the wheel [semitones]. */
#define GUITAR_MIDI_MOST_BEND 24.0

/** What is remembered of a channel. */
typedef struct {
  double wheel;       /**< −1 to 1 */
  uint32_t semitones; /**< Of the wheel's range */
  uint32_t cents;     /**< Of the wheel's range, and more than `semitones` */
  uint32_t parameter; /**< The registered one that data entry is for: its upper seven bits and its
                         lower seven, all ones for none */
} GuitarChannel;

/** Who hears the messages, and what came before. */
typedef struct {
  Guitar* guitar;
  Guitarist* guitarist;
  GuitarChannel channels[GUITARIST_CHANNELS];
} GuitarMidi;

/** Wheels in the middle, their ranges ±2 semitones, no parameter chosen; nobody is told. */
void guitar_midi_reset(GuitarMidi* midi);

/** Wheels in the middle, as the guitarist puts them when its mode changes. */
void guitar_midi_centre(GuitarMidi* midi);

/**
   Do what one complete MIDI message says, each channel for itself.

   Note on and off; the wheel, whose range is registered parameter 0 (controllers 101, 100, then 6
   for semitones and 38 for cents), 0 to 24 semitones, ±2 at first; vibrato (1) of up to half a
   semitone; pedal (64); the palm's weight (67), of all strings; all sound off (120); reset
   controllers (121), which leaves the wheel's range; all notes off (123 and the mode messages after
   it).  What is unknown, cut short or out of range is ignored.

   @param bytes     `n_bytes` of them
   @param is_muted  Whether to ignore keys that go down
*/
void guitar_midi_play(GuitarMidi* midi, const uint8_t* bytes, uint32_t n_bytes, bool is_muted);

#endif
