/**
   Up to eight strings that are fretted, plucked, slid, bent, touched and damped, the pickups under
   them, and the body that they are on.

   Length.  The bridge is place 0 and the nut of the open string place 1; where strings are plucked
   and read is measured so, and does not move when they are fretted.  A string of N masses that is
   stopped at fret f keeps the M of them between the bridge and the mass nearest to the fret,

       M + 1 = round((N + 1) 2^(−f/12)),

   and is tuned anew for those, so that its pitch is exact and not up to ten cents out.

   Time.  What happens to a string takes at least a gesture, and on the way its pitch is exact in
   each of its pieces of 64 frames.  Where a string becomes shorter its motion is moved onto the
   fewer masses first, where it becomes longer onto the more masses last; what it is read by fades
   over.  So nothing clicks.  The samples do not depend on how the frames are cut into calls of
   guitar_run().

   Body.  The strings are pulled and let go, pickups are magnets and hear how fast they move, and
   the body hears how they pull at the bridge and does nothing to them (core/voice/radiator.h).  No
   palm damps it.

   Thread: guitar_new() and guitar_free() anywhere but the audio thread; all else is real-time safe,
   one thread at a time.
*/
#ifndef HOOKE_CORE_GUITAR_GUITAR_H
#define HOOKE_CORE_GUITAR_GUITAR_H

#include "core/guitar/guitar_patch.h"
#include "core/play/performance.h"
#include "core/voice/voice.h"

#include <stdbool.h>
#include <stdint.h>

/** See VOICE_NOTE_PEAK. */
#define GUITAR_NOTE_PEAK VOICE_NOTE_PEAK

/** Force of a pluck by the velocity of a key, 1 to 127: its square, so that loudness is as in the
 * harp. */
double guitar_force(uint32_t velocity);

/** The patch's hardness as it is heard of a pluck, 0 to 1: harder for a stronger one, see
 * pluck_softness(). */
double guitar_hardness(double hardness, double force);

/** Opaque: a guitar. */
typedef struct Guitar Guitar;

/**
   Make a guitar at rest, which has no strings until it is given a patch.

   @param rate_hz  Frames per second [Hz], > 0
   @return NULL if there is no memory or the rate is no rate; else the caller's, to guitar_free()
*/
Guitar* guitar_new(double rate_hz);

/** Free a guitar; NULL is ignored. */
void guitar_free(Guitar* guitar);

/** Frames per second [Hz]. */
double guitar_rate_hz(const Guitar* guitar);

/** Bring all strings to rest at once, open, unbent and untouched; the patch stays. */
void guitar_reset(Guitar* guitar);

/** Take a new patch; what rings gets there in `n_frames`, and no faster than by a gesture (0: at
   once).  How and where strings are plucked, and the most masses, hold from the next pluck on. */
void guitar_set_patch(Guitar* guitar, const GuitarPatch* patch, uint32_t n_frames);

/** What BODIES_FILE is from now on: a copy of `body`; NULL: nothing.  What rings fades there. */
void guitar_set_body(Guitar* guitar, const Body* body);

/**
   Give the keys of a channel other pitches.  A string is tuned, open or at the capo, as its key is,
   and every fret has the pitch of the key that it is: between keys, and past those that have no
   pitch, in a straight line.  What a course has beside a string is as far from it as ever.

   @param semitones  Above A4; NAN: the key has none.  `key − 69` is equal temperament
   @param is_live    Whether strings that sound go there, in a gesture; else they do when they are
   next fretted
*/
void guitar_set_scale(Guitar* guitar,
                      uint32_t channel,
                      const double semitones[PERFORMANCE_KEYS],
                      bool is_live);

/** Let a string have the pitches of a channel, when it is next fretted; 0 at first. */
void guitar_follow_channel(Guitar* guitar, uint32_t string, uint32_t channel);

/* The hands.  `string` counts from 0, the highest; one that the patch does not have is ignored.
   Times are in seconds, and no shorter than a gesture. */

/** Pluck a string as it is fretted; whatever damped it lifts.  The plectrum stops what it was
 * doing, in a few hundredths of a second. */
void guitar_pluck(Guitar* guitar, uint32_t string, GuitarPluck pluck);

/** Stop a string at a fret (0: none but the capo), its motion kept, in one gesture. */
void guitar_fret(Guitar* guitar, uint32_t string, double fret);

/** As guitar_fret(), the finger falling or pulling off so hard that the string sounds of it: a
    hammer-on or a pull-off of `force`, 0 to 1.  What damped it lifts. */
void guitar_hammer(Guitar* guitar, uint32_t string, double fret, double force);

/** Slide to a fret, the pitch going evenly in semitones. */
void guitar_slide(Guitar* guitar, uint32_t string, double fret, double time_s);

/** Bend by `semitones` above the fret, evenly in semitones. */
void guitar_bend(Guitar* guitar, uint32_t string, double semitones, double time_s);

/** Swing the pitch about where it is; `depth` [semitones] to either side, 0: stop. */
void guitar_vibrato(Guitar* guitar, uint32_t string, double depth, double rate_hz);

/** Damp a string with the patch's release for a time, INFINITY: until it is plucked.  One that is
    choked stays so. */
void guitar_damp(Guitar* guitar, uint32_t string, double time_s);

/** Lift what damps a string. */
void guitar_let_ring(Guitar* guitar, uint32_t string);

/** Touch a string lightly for a time, at `place` of what sounds of it, from the bridge, 0 to 1: a
 * harmonic rings on where the partials have no node there. */
void guitar_touch(Guitar* guitar, uint32_t string, double place, double time_s);

/** Lay the palm on all strings, by `weight` more than the patch says, 0 to 1; 0: lift it. */
void guitar_palm(Guitar* guitar, double weight);

/** Every string silent in a few hundredths of a second, fretted as it is and touched by nobody. */
void guitar_choke(Guitar* guitar);

/** The same of one. */
void guitar_choke_string(Guitar* guitar, uint32_t string);

/** Gain of a string beside the patch's level, ≥ 0; what rings gets there in a gesture. */
void guitar_set_gain(Guitar* guitar, uint32_t string, double gain);

/* Looks */

/** Whether a string moves. */
bool guitar_is_awake(const Guitar* guitar, uint32_t string);

/** Where a string is stopped, or is being slid to, in semitones above where the capo stops it. */
double guitar_fretted(const Guitar* guitar, uint32_t string);

/** What is sounding now, tails of what was plucked anew as well. */
VoiceReport guitar_report(const Guitar* guitar);

/** Run `n_frames` and write them to `left` and `right`. */
void guitar_run(Guitar* guitar, uint32_t n_frames, float* left, float* right);

#endif
