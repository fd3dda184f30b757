/**
   The eigenvalues of a network whose damping is not proportional, by dgeev.

   With R triangular, RᵀR = K̂, and the state (R y, y'), A is similar to

       [0  R; −Rᵀ  −Ẑ],

   whose entries are frequencies where A has their squares, and which is normal but for Ẑ: half as
   many digits are lost to a wide range of stiffnesses as in A itself.  Half of those come back when
   each value w is had anew from its vector y, as a root of

       w² yᵀy + w yᵀẐy + yᵀK̂y = 0

   with the forms summed link by link: the matrices are symmetric, so y's error enters squared.

   No error is estimated; what all values together must be, det K̂ = Π w and tr K̂⁻¹Ẑ = −Σ 1/w, tells
   whether the small ones and their decays survived.

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_GENERAL_H
#define HOOKE_CORE_ANALYSIS_MODES_GENERAL_H

#include "core/analysis/modes_frame.h"
#include "core/base/status.h"

#include <complex.h>

/** Masses beyond which a dense matrix of twice the order is out of the question. */
#define GENERAL_MOST 8192

/** What is known of all the values together. */
typedef struct {
  double log_det;       /**< ln det K̂ = 2 Σ ln ω */
  double inverse_trace; /**< tr K̂⁻¹Ẑ = Σ c/ω² */
} GeneralCheck;

/** The checks of n modes without dampers; see symmetric_solve(). */
GeneralCheck general_check(uint32_t n, const double* omega, const double* damping);

/**
   Find all w for which  w² I + w (Ẑ + step_s K̂) + K̂  is singular: with step_s = 0 the analog
   eigenvalues, else (z − 1)/h for the poles z with that step.

   @param step_s       [s], ≥ 0
   @param[out] values  w [1/s], 2n
   @param check        Of the modes without dampers
   @return STATUS_OK; STATUS_ILL_SCALED where one check fails by more than a thousandth;
   STATUS_NO_CONVERGENCE; STATUS_NO_MEMORY (also for more than GENERAL_MOST)
*/
Status general_solve(const Frame* frame, double step_s, GeneralCheck check, double complex* values);

/** A value w anew from its shape y, of n; as it was if the shape has no say, as where two meet. */
double complex general_polish(const Frame* frame,
                              double step_s,
                              const double complex* y,
                              double complex w);

#endif
