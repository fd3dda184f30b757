#include "core/analysis/modes_few.h"

#include "core/analysis/modes_drift.h"
#include "core/analysis/modes_general.h"
#include "core/analysis/modes_lapack.h"
#include "core/analysis/modes_sparse.h"
#include "core/base/complex_of.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pairs iterated beside those that are wanted, and rounds: each takes off the ratio of the last
 * wanted value to the first left out. */
enum { MORE_PAIRS = 8, MOST_ROUNDS = 500 };

/* Below this, changes of a value are rounding once they do not halve any more. */
static const double NEARLY = 1e-12;

/* p states (y, y') and their stretches B y. */
typedef struct {
  double* y;       /* n × p */
  double* v;       /* n × p, y' */
  double* stretch; /* n_edges × p */
} States;

/* A subspace near the slow one, its image under A⁻¹, and A⁻¹ on it. */
typedef struct {
  const Frame* frame;
  double step_s;
  uint32_t p;
  uint32_t n_edges;
  States basis;          /* Orthonormal in energy */
  States image;          /* A⁻¹ times the basis */
  double* drag;          /* n */
  double* small;         /* A⁻¹ on the basis, p × p, destroyed */
  double* vectors;       /* p × p */
  double* re;            /* p */
  double* im;            /* p */
  double* work;          /* 64 p */
  double complex* shape; /* n */
  double complex* found; /* p: upper and real values, rising */
  double complex* before;
} Slow;

static uint32_t n_pairs_for(uint32_t n_wanted) {
  return n_wanted + n_wanted / 2 + (uint32_t)MORE_PAIRS;
}

/* Room for p states, beginning at `space`; where it ends. */
static double* states_init(States* states, size_t n, size_t n_edges, size_t p, double* space) {
  *states = (States){.y = space, .v = space + n * p, .stretch = space + 2 * n * p};
  return states->stretch + n_edges * p;
}

static Status slow_init(Slow* slow, const Frame* frame, double step_s, uint32_t n_wanted) {
  const size_t n = frame->n;
  const size_t p = 2 * (size_t)n_pairs_for(n_wanted);
  const size_t m = frame_count_edges(frame);
  double* const space = calloc(2 * (2 * n + m) * p + n + 2 * p * p + 66 * p, sizeof(double));
  double complex* const numbers = malloc((n + 2 * p) * sizeof(double complex));
  *slow = (Slow){.frame = frame, .step_s = step_s, .p = (uint32_t)p, .n_edges = (uint32_t)m};
  if (!space || !numbers) {
    free(space);
    free(numbers);
    return STATUS_NO_MEMORY;
  }
  double* const second = states_init(&slow->basis, n, m, p, space);
  slow->drag = states_init(&slow->image, n, m, p, second);
  slow->small = slow->drag + n;
  slow->vectors = slow->small + p * p;
  slow->re = slow->vectors + p * p;
  slow->im = slow->re + p;
  slow->work = slow->im + p;
  slow->shape = numbers;
  slow->found = numbers + n;
  slow->before = slow->found + p;
  return STATUS_OK;
}

static void slow_clear(Slow* slow) {
  free(slow->basis.y < slow->image.y ? slow->basis.y : slow->image.y);
  free(slow->shape);
}

/* Any numbers that no shape is likely to be orthogonal to. */
static void scatter(size_t n, double* values, uint32_t seed) {
  uint32_t state = seed;
  for (size_t i = 0; i < n; ++i) {
    state = 1664525U * state + 1013904223U;
    values[i] = (double)(state >> 8) * 0x1p-23 - 1.0;
  }
}

/* The image of the basis; `space` has n. */
static void slow_down(Slow* slow, const Sparse* sparse, double* space) {
  const size_t n = slow->frame->n;
  for (size_t k = 0; k < slow->p; ++k) {
    const double* const f = slow->basis.y + n * k;
    const double* const g = slow->basis.v + n * k;
    double* const y = slow->image.y + n * k;
    double* const v = slow->image.v + n * k;
    memcpy(v, f, n * sizeof(double));
    memcpy(slow->drag, g, n * sizeof(double));
    frame_add_drag(slow->frame, f, slow->drag);
    drift_solve(sparse, slow->frame, 1, slow->drag, space);
    for (size_t i = 0; i < n; ++i) {
      y[i] = -slow->drag[i] - slow->step_s * f[i];
    }
    frame_stretch_edges(slow->frame, y, slow->image.stretch + slow->n_edges * k);
  }
}

/* In four sums, which a processor can take at once. */
static double dot(size_t n, const double* a, const double* b) {
  double sum[4] = {0.0};
  size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    for (size_t lane = 0; lane < 4; ++lane) {
      sum[lane] += a[i + lane] * b[i + lane];
    }
  }
  for (; i < n; ++i) {
    sum[0] += a[i] * b[i];
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

static void add(size_t n, double share, const double* a, double* sum) {
  for (size_t i = 0; i < n; ++i) {
    sum[i] += share * a[i];
  }
}

static void scale(size_t n, double factor, double* a) {
  for (size_t i = 0; i < n; ++i) {
    a[i] *= factor;
  }
}

/* Gram and Schmidt's, modified, twice, by the energy: |B y|² + |v|². */
static void orthonormalise(const Slow* slow, const States* states) {
  const size_t n = slow->frame->n;
  const size_t m = slow->n_edges;
  for (size_t k = 0; k < slow->p; ++k) {
    double* const y = states->y + n * k;
    double* const v = states->v + n * k;
    double* const stretch = states->stretch + m * k;
    for (int pass = 0; pass < 3; ++pass) {
      for (size_t j = 0; j < k && pass > 0; ++j) {
        const double share =
            -dot(m, stretch, states->stretch + m * j) - dot(n, v, states->v + n * j);
        add(n, share, states->y + n * j, y);
        add(n, share, states->v + n * j, v);
        add(m, share, states->stretch + m * j, stretch);
      }
      const double length = sqrt(dot(m, stretch, stretch) + dot(n, v, v));
      scale(n, 1.0 / length, y);
      scale(n, 1.0 / length, v);
      scale(m, 1.0 / length, stretch);
    }
    frame_stretch_edges(slow->frame, y, stretch);
  }
}

/* A⁻¹ on the basis.  (A itself would show values of no mode in between: its slow values lie inside
 * of the others, those of A⁻¹ outside.) */
static void project(const Slow* slow) {
  const size_t n = slow->frame->n;
  const size_t m = slow->n_edges;
  for (size_t j = 0; j < slow->p; ++j) {
    for (size_t i = 0; i < slow->p; ++i) {
      slow->small[i + j * slow->p] =
          dot(m, slow->basis.stretch + m * i, slow->image.stretch + m * j) +
          dot(n, slow->basis.v + n * i, slow->image.v + n * j);
    }
  }
}

/* The shape of the k-th value on the subspace, from the image, where it is the purer. */
static void take_shape(Slow* slow, size_t k) {
  const size_t n = slow->frame->n;
  const double* const re = slow->vectors + k * slow->p;
  memset(slow->shape, 0, n * sizeof(double complex));
  for (size_t j = 0; j < slow->p; ++j) {
    const double complex share = complex_of(re[j], slow->im[k] != 0.0 ? re[slow->p + j] : 0.0);
    const double* const y = slow->image.y + n * j;
    for (size_t i = 0; i < n; ++i) {
      slow->shape[i] += share * y[i];
    }
  }
}

static int compare_sizes(const void* left, const void* right) {
  const double p = cabs(*(const double complex*)left);
  const double q = cabs(*(const double complex*)right);
  return p < q ? -1 : p > q;
}

/* The lowest n_wanted values on the subspace, upper ones and real ones, each anew from its shape;
 * n_found tells how many there are.  The upper one of a pair of 1/w has the lower w. */
static Status look(Slow* slow, uint32_t n_wanted, uint32_t* n_found) {
  const int p = (int)slow->p;
  const int n_work = 64 * p;
  const int one = 1;
  double unused = 0.0;
  int info = 0;
  project(slow);
  dgeev_("N", "V", &p, slow->small, &p, slow->re, slow->im, &unused, &one, slow->vectors, &p,
         slow->work, &n_work, &info);
  if (info) {
    return STATUS_NO_CONVERGENCE;
  }
  *n_found = 0;
  for (size_t k = 0; k < slow->p; ++k) {
    const double size = hypot(slow->re[k], slow->im[k]);
    uint32_t n_slower = 0;
    for (size_t j = 0; j < slow->p; ++j) {
      n_slower += slow->im[j] >= 0.0 && hypot(slow->re[j], slow->im[j]) > size ? 1 : 0;
    }
    if (slow->im[k] >= 0.0 && n_slower < n_wanted && *n_found < n_wanted) {
      const double complex lower = 1.0 / complex_of(slow->re[k], slow->im[k]);
      take_shape(slow, k);
      slow->found[(*n_found)++] =
          conj(general_polish(slow->frame, slow->step_s, slow->shape, lower));
    }
  }
  qsort(slow->found, *n_found, sizeof(double complex), compare_sizes);
  return *n_found < n_wanted ? STATUS_NO_CONVERGENCE : STATUS_OK;
}

static Status iterate(Slow* slow, const Sparse* sparse, uint32_t n_wanted, double* space) {
  double last = HUGE_VAL;
  scatter((size_t)slow->frame->n * slow->p, slow->basis.y, 1);
  scatter((size_t)slow->frame->n * slow->p, slow->basis.v, 2);
  drift_remove(slow->frame, slow->p, slow->basis.y, space);
  drift_remove(slow->frame, slow->p, slow->basis.v, space);
  for (size_t k = 0; k < slow->p; ++k) {
    frame_stretch_edges(slow->frame, slow->basis.y + slow->frame->n * k,
                        slow->basis.stretch + slow->n_edges * k);
  }
  orthonormalise(slow, &slow->basis);
  for (int round = 0; round < MOST_ROUNDS; ++round) {
    uint32_t n_found = 0;
    slow_down(slow, sparse, space);
    memcpy(slow->before, slow->found, n_wanted * sizeof(double complex));
    const Status status = look(slow, n_wanted, &n_found);
    if (status) {
      return status;
    }
    double moved = round > 0 ? 0.0 : HUGE_VAL;
    for (uint32_t k = 0; k < n_wanted && round > 0; ++k) {
      moved = fmax(moved, cabs(slow->before[k] / slow->found[k] - 1.0));
    }
    if (moved <= 4.0 * DBL_EPSILON || (moved < NEARLY && !(moved < 0.5 * last))) {
      return STATUS_OK;
    }
    last = moved;
    const States image = slow->image;
    slow->image = slow->basis;
    slow->basis = image;
    orthonormalise(slow, &slow->basis);
  }
  return STATUS_NO_CONVERGENCE;
}

bool few_is_worth_it(const Frame* frame, uint32_t n_wanted) {
  return 4 * (uint64_t)n_pairs_for(n_wanted) < frame->n - frame->n_free;
}

Status few_solve(const Frame* frame, double step_s, uint32_t n_wanted, double complex* values) {
  Slow slow;
  Sparse sparse;
  double* const space = malloc(frame->n * sizeof(double));
  Status status = space ? slow_init(&slow, frame, step_s, n_wanted) : STATUS_NO_MEMORY;
  if (!status) {
    status = sparse_init(&sparse, frame);
    if (!status) {
      status = drift_factor(&sparse, frame);
      status = status ? status : iterate(&slow, &sparse, n_wanted, space);
      sparse_clear(&sparse);
    }
    for (uint32_t k = 0; k < n_wanted && !status; ++k) {
      values[k] = slow.found[k];
      status = cimag(values[k]) > 0.0 ? STATUS_OK : STATUS_NO_SUCH_MODE;
    }
    slow_clear(&slow);
  }
  free(space);
  return status;
}
