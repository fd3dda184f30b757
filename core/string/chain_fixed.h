/**
   Strings in fixed point: which coefficients they are stepped with, and how large the numbers
   are.

   Floats lose count.  A position rounded to 24 bits forgets where it came from, and what is
   forgotten is energy: a string that should ring for a minute dies a part in a hundred too soon or
   too late.  In fixed point x ← x + u and u ← u + (link − link before) are exact and could be run
   backwards; all that is rounded is a link, once, for both masses that it pulls.  So nothing
   drifts: what is left is a noise of less than half a number in each link, and a step costs what it
   does in floats.

   Dampers to the ground take from every mode alike.  They are left out of the loop: with
   ρ² = 1 − z0 and x[n] = gain ρⁿ X[n] the string X has none of them, and its modes

       g'_k = 1 − (1 − g_k)/ρ²,   a'_k = 2 − g'_k − (2 − a_k − g_k)/ρ

   are those of a string with coefficients of its own, but for a push of z0²/4 x to the outside.
   That is made up for in k1 by the fundamental's share, and the string is not taken into whole
   numbers where the partials would hear it.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_STRING_CHAIN_FIXED_H
#define HOOKE_CORE_STRING_CHAIN_FIXED_H

#include "core/string/chain_kernel.h"
#include "core/string/tuning.h"

#include <stdbool.h>
#include <stdint.h>

/** A string in fixed point. */
typedef struct {
  StringCoefs coefs; /**< Of X; without z0 */
  double fade;       /**< ρ */
  double gain;       /**< x/X, such that no number ever overflows */
  double noise;      /**< Of the rounded links over one time constant, relative to the motion */
} ChainFixed;

/**
   Design it for a still string with a motion of `sums`, in true units.

   @param[out] fixed  Untouched on failure
   @return false where it cannot be had: no motion, no damping, damped so much that its partials
   would shift by more than about 0.01 cent, or bending so negative that it hardly pulls back
*/
bool chain_fixed_design(StringCoefs coefs, uint32_t n_masses, ChainSums sums, ChainFixed* fixed);

#endif
