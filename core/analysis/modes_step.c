#include "core/analysis/modes_step.h"

#include "core/analysis/modes_sparse.h"
#include "core/string/pole.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Rounds of inverse iteration after each step that is found stable. */
enum { ROUNDS = 2 };

/* How near to a bound that is known to rounding a step is tried. */
static const double NEAR = 8.0 * DBL_EPSILON;
static const double FARTHER = 8.0;

/* Where the largest step lies. */
typedef struct {
  const Frame* frame;
  Sparse sparse;
  double low;    /* Stable */
  double high;   /* Not stable, or a bound */
  double* y;     /* Near the shape that grows first, n */
  double* space; /* 4 n */
} Search;

/* Steps of single masses which have the largest diagonal entry, or the largest row: the network's
 * own lies between. */
static void bracket_step(const Frame* frame, double* space, double* low, double* high) {
  double* const k = space;
  double* const z = space + frame->n;
  double* const far_k = space + 2 * (size_t)frame->n;
  double* const far_z = space + 3 * (size_t)frame->n;
  memset(space, 0, 4 * (size_t)frame->n * sizeof(double));
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    const double root_a = frame->root[link.a];
    k[link.a] += link.k / root_a / root_a;
    z[link.a] += link.z / root_a / root_a;
    if (link.b != FRAME_GROUND) {
      const double root_b = frame->root[link.b];
      k[link.b] += link.k / root_b / root_b;
      z[link.b] += link.z / root_b / root_b;
      far_k[link.a] += link.k / root_a / root_b;
      far_k[link.b] += link.k / root_a / root_b;
      far_z[link.a] += link.z / root_a / root_b;
      far_z[link.b] += link.z / root_a / root_b;
    }
  }
  for (uint32_t l = 0; l < frame->n_levers; ++l) {
    const FrameLever lever = frame->lever[l];
    const FrameTerm* const term = frame->term + lever.first;
    double sum = 0.0;
    for (uint32_t i = 0; i < lever.n_terms; ++i) {
      sum += fabs(term[i].weight);
    }
    for (uint32_t i = 0; i < lever.n_terms; ++i) {
      const double weight = fabs(term[i].weight);
      k[term[i].mass] += lever.k * weight * weight;
      far_k[term[i].mass] += lever.k * weight * (sum - weight);
    }
  }
  *low = *high = HUGE_VAL;
  for (uint32_t i = 0; i < frame->n; ++i) {
    *high = fmin(*high, pole_largest_step_s(sqrt(k[i]), z[i]));
    *low = fmin(*low, pole_largest_step_s(sqrt(k[i] + far_k[i]), z[i] + far_z[i]));
  }
}

/* Any numbers that no shape is likely to be orthogonal to. */
static void scatter(const Search* search) {
  uint32_t state = 1;
  for (uint32_t i = 0; i < search->frame->n; ++i) {
    state = 1664525U * state + 1013904223U;
    search->y[i] = (double)(state >> 8) * 0x1p-23 - 1.0;
  }
}

static void normalise(const Search* search) {
  double largest = 0.0;
  double square = 0.0;
  for (uint32_t i = 0; i < search->frame->n; ++i) {
    largest = fmax(largest, fabs(search->y[i]));
  }
  for (uint32_t i = 0; i < search->frame->n; ++i) {
    search->y[i] /= largest;
    square += search->y[i] * search->y[i];
  }
  for (uint32_t i = 0; i < search->frame->n; ++i) {
    search->y[i] /= sqrt(square);
  }
}

/* Bend y towards the shape that grows first, with the factor of a stable step.  Any shape is one
 * mass whose own step is none too small. */
static double bound(const Search* search) {
  for (int round = 0; round < ROUNDS; ++round) {
    sparse_solve(&search->sparse, 1, search->y, search->space);
    normalise(search);
  }
  return pole_largest_step_s(sqrt(frame_stiffness(search->frame, search->y)),
                             frame_damping(search->frame, search->y));
}

static bool is_stable(Search* search, double step_s) {
  sparse_fill(&search->sparse, search->frame, 4.0, -2.0 * step_s, -step_s * step_s);
  return !sparse_factor(&search->sparse);
}

/* How much of what the bracket was, in its logarithm, is left to do. */
static void tell(const Search* search, double whole, const ModesWatch* watch) {
  const double left = log(search->high / search->low);
  if (watch) {
    watch->tell(watch->self, 1.0 - log1p(left / DBL_EPSILON) / log1p(whole / DBL_EPSILON));
  }
}

/* Halve what is left, or, as soon as bounds come close to each other, try just below: by as much as
 * the last two differ, and by more where that was too near. */
static void narrow(Search* search, const ModesWatch* watch) {
  const double whole = log(search->high / search->low);
  double last = search->high;
  double margin = 1.0;
  double step_s = sqrt(search->low) * sqrt(search->high);
  while (step_s > search->low && step_s < search->high) {
    if (is_stable(search, step_s)) {
      const double limit = bound(search);
      search->low = step_s;
      /* It may be off by its own roundings. */
      search->high = fmin(search->high, limit * (1.0 + NEAR));
      margin = fmax(NEAR, fabs(limit / last - 1.0));
      last = limit;
    } else {
      search->high = step_s;
      margin *= FARTHER;
    }
    const double middle = sqrt(search->low) * sqrt(search->high);
    const double near = fmin(search->high, last) * (1.0 - margin);
    step_s = near > middle && near < search->high ? near : middle;
    tell(search, whole, watch);
  }
}

Status step_find(const Frame* frame, const ModesWatch* watch, double* step_s) {
  double* const space = malloc(5 * (size_t)frame->n * sizeof(double));
  Search search = {.frame = frame, .y = space, .space = space ? space + frame->n : NULL};
  Status status = space ? sparse_init(&search.sparse, frame) : STATUS_NO_MEMORY;
  if (!status) {
    bracket_step(frame, search.space, &search.low, &search.high);
    scatter(&search);
    narrow(&search, watch);
    *step_s = search.low;
    sparse_clear(&search.sparse);
  }
  free(space);
  return status;
}
