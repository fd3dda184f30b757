/**
   What the player sets of the strings themselves, whatever they are played with and read by: the
   part of every instrument's patch that a voice is strung and tuned with.

   Every value must be in its range and a number: who fills a patch in clamps it.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_STRING_PATCH_H
#define HOOKE_CORE_VOICE_STRING_PATCH_H

#include "core/string/tuning.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct {
  double damping_per_s; /**< 1/τ of the fundamental at A4 [1/s], > 0 */
  double tracking;      /**< Damping of a note is damping · 2^(tracking (note − 69)/12) */
  double loss; /**< Share of the fundamental's damping that sits between the masses, 0 to 1 */
  double loss_tracking; /**< That of a note is loss · 2^(loss_tracking (note − 69)/12), at most 1 */
  double inharmonicity;          /**< B, ≥ 0; 0: perfectly flexible */
  double inharmonicity_tracking; /**< The same of B, which it takes to 0.1 at most */
  Partials partials;             /**< How true strings are to the ideal one */
  double release_s; /**< τ once the key is up [s], > 0; a damper never makes a string ring longer */
  double release_tracking; /**< That of a note is release_s · 2^(−release_tracking (note − 69)/12),
                              which it takes to 5 ms at least */
  double tension;          /**< Cents that a string is sharp by at TENSION_AMPLITUDE, ≥ 0 */
  double tuning_hz;        /**< A4 [Hz], > 0 */
  uint32_t max_masses;     /**< Most masses of a string, ≥ 1 */
} StringPatch;

/** Whether what rings has the same coefficients under both: all but the masses are the same. */
bool string_patch_rings_alike(const StringPatch* a, const StringPatch* b);

/** Pitch of a note `semitones` above A4 [Hz]. */
double string_patch_pitch_hz(const StringPatch* patch, double semitones);

/**
   What a string is to be with nothing on it.

   @param semitones  Of the note that it is damped and stiff as, above A4
   @param f0_hz      Pitch that it is to have [Hz]
*/
TuningTarget
string_patch_target(const StringPatch* patch, double rate_hz, double semitones, double f0_hz);

/** What a damper leaves a string of a note `semitones` above A4: τ [s], > 0. */
double string_patch_release_s(const StringPatch* patch, double semitones);

#endif
