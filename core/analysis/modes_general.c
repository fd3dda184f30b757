#include "core/analysis/modes_general.h"

#include "core/analysis/modes_lapack.h"
#include "core/base/complex_of.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The share by which a value may be bettered: beyond it the shape is of another. */
static const double MOST_MOVE = 0.1;

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
 * m × n.  Its last n_free rows would be rounding. */
static Status factor_edges(const Frame* frame, int m, double* edges, int* column) {
  const int n = (int)frame->n;
  const int n_work = 64 * (n + 1);
  for (int j = 0; j < n && m == 0; ++j) {
    column[j] = j + 1;
  }
  if (m == 0) {
    return STATUS_OK;
  }
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

/* [0 R; −Rᵀ −(Ẑ + h K̂)], of order 2n − n_free, with the masses in R's order, `column` from 1. */
static Status fill_state(const Frame* frame, double step_s, double* state, int* column) {
  const size_t n = frame->n;
  const size_t r = n - frame->n_free;
  const size_t order = r + n;
  const size_t m = frame_count_edges(frame);
  double* const edges = malloc((m * n + 2 * n * n) * sizeof(double));
  Status status = edges ? factor_edges(frame, (int)m, edges, column) : STATUS_NO_MEMORY;
  if (!status) {
    double* const stiffness = edges + m * n;
    double* const damping = stiffness + n * n;
    frame_fill_stiffness(frame, stiffness);
    frame_fill_damping(frame, damping);
    memset(state, 0, order * order * sizeof(double));
    for (size_t j = 0; j < n; ++j) {
      for (size_t i = 0; i < r && i <= j; ++i) {
        state[i + (r + j) * order] = edges[i + j * m];
        state[r + j + i * order] = -edges[i + j * m];
      }
      for (size_t i = 0; i < n; ++i) {
        const size_t from = (size_t)(column[i] - 1) + (size_t)(column[j] - 1) * n;
        state[r + i + (r + j) * order] = -(damping[from] + step_s * stiffness[from]);
      }
    }
  }
  free(edges);
  return status;
}

/* What dgeev works on and gives. */
typedef struct {
  int order;
  double* state;
  double* vectors;
  double* re;
  double* im;
  double* work;
  int n_work;
  double complex* y;
  int* column;
} Problem;

static void problem_clear(Problem* problem) {
  free(problem->state);
  free(problem->y);
  free(problem->column);
}

static Status problem_init(Problem* problem, const Frame* frame, double step_s) {
  const size_t order = 2 * (size_t)frame->n - frame->n_free;
  const size_t n_work = 64 * order;
  *problem = (Problem){
      .order = (int)order,
      .state = malloc((2 * order * order + 2 * order + n_work) * sizeof(double)),
      .n_work = (int)n_work,
      .y = malloc(frame->n * sizeof(double complex)),
      .column = malloc(frame->n * sizeof(int)),
  };
  Status status = STATUS_NO_MEMORY;
  if (problem->state && problem->y && problem->column) {
    problem->vectors = problem->state + order * order;
    problem->re = problem->vectors + order * order;
    problem->im = problem->re + order;
    problem->work = problem->im + order;
    status = fill_state(frame, step_s, problem->state, problem->column);
  }
  if (status) {
    problem_clear(problem);
  }
  return status;
}

static Status call_lapack(const Problem* problem) {
  const int* const n = &problem->order;
  const int one = 1;
  double unused = 0.0;
  int info = 0;
  dgeev_("N", "V", n, problem->state, n, problem->re, problem->im, &unused, &one, problem->vectors,
         n, problem->work, &problem->n_work, &info);
  return info ? STATUS_NO_CONVERGENCE : STATUS_OK;
}

/* The shape of the k-th value, in the frame's order: the lower half of its vector, which is w y. */
static void take_shape(const Problem* problem, uint32_t n, size_t k) {
  const size_t order = (size_t)problem->order;
  const double* const re = problem->vectors + k * order + order - n;
  const double* const im = problem->im[k] > 0.0 ? re + order : NULL;
  for (uint32_t i = 0; i < n; ++i) {
    problem->y[problem->column[i] - 1] = complex_of(re[i], im ? im[i] : 0.0);
  }
}

/* The root of w² + c w + k that lies nearest. */
static double complex nearest_root(double complex c, double complex k, double complex w) {
  const double complex root = csqrt(c * c - 4.0 * k);
  const double complex sum = creal(conj(c) * root) < 0.0 ? c - root : c + root;
  const double complex larger = -0.5 * sum;
  const double complex smaller = -2.0 * k / sum;
  return cabs(larger - w) < cabs(smaller - w) ? larger : smaller;
}

static void
collect(const Problem* problem, const Frame* frame, double step_s, double complex* values) {
  for (size_t k = 0; k < (size_t)problem->order; ++k) {
    take_shape(problem, frame->n, k);
    values[k] =
        general_polish(frame, step_s, problem->y, complex_of(problem->re[k], problem->im[k]));
    if (problem->im[k] > 0.0) {
      values[k + 1] = conj(values[k]);
      ++k;
    }
  }
}

static int compare_sizes(const void* left, const void* right) {
  const double p = cabs(*(const double complex*)left);
  const double q = cabs(*(const double complex*)right);
  return p < q ? -1 : p > q;
}

/* What nothing holds and nothing slows down has two values of 0, one of them left out of the state;
 * the other came with its rounding. */
static Status take_zeros(const Problem* problem, const Frame* frame, double complex* values) {
  double above = 0.0;
  memset(values + problem->order, 0, frame->n_free * sizeof(double complex));
  if (frame->n_adrift > 0) {
    qsort(values, (size_t)problem->order, sizeof(double complex), compare_sizes);
  }
  for (uint32_t k = 0; k < frame->n_adrift; ++k) {
    above += cimag(values[k]);
    values[k] = 0.0;
  }
  /* Half of a pair is none of them. */
  return above == 0.0 ? STATUS_OK : STATUS_ILL_SCALED;
}

Status
general_solve(const Frame* frame, double step_s, const Check* check, double complex* values) {
  if (frame->n > GENERAL_MOST) {
    return STATUS_NO_MEMORY;
  }
  Problem problem;
  Status status = problem_init(&problem, frame, step_s);
  if (status) {
    return status;
  }
  status = call_lapack(&problem);
  if (!status) {
    collect(&problem, frame, step_s, values);
    status = take_zeros(&problem, frame, values);
  }
  if (!status && !check_is_met(check, frame, step_s, values)) {
    status = STATUS_ILL_SCALED;
  }
  problem_clear(&problem);
  return status;
}

double complex general_polish(const Frame* frame,
                              double step_s,
                              const double complex* y,
                              double complex w) {
  const FrameForms forms = frame_forms(frame, y);
  const double complex c = (forms.damping + step_s * forms.stiffness) / forms.inertia;
  const double complex k = forms.stiffness / forms.inertia;
  const double complex better = nearest_root(c, k, w);
  const bool is_of_its_kind = (cimag(better) > 0.0) == (cimag(w) > 0.0);
  return is_of_its_kind && cabs(better - w) <= MOST_MOVE * cabs(w) ? better : w;
}
