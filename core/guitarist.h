/**
   Who plays the guitar from MIDI: gives notes to strings, and plays chords, strums, hammer-ons and
   pull-offs as a guitarist would.

   Modes.  With a channel for each string (channels 1 to 6, 1 being the highest string, as MIDI
   guitars send) a note goes to the string of its channel.  With one channel for all the guitarist
   chooses: the hand is at a position that spans five frets, and stays there while it can; open
   strings are always in reach; no string takes two notes while another could take one; a chord
   spreads over the strings.  Where every string that could play a note is taken, the one whose note
   is the oldest is played anew.  A note below the lowest open string is played on the lowest
   string, tuned down; no note is left out.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_CORE_GUITARIST_H
#define HOOKE_CORE_GUITARIST_H

#include "core/guitar.h"

#include <stdbool.h>
#include <stdint.h>

enum { GUITARIST_CHANNELS = 16, GUITARIST_KEYS = 128 };

/** How it plays. */
typedef struct {
  bool has_channels; /**< A channel for each string; false: one for all */
  double strum_s;    /**< From string to string of a chord struck together [s], ≥ 0 */
  uint32_t legato;   /**< Hardest velocity that is a hammer-on, 0: none is */
  uint32_t harmonic; /**< Every pluck is touched at 1/(harmonic + 1) of the string: 0 (not at all)
                        to 3 */
} GuitaristHow;

/** Opaque in all but size: use it through the functions below. */
typedef struct Guitarist Guitarist;

/** @return NULL if there is no memory; else the caller's, to guitarist_free() */
Guitarist* guitarist_new(Guitar* guitar);
void guitarist_free(Guitarist* guitarist);

/** All notes, pedals and wheels as at the start; the guitar is not touched. */
void guitarist_reset(Guitarist* guitarist);

/** Take another way of playing; notes that sound go on. */
void guitarist_set_how(Guitarist* guitarist, GuitaristHow how);

/** Say which strings there are: the patch that the guitar was given. */
void guitarist_set_patch(Guitarist* guitarist, const GuitarPatch* patch);

/* MIDI; channels count from 0 */

void guitarist_note_on(Guitarist* guitarist, uint32_t channel, uint32_t key, uint32_t velocity);
void guitarist_note_off(Guitarist* guitarist, uint32_t channel, uint32_t key);
void guitarist_bend(Guitarist* guitarist, uint32_t channel, double semitones);
void guitarist_pedal(Guitarist* guitarist, uint32_t channel, bool is_down);
void guitarist_vibrato(Guitarist* guitarist, uint32_t channel, double depth);
void guitarist_all_notes_off(Guitarist* guitarist, uint32_t channel);
void guitarist_all_sound_off(Guitarist* guitarist);

/** Run the guitar, and pluck what is due on the way. */
void guitarist_run(Guitarist* guitarist, uint32_t n_frames, float* left, float* right);

#endif
