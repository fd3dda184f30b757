#include "core/analysis/modes_check.h"

#include "core/analysis/modes_drift.h"
#include "core/analysis/modes_lapack.h"
#include "core/analysis/modes_symmetric.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The share by which a check may fail: where small values are lost, it fails by all of itself. */
static const double MOST_ERROR = 1e-3;

/* What is known of a network without its dampers. */
typedef struct {
  const Frame* frame;
  double* omega;   /* n */
  double* damping; /* n */
  double* shapes;  /* n × n; NULL where nothing that drifts is slowed down */
  double* slowing; /* The eigenvectors of D, n_free × n_free */
  double* space;   /* 2 n */
} Parts;

static bool is_slowed(const Frame* frame) {
  return frame->n_free > frame->n_adrift;
}

static void parts_clear(Parts* parts) {
  free(parts->omega);
  free(parts->shapes);
  free(parts->slowing);
}

static bool parts_init(Parts* parts, const Frame* frame) {
  const size_t n = frame->n;
  const size_t f = frame->n_free;
  *parts = (Parts){.frame = frame, .omega = malloc(4 * n * sizeof(double))};
  bool has_room = parts->omega;
  if (has_room) {
    parts->damping = parts->omega + n;
    parts->space = parts->omega + 2 * n;
  }
  if (has_room && is_slowed(frame)) {
    parts->shapes = malloc(n * n * sizeof(double));
    parts->slowing = malloc(f * f * sizeof(double));
    has_room = parts->shapes && parts->slowing;
  }
  return has_room;
}

/* The eigenvalues and vectors of D. */
static Status solve_slowing(Parts* parts, double* rate) {
  const int n = (int)parts->frame->n_free;
  const int n_work = 64 * (n + 1);
  int info = 0;
  double* const work = malloc((size_t)n_work * sizeof(double));
  if (!work) {
    return STATUS_NO_MEMORY;
  }
  drift_fill_damping(parts->frame, parts->slowing);
  dsyev_("V", "L", &n, parts->slowing, &n, rate, work, &n_work, &info);
  free(work);
  memset(rate, 0, parts->frame->n_adrift * sizeof(double));
  for (uint32_t j = parts->frame->n_adrift; j < parts->frame->n_free; ++j) {
    if (!(rate[j] > 0.0)) {
      return STATUS_ILL_SCALED;
    }
  }
  return info ? STATUS_NO_CONVERGENCE : STATUS_OK;
}

/* share becomes −D⁻¹ of itself, where D is not 0; `space` has n_free. */
static void give_way(const Parts* parts, const double* rate, double* share, double* space) {
  const size_t f = parts->frame->n_free;
  memset(space, 0, f * sizeof(double));
  for (size_t j = parts->frame->n_adrift; j < f; ++j) {
    const double* const vector = parts->slowing + j * f;
    double sum = 0.0;
    for (size_t p = 0; p < f; ++p) {
      sum += vector[p] * share[p];
    }
    for (size_t p = 0; p < f; ++p) {
      space[p] -= sum / rate[j] * vector[p];
    }
  }
  memcpy(share, space, f * sizeof(double));
}

/* What the dampers do to the k-th mode while the free parts follow them. */
static double damping_of(const Parts* parts, const double* rate, uint32_t k) {
  const Frame* const frame = parts->frame;
  double* const share = parts->space;
  double* const y = parts->shapes + (size_t)frame->n * k;
  double* const drag = parts->space + frame->n;
  memset(drag, 0, frame->n * sizeof(double));
  frame_add_drag(frame, y, drag);
  drift_shares(frame, drag, share);
  give_way(parts, rate, share, drag);
  drift_add(frame, share, y);
  return frame_damping(frame, y);
}

static void sum_up(const Parts* parts, Check* check) {
  const uint32_t n_free = parts->frame->n_free;
  for (uint32_t j = parts->frame->n_adrift; j < n_free; ++j) {
    check->log_det += log(check->rate[j]);
    check->inverse_trace += 1.0 / check->rate[j];
  }
  for (uint32_t k = n_free; k < parts->frame->n; ++k) {
    const double omega = parts->omega[k];
    const double damping = parts->shapes ? damping_of(parts, check->rate, k) : parts->damping[k];
    check->log_det += 2.0 * log(omega);
    check->inverse_trace += damping / omega / omega;
  }
}

Status check_find(const Frame* frame, Check* check) {
  Parts parts;
  *check = (Check){.rate = calloc(frame->n_free + (size_t)1, sizeof(double))};
  Status status = parts_init(&parts, frame) && check->rate ? STATUS_OK : STATUS_NO_MEMORY;
  status =
      status ? status : symmetric_solve(frame, frame->n, parts.omega, parts.damping, parts.shapes);
  if (!status && is_slowed(frame)) {
    status = solve_slowing(&parts, check->rate);
  }
  if (!status) {
    sum_up(&parts, check);
  } else {
    check_clear(check);
  }
  parts_clear(&parts);
  return status;
}

void check_clear(Check* check) {
  free(check->rate);
  *check = (Check){0};
}

bool check_is_met(const Check* check,
                  const Frame* frame,
                  double step_s,
                  const double complex* values) {
  double log_det = 0.0;
  double inverse_trace = step_s * (frame->n - frame->n_free);
  for (size_t k = 0; k < 2 * (size_t)frame->n; ++k) {
    if (values[k] != 0.0) {
      log_det += log(cabs(values[k]));
      inverse_trace += creal(1.0 / values[k]);
    }
  }
  return fabs(log_det - check->log_det) <= MOST_ERROR &&
         fabs(inverse_trace + check->inverse_trace) <= MOST_ERROR * check->inverse_trace;
}
