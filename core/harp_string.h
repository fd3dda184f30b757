/**
   One string of the harp: the key it belongs to, and its damper.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_STRING_H
#define HOOKE_CORE_HARP_STRING_H

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
} HarpString;

/** The pitch of a string [Hz], with a bend in semitones. */
double harp_string_pitch_hz(const HarpString* string, const Patch* patch, double bend_semitones);

/** Lay a string at rest over `memory`, chain_size(capacity) bytes, aligned to CHAIN_ALIGNMENT; it
 * has the pitch of its key in equal temperament, and never more masses than `capacity`. */
void harp_string_init(
    HarpString* string, double rate_hz, uint32_t key, void* memory, uint32_t capacity);

/**
   Pluck a string.  From rest it is strung anew, with the largest stable number of masses up to the
   patch's; while it rings the pluck adds to its motion, its damper lifts, the coefficients take
   `n_glide` frames, and if a bend has left it few of its masses it has them again.  A string whose
   pitch is at or above Nyquist stays silent.
*/
void harp_string_pluck(
    HarpString* string, const Patch* patch, double bend_semitones, Pluck pluck, uint32_t n_glide);

/**
   Bring a ringing string to the patch, bend and damper in `n_glide` frames, see wire_retune().  A
   pitch that cannot be had at all chokes it.
*/
void harp_string_retune(
    HarpString* string, const Patch* patch, double bend_semitones, Damper damper, uint32_t n_glide);

#endif
