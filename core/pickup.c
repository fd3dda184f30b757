#include "core/pickup.h"

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
