/**
   A network's matrices as narrow bands, by the ordering of Cuthill and McKee reversed.

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_BAND_H
#define HOOKE_CORE_ANALYSIS_MODES_BAND_H

#include "core/analysis/modes_frame.h"
#include "core/base/status.h"

#include <stdint.h>

typedef struct {
  uint32_t n;
  uint32_t width;  /**< Off-diagonals below the diagonal */
  uint32_t* place; /**< Of each mass in the band's order, n */
  double* value;   /**< Lower triangle, LAPACK's: (width + 1) × n */
} Band;

/** @return STATUS_OK, or STATUS_NO_MEMORY with nothing to be cleared */
Status band_init(Band* band, const Frame* frame);
void band_clear(Band* band);

/** Fill the band with  one I + damping Ẑ + stiffness K̂. */
void band_fill(Band* band, const Frame* frame, double one, double damping, double stiffness);

/** Replace the band by its Cholesky factor; STATUS_ILL_SCALED where it is not positive definite. */
Status band_factor(Band* band);

/** With the factor, solve in place for n_vectors vectors in the frame's order; `space` has n. */
void band_solve(const Band* band, uint32_t n_vectors, double* vectors, double* space);

/** The least positive h at which  4 I − 2h Ẑ − h² K̂  is singular [s]; see core/analysis/modes.h. */
double band_largest_step(Band* band, const Frame* frame, double* space);

#endif
