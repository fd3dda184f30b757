#include "core/analysis/retune.h"

#include "core/analysis/modes.h"
#include "core/analysis/modes_frame.h"
#include "core/analysis/modes_lapack.h"
#include "core/analysis/modes_symmetric.h"
#include "core/base/complex_of.h"
#include "core/base/maths.h"

#include <complex.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Rounds of inverse iteration: it converges cubically, and a path step that needs more is too long.
 */
enum { MOST_ROUNDS = 30 };

/* How far two shapes may turn from one step of the path to the next: |cos| of the angle. */
static const double LEAST_LIKENESS = 0.9;

/* The shortest step of the path, of its whole length. */
static const double SHORTEST = 1e-6;

/* Below this, changes of p and q are rounding once they do not halve any more. */
static const double NEARLY = 1e-9;

/* The mode that is followed. */
typedef struct {
  const Frame* frame;
  double rate_hz;
  double* stiffness; /* K̂, n × n */
  double* damping;   /* Ẑ, n × n */
  double complex* y; /* Its shape, |y| = 1 */
  double p;
  double q;
} Path;

/* p and q with which the shape y solves its own equation for w. */
static bool fit(Path* path, double complex w, const double complex* y) {
  const FrameForms forms = frame_forms(path->frame, y);
  const double complex inertia = -w * w * forms.inertia;
  const double complex stiff = (1.0 + w / path->rate_hz) * forms.stiffness;
  const double complex damped = w * forms.damping;
  const double area = cimag(conj(stiff) * damped);
  path->p = cimag(conj(inertia) * damped) / area;
  path->q = cimag(conj(stiff) * inertia) / area;
  return isfinite(path->p) && isfinite(path->q);
}

/* Factor w² I + w q Ẑ + (1 + h w) p K̂ into `matrix`. */
static void factor(const Path* path, double complex w, double complex* matrix, int* pivot) {
  const int n = (int)path->frame->n;
  const double complex stiff = (1.0 + w / path->rate_hz) * path->p;
  const double complex damped = w * path->q;
  for (size_t i = 0; i < (size_t)n * (size_t)n; ++i) {
    matrix[i] = stiff * path->stiffness[i] + damped * path->damping[i];
  }
  for (size_t i = 0; i < (size_t)n; ++i) {
    matrix[i + i * (size_t)n] += w * w;
  }
  int info = 0;
  zgetrf_(&n, &n, matrix, &n, pivot, &info);
  for (size_t i = 0; i < (size_t)n; ++i) {
    /* The nearer to singular the better, but not altogether. */
    if (matrix[i + i * (size_t)n] == 0.0) {
      matrix[i + i * (size_t)n] = DBL_EPSILON * cabs(w * w);
    }
  }
}

static void normalise(uint32_t n, double complex* y) {
  double largest = 0.0;
  double square = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    largest = fmax(largest, cabs(y[i]));
  }
  for (uint32_t i = 0; i < n; ++i) {
    y[i] /= largest;
    square += creal(y[i] * conj(y[i]));
  }
  for (uint32_t i = 0; i < n; ++i) {
    y[i] /= sqrt(square);
  }
}

static double likeness(uint32_t n, const double complex* y, const double complex* other) {
  double complex product = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    product += conj(y[i]) * other[i];
  }
  return cabs(product);
}

/* Turn y into the shape of the mode that has w, beginning with the path's p and q; and these too.
 */
static bool
settle(Path* path, double complex w, double complex* y, double complex* matrix, int* pivot) {
  const int n = (int)path->frame->n;
  const int one = 1;
  double last = HUGE_VAL;
  for (int round = 0; round < MOST_ROUNDS; ++round) {
    const Path before = *path;
    int info = 0;
    factor(path, w, matrix, pivot);
    zgetrs_("N", &n, &one, matrix, &n, pivot, y, &n, &info);
    normalise(path->frame->n, y);
    if (!fit(path, w, y)) {
      return false;
    }
    const double change = fmax(fabs(path->p / before.p - 1.0), fabs(path->q / before.q - 1.0));
    if (change <= 4.0 * DBL_EPSILON || (change < NEARLY && !(change < 0.5 * last))) {
      return path->p > 0.0 && path->q > 0.0;
    }
    last = change;
  }
  return false;
}

static double complex wanted_w(double rate_hz, Tone tone, double share) {
  const double complex log_z =
      complex_of(-share / (tone.tau_s * rate_hz), 2.0 * PI * tone.f0_hz / rate_hz);
  return (cexp(log_z) - 1.0) * rate_hz;
}

/* Follow the mode from no damping to the wanted one, in steps that do not turn its shape much.
 * `first` is p without damping, `slope` the q of the light damping that makes the whole decay. */
static Status
follow(Path* path, Tone tone, double first, double slope, double complex* matrix, int* pivot) {
  const uint32_t n = path->frame->n;
  double complex* const y = matrix + (size_t)n * n;
  double done = 0.0;
  double step = 1.0;
  path->p = first;
  path->q = 0.0;
  while (done < 1.0) {
    const double share = fmin(1.0, done + step);
    Path ahead = *path;
    ahead.q = done > 0.0 ? path->q * share / done : slope * share;
    memcpy(y, path->y, n * sizeof(double complex));
    if (settle(&ahead, wanted_w(path->rate_hz, tone, share), y, matrix, pivot) &&
        likeness(n, path->y, y) >= LEAST_LIKENESS) {
      memcpy(path->y, y, n * sizeof(double complex));
      path->p = ahead.p;
      path->q = ahead.q;
      done = share;
      step *= 2.0;
    } else {
      step *= 0.5;
    }
    if (step < SHORTEST) {
      return STATUS_UNREACHABLE;
    }
  }
  return STATUS_OK;
}

static Status solve_path(const Frame* frame,
                         double rate_hz,
                         Tone tone,
                         const double* shape,
                         double first,
                         double slope,
                         Retuning* out) {
  const size_t n = frame->n;
  double* const dense = malloc(2 * n * n * sizeof(double));
  double complex* const space = malloc((n * n + 2 * n) * sizeof(double complex));
  int* const pivot = malloc(n * sizeof(int));
  Status status = dense && space && pivot ? STATUS_OK : STATUS_NO_MEMORY;
  if (!status) {
    Path path = {
        .frame = frame,
        .rate_hz = rate_hz,
        .stiffness = dense,
        .damping = dense + n * n,
        .y = space + n * n + n,
    };
    frame_fill_stiffness(frame, path.stiffness);
    frame_fill_damping(frame, path.damping);
    for (size_t i = 0; i < n; ++i) {
      path.y[i] = shape[i];
    }
    status = follow(&path, tone, first, slope, space, pivot);
    *out = (Retuning){.stiffness_factor = path.p, .damping_factor = path.q};
  }
  free(dense);
  free(space);
  free(pivot);
  return status;
}

static Status
solve_frame(const Frame* frame, double rate_hz, Tone tone, uint32_t k, Retuning* out) {
  const size_t n = frame->n;
  double* const omega = malloc((2 * (size_t)k + n * k) * sizeof(double));
  double* const damping = omega + k;
  double* const shapes = damping + k;
  Status status = omega ? symmetric_solve(frame, k, omega, damping, shapes) : STATUS_NO_MEMORY;
  Pole pole = {0};
  status = status ? status : pole_solve(rate_hz, tone, &pole);
  if (!status) {
    const double warp = omega[k - 1] / rate_hz;
    out->stiffness_factor = pole.a / (warp * warp);
    out->damping_factor = pole.g > 0.0 ? pole.g * rate_hz / damping[k - 1] : 0.0;
    if (pole.g > 0.0 && !(damping[k - 1] > 0.0)) {
      status = STATUS_UNREACHABLE;
    } else if (pole.g > 0.0 && !frame_is_proportional(frame)) {
      status = solve_path(frame, rate_hz, tone, shapes + n * (k - 1), out->stiffness_factor,
                          out->damping_factor, out);
    }
  }
  free(omega);
  return status;
}

/* Whether all modes of the network are stable once it is scaled. */
static Status judge(const Network* network, double rate_hz, Retuning retuning) {
  Network* const scaled = network_copy(network);
  double step_s = 0.0;
  if (!scaled) {
    return STATUS_NO_MEMORY;
  }
  network_scale(scaled, retuning.stiffness_factor, retuning.damping_factor);
  Status status = modes_largest_step(scaled, NULL, &step_s);
  if (!status && !(1.0 / rate_hz <= step_s)) {
    status = STATUS_UNSTABLE;
  }
  network_free(scaled);
  return status;
}

Status retune_solve(const Network* network, double rate_hz, Tone tone, uint32_t k, Retuning* out) {
  if (!network->is_checked || !(rate_hz > 0.0) || !isfinite(rate_hz) || !(tone.f0_hz > 0.0) ||
      !(tone.tau_s > 0.0)) {
    return STATUS_BAD_ARGUMENT;
  }
  if (!(tone.f0_hz < 0.5 * rate_hz)) {
    return STATUS_UNREACHABLE;
  }
  if (k > network->n_masses) {
    return STATUS_NO_SUCH_MODE;
  }
  Frame frame;
  Retuning found = {0};
  Status status = frame_init(&frame, network);
  if (status) {
    return status;
  }
  const uint32_t mode = k ? k : frame.n_free + 1;
  status = mode > frame.n_free && mode <= frame.n ? solve_frame(&frame, rate_hz, tone, mode, &found)
                                                  : STATUS_FREE;
  frame_clear(&frame);
  status = status ? status : judge(network, rate_hz, found);
  if (!status) {
    *out = found;
  }
  return status;
}
