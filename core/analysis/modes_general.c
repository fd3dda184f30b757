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

/* The share by which a check may fail: where small values are lost, it fails by all of itself. */
static const double MOST_ERROR = 1e-3;

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

/* [0 R; −Rᵀ −(Ẑ + h K̂)], 2n × 2n, with the masses in R's order, `column` from 1. */
static Status fill_state(const Frame* frame, double step_s, double* state, int* column) {
  const size_t n = frame->n;
  const size_t m = frame_count_edges(frame);
  double* const edges = malloc((m * n + 2 * n * n) * sizeof(double));
  Status status = edges ? factor_edges(frame, (int)m, edges, column) : STATUS_NO_MEMORY;
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
  return status;
}

/* What dgeev works on and gives; order 2n. */
typedef struct {
  int n;
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
  const size_t order = 2 * (size_t)frame->n;
  const size_t n_work = 64 * order;
  *problem = (Problem){
      .n = (int)order,
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
  const int* const n = &problem->n;
  const int one = 1;
  double unused = 0.0;
  int info = 0;
  dgeev_("N", "V", n, problem->state, n, problem->re, problem->im, &unused, &one, problem->vectors,
         n, problem->work, &problem->n_work, &info);
  return info ? STATUS_NO_CONVERGENCE : STATUS_OK;
}

/* The shape of the k-th value, in the frame's order: the lower half of its vector, which is w y. */
static void take_shape(const Problem* problem, uint32_t n, size_t k) {
  const size_t order = (size_t)problem->n;
  const double* const re = problem->vectors + k * order + n;
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
  for (size_t k = 0; k < (size_t)problem->n; ++k) {
    take_shape(problem, frame->n, k);
    values[k] =
        general_polish(frame, step_s, problem->y, complex_of(problem->re[k], problem->im[k]));
    if (problem->im[k] > 0.0) {
      values[k + 1] = conj(values[k]);
      ++k;
    }
  }
}

static bool is_met(GeneralCheck check, double step_s, uint32_t n, const double complex* values) {
  double log_det = 0.0;
  double inverse_trace = step_s * n;
  for (size_t k = 0; k < 2 * (size_t)n; ++k) {
    log_det += log(cabs(values[k]));
    inverse_trace += creal(1.0 / values[k]);
  }
  return fabs(log_det - check.log_det) <= MOST_ERROR &&
         fabs(inverse_trace + check.inverse_trace) <= MOST_ERROR * check.inverse_trace;
}

GeneralCheck general_check(uint32_t n, const double* omega, const double* damping) {
  GeneralCheck check = {0};
  for (uint32_t k = 0; k < n; ++k) {
    check.log_det += 2.0 * log(omega[k]);
    check.inverse_trace += damping[k] / omega[k] / omega[k];
  }
  return check;
}

Status
general_solve(const Frame* frame, double step_s, GeneralCheck check, double complex* values) {
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
    status = is_met(check, step_s, frame->n, values) ? STATUS_OK : STATUS_ILL_SCALED;
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
