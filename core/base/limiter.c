#include "core/base/limiter.h"

#include <math.h>

/* Time in which what is followed falls to 1/e [s]. */
static const double RELEASE_S = 0.15;

void limiter_init(Limiter* limiter, double rate_hz) {
  *limiter = (Limiter){.rate_hz = rate_hz};
}

void limiter_turn(Limiter* limiter, bool is_on, uint32_t n_frames) {
  const double amount = is_on ? 1.0 : 0.0;
  if (amount != limiter->amount.goal || n_frames == 0) {
    line_to(&limiter->amount, amount, n_frames);
  }
}

static double gain_of(double followed) {
  const double room = 1.0 - LIMITER_KNEE;
  return followed > LIMITER_KNEE
             ? (LIMITER_KNEE + room * tanh((followed - LIMITER_KNEE) / room)) / followed
             : 1.0;
}

/* Whether all is below the knee. */
static bool is_low(const float* samples, uint32_t n_frames) {
  unsigned n_above = 0;
  for (uint32_t n = 0; n < n_frames; ++n) {
    n_above |= fabsf(samples[n]) > (float)LIMITER_KNEE;
  }
  return n_above == 0;
}

/* What is below the knee need not be followed. */
static bool
is_idle(const Limiter* limiter, uint32_t n_frames, const float* left, const float* right) {
  const bool is_off = limiter->amount.goal == 0.0 && limiter->amount.n_left == 0;
  const bool is_still = limiter->amount.n_left == 0 && limiter->followed <= LIMITER_KNEE;
  return is_off || (is_still && is_low(left, n_frames) && is_low(right, n_frames));
}

void limiter_run(Limiter* limiter, uint32_t n_frames, float* left, float* right) {
  if (is_idle(limiter, n_frames, left, right)) {
    limiter->followed = 0.0;
    return;
  }
  const double kept = exp(-1.0 / (RELEASE_S * limiter->rate_hz));
  for (uint32_t n = 0; n < n_frames; ++n) {
    const double loudest = fmax(fabs((double)left[n]), fabs((double)right[n]));
    const double amount = line_next(&limiter->amount);
    limiter->followed = fmax(loudest, kept * limiter->followed);
    /* Not 1 + amount (gain - 1), which loses the digits of a small gain. */
    const double gain = (1.0 - amount) + amount * gain_of(limiter->followed);
    left[n] = (float)(gain * (double)left[n]);
    right[n] = (float)(gain * (double)right[n]);
  }
}
