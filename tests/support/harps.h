/** Harps for the tests: how they are set, played and heard. */
#ifndef HOOKE_TESTS_SUPPORT_HARPS_H
#define HOOKE_TESTS_SUPPORT_HARPS_H

#include "core/harp/harp.h"

#include <stddef.h>
#include <stdint.h>

enum { HARPS_N_EXCITERS = 3, HARPS_N_SENSES = 3, HARPS_N_WAYS = 9 };

/** Name of an exciter and of a sense, for print. */
const char* harps_exciter(Exciter exciter);
const char* harps_pickup_type(PickupType sense);

/** All ports at their defaults, but for what plays and what is heard: the `way`-th of all nine. */
HarpPatch harps_patch(uint32_t way);

/** The same for what hands do: heard in one place, with a vibrato of 5 Hz. */
HarpPatch harps_touched_patch(uint32_t way);

/** A harp at rest with a patch; the test fails if there is none. */
Harp* harps_new(double rate_hz, const HarpPatch* patch);

/** Bring it to rest and give it another patch. */
void harps_restart(Harp* harp, const HarpPatch* patch);

/** Run it, in one call or in many, and keep both sides; NULL: not that one. */
void harps_run(Harp* harp, size_t n_frames, float* left, float* right);

/** Largest change from a sample to the next, from the one before the first on. */
double harps_largest_step(const float* samples, size_t n);

/** Pitch [Hz] and decay [s] of an open string, as the headers say. */
Tone harps_tone(const HarpPatch* patch, uint32_t key, double bend_semitones);

/** Those of a string as it is; the test fails unless it is awake and its coefficients stand still.
 */
Tone harps_string_tone(const HarpString* string);

#endif
