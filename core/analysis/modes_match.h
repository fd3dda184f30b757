/**
   Sorting eigenvalues into modes.  Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_MATCH_H
#define HOOKE_CORE_ANALYSIS_MODES_MATCH_H

#include "core/base/status.h"

#include <complex.h>
#include <stdint.h>

/**
   Put 2n eigenvalues of a real matrix into pairs: the conjugate ones, the upper first; a 0 each
   with what comes nearest to the rate at which it is slowed down; and the other real ones, the
   fastest with the slowest and so on inwards, which for damping in proportion to mass or to
   stiffness is how one mass has them; the slower first.

   @param n_free  How many pairs have a 0
   @param rate    At which these are slowed down, rising, 0: not at all [1/s]; n_free
   @param values  2n; reordered, so that 2k and 2k + 1 are the k-th pair
   @return STATUS_OK or STATUS_NO_MEMORY
*/
Status match_pairs(uint32_t n, uint32_t n_free, const double* rate, double complex* values);

/**
   Put the true poles into the order of those that one-mass maps predict, each to the nearest that
   is left: conjugate pairs first, those of a 0 last, then what is left.

   @param expected  n pairs
   @param values    2n; reordered into n pairs
   @return STATUS_OK or STATUS_NO_MEMORY
*/
Status match_poles(uint32_t n, const double complex* expected, double complex* values);

#endif
