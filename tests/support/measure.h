/** What a sound is, measured from its samples alone: nothing here knows how they were made. */
#ifndef HOOKE_TESTS_SUPPORT_MEASURE_H
#define HOOKE_TESTS_SUPPORT_MEASURE_H

#include "core/string/pole.h"

#include <stdbool.h>
#include <stddef.h>

/** A frequency in cents above another; negative below. */
double measure_cents(double f_hz, double reference_hz);

/**
   Fit a damped sinusoid to the narrow band around `near` of a sound that decays.

   The sound is brought down by near.f0_hz, and weighed by Kaiser windows that slide along it.  A
   window passes a damped sinusoid as it is, but for a factor, and stops the other partials by more
   than 110 dB if they are 0.7 f0 away or more; so the phase and the logarithm of what is passed are
   straight lines, whose slopes are the frequency and the decay. The lines are fitted with the power
   as the weight.

   @param samples  `n` of them, of the decay alone: from after the attack
   @param near     About what is expected; its τ only says how much of the sound is worth looking at
   @param[out] tone  f0 and τ
   @return false if the sound is too short (16 periods are needed), silent, or not finite
*/
bool measure_tone(const float* samples, size_t n, double rate_hz, Tone near, Tone* tone);

/** As measure_tone(), of one partial among others: the windows are as long as `spacing_hz` asks,
 * the distance to the next partial on either side, rather than f0. */
bool measure_partial(
    const float* samples, size_t n, double rate_hz, Tone near, double spacing_hz, Tone* tone);

/** Amplitude of a steady sinusoid about a frequency, in the middle of `n` samples: under a Hann
 * window, which lets pass what is 2 rate/n away or less. */
double measure_near(const float* samples, size_t n, double rate_hz, double f_hz);

/** Largest magnitude of `n` samples; NaN if any is not finite. */
double measure_peak(const float* samples, size_t n);

/** Root of the mean square of `n` samples. */
double measure_rms(const float* samples, size_t n);

#endif
