#include "core/analysis/modes_symmetric.h"

#include "core/analysis/modes_drift.h"
#include "core/analysis/modes_lapack.h"
#include "core/analysis/modes_sparse.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Vectors that are iterated beside those that are wanted, and rounds: each takes off the ratio of
 * the first frequency left out to the last wanted, to the fourth. */
enum { MORE_VECTORS = 8, MOST_ROUNDS = 1000 };

/* Below this, changes of ω are rounding once they do not halve any more. */
static const double NEARLY = 1e-11;

/* What LAPACK is to allow for in a matrix, its JOBA: rows and columns of unlike size, or columns
 * only, which saves a search that takes the square of the rows. */
static const char UNLIKE_ROWS[] = "F";
static const char UNLIKE_COLUMNS[] = "C";

/* Singular values of `matrix`, m × n with m ≥ n, destroyed, falling, and their right vectors in
 * `right`, n × n. */
static Status jacobi(const char* kind,
                     uint32_t m_rows,
                     uint32_t n_columns,
                     double* matrix,
                     double* value,
                     double* right) {
  const int m = (int)m_rows;
  const int n = (int)n_columns;
  const int n_work = 2 * m + 70 * n + 7;
  const int one = 1;
  double unused = 0.0;
  int info = 0;
  double* const work = malloc((size_t)n_work * sizeof(double));
  int* const iwork = malloc(((size_t)m + 3 * (size_t)n) * sizeof(int));
  Status status = work && iwork ? STATUS_OK : STATUS_NO_MEMORY;
  if (!status) {
    dgejsv_(kind, "N", "V", "N", "N", "N", &m, &n, matrix, &m, value, &unused, &one, right, &n,
            work, &n_work, iwork, &info);
    status = info ? STATUS_NO_CONVERGENCE : STATUS_OK;
    for (int k = 0; k < n; ++k) {
      value[k] *= work[0] / work[1];
    }
  }
  free(work);
  free(iwork);
  return status;
}

/* Beneath the edges, n_edges of m rows, the shapes of what drifts, so long that they sound higher
 * than all else: B has no frequency of 0 then, and the others are what they were. */
static void add_drift(const Frame* frame, uint32_t n_edges, uint32_t m, double* edges) {
  double largest = 0.0;
  for (size_t e = 0; e < (size_t)m * frame->n; ++e) {
    largest = fmax(largest, fabs(edges[e]));
  }
  const double length = largest > 0.0 ? 2.0 * largest * sqrt(2.0 * n_edges) : 1.0;
  for (uint32_t i = 0; i < frame->n; ++i) {
    if (frame->part[i] != FRAME_GROUND) {
      edges[n_edges + frame->part[i] + (size_t)i * m] =
          length * frame->root[i] / frame->part_root[frame->part[i]];
    }
  }
}

/* All shapes, n × n, and their ω, falling; what drifts comes first, with an ω that is none. */
static Status solve_all(const Frame* frame, double* omega, double* shapes) {
  const uint32_t n_edges = frame_count_edges(frame);
  const uint32_t m = n_edges + frame->n_free;
  double* const edges = malloc((size_t)m * frame->n * sizeof(double));
  Status status = edges ? STATUS_OK : STATUS_NO_MEMORY;
  if (!status) {
    frame_fill_edges(frame, m, edges);
    add_drift(frame, n_edges, m, edges);
    status = jacobi(UNLIKE_ROWS, m, frame->n, edges, omega, shapes);
  }
  free(edges);
  return status;
}

/* What is iterated: n_vectors vectors of n. */
typedef struct {
  const Frame* frame;
  uint32_t n_vectors;
  uint32_t n_edges;
  double* vectors;   /* n × n_vectors */
  double* turned;    /* n × n_vectors */
  double* stretches; /* B times the vectors, n_edges × n_vectors */
  double* right;     /* n_vectors × n_vectors */
  double* omega;     /* n_vectors, falling */
  double* before;
} Subspace;

static Status subspace_init(Subspace* sub, const Frame* frame, uint32_t n_vectors) {
  const size_t n = frame->n;
  const size_t p = n_vectors;
  const size_t n_edges = frame_count_edges(frame);
  double* const space = malloc((2 * n * p + n_edges * p + p * p + 2 * p) * sizeof(double));
  *sub = (Subspace){.frame = frame, .n_vectors = n_vectors, .n_edges = (uint32_t)n_edges};
  if (!space) {
    return STATUS_NO_MEMORY;
  }
  sub->vectors = space;
  sub->turned = sub->vectors + n * p;
  sub->stretches = sub->turned + n * p;
  sub->right = sub->stretches + n_edges * p;
  sub->omega = sub->right + p * p;
  sub->before = sub->omega + p;
  return STATUS_OK;
}

/* Any numbers that no shape is likely to be orthogonal to. */
static void scatter(Subspace* sub) {
  uint32_t state = 1;
  for (size_t i = 0; i < (size_t)sub->frame->n * sub->n_vectors; ++i) {
    state = 1664525U * state + 1013904223U;
    sub->vectors[i] = (double)(state >> 8) * 0x1p-23 - 1.0;
  }
}

static double dot(uint32_t n, const double* a, const double* b) {
  double sum = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/* Gram and Schmidt's, modified, twice. */
static void orthonormalise(Subspace* sub) {
  const uint32_t n = sub->frame->n;
  for (uint32_t k = 0; k < sub->n_vectors; ++k) {
    double* const y = sub->vectors + (size_t)n * k;
    for (int pass = 0; pass < 2; ++pass) {
      const double length = sqrt(dot(n, y, y));
      for (uint32_t i = 0; i < n; ++i) {
        y[i] /= length;
      }
      for (uint32_t j = 0; j < k; ++j) {
        const double* const other = sub->vectors + (size_t)n * j;
        const double share = dot(n, y, other);
        for (uint32_t i = 0; i < n; ++i) {
          y[i] -= share * other[i];
        }
      }
    }
    const double length = sqrt(dot(n, y, y));
    for (uint32_t i = 0; i < n; ++i) {
      y[i] /= length;
    }
  }
}

/* Turn the vectors within their subspace into the shapes of B on it. */
static Status turn(Subspace* sub) {
  const uint32_t n = sub->frame->n;
  const uint32_t p = sub->n_vectors;
  for (uint32_t k = 0; k < p; ++k) {
    frame_stretch_edges(sub->frame, sub->vectors + (size_t)n * k,
                        sub->stretches + (size_t)sub->n_edges * k);
  }
  const Status status =
      jacobi(UNLIKE_COLUMNS, sub->n_edges, p, sub->stretches, sub->omega, sub->right);
  memset(sub->turned, 0, (size_t)n * p * sizeof(double));
  for (uint32_t k = 0; k < p && !status; ++k) {
    for (uint32_t j = 0; j < p; ++j) {
      const double share = sub->right[j + (size_t)p * k];
      for (uint32_t i = 0; i < n; ++i) {
        sub->turned[i + (size_t)n * k] += share * sub->vectors[i + (size_t)n * j];
      }
    }
  }
  double* const turned = sub->turned;
  sub->turned = sub->vectors;
  sub->vectors = turned;
  return status;
}

/* The largest change of the lowest n_wanted ω, relative. */
static double change(const Subspace* sub, uint32_t n_wanted) {
  double largest = 0.0;
  for (uint32_t k = sub->n_vectors - n_wanted; k < sub->n_vectors; ++k) {
    largest = fmax(largest, fabs(sub->before[k] / sub->omega[k] - 1.0));
  }
  return largest;
}

static Status iterate(Subspace* sub, const Sparse* sparse, uint32_t n_wanted, double* space) {
  double last = HUGE_VAL;
  scatter(sub);
  for (int round = 0; round < MOST_ROUNDS; ++round) {
    drift_solve(sparse, sub->frame, sub->n_vectors, sub->vectors, space);
    orthonormalise(sub);
    memcpy(sub->before, sub->omega, sub->n_vectors * sizeof(double));
    const Status status = turn(sub);
    const double moved = round > 0 ? change(sub, n_wanted) : HUGE_VAL;
    if (status || moved <= 2.0 * DBL_EPSILON || (moved < NEARLY && !(moved < 0.5 * last))) {
      return status;
    }
    last = moved;
  }
  return STATUS_NO_CONVERGENCE;
}

/* The lowest ω and shapes of many masses, falling, n_wanted of the subspace's. */
static Status solve_few(Subspace* sub, uint32_t n_wanted) {
  Sparse sparse;
  double* const space = malloc(sub->frame->n * sizeof(double));
  Status status = space ? sparse_init(&sparse, sub->frame) : STATUS_NO_MEMORY;
  if (!status) {
    status = drift_factor(&sparse, sub->frame);
    status = status ? status : iterate(sub, &sparse, n_wanted, space);
    sparse_clear(&sparse);
  }
  free(space);
  return status;
}

/* What drifts: ω = 0. */
static Status
take_drift(const Frame* frame, uint32_t n_wanted, double* omega, double* damping, double* shapes) {
  double* const all = malloc((frame->n_free + (size_t)1) * sizeof(double));
  if (!all) {
    return STATUS_NO_MEMORY;
  }
  drift_damping(frame, all);
  memcpy(damping, all, n_wanted * sizeof(double));
  memset(omega, 0, n_wanted * sizeof(double));
  for (uint32_t k = 0; k < n_wanted && shapes; ++k) {
    drift_shape(frame, k, shapes + (size_t)frame->n * k);
  }
  free(all);
  return STATUS_OK;
}

/* What does not: at most n − n_free are wanted. */
static Status
solve_held(const Frame* frame, uint32_t n_wanted, double* omega, double* damping, double* shapes) {
  const size_t n = frame->n;
  const size_t n_guessed = n_wanted + n_wanted / 2 + (size_t)MORE_VECTORS;
  const bool is_few = 2 * n_guessed < n - frame->n_free;
  const uint32_t n_vectors = is_few ? (uint32_t)n_guessed : frame->n;
  Subspace sub = {0};
  Status status = STATUS_NO_MEMORY;
  if (is_few || frame->n <= SYMMETRIC_MOST) {
    status = subspace_init(&sub, frame, n_vectors);
  }
  double* const space = sub.vectors < sub.turned ? sub.vectors : sub.turned;
  if (!status) {
    status = is_few ? solve_few(&sub, n_wanted) : solve_all(frame, sub.omega, sub.vectors);
  }
  for (uint32_t k = 0; k < n_wanted && !status; ++k) {
    const double* const y = sub.vectors + n * (n_vectors - 1 - k);
    omega[k] = sub.omega[n_vectors - 1 - k];
    damping[k] = frame_damping(frame, y) / dot(frame->n, y, y);
    if (shapes) {
      memcpy(shapes + n * k, y, n * sizeof(double));
    }
  }
  free(space);
  return status;
}

Status symmetric_solve(
    const Frame* frame, uint32_t n_wanted, double* omega, double* damping, double* shapes) {
  const uint32_t n_free = n_wanted < frame->n_free ? n_wanted : frame->n_free;
  Status status = take_drift(frame, n_free, omega, damping, shapes);
  if (!status && n_wanted > n_free) {
    status = solve_held(frame, n_wanted - n_free, omega + n_free, damping + n_free,
                        shapes ? shapes + (size_t)frame->n * n_free : NULL);
  }
  return status;
}
