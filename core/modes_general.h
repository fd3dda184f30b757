/**
   The eigenvalues of a network whose damping is not proportional, by dgeev.

   With R triangular, RᵀR = K̂, and the state (R y, y'), A is similar to

       [0  R; −Rᵀ  −Ẑ],

   whose entries are frequencies where A has their squares, and which is normal but for Ẑ: half as
   many digits are lost to a wide range of stiffnesses as in A itself.

   Part of core/modes.
*/
#ifndef HOOKE_CORE_MODES_GENERAL_H
#define HOOKE_CORE_MODES_GENERAL_H

#include "core/modes_frame.h"
#include "core/status.h"

#include <complex.h>

/** Masses beyond which a dense matrix of twice the order is out of the question. */
#define GENERAL_MOST 8192

/**
   Find all w for which  w² I + w (Ẑ + step_s K̂) + K̂  is singular: with step_s = 0 the analog
   eigenvalues, else (z − 1)/h for the poles z with that step.

   @param step_s       [s], ≥ 0
   @param[out] values  w [1/s], 2n
   @param[out] error   About how far rounding may have moved a value [1/s]
   @return STATUS_OK, STATUS_NO_CONVERGENCE or STATUS_NO_MEMORY (also for more than GENERAL_MOST)
*/
Status general_solve(const Frame* frame, double step_s, double complex* values, double* error);

#endif
