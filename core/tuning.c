#include "core/tuning.h"

#include <math.h>
#include <stdbool.h>

static const double PI = 3.14159265358979323846;

/* Halvings that take an interval below the precision of the float coefficients. */
enum { FIT_HALVINGS = 40 };

/* Bending (in units of k1) down to which a_k still grows with k; below it the top modes fold back.
 */
static const double LEAST_GROWING_BENDING = -0.125;

/* Bending at which the top mode of an endless string stands still is −1/4; stop short of it. */
static const double LEAST_BENDING = -0.24;

/* The target reduced to what the coefficients are made of. */
typedef struct {
  Pole first;     /* The fundamental */
  double lambda1; /* Its eigenvalue */
  double lambda_last;
  double loss;    /* s */
  double bending; /* b = k2/k1 */
} Design;

static bool is_between(double value, double low, double high) {
  return value >= low && value <= high;
}

static Status design_init(Design* design, const TuningTarget* target, uint32_t n_masses) {
  Pole first = {0};
  if (n_masses == 0 || pole_solve(target->rate_hz, target->tone, &first) ||
      !is_between(target->loss, 0.0, 1.0) || !(target->inharmonicity >= 0.0) ||
      !isfinite(target->inharmonicity)) {
    return STATUS_BAD_ARGUMENT;
  }
  const double length = (n_masses + 1.0) / PI;
  *design = (Design){
      .first = first,
      .lambda1 = tuning_lambda(n_masses, 1),
      .lambda_last = tuning_lambda(n_masses, n_masses),
      .loss = target->loss,
      .bending = target->inharmonicity * length * length,
  };
  return STATUS_OK;
}

static StringCoefs design_coefs(const Design* design) {
  const double lambda1 = design->lambda1;
  const double k1 = design->first.a / (lambda1 * (1.0 + design->bending * lambda1));
  return (StringCoefs){
      .k1 = k1,
      .k2 = design->bending * k1,
      .z0 = design->first.g * (1.0 - design->loss),
      .z1 = design->first.g * design->loss / lambda1,
  };
}

static Pole mode_at(StringCoefs coefs, double lambda) {
  return (Pole){
      .a = (coefs.k1 + coefs.k2 * lambda) * lambda,
      .g = coefs.z0 + coefs.z1 * lambda,
  };
}

static double headroom(StringCoefs coefs, double lambda_last) {
  const Pole last = mode_at(coefs, lambda_last);
  const double slope = coefs.k1 + 2.0 * coefs.z1;
  double load = last.a + 2.0 * last.g;
  /* With negative bending the load is a parabola in λ that may peak below the last mode. */
  if (coefs.k2 < 0.0) {
    const double peak = -0.5 * slope / coefs.k2;
    if (peak < lambda_last) {
      load = 2.0 * coefs.z0 + 0.5 * slope * peak;
    }
  }
  /* a_k/λ_k is linear in λ and positive in the first mode: if the last pulls back, all do. */
  return last.a > 0.0 ? 1.0 - 0.25 * load : -HUGE_VAL;
}

static bool design_is_safe(const Design* design) {
  return headroom(design_coefs(design), design->lambda_last) >= TUNING_MARGIN;
}

/* Raise *field from `low`, where the design must be safe, towards `high`, as far as it stays safe.
 */
static void raise_while_safe(Design* design, double* field, double low, double high) {
  for (int i = 0; i < FIT_HALVINGS; ++i) {
    const double middle = 0.5 * (low + high);
    *field = middle;
    if (design_is_safe(design)) {
      low = middle;
    } else {
      high = middle;
    }
  }
  *field = low;
}

/* Let *field give way down to `least`; true if that was enough. */
static bool give_way(Design* design, double* field, double least) {
  const double wanted = *field;
  *field = least;
  if (!design_is_safe(design)) {
    return false;
  }
  raise_while_safe(design, field, least, wanted);
  return true;
}

double tuning_lambda(uint32_t n_masses, uint32_t k) {
  const double half = sin(0.5 * PI * k / (n_masses + 1.0));
  return 4.0 * half * half;
}

Pole tuning_mode(StringCoefs coefs, uint32_t n_masses, uint32_t k) {
  return mode_at(coefs, tuning_lambda(n_masses, k));
}

Status tuning_solve(const TuningTarget* target, uint32_t n_masses, StringCoefs* coefs) {
  Design design;
  const Status status = design_init(&design, target, n_masses);
  if (!status) {
    *coefs = design_coefs(&design);
  }
  return status;
}

double tuning_headroom(StringCoefs coefs, uint32_t n_masses) {
  return headroom(coefs, tuning_lambda(n_masses, n_masses));
}

uint32_t tuning_max_masses(const TuningTarget* target, uint32_t limit) {
  uint32_t low = 0;
  uint32_t high = limit;
  while (low < high) {
    const uint32_t middle = low + (high - low + 1) / 2;
    Design design;
    if (!design_init(&design, target, middle) && design_is_safe(&design)) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

Status tuning_fit(const TuningTarget* target, uint32_t n_masses, StringCoefs* coefs) {
  Design design;
  const Status status = design_init(&design, target, n_masses);
  if (status) {
    return status;
  }
  if (!design_is_safe(&design) && !give_way(&design, &design.bending, LEAST_GROWING_BENDING) &&
      !give_way(&design, &design.loss, 0.0) && !give_way(&design, &design.bending, LEAST_BENDING)) {
    return STATUS_UNSTABLE;
  }
  *coefs = design_coefs(&design);
  return STATUS_OK;
}
