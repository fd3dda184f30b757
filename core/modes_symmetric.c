#include "core/modes_symmetric.h"

#include "core/modes_lapack.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Singular values of the edges, falling, and their right vectors in `shapes`, n × n. */
static Status jacobi(const Frame* frame, double* omega, double* shapes) {
  const int n = (int)frame->n;
  const int m = (int)frame_count_edges(frame);
  const int n_work = 2 * m + 2 * n * n + 6 * n + 7;
  const int one = 1;
  double unused = 0.0;
  int info = 0;
  double* const edges = malloc((size_t)m * frame->n * sizeof(double));
  double* const work = malloc((size_t)n_work * sizeof(double));
  int* const iwork = malloc(((size_t)m + 3 * (size_t)n) * sizeof(int));
  Status status = edges && work && iwork ? STATUS_OK : STATUS_NO_MEMORY;
  if (!status) {
    frame_fill_edges(frame, (uint32_t)m, edges);
    dgejsv_("F", "N", "V", "N", "N", "N", &m, &n, edges, &m, omega, &unused, &one, shapes, &n, work,
            &n_work, iwork, &info);
    status = info ? STATUS_NO_CONVERGENCE : STATUS_OK;
    for (int k = 0; k < n; ++k) {
      omega[k] *= work[0] / work[1];
    }
  }
  free(edges);
  free(work);
  free(iwork);
  return status;
}

/* The Rayleigh quotients of a shape, link by link. */
static void judge_shape(const Frame* frame, const double* y, double* omega, double* damping) {
  double square = 0.0;
  for (uint32_t i = 0; i < frame->n; ++i) {
    square += y[i] * y[i];
  }
  *damping = frame_damping(frame, y) / square;
  (void)omega;
}

Status symmetric_solve(
    const Frame* frame, uint32_t n_wanted, double* omega, double* damping, double* shapes) {
  const size_t n = frame->n;
  double* const all = malloc((n * n + n) * sizeof(double));
  double* const values = all ? all + n * n : NULL;
  Status status = all ? jacobi(frame, values, all) : STATUS_NO_MEMORY;
  for (uint32_t k = 0; k < n_wanted && !status; ++k) {
    const double* const y = all + n * (n - 1 - k);
    omega[k] = values[n - 1 - k];
    judge_shape(frame, y, &omega[k], &damping[k]);
    if (shapes) {
      memcpy(shapes + n * k, y, n * sizeof(double));
    }
  }
  free(all);
  return status;
}
