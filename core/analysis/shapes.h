/**
   The modes of a network without dampers as shapes, and what its dampers do to each of them: all
   that is heard and pushed of a network at a few of its points.

   With K φ_k = ω_k² M φ_k and φ_jᵀ M φ_k = δ_jk, a force f at the point p moves

       x_i = Σ_k φ_k(i) q_k,   q̈_k + c_k q̇_k + ω_k² q_k = φ_k(p) f,   c_k = φ_kᵀ Z φ_k,

   exactly where Z is proportional (core/analysis/modes.h), and nearly so where dampers are weak.

   Thread: any.  Allocates; calls LAPACK; is not real-time safe.
*/
#ifndef HOOKE_CORE_ANALYSIS_SHAPES_H
#define HOOKE_CORE_ANALYSIS_SHAPES_H

#include "core/analysis/network.h"
#include "core/base/status.h"

#include <stdint.h>

/** Masses beyond which a dense matrix is out of the question. */
#define SHAPES_MOST 4096

typedef struct {
  uint32_t n;
  uint32_t* row;   /**< Of each point its mass, from 0; UINT32_MAX for a grounded one, n_points */
  double* omega;   /**< ω [rad/s], rising, n */
  double* damping; /**< c [1/s], n */
  double* shape;   /**< φ [kg^−½], n × n, column-major: a column a mode */
} Shapes;

/**
   Find all modes of a checked network.

   ω is good to some roundings of the highest ω² over ω²: to 1e-11 over three decades.

   @param[out] shapes  To be given to shapes_clear(); untouched on failure
   @return STATUS_OK; STATUS_BAD_ARGUMENT (not checked, or more than SHAPES_MOST masses);
   STATUS_NO_CONVERGENCE; STATUS_NO_MEMORY
*/
Status shapes_solve(const Network* network, Shapes* shapes);

/** Free what it holds and leave it without modes. */
void shapes_clear(Shapes* shapes);

/** φ_k at a point of the network; 0 where it is grounded. */
double shapes_at(const Shapes* shapes, uint32_t k, uint32_t point);

#endif
