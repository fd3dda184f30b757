/**
   A string for every key of the MIDI range, with its damper, and the channels that play.

   Each channel has pedals, a bend, a touch and a gain of its own, which act on what it has played.
   Two channels that hold the same key have a string each, as long as there are spare ones; else
   they share one, which sounds until the last of them lets go. It then does what the one that
   played it last does, and is heard with the gain that it was until it has died away.

   A key may play more strings than its own, and a second direction of each: core/harp/harp_group.h.
   What is said of a string here is so of all of them, but for the bridge.

   No string is ever stolen.  A string that has died away is at rest in exact zeros and costs
   nothing.  The samples do not depend on how the frames are cut into calls of harp_run().

   Thread: harp_new() and harp_free() anywhere but the audio thread; all else is real-time safe, one
   thread at a time.
*/
#ifndef HOOKE_CORE_HARP_HARP_H
#define HOOKE_CORE_HARP_HARP_H

#include "core/harp/harp_state.h"

#include <stdbool.h>
#include <stdint.h>

/** See VOICE_NOTE_PEAK. */
#define HARP_NOTE_PEAK VOICE_NOTE_PEAK

/**
   Make a harp at rest.

   @param rate_hz  Frames per second [Hz], > 0
   @return NULL if there is no memory or the rate is no rate; else the caller's, to harp_free()
*/
Harp* harp_new(double rate_hz);

/** Free a harp; NULL is ignored. */
void harp_free(Harp* harp);

/** Bring all strings to rest at once; keys and pedals up, no channel does anything. */
void harp_reset(Harp* harp);

/** Take a new patch; what rings gets there in `n_frames`, and no faster than by a gesture (0: at
   once).  How and where it is plucked, and the most masses, hold from the next pluck on. */
void harp_set_patch(Harp* harp, const HarpPatch* patch, uint32_t n_frames);

/** What BODIES_FILE is from now on; NULL: no body.  It is copied. */
void harp_set_body(Harp* harp, const Body* body);

/**
   Tune the keys of a channel anew.  What it has played glides there by a gesture if `is_live`, and
   else keeps its pitch until it is played again; what is at rest is tuned at once.

   A key then has tuning_hz · 2^((semitones + bend) / 12).  Damping and its tracking stay with the
   key.  Every key's string has memory for CHAIN_MAX_MASSES, so that a scale takes none of its
   masses from it, however low.  A key without a pitch is silent: what rings there is choked.

   @param semitones  Of every key above A4, in any order; NAN: it has no pitch.  `key − 69` is equal
   temperament, as after harp_new()
*/
void harp_set_scale(Harp* harp, uint32_t channel, const double semitones[HARP_KEYS], bool is_live);

/* What channels do; each is a number less than HARP_CHANNELS, each key one less than HARP_KEYS.
   What it does to what rings takes a gesture, sample by sample. */

/**
   Key down: play its string.  A key that another channel holds is played on a spare string or, if
   none is left, on the same; a string whose key is up is taken over, if it rings as loud as the
   channel plays.

   @param velocity  1 to 127, loudness as its square; harder plucks are a little brighter
*/
void harp_note_on(Harp* harp, uint32_t channel, uint32_t key, uint32_t velocity);

/** Key up: when no other channel holds the string, the damper falls, as far as pedals let it. */
void harp_note_off(Harp* harp, uint32_t channel, uint32_t key);

/** What the channel has played and whose keys are up keeps the touch that it has; only the pedals
 * go on acting on it. */
void harp_let_go(Harp* harp, uint32_t channel);

/** Lift the dampers of all keys that are up: 0, they lie on their strings, to 1, they are off.
 * Between, they take a share of their way on a scale of octaves of τ. */
void harp_pedal(Harp* harp, uint32_t channel, double lift);

/** Keep the dampers up of those keys that are down now, until it is up again. */
void harp_sostenuto(Harp* harp, uint32_t channel, bool is_down);

/** The soft pedal, 0 to 1: the next notes are softer and duller. */
void harp_soften(Harp* harp, uint32_t channel, double softness);

/** Bend; what rings has exact pitch once it is there. */
void harp_bend(Harp* harp, uint32_t channel, double semitones);

/** Let the pitch swing, to the sharp side by 0 to 1 semitones, at the patch's rate; its mean stays
 * exact. */
void harp_vibrato(Harp* harp, uint32_t channel, double semitones);

/** Press on all keys, 0 to 1: bows are drawn up to twice as strong; what is not bowed swings more.
 */
void harp_press(Harp* harp, uint32_t channel, double pressure);

/** Press on one key that is down. */
void harp_press_key(Harp* harp, uint32_t channel, uint32_t key, double pressure);

/** Make it brighter, −1 to 1: less sits between the masses of what rings, and the next notes are
 * played with something harder.  The fundamental decays as before. */
void harp_brighten(Harp* harp, uint32_t channel, double brightness);

/** Share of their strength that bows have, 0 to 1. */
void harp_breathe(Harp* harp, uint32_t channel, double breath);

/** Gain of all that the channel plays and has played, beside the patch's level, ≥ 0; 1 at first.
 * What sounds gets there in a straight line, the note after silence has it from its first frame. */
void harp_set_gain(Harp* harp, uint32_t channel, double gain);

/** All keys of a channel up. */
void harp_all_notes_off(Harp* harp, uint32_t channel);

/** All keys and pedals of a channel up, and its strings silent in a few hundredths of a second. */
void harp_all_sound_off(Harp* harp, uint32_t channel);

/** The same of all channels. */
void harp_silence(Harp* harp);

/** Run `n_frames` and write them to `left` and `right`. */
void harp_run(Harp* harp, uint32_t n_frames, float* left, float* right);

/** What is sounding now; the headroom is the bridge's, too. */
VoiceReport harp_report(const Harp* harp);

#endif
