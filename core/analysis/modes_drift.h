/**
   What stretches no spring: a part that hangs on no ground, moved as a whole.

   With y = M^½ x the shape of a free part p is u_p = √m over it and 0 elsewhere, brought to length
   1.  These span all that K̂ makes nothing of.  Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_DRIFT_H
#define HOOKE_CORE_ANALYSIS_MODES_DRIFT_H

#include "core/analysis/modes_frame.h"
#include "core/analysis/modes_sparse.h"
#include "core/base/status.h"

#include <stdint.h>

/** Fill in u_p, n. */
void drift_shape(const Frame* frame, uint32_t p, double* y);

/** Fill in u_pᵀ Ẑ u_p of each free part [1/s], n_free. */
void drift_damping(const Frame* frame, double* damping);

/** Fill in Uᵀ Ẑ U, n_free × n_free, column-major. */
void drift_fill_damping(const Frame* frame, double* matrix);

/** Fill in Uᵀ y, n_free. */
void drift_shares(const Frame* frame, const double* y, double* share);

/** Add U times `share`, n_free. */
void drift_add(const Frame* frame, const double* share, double* y);

/** Take what drifts out of n_vectors vectors; `space` has n. */
void drift_remove(const Frame* frame, uint32_t n_vectors, double* vectors, double* space);

/**
   Fill in K̂, tied to the ground by one mass of each free part, and factor it.

   Of a load that does not push a free part as a whole, the ground bears nothing: what it solves is
   K̂ then, but for a drift.

   @return as sparse_factor()
*/
Status drift_factor(Sparse* sparse, const Frame* frame);

/** With that factor, the image under K̂⁻¹, of what does not drift; as sparse_solve(). */
void drift_solve(
    const Sparse* sparse, const Frame* frame, uint32_t n_vectors, double* vectors, double* space);

#endif
