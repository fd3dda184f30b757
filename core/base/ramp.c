#include "core/base/ramp.h"

void ramp_init(Ramp* ramp, float value) {
  *ramp = (Ramp){.value = value, .goal = value};
}

void ramp_to(Ramp* ramp, float goal, uint32_t n_frames) {
  if (n_frames == 0) {
    ramp_init(ramp, goal);
    return;
  }
  ramp->goal = goal;
  ramp->change = (goal - ramp->value) / (float)n_frames;
  ramp->n_left = n_frames;
}

void ramp_skip(Ramp* ramp, uint32_t n_frames) {
  for (uint32_t n = 0; n < n_frames && ramp->n_left > 0; ++n) {
    (void)ramp_next(ramp);
  }
}

void ramp_fill(Ramp* ramp, uint32_t n_frames, float* out) {
  uint32_t n = 0;
  for (; n < n_frames && ramp->n_left > 0; ++n) {
    out[n] = ramp_next(ramp);
  }
  const float still = ramp->value;
  for (; n < n_frames; ++n) {
    out[n] = still;
  }
}
