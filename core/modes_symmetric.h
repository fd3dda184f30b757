/**
   The modes without dampers: K̂ y = ω² y, and what the dampers do to each, c = yᵀ Ẑ y / yᵀy.

   All of them come from the singular values of B, BᵀB = K̂, by one-sided Jacobi rotations, which
   keep small ω beside large ones where eigenvalues of K̂ would lose them: B is a matrix of signs
   between two diagonal ones, so each ω is good to a few roundings of itself.  The lowest few of
   many come from K̂ as a band (core/modes_band.h).

   Part of core/modes.
*/
#ifndef HOOKE_CORE_MODES_SYMMETRIC_H
#define HOOKE_CORE_MODES_SYMMETRIC_H

#include "core/modes_frame.h"
#include "core/status.h"

#include <stdint.h>

/**
   @param frame        Of n masses, no part of it free
   @param n_wanted     How many, the lowest; 1 to n
   @param[out] omega   ω [rad/s], rising, n_wanted
   @param[out] damping c [1/s], n_wanted
   @param[out] shapes  y, orthonormal, n × n_wanted, column-major; NULL if not wanted
   @return STATUS_OK, STATUS_NO_CONVERGENCE, STATUS_ILL_SCALED or STATUS_NO_MEMORY
*/
Status symmetric_solve(
    const Frame* frame, uint32_t n_wanted, double* omega, double* damping, double* shapes);

#endif
