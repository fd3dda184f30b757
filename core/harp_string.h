/**
   One string of the harp: the key it belongs to, its damper, and what it is played with.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_STRING_H
#define HOOKE_CORE_HARP_STRING_H

#include "core/bow.h"
#include "core/hammer.h"
#include "core/patch.h"
#include "core/wire.h"

#include <stdbool.h>
#include <stdint.h>

/** What touches the string. */
typedef enum {
  DAMPER_OFF,    /**< Nothing: it rings with its own decay */
  DAMPER_ON,     /**< The damper: it dies with the patch's release */
  DAMPER_CHOKING /**< A hand: it is gone in a moment */
} Damper;

/** Zero is a string that is asleep and has no memory. */
typedef struct {
  Wire wire;
  uint32_t key;      /**< MIDI note number */
  double semitones;  /**< Its pitch above A4 [semitones]; NAN: it has none, and is silent */
  uint32_t n_strung; /**< Masses that it was strung with; a bend may have left it fewer */
  Damper damper;
  Hammer hammer; /**< What strikes it now */
  Bow bow;       /**< What is drawn across it now */
} HarpString;

/** The pitch of a string [Hz], with a bend in semitones. */
double harp_string_pitch_hz(const HarpString* string, const Patch* patch, double bend_semitones);

/** Lay a string at rest over `memory`, chain_size(capacity) bytes, aligned to CHAIN_ALIGNMENT; it
 * has the pitch of its key in equal temperament, and never more masses than `capacity`. */
void harp_string_init(
    HarpString* string, double rate_hz, uint32_t key, void* memory, uint32_t capacity);

/** Silence it at once, with nothing at it. */
void harp_string_rest(HarpString* string);

/**
   Play a string with the patch's exciter.  From rest it is strung anew, with the largest stable
   number of masses up to the patch's; while it rings the motion adds to its own, its damper lifts,
   the coefficients take `n_glide` frames, and if a bend has left it few of its masses it has them
   again.  A string whose pitch is at or above Nyquist stays silent.

   @param pluck  As loud as a strike or a bow is to be; its hardness is the hammer's, or the bow's
   pressure
*/
void harp_string_play(
    HarpString* string, const Patch* patch, double bend_semitones, Pluck pluck, uint32_t n_glide);

/** Lift the bow, if there is one. */
void harp_string_lift(HarpString* string);

/**
   Bring a ringing string to the patch, bend and damper in `n_glide` frames, see wire_retune().  A
   pitch that cannot be had at all chokes it.
*/
void harp_string_retune(
    HarpString* string, const Patch* patch, double bend_semitones, Damper damper, uint32_t n_glide);

/** Frames that its chain can be run in one go, before harp_string_pass() must be told: one while a
 * hammer or a bow is at it. */
uint32_t harp_string_stretch(const HarpString* string);

/** After `n_frames`, at most its stretch: let the hammer and the bow act, and see wire_pass(). */
void harp_string_pass(HarpString* string, uint32_t n_frames);

#endif
