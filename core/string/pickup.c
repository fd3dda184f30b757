#include "core/string/pickup.h"

#include "core/base/maths.h"

#include <math.h>

/* What is bright is louder at the same fundamental: these bring a pluck as the panel has it at
 * first back to the loudness of its displacement. */
static const double VELOCITY_GAIN = 0.24;
static const double FORCE_GAIN = 0.18;

ChainTap pickup_tap(uint32_t n_masses, double place) {
  const double x = place * (n_masses + 1.0);
  const uint32_t wall = n_masses + 1;
  const uint32_t i = x < wall ? (uint32_t)x : n_masses;
  const double share = x - i;
  /* Points 0 and N + 1 are walls: they have no mass to read, and no weight. */
  return (ChainTap){
      .mass = {i > 0 ? i - 1 : 0, i < n_masses ? i : n_masses - 1},
      .weight = {i > 0 ? (float)(1.0 - share) : 0.0f, i < n_masses ? (float)share : 0.0f},
  };
}

ChainTap pickup_tap_of_type(PickupType type, uint32_t n_masses, double place, double angle1) {
  ChainTap tap = pickup_tap(n_masses, place);
  switch (type) {
  case PICKUP_DISPLACEMENT:
    break;
  case PICKUP_VELOCITY: {
    const double gain = VELOCITY_GAIN * 0.5 / sin(0.5 * fmin(angle1, PI));
    tap.weight[0] = (float)(gain * (double)tap.weight[0]);
    tap.weight[1] = (float)(gain * (double)tap.weight[1]);
    break;
  }
  case PICKUP_FORCE: {
    tap = (ChainTap){.weight = {(float)(FORCE_GAIN * (n_masses + 1.0) / PI), 0.0f}};
    break;
  }
  case PICKUP_MAGNET:
    tap.is_velocity = true;
    break;
  }
  return tap;
}

void pickup_differentiate(float* samples, uint32_t n_frames, float* before) {
  for (uint32_t n = 0; n < n_frames; ++n) {
    const float now = samples[n];
    samples[n] = now - *before;
    *before = now;
  }
}
