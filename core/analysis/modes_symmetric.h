/**
   The modes without dampers: K̂ y = ω² y, and what the dampers do to each, c = yᵀ Ẑ y / yᵀy.

   All of them come from the singular values of B, BᵀB = K̂, by one-sided Jacobi rotations, which
   keep small ω beside large ones where eigenvalues of K̂ would lose them: B is a matrix of signs
   between two diagonal ones, so each ω is good to a few roundings of itself ([D99]).  The lowest
   few of many come by subspace iteration with the factor of K̂ (core/analysis/modes_sparse.h), again
   as singular values of B on that subspace, whose error is the square of the shapes'.

   [D99] J. Demmel et al., "Computing the singular value decomposition with high relative accuracy",
   1999.

   What hangs on no ground has ω = 0 exactly, and comes first (core/analysis/modes_drift.h).

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_SYMMETRIC_H
#define HOOKE_CORE_ANALYSIS_MODES_SYMMETRIC_H

#include "core/analysis/modes_frame.h"
#include "core/base/status.h"

#include <stdint.h>

/** Masses beyond which a dense matrix is out of the question. */
#define SYMMETRIC_MOST 16384

/**
   @param frame        Of n masses
   @param n_wanted     How many, the lowest; 1 to n
   @param[out] omega   ω [rad/s], rising, n_wanted
   @param[out] damping c [1/s], n_wanted
   @param[out] shapes  y, orthonormal, n × n_wanted, column-major; NULL if not wanted
   @return STATUS_OK; STATUS_NO_CONVERGENCE; STATUS_ILL_SCALED (of few: where K̂ has no Cholesky
   factor to rounding); STATUS_NO_MEMORY (also for more than SYMMETRIC_MOST of which many are
   wanted)
*/
Status symmetric_solve(
    const Frame* frame, uint32_t n_wanted, double* omega, double* damping, double* shapes);

#endif
