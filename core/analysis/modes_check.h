/**
   What all eigenvalues of a network are together, from the modes without dampers: no error is
   estimated by those who find them, and this tells whether the small ones and their decays
   survived.

   With ω, φ of the modes that do not drift, U of those that do (core/analysis/modes_drift.h) and
   D = Uᵀ Ẑ U, what slows these down:

       Π w = Π ω² det D,    −Σ 1/w = Σ c/ω² + tr D⁻¹ + h (n − n_free)

   over all w but 0, and only over the D of what is slowed down at all.  c = yᵀẐy, where
   y = φ − U D⁻¹ Uᵀ Ẑ φ: at rest a free part follows its dampers.

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_CHECK_H
#define HOOKE_CORE_ANALYSIS_MODES_CHECK_H

#include "core/analysis/modes_frame.h"
#include "core/base/status.h"

#include <complex.h>
#include <stdbool.h>

typedef struct {
  double log_det;       /**< ln Π w */
  double inverse_trace; /**< −Σ 1/w, with a step of 0 [s] */
  double* rate;         /**< The eigenvalues of D, rising [1/s], n_free */
} Check;

/** @return STATUS_OK, or, with nothing to be cleared, what symmetric_solve() returns, or
 * STATUS_ILL_SCALED */
Status check_find(const Frame* frame, Check* check);
void check_clear(Check* check);

/** Whether the 2n values of a frame and a step are these, to a thousandth. */
bool check_is_met(const Check* check,
                  const Frame* frame,
                  double step_s,
                  const double complex* values);

#endif
