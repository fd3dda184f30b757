/** Whether samples are numbers.  Thread: any; real-time safe. */
#ifndef HOOKE_CORE_BASE_FINITE_H
#define HOOKE_CORE_BASE_FINITE_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/** Whether none of `samples` is infinite or not a number. */
static inline bool finite_all(const float* samples, uint32_t n_frames) {
  unsigned n_other = 0;
  for (uint32_t n = 0; n < n_frames; ++n) {
    n_other |= (unsigned)!(fabsf(samples[n]) <= FLT_MAX);
  }
  return n_other == 0;
}

#endif
