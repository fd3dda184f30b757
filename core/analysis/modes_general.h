/**
   The eigenvalues of a network whose damping is not proportional, by dgeev.

   With R triangular, RᵀR = K̂, and the state (R y, y'), A is similar to

       [0  R; −Rᵀ  −Ẑ],

   whose entries are frequencies where A has their squares, and which is normal but for Ẑ: half as
   many digits are lost to a wide range of stiffnesses as in A itself.  Half of those come back when
   each value w is had anew from its vector y, as a root of

       w² yᵀy + w yᵀẐy + yᵀK̂y = 0

   with the forms summed link by link: the matrices are symmetric, so y's error enters squared.

   Where parts hang on no ground R has as many rows less, whose values are 0.  No error is
   estimated: see core/analysis/modes_check.h.

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_GENERAL_H
#define HOOKE_CORE_ANALYSIS_MODES_GENERAL_H

#include "core/analysis/modes_check.h"
#include "core/analysis/modes_frame.h"
#include "core/base/status.h"

#include <complex.h>

/** Masses beyond which a dense matrix of twice the order is out of the question. */
#define GENERAL_MOST 8192

/**
   Find all w for which  w² I + w (Ẑ + step_s K̂) + K̂  is singular: with step_s = 0 the analog
   eigenvalues, else (z − 1)/h for the poles z with that step.

   @param step_s       [s], ≥ 0
   @param check        What they must be together
   @param[out] values  w [1/s], 2n, of which n_free + n_adrift are 0 exactly
   @return STATUS_OK; STATUS_ILL_SCALED where the check fails; STATUS_NO_CONVERGENCE;
   STATUS_NO_MEMORY (also for more than GENERAL_MOST)
*/
Status general_solve(const Frame* frame, double step_s, const Check* check, double complex* values);

/** A value w anew from its shape y, of n; as it was if the shape has no say, as where two meet. */
double complex general_polish(const Frame* frame,
                              double step_s,
                              const double complex* y,
                              double complex w);

#endif
