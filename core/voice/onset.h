/**
   What hides a step in what is read of a string.

   A string that is pulled aside (core/excite/pluck.h) is there at once, and what rang before is
   gone at once.  Whoever reads it adds, from that frame on, what makes up for the difference: one
   mass (core/string/pole.h), as strongly damped as one that does not swing, set off from where the
   reading was, and as fast as that moved.  So what is heard goes on as it went and comes to what
   the string does in a millisecond or two, as though the pull had taken that long.

   Zero hides nothing.  Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_ONSET_H
#define HOOKE_CORE_VOICE_ONSET_H

#include "core/string/pole.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/** Its time constant [s]: after four of them a tenth is left. */
#define ONSET_S 0.0005

/** Below which nobody hears it. */
#define ONSET_LEAST 1e-9

typedef struct {
  double x; /**< What is to be added, in units of the reading */
  double u; /**< How fast that goes [per frame] */
} Onset;

/** Two poles at exp(−1/(ONSET_S rate)): 1 − g is their square, and a that of 1 less one of them. */
static inline Pole onset_pole(double rate_hz) {
  const double less = -expm1(-1.0 / (ONSET_S * rate_hz));
  return (Pole){less * less, less * (2.0 - less)};
}

/** The reading steps down by `step`, and from a `speed` per frame to none. */
static inline void onset_hide(Onset* onset, double step, double speed) {
  onset->x += step;
  onset->u += speed;
}

/** Whether it has nothing to hide. */
static inline bool onset_is_over(const Onset* onset) {
  return onset->x == 0.0 && onset->u == 0.0;
}

/** Add it to `n_frames` of a reading. */
static inline void onset_run(Onset* onset, Pole pole, uint32_t n_frames, float* out) {
  if (onset_is_over(onset)) {
    return;
  }
  for (uint32_t n = 0; n < n_frames; ++n) {
    onset->u -= pole.a * onset->x + pole.g * onset->u;
    onset->x += onset->u;
    out[n] += (float)onset->x;
    if (fabs(onset->x) < ONSET_LEAST && fabs(onset->u) < ONSET_LEAST) {
      *onset = (Onset){0};
      return;
    }
  }
}

#endif
