/**
   A gentle limiter for both sides of an output, so that no sum of strings leaves it above full
   scale.

   It follows the larger side: at once upwards, slowly downwards.  What it follows stays below
   LIMITER_KNEE: then nothing is touched, bit by bit.  Above, the gain is such that what is followed
   would be bent over towards 1 along a hyperbolic tangent; so the gain is never a step, both sides
   keep their balance, and there is no delay.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_BASE_LIMITER_H
#define HOOKE_CORE_BASE_LIMITER_H

#include "core/base/line.h"

#include <stdbool.h>
#include <stdint.h>

/** Where it begins, −1.9 dB below full scale. */
#define LIMITER_KNEE 0.8

/** Zero is one that is off. */
typedef struct {
  double rate_hz;
  double followed; /**< What it follows, ≥ 0 */
  Line amount;     /**< 0: off, 1: on */
} Limiter;

/** Off. @param rate_hz  Frames per second [Hz], > 0 */
void limiter_init(Limiter* limiter, double rate_hz);

/** Turn it on or off in `n_frames`; 0: at once. */
void limiter_turn(Limiter* limiter, bool is_on, uint32_t n_frames);

/** Limit `n_frames` of both sides in place; where it is off, nothing is done. */
void limiter_run(Limiter* limiter, uint32_t n_frames, float* left, float* right);

#endif
