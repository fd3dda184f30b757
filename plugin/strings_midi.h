/**
   MIDI messages to the harp.

   Without zones (core/play/zones.h) all channels are one: the last message wins, whichever it came
   on. In a zone each channel is a hand with its own wheel, pressure and brightness, and its
   leader's messages are for the whole zone.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_PLUGIN_STRINGS_MIDI_H
#define HOOKE_PLUGIN_STRINGS_MIDI_H

#include "plugin/strings_hands.h"

#include <stdbool.h>
#include <stdint.h>

/** Deepest vibrato [semitones]. */
#define STRINGS_MIDI_VIBRATO 0.5

/** Who hears the messages, and what came before. */
typedef struct {
  StringsHands hands;                  /**< With the harp */
  uint32_t parameters[ZONES_CHANNELS]; /**< Chosen on each channel, see core/play/rpn.h */
  double volume;                       /**< This and expression: gains of all strings, 0 to 1 */
  double expression;
} StringsMidi;

/** As if no message had come: no zone, ranges of ±2 semitones.  The harp is not told; it is to be
 * reset too. */
void strings_midi_reset(StringsMidi* midi);

/** All sound off; keys and pedals are up. */
void strings_midi_silence(StringsMidi* midi);

/**
   Do what one complete MIDI message says.

   Note on and off.  The wheel, whose range is registered parameter 0, 0 to 96 semitones; fine and
   coarse tuning, parameters 1 and 2; zones, parameter 6 on channels 0 and 15, of 0 to 15 members.
   Pressure, of all keys or of one.  Vibrato (1), breath (2), volume (7), expression (11), pedals
   (64, 66, 67), brightness (74), all sound off (120), reset controllers (121), all notes off (123
   and the mode messages after it).

   A zone's member hears notes, its wheel and the wheel's range (which is every member's), its
   pressure and its brightness.  All else it leaves to its leader, whose wheel, tuning, vibrato,
   breath, pedals, pressure and brightness are for all members.

   Reset controllers puts wheel, vibrato, pressures and pedals at rest, breath and expression at
   full, and chooses no parameter; it leaves volume, brightness, ranges and tunings.  Volume,
   expression and all sound off are for all strings.  What is unknown, cut short or out of range is
   ignored.

   @param bytes     `n_bytes` of them
   @param is_muted  Whether to ignore keys that go down
*/
void strings_midi_play(StringsMidi* midi, const uint8_t* bytes, uint32_t n_bytes, bool is_muted);

#endif
