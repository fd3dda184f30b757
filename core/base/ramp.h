/**
   A value that moves in a straight line to its goal, so that no change is heard as a step.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_BASE_RAMP_H
#define HOOKE_CORE_BASE_RAMP_H

#include <stdint.h>

/** Zero is a ramp that stands still at 0. */
typedef struct {
  float value;     /**< Now */
  float goal;      /**< Where it ends, exactly */
  float change;    /**< Per frame */
  uint32_t n_left; /**< Frames until it is there */
} Ramp;

/** Stand still at `value`. */
void ramp_init(Ramp* ramp, float value);

/** Move to `goal` in `n_frames`, from wherever it is; 0: at once. */
void ramp_to(Ramp* ramp, float goal, uint32_t n_frames);

/** Go one frame on. */
static inline float ramp_next(Ramp* ramp) {
  if (ramp->n_left > 0) {
    ramp->value = --ramp->n_left > 0 ? ramp->value + ramp->change : ramp->goal;
  }
  return ramp->value;
}

/** Go `n_frames` on. */
void ramp_skip(Ramp* ramp, uint32_t n_frames);

/** Its next `n_frames` values. */
void ramp_fill(Ramp* ramp, uint32_t n_frames, float* out);

#endif
