/**
   Who plays the guitar from MIDI: gives notes to strings, and plays chords, strums, hammer-ons and
   pull-offs as a guitarist would.

   Modes.  With a channel for each string (channels 1 to 6, 1 being the highest string, as MIDI
   guitars send, or the first six members of a zone) a note goes to the string of its channel.  With
   one channel for all the guitarist chooses: the hand is at a position that spans five frets, and
   stays there while it can; open strings are always in reach; no string takes two notes while
   another could take one; a chord spreads over the strings.  Where every string that could play a
   note is taken, the one whose note is the oldest is played anew.  A note below the lowest open
   string is played on the lowest string, tuned down; no note is left out.

   Channels.  Each channel is a player of its own, in either mode: a string follows the gestures and
   the pedals of the channel whose note it plays, and one that has not been played yet those of the
   channel that it belongs to, or of all.  A key that several channels hold on one string rings
   until the last of them lets go.

   Chords.  Notes of one frame are a chord, and are given strings together when time next goes on:
   core/guitar/fretboard.h says what a hand prefers.  A key that its channel still holds is played
   again on its string.  Notes that come frame by frame are decided one by one, and what is played
   stays where it is.

   Strum.  The strings of a chord are plucked from the lowest to the highest.  A note that comes
   within 30 ms of its start, while it is under way, is plucked after its last.  A key that goes up
   before its string is plucked damps it after that.

   Legato.  A soft note on a string that sounds and whose key is down is hammered on; with one
   channel that is the string that was played last, if the note comes alone, more than 50 ms after
   that one and within two frets of it.  When its key goes up and that of the note before is still
   down, the finger pulls off to it, half as strong.

   Thread: guitarist_new() and guitarist_free() anywhere but the audio thread; all else is real-time
   safe, one thread at a time, that of the guitar.  What is called does not depend on how the frames
   are cut into calls of guitarist_run().
*/
#ifndef HOOKE_CORE_GUITAR_GUITARIST_H
#define HOOKE_CORE_GUITAR_GUITARIST_H

#include "core/guitar/guitarist_state.h"
#include "core/play/performance.h"

#include <stdbool.h>
#include <stdint.h>

/** Farthest that gestures bend a string, to either side [semitones]: the result, not the scale. */
#define GUITARIST_MOST_BEND 24.0

/**
   Seat a guitarist at a guitar with six strings in the usual tuning: one channel, no strum, no
   legato, no harmonics.

   @return NULL if there is no memory; else the caller's, to guitarist_free()
*/
Guitarist* guitarist_new(GuitarSeat seat);

/** Free a guitarist; NULL is ignored. */
void guitarist_free(Guitarist* guitarist);

/** Give the keys of a channel other pitches, see guitar_set_scale(), which it calls.  A key without
 * one plays nothing, and what it plays is choked if `is_live`. */
void guitarist_set_scale(Guitarist* guitarist,
                         uint32_t channel,
                         const double semitones[PERFORMANCE_KEYS],
                         bool is_live);

/** All notes and gestures as at the start, and every channel's string that of its number; the
   guitar is not touched, and is to be reset too. */
void guitarist_reset(Guitarist* guitarist);

/** Take another way of playing; notes that sound go on. */
void guitarist_set_how(Guitarist* guitarist, GuitaristHow how);

/** Say which strings there are: the patch that the guitar was given.  What is fretted stays so. */
void guitarist_set_patch(Guitarist* guitarist, const GuitarPatch* patch);

/** The guitarist as core/play/performance.h has instruments: what follows, as a table. */
Performance guitarist_performance(Guitarist* guitarist);

/* Channels count from 0; one that MIDI does not have, or such a key, is ignored. */

/** Key down.  `velocity` 1 to 127; 0 is a key up. */
void guitarist_note_on(Guitarist* guitarist, uint32_t channel, uint32_t key, uint32_t velocity);

/** Key up: once no channel holds it its string is damped, or the finger pulls off, or a pedal holds
    it. */
void guitarist_note_off(Guitarist* guitarist, uint32_t channel, uint32_t key);

/**
   A gesture of a channel.

   Bends, gains and vibratos are those of its strings; pressure makes them swing by up to half a
   semitone more.  Brightness is hardness of the next plucks.  Softness is the palm's weight, on all
   strings and the heaviest of all channels.  The damper's pedal is down at its end or up, and lets
   go what it holds.  There is no breath.
*/
void guitarist_gesture(Guitarist* guitarist, uint32_t channel, Gesture gesture, double value);

/** Press one key of a channel, 0 to 1: its string swings. */
void guitarist_press_key(Guitarist* guitarist, uint32_t channel, uint32_t key, double pressure);

/** Strings of the channel whose keys are up keep the touch that they have. */
void guitarist_let_go(Guitarist* guitarist, uint32_t channel);

/** All keys of the channel up. */
void guitarist_all_notes_off(Guitarist* guitarist, uint32_t channel);

/** All keys and pedals of the channel up, nothing of it due any more, and its strings choked, with
    them those that nobody has played. */
void guitarist_all_sound_off(Guitarist* guitarist, uint32_t channel);

/** Give a channel the string of a number, where each has its own; too large: none. */
void guitarist_seat(Guitarist* guitarist, uint32_t channel, uint32_t seat);

/** Run the guitar for `n_frames`, write them to `left` and `right`, and pluck what is due on the
    way; 0: nothing happens, not even the end of the frame. */
void guitarist_run(Guitarist* guitarist, uint32_t n_frames, float* left, float* right);

#endif
