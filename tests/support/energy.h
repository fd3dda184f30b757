/**
   The energy of a string, straight from its equations, and steps of it in double.

   With L = tridiag(−1, 2, −1), K = k1 L + k2 L² + k3 L³ and Z = z0 I + z1 L the step of
   core/string/tuning.h is, with the difference backwards in the damper split into the one about the
   middle and a second difference,

       (I − Z/2)(x[n+1] − 2 x[n] + x[n−1]) = −K x[n] − Z (x[n+1] − x[n−1])/2.

   So its energy is

       H = ½ uᵀ(I − Z/2) u + ½ xᵀK (x − u),   H[n+1] − H[n] = −¼ wᵀZ w,   w = x[n+1] − x[n−1]:

   it never grows, whatever the dampers, and it is positive for every motion exactly where each mode
   has a > 0 and a + 2g < 4, which is where the string is stable.  Without dampers it is the
   scheme's own energy E, which in a damped string ripples by about g/(2 √a) of itself, twice a
   period: E is H and the ¼ uᵀZu that comes and goes.
*/
#ifndef HOOKE_TESTS_SUPPORT_ENERGY_H
#define HOOKE_TESTS_SUPPORT_ENERGY_H

#include "core/string/chain.h"
#include "core/string/tuning.h"

#include <stdint.h>

/** Positions and velocities; zero is at rest. */
typedef struct {
  uint32_t n;
  double x[CHAIN_MAX_MASSES];
  double u[CHAIN_MAX_MASSES];
} Motion;

/** What a chain does now. */
void motion_read(const Chain* chain, Motion* motion);

/** H of a motion. */
double motion_energy(const Motion* motion, StringCoefs coefs);

/** One step in double. */
void motion_step(Motion* motion, StringCoefs coefs);

#endif
