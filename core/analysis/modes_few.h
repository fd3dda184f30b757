/**
   The lowest of many modes whose damping is not proportional.

   By subspace iteration: the state (y, y') is brought nearer to its slow part by

       A⁻¹ (f, g) = (−K̂⁻¹ (g + Ẑ f) − h f,  f)

   with the factor of K̂ (core/analysis/modes_sparse.h), kept orthonormal in energy, and A⁻¹ is
   looked at on that subspace only, where it is small and dense; the values are had anew from their
   shapes (core/analysis/modes_general.h).

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_FEW_H
#define HOOKE_CORE_ANALYSIS_MODES_FEW_H

#include "core/analysis/modes_frame.h"
#include "core/base/status.h"

#include <complex.h>
#include <stdbool.h>
#include <stdint.h>

/** Whether so few are wanted, of those that do not drift, that it pays. */
bool few_is_worth_it(const Frame* frame, uint32_t n_wanted);

/**
   Find the lowest w but 0, by modulus, for which  w² I + w (Ẑ + step_s K̂) + K̂  is singular.

   @param frame        Where nothing slows down what drifts
   @param n_wanted     For which few_is_worth_it()
   @param[out] values  w [1/s], the upper ones of conjugate pairs, rising in modulus, n_wanted
   @return STATUS_OK; STATUS_NO_SUCH_MODE where one so low is real, which has no pair to be told by;
   STATUS_NO_CONVERGENCE; STATUS_ILL_SCALED; STATUS_NO_MEMORY
*/
Status few_solve(const Frame* frame, double step_s, uint32_t n_wanted, double complex* values);

#endif
