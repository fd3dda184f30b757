/**
   One string of the harp: a chain, the key it belongs to, and its damper.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_HARP_STRING_H
#define HOOKE_CORE_HARP_STRING_H

#include "core/chain.h"
#include "core/exciter.h"
#include "core/patch.h"

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
  Chain chain;
  const ChainKernel* kernel; /**< What steps it */
  void* memory;              /**< Memory for `capacity` masses, the caller's */
  uint32_t capacity;         /**< Most masses it can have */
  uint32_t key;              /**< MIDI note number */
  double rate_hz;            /**< Steps per second [Hz] */
  double given;              /**< Motion that its plucks gave it: √ω times an amplitude */
  double f0_hz;              /**< Pitch it has or is gliding to [Hz] */
  double a1;                 /**< (ω0 h)² of its fundamental */
  double headroom;           /**< Of its coefficients, see tuning_headroom() */
  double loudest;            /**< Largest displacement seen since it was last plucked */
  uint32_t n_choked;         /**< Frames in which it has been choked */
  uint32_t n_strung;         /**< Masses that it was strung with; a bend may have left it fewer */
  uint32_t n_until_doze;     /**< Frames until it is next looked at, see harp_string_pass() */
  bool is_awake;             /**< Whether it moves */
  Damper damper;
} HarpString;

/** The pitch of a key [Hz], with a bend in semitones. */
double harp_string_pitch_hz(const Patch* patch, uint32_t key, double bend_semitones);

/**
   The most masses that a key's string can have at a rate, whatever the patch, down to `lowest_hz`
   for A4, bent or not; at most CHAIN_MAX_MASSES, 0 if it can never sound.
*/
uint32_t harp_string_capacity(double rate_hz, uint32_t key, double lowest_hz);

/** Lay a string at rest over `memory`, chain_size(capacity) bytes, aligned to CHAIN_ALIGNMENT.
 */
void harp_string_init(
    HarpString* string, double rate_hz, uint32_t key, void* memory, uint32_t capacity);

/** Silence a string and set all its masses to exact zeros. */
void harp_string_sleep(HarpString* string);

/**
   Pluck a string.  From rest it is strung anew, with the largest stable number of masses up to the
   patch's; while it rings the pluck adds to its motion, its damper lifts, the coefficients take
   `n_glide` frames, and if a bend has left it few of its masses it has them again.  A string whose
   pitch is at or above Nyquist stays silent.
*/
void harp_string_pluck(
    HarpString* string, const Patch* patch, double bend_semitones, Pluck pluck, uint32_t n_glide);

/**
   Bring a ringing string to the patch, bend and damper in `n_glide` frames, its motion kept.  Where
   that would pass its limit stiffness and true partials give way (tuning_fit()); where they would
   have to by far, the motion is moved onto fewer masses (core/remesh.h).  A pitch that cannot be
   had at all chokes it.
*/
void harp_string_retune(
    HarpString* string, const Patch* patch, double bend_semitones, Damper damper, uint32_t n_glide);

/** Frames that it can be run until harp_string_pass() must be told. */
uint32_t harp_string_stretch(const HarpString* string);

/**
   After `n_frames`, at most its stretch: when it is due, put the string to sleep if it has died
   away to −120 dB of its loudest, or has been choked for a while; else see that its numbers suit
   it.
*/
void harp_string_pass(HarpString* string, uint32_t n_frames);

#endif
