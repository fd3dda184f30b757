/**
   A network's matrices, symmetric and mostly zero, and their Cholesky factors, in an order that
   fills little (core/analysis/modes_order.h).

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_SPARSE_H
#define HOOKE_CORE_ANALYSIS_MODES_SPARSE_H

#include "core/analysis/modes_frame.h"
#include "core/analysis/modes_order.h"
#include "core/base/status.h"

#include <stddef.h>
#include <stdint.h>

typedef struct {
  Order order;
  double* value;   /**< Lower triangle, where order.row says */
  double* sum;     /**< The column that is factored, n */
  size_t* at;      /**< Of each column, what acts next, n */
  uint32_t* first; /**< Of each row the columns that act on it next, n */
  uint32_t* next;
} Sparse;

/** @return STATUS_OK, or STATUS_NO_MEMORY with nothing to be cleared */
Status sparse_init(Sparse* sparse, const Frame* frame);
void sparse_clear(Sparse* sparse);

/** Fill the matrix with  one I + damping Ẑ + stiffness K̂. */
void sparse_fill(Sparse* sparse, const Frame* frame, double one, double damping, double stiffness);

/** Add to a mass's place on the diagonal as much again, or 1 where it is 0. */
void sparse_tie(Sparse* sparse, uint32_t mass);

/** Replace the matrix by its Cholesky factor; STATUS_ILL_SCALED where it is not positive definite.
 */
Status sparse_factor(Sparse* sparse);

/** With the factor, solve in place for n_vectors vectors in the frame's order; `space` has n. */
void sparse_solve(const Sparse* sparse, uint32_t n_vectors, double* vectors, double* space);

#endif
