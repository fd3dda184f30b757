/**
   MIDI messages to an instrument.

   Each channel is a player of its own: its wheel, pressure, pedals, volume and all else act on its
   own notes.  In a zone (core/play/zones.h) the leader's messages are for all its members too.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_CORE_PLAY_CHANNELS_H
#define HOOKE_CORE_PLAY_CHANNELS_H

#include "core/play/channel.h"
#include "core/play/mts.h"
#include "core/play/performance.h"
#include "core/play/zones.h"

#include <stdbool.h>
#include <stdint.h>

/** Deepest vibrato [semitones]. */
#define CHANNELS_VIBRATO 0.5

/** Who is told, and what came before; set `to`, then channels_reset(). */
typedef struct {
  Performance to;
  Zones zones;
  Channel channels[ZONES_CHANNELS];
  Mts mts;
} Channels;

/** As if no message had come: no zone, ranges of ±2 semitones, equal temperament.  The instrument
 * is not told; it is to be reset too. */
void channels_reset(Channels* all);

/** Tune the keys of all channels, and what sounds too, until a message tunes them otherwise.
 * @param semitones  Above A4, master tuning not in them; NAN: no pitch */
void channels_set_scale(Channels* all, const double semitones[PERFORMANCE_KEYS]);

/** All sound off, of all channels. */
void channels_silence(Channels* all);

/**
   Do what one complete MIDI message says.

   Note on and off.  The wheel, whose range is registered parameter 0, 0 to 96 semitones; fine and
   coarse tuning, parameters 1 and 2; zones, parameter 6 on channels 0 and 15, of 0 to 15 members.
   Pressure, of all keys or of one.  Vibrato (1), breath (2), volume (7), expression (11), pedals
   (64, 66, 67), brightness (74), all sound off (120), reset controllers (121), all notes off (123
   and the mode messages after it).  System exclusive messages that tune, see core/play/mts.h.

   A zone's member hears notes, its wheel and the wheel's range (which is every member's), its
   pressure and its brightness.  All else it leaves to its leader, whose every message is for all
   members.  A member whose keys are all up lets go of what it has played as soon as it plays again,
   or its wheel, pressure or brightness moves: that may be for the next note.

   Where a zone is set up, or one ends, its channels put their keys up and start afresh but for
   their volume; members then have a wheel of ±48 semitones, all others of ±2.  What is unknown, cut
   short or out of range is ignored, and so are programs and banks.

   @param bytes     `n_bytes` of them
   @param is_muted  Whether to ignore keys that go down
*/
void channels_play(Channels* all, const uint8_t* bytes, uint32_t n_bytes, bool is_muted);

#endif
