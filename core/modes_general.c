#include "core/modes_general.h"

#include "core/modes_lapack.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* One row of the edges, to be sorted. */
typedef struct {
  double largest;
  uint32_t row;
} RowSize;

static int compare_rows(const void* left, const void* right) {
  const double p = ((const RowSize*)left)->largest;
  const double q = ((const RowSize*)right)->largest;
  return p > q ? -1 : p < q;
}

/* Large rows first: with that and columns pivoted, QR is accurate row by row. */
static Status sort_rows(const double* edges, uint32_t m, uint32_t n, double* sorted) {
  RowSize* const size = calloc(m, sizeof(RowSize));
  if (!size) {
    return STATUS_NO_MEMORY;
  }
  for (uint32_t e = 0; e < m; ++e) {
    size[e].row = e;
    for (uint32_t j = 0; j < n; ++j) {
      size[e].largest = fmax(size[e].largest, fabs(edges[e + (size_t)j * m]));
    }
  }
  qsort(size, m, sizeof(RowSize), compare_rows);
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t e = 0; e < m; ++e) {
      sorted[e + (size_t)j * m] = edges[size[e].row + (size_t)j * m];
    }
  }
  free(size);
  return STATUS_OK;
}

/* R of the edges with its columns in the order `column`, from 1; in the upper triangle of `edges`,
 * m × n. */
static Status factor_edges(const Frame* frame, int m, double* edges, int* column) {
  const int n = (int)frame->n;
  const int n_work = 64 * (n + 1);
  double* const unsorted = malloc((size_t)m * frame->n * sizeof(double));
  double* const work = malloc(((size_t)n_work + frame->n) * sizeof(double));
  Status status = unsorted && work ? STATUS_OK : STATUS_NO_MEMORY;
  if (!status) {
    frame_fill_edges(frame, (uint32_t)m, unsorted);
    status = sort_rows(unsorted, (uint32_t)m, frame->n, edges);
  }
  if (!status) {
    int info = 0;
    memset(column, 0, frame->n * sizeof(int));
    dgeqp3_(&m, &n, edges, &m, column, work, work + n, &n_work, &info);
    status = info ? STATUS_NO_CONVERGENCE : STATUS_OK;
  }
  free(unsorted);
  free(work);
  return status;
}

/* [0 R; −Rᵀ −(Ẑ + h K̂)], 2n × 2n, columns of the frame's matrices in R's order. */
static Status fill_state(const Frame* frame, double step_s, double* state) {
  const size_t n = frame->n;
  const size_t m = frame_count_edges(frame);
  double* const edges = malloc((m * n + 2 * n * n) * sizeof(double));
  int* const column = malloc(n * sizeof(int));
  Status status = edges && column ? STATUS_OK : STATUS_NO_MEMORY;
  if (!status) {
    status = factor_edges(frame, (int)m, edges, column);
  }
  if (!status) {
    double* const stiffness = edges + m * n;
    double* const damping = stiffness + n * n;
    frame_fill_stiffness(frame, stiffness);
    frame_fill_damping(frame, damping);
    memset(state, 0, 4 * n * n * sizeof(double));
    for (size_t j = 0; j < n; ++j) {
      for (size_t i = 0; i < n; ++i) {
        const size_t from = (size_t)(column[i] - 1) + (size_t)(column[j] - 1) * n;
        const double r = i <= j ? edges[i + j * m] : 0.0;
        state[i + (n + j) * 2 * n] = r;
        state[n + j + i * 2 * n] = -r;
        state[n + i + (n + j) * 2 * n] = -(damping[from] + step_s * stiffness[from]);
      }
    }
  }
  free(edges);
  free(column);
  return status;
}

static double frobenius(const double* matrix, size_t n_values) {
  double sum = 0.0;
  for (size_t i = 0; i < n_values; ++i) {
    sum += matrix[i] * matrix[i];
  }
  return sqrt(sum);
}

Status general_solve(const Frame* frame, double step_s, double complex* values, double* error) {
  if (frame->n > GENERAL_MOST) {
    return STATUS_NO_MEMORY;
  }
  const size_t order = 2 * (size_t)frame->n;
  const int n = (int)order;
  const int n_work = 64 * n;
  const int one = 1;
  double unused = 0.0;
  double* const state = malloc(order * order * sizeof(double));
  double* const work = malloc((2 * order + (size_t)n_work) * sizeof(double));
  Status status = state && work ? fill_state(frame, step_s, state) : STATUS_NO_MEMORY;
  if (!status) {
    int info = 0;
    *error = DBL_EPSILON * frobenius(state, order * order);
    dgeev_("N", "N", &n, state, &n, work, work + n, &unused, &one, &unused, &one, work + 2 * n,
           &n_work, &info);
    status = info ? STATUS_NO_CONVERGENCE : STATUS_OK;
  }
  for (size_t k = 0; k < order && !status; ++k) {
    values[k] = CMPLX(work[k], work[order + k]);
  }
  free(state);
  free(work);
  return status;
}
