#include "core/analysis/modes.h"

#include "core/analysis/modes_check.h"
#include "core/analysis/modes_few.h"
#include "core/analysis/modes_frame.h"
#include "core/analysis/modes_general.h"
#include "core/analysis/modes_match.h"
#include "core/analysis/modes_step.h"
#include "core/analysis/modes_symmetric.h"
#include "core/base/complex_of.h"
#include "core/base/maths.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Poles looked for beyond those that are wanted. */
enum { MORE_FEW = 2 };

/* Room for the rounding of the paper's radius. */
static const double PAPER_MARGIN = 1e-12;

/* The two roots of w² + c w + k = 0, without cancellation: a conjugate pair, the upper first, or
 * the slower first. */
static void roots(double c, double k, double complex* w) {
  const double d = c * c - 4.0 * k;
  if (d < 0.0) {
    w[0] = complex_of(-0.5 * c, 0.5 * sqrt(-d));
    w[1] = conj(w[0]);
  } else {
    const double faster = -0.5 * (c + sqrt(d));
    /* No 0 of theirs has a sign. */
    w[0] = (faster != 0.0 ? k / faster : 0.0) + 0.0;
    w[1] = faster + 0.0;
  }
}

static void put_larger_first(double complex* z) {
  if (cimag(z[0]) == 0.0 && cabs(z[1]) > cabs(z[0])) {
    const double complex smaller = z[0];
    z[0] = z[1];
    z[1] = smaller;
  }
}

static double warp_cents(const Mode* mode) {
  const bool vibrates = cimag(mode->analog[0]) > 0.0 && cimag(mode->pole[0]) > 0.0;
  return vibrates ? 1200.0 * log2(2.0 * PI * mode->tone.f0_hz / cimag(mode->analog[0]))
                  : (double)NAN;
}

/* The mass which has the two analog eigenvalues; those of a passive network do not grow. */
static Pole paper_pole(const Mode* mode, double step_s) {
  const double sum = creal(mode->analog[0] + mode->analog[1]);
  const double product = creal(mode->analog[0] * mode->analog[1]);
  return (Pole){.a = product * step_s * step_s, .g = fmax(0.0, -sum * step_s)};
}

/* ln |1 + h w|, without the cancellation at slow decays. */
static double log_radius_of(double step_s, double complex w) {
  const double re = step_s * creal(w);
  const double im = step_s * cimag(w);
  return re > -0.5 ? 0.5 * log1p(2.0 * re + re * re + im * im) : log(cabs(1.0 + step_s * w));
}

/* All of a mode from its pairs of s and of w = (z − 1)/h. */
static void fill_mode(Mode* mode, double step_s, const double complex* s, const double complex* w) {
  memcpy(mode->analog, s, sizeof(mode->analog));
  mode->is_free = s[0] == 0.0;
  mode->pole[0] = 1.0 + step_s * w[0];
  mode->pole[1] = 1.0 + step_s * w[1];
  const bool is_second =
      cimag(w[0]) == 0.0 && (mode->is_free || cabs(mode->pole[1]) > cabs(mode->pole[0]));
  const double log_radius = log_radius_of(step_s, w[is_second ? 1 : 0]);
  put_larger_first(mode->pole);
  mode->tone = (Tone){
      .f0_hz = fabs(carg(mode->pole[0])) / (2.0 * PI * step_s),
      .tau_s = log_radius == 0.0 ? HUGE_VAL : -step_s / log_radius,
  };
  mode->warp_cents = warp_cents(mode);
  mode->radius = cabs(mode->pole[0]);
  mode->paper_radius = pole_radius(paper_pole(mode, step_s));
}

/* A mode of proportional damping is one mass. */
static void fill_mode_of_mass(Mode* mode, double rate_hz, double omega, double damping) {
  const double step_s = 1.0 / rate_hz;
  const Pole pole = pole_from_analog(rate_hz, omega, damping);
  double complex s[2];
  double complex w[2];
  roots(damping, omega * omega, s);
  roots(damping + step_s * omega * omega, omega * omega, w);
  fill_mode(mode, step_s, s, w);
  if (!mode->is_free) {
    mode->tone = pole_tone(rate_hz, pole);
    mode->radius = mode->paper_radius = pole_radius(pole);
    mode->warp_cents = warp_cents(mode);
  }
}

static Status solve_proportional(const Frame* frame, Modes* modes) {
  double* const omega = malloc(2 * (size_t)modes->n_modes * sizeof(double));
  double* const damping = omega + modes->n_modes;
  Status status =
      omega ? symmetric_solve(frame, modes->n_modes, omega, damping, NULL) : STATUS_NO_MEMORY;
  for (uint32_t k = 0; k < modes->n_modes && !status; ++k) {
    fill_mode_of_mass(&modes->mode[k], modes->rate_hz, omega[k], damping[k]);
  }
  free(omega);
  return status;
}

static int compare_pairs(const void* left, const void* right) {
  const double complex* const p = left;
  const double complex* const q = right;
  const double size_p = sqrt(cabs(p[0])) * sqrt(cabs(p[1]));
  const double size_q = sqrt(cabs(q[0])) * sqrt(cabs(q[1]));
  if (size_p != size_q) {
    return size_p < size_q ? -1 : 1;
  }
  /* Of what is not held, the least slowed down. */
  return cabs(p[1]) < cabs(q[1]) ? -1 : cabs(p[1]) > cabs(q[1]);
}

/* The poles that one-mass maps of the pairs s give, as w. */
static void predict(size_t n, double step_s, const double complex* s, double complex* w) {
  for (size_t k = 0; k < n; ++k) {
    const double c = -creal(s[2 * k] + s[2 * k + 1]);
    const double stiffness = creal(s[2 * k] * s[2 * k + 1]);
    roots(c + step_s * stiffness, stiffness, &w[2 * k]);
  }
}

/* Pairs of s, rising, and pairs of w beside them. */
static Status find_pairs(const Frame* frame, double step_s, double complex* s, double complex* w) {
  const uint32_t n = frame->n;
  Check check = {0};
  double complex* const expected = malloc(2 * (size_t)n * sizeof(double complex));
  Status status = expected ? check_find(frame, &check) : STATUS_NO_MEMORY;
  status = status ? status : general_solve(frame, 0.0, &check, s);
  status = status ? status : general_solve(frame, step_s, &check, w);
  status = status ? status : match_pairs(n, frame->n_free, check.rate, s);
  if (!status) {
    qsort(s, n, 2 * sizeof(double complex), compare_pairs);
    predict(n, step_s, s, expected);
    status = match_poles(n, expected, w);
  }
  check_clear(&check);
  free(expected);
  return status;
}

/* Pairs of the lowest s but 0, rising, and beside each the nearest of the lowest w, some more than
 * those that are wanted, since the scheme may order them otherwise. */
static Status find_held_pairs(
    const Frame* frame, double step_s, uint32_t n, double complex* s, double complex* w) {
  const uint32_t n_w = n + MORE_FEW;
  double complex* const left = malloc(((size_t)n + n_w) * sizeof(double complex));
  double complex* const upper = left + n_w;
  Status status = left ? few_solve(frame, 0.0, n, upper) : STATUS_NO_MEMORY;
  status = status ? status : few_solve(frame, step_s, n_w, left);
  for (size_t k = 0; k < n && !status; ++k) {
    s[2 * k] = upper[k];
    s[2 * k + 1] = conj(upper[k]);
    predict(1, step_s, &s[2 * k], &w[2 * k]);
    size_t best = 0;
    for (size_t i = 1; i < n_w - k; ++i) {
      best = cabs(left[i] - w[2 * k]) < cabs(left[best] - w[2 * k]) ? i : best;
    }
    w[2 * k] = left[best];
    w[2 * k + 1] = conj(left[best]);
    left[best] = left[n_w - 1 - k];
  }
  free(left);
  return status;
}

/* The lowest pairs, those of 0 first, which nothing slows down. */
static Status find_few_pairs(
    const Frame* frame, double step_s, uint32_t n, double complex* s, double complex* w) {
  const size_t n_zeros = 2 * (size_t)(n < frame->n_free ? n : frame->n_free);
  memset(s, 0, n_zeros * sizeof(double complex));
  memset(w, 0, n_zeros * sizeof(double complex));
  if (frame->n_free > frame->n_adrift) {
    return STATUS_NO_SUCH_MODE;
  }
  return n > frame->n_free
             ? find_held_pairs(frame, step_s, n - frame->n_free, s + n_zeros, w + n_zeros)
             : STATUS_OK;
}

static Status solve_general(const Frame* frame, Modes* modes) {
  const double step_s = 1.0 / modes->rate_hz;
  const size_t n_values = 2 * (size_t)frame->n;
  double complex* const s = malloc(2 * n_values * sizeof(double complex));
  double complex* const w = s + n_values;
  Status status = s ? STATUS_NO_SUCH_MODE : STATUS_NO_MEMORY;
  if (s && few_is_worth_it(frame, modes->n_modes + MORE_FEW)) {
    status = find_few_pairs(frame, step_s, modes->n_modes, s, w);
  }
  /* Real values are paired among all. */
  if (status == STATUS_NO_SUCH_MODE || status == STATUS_NO_CONVERGENCE) {
    status = find_pairs(frame, step_s, s, w);
  }
  for (size_t k = 0; k < modes->n_modes && !status; ++k) {
    fill_mode(&modes->mode[k], step_s, &s[2 * k], &w[2 * k]);
  }
  free(s);
  return status;
}

/* Where the network is unstable, some pole is real and beyond −1; if rounding hides it, it is the
 * lowest. */
static void name_regions(Modes* modes) {
  double lowest = -1.0;
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    lowest = fmin(lowest, creal(modes->mode[k].pole[0]));
  }
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    Mode* const mode = &modes->mode[k];
    const double re = creal(mode->pole[0]);
    if (!modes->is_stable && re < -1.0 && cimag(mode->pole[0]) == 0.0) {
      mode->region = POLE_UNSTABLE;
    } else if (cimag(mode->pole[0]) != 0.0) {
      mode->region = POLE_COMPLEX;
    } else {
      mode->region = re < 0.0 ? POLE_REAL_AT_PI : POLE_REAL_AT_ZERO;
    }
  }
}

static void judge(Modes* modes) {
  modes->is_stable = 1.0 / modes->rate_hz <= modes->largest_step_s;
  modes->paper_is_stable = true;
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    const Mode* const mode = &modes->mode[k];
    const Pole pole = paper_pole(mode, 1.0 / modes->rate_hz);
    modes->radius = fmax(modes->radius, mode->radius);
    modes->paper_radius = fmax(modes->paper_radius, mode->paper_radius);
    modes->paper_is_stable &= pole.a + 2.0 * pole.g <= 4.0 * (1.0 + PAPER_MARGIN);
  }
  name_regions(modes);
}

static Status solve_frame(const Frame* frame, Modes* modes, Modes** out) {
  const Status status =
      modes->is_proportional ? solve_proportional(frame, modes) : solve_general(frame, modes);
  if (status) {
    free(modes);
    return status;
  }
  judge(modes);
  *out = modes;
  return STATUS_OK;
}

Status modes_solve(const Network* network, double rate_hz, uint32_t n_wanted, Modes** modes) {
  if (!(rate_hz > 0.0) || !isfinite(rate_hz) || !network->is_checked) {
    return STATUS_BAD_ARGUMENT;
  }
  const uint32_t n = network->n_masses;
  const uint32_t n_modes = n_wanted > 0 && n_wanted < n ? n_wanted : n;
  Frame frame;
  double step_s = 0.0;
  Status status = frame_init(&frame, network);
  if (status) {
    return status;
  }
  status = step_find(&frame, NULL, &step_s);
  Modes* const found = status ? NULL : calloc(1, sizeof(Modes) + n_modes * sizeof(Mode));
  if (found) {
    found->rate_hz = rate_hz;
    found->n_modes = n_modes;
    found->is_complete = n_modes == n;
    found->is_proportional = frame_is_proportional(&frame);
    found->largest_step_s = step_s;
    status = solve_frame(&frame, found, modes);
  } else {
    status = status ? status : STATUS_NO_MEMORY;
  }
  frame_clear(&frame);
  return status;
}

void modes_free(Modes* modes) {
  free(modes);
}

Status modes_largest_step(const Network* network, const ModesWatch* watch, double* step_s) {
  Frame frame;
  Status status = network->is_checked ? frame_init(&frame, network) : STATUS_BAD_ARGUMENT;
  if (!status) {
    status = step_find(&frame, watch, step_s);
    frame_clear(&frame);
  }
  return status;
}
