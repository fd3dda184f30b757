/**
   The MIDI tuning standard: the pitch that each key has on each channel, and the messages that
   change it.

   Whatever tunes keys, a message or a scale that is set, says what pitch they have from then on, so
   the last word counts: a bulk dump gives all keys of all channels one, a change of single notes
   gives it to those on all channels, and a tuning by octaves gives all keys of the channels that it
   names their pitch in equal temperament and what it adds to each of the twelve.  Master tuning is
   added to all.  A key that is given a pitch has one, even if the scale left it out.

   There is one tuning program: messages for all programs and banks are for it.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_PLAY_MTS_H
#define HOOKE_CORE_PLAY_MTS_H

#include "core/play/performance.h"

#include <stdbool.h>
#include <stdint.h>

/** What keys have. */
typedef struct {
  double keys[PERFORMANCE_CHANNELS][PERFORMANCE_KEYS]; /**< Above A4 [semitones]; NAN: no pitch */
  double fine;                                         /**< This and the next: added to all keys */
  double coarse;
} Mts;

/** What a message has changed. */
typedef struct {
  uint32_t channels; /**< A bit each; 0: none */
  bool is_live;      /**< What sounds moves, too; else the next notes alone */
} MtsChange;

/** Equal temperament, and no master tuning. */
void mts_reset(Mts* mts);

/** Give the keys of all channels these pitches above A4 [semitones]; NAN: none.
 * @return That all channels have changed, live */
MtsChange mts_set_scale(Mts* mts, const double semitones[PERFORMANCE_KEYS]);

/**
   Do what a system exclusive message says, from F0 to F7, to whatever device it is.

   | 7E or 7F | id    |                                                                            |
   |----------|-------|----------------------------------------------------------------------------|
   | 7E       | 08 01 | bulk dump: program, 16 characters, 128 pitches of three bytes, checksum    |
   | 7E       | 08 04 | the same with a bank before the program                                    |
   | 7E       | 08 05 | octave: bank, program, 16 characters, 12 cents of one byte, checksum       |
   | 7E       | 08 06 | the same with two bytes                                                    |
   | 7F       | 08 02 | single notes: program, their number, a key and three bytes for each        |
   | both     | 08 07 | the same with a bank before the program                                    |
   | both     | 08 08 | octave: three bytes of channels, 12 cents of one byte                      |
   | both     | 08 09 | the same with two bytes                                                    |
   | 7F       | 04 03 | master tuning, fine                                                        |
   | 7F       | 04 04 | master tuning, coarse                                                      |

   Three bytes are a key and 1/16384 semitones above it, 7F 7F 7F is no change; one is a cent from
   0x40, two are 100/8192 cents from 0x2000, and so is fine master tuning.  Coarse is a semitone
   from 0x40.  A message of another length, one with a byte above 7F, or one whose checksum is not
   that of its bytes, all after F0 taken together by exclusive or, changes nothing.
*/
MtsChange mts_play(Mts* mts, const uint8_t* bytes, uint32_t n_bytes);

/** Pitches of a channel's keys above A4 [semitones], master tuning in them; NAN: none. */
void mts_pitches(const Mts* mts, uint32_t channel, double semitones[PERFORMANCE_KEYS]);

#endif
