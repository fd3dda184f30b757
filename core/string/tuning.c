#include "core/string/tuning.h"

#include "core/base/maths.h"

#include <math.h>
#include <stdbool.h>

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
  double margin;  /* Headroom that is to be left */
  double loss;    /* s */
  double bending; /* b = k2/k1 */
  double fade; /* d = k3/k1 over what b is above LEAST_GROWING_BENDING, with which it gives way */
} Design;

static bool is_between(double value, double low, double high) {
  return value >= low && value <= high;
}

/* What of the series is wanted; past c = 1, where 1 − c² is negative, the chain as it is. */
static void set_partials(Design* design, const TuningTarget* target, uint32_t n_masses) {
  const double length = (n_masses + 1.0) / PI;
  const double beta = target->inharmonicity * length * length;
  const double courant = 2.0 * target->tone.f0_hz * (n_masses + 1.0) / target->rate_hz;
  const double missing = fmax(0.0, 1.0 - courant * courant / (1.0 + target->inharmonicity));
  const double third = missing * ((3.0 + missing) / 360.0 + beta / 6.0);
  design->bending = target->partials == PARTIALS_LUMPED ? beta : beta + missing / 12.0;
  design->fade =
      target->partials == PARTIALS_TRUEST ? third / (design->bending - LEAST_GROWING_BENDING) : 0.0;
}

static Status design_init(Design* design, const TuningTarget* target, uint32_t n_masses) {
  Pole first = {0};
  if (n_masses == 0 || pole_solve(target->rate_hz, target->tone, &first) ||
      !is_between(target->loss, 0.0, 1.0) || !(target->inharmonicity >= 0.0) ||
      !isfinite(target->inharmonicity) || (unsigned)target->partials > PARTIALS_TRUEST) {
    return STATUS_BAD_ARGUMENT;
  }
  *design = (Design){
      .first = first,
      .lambda1 = tuning_lambda(n_masses, 1),
      .lambda_last = tuning_lambda(n_masses, n_masses),
      .margin = n_masses > 1 ? TUNING_MARGIN : TUNING_LAST_MARGIN,
      .loss = target->loss,
  };
  set_partials(design, target, n_masses);
  return STATUS_OK;
}

static StringCoefs design_coefs(const Design* design) {
  const double lambda1 = design->lambda1;
  const double third = fmax(0.0, design->fade * (design->bending - LEAST_GROWING_BENDING));
  const double k1 =
      design->first.a / (lambda1 * (1.0 + (design->bending + third * lambda1) * lambda1));
  return (StringCoefs){
      .k1 = k1,
      .k2 = design->bending * k1,
      .z0 = design->first.g * (1.0 - design->loss),
      .z1 = design->first.g * design->loss / lambda1,
      .k3 = third * k1,
  };
}

static Pole mode_at(StringCoefs coefs, double lambda) {
  return (Pole){
      .a = (coefs.k1 + (coefs.k2 + coefs.k3 * lambda) * lambda) * lambda,
      .g = coefs.z0 + coefs.z1 * lambda,
  };
}

/*
  The largest of a + 2g, a cubic in λ, from 0 to the last mode. It sets out rising, by s = k1 + 2
  z1, so it is largest at its end or where it first stops rising, s + 2 k2 λ + 3 k3 λ² = 0. Where
  neither k2 nor k3 is negative it never stops, and the last mode is the heaviest.
*/
static double largest_load(StringCoefs coefs, double lambda_last) {
  const Pole last = mode_at(coefs, lambda_last);
  const double load = last.a + 2.0 * last.g;
  const double slope = coefs.k1 + 2.0 * coefs.z1;
  const double discriminant = coefs.k2 * coefs.k2 - 3.0 * coefs.k3 * slope;
  if (!(coefs.k2 < 0.0 || coefs.k3 < 0.0) || !(discriminant >= 0.0)) {
    return load;
  }
  const double peak = slope / (sqrt(discriminant) - coefs.k2);
  if (!(peak < lambda_last)) {
    return load;
  }
  /* The cubic there, less the half of λ times what is nought there. */
  return fmax(load, 2.0 * coefs.z0 + 0.5 * peak * (slope - coefs.k3 * peak * peak));
}

/* Whether a/λ = k1 + k2 λ + k3 λ² is positive from 0 to the last mode. It is at 0; so it is all
 * along if it is at its end and, should it have one in between, at its bottom. */
static bool is_pulled_back(StringCoefs coefs, double lambda_last) {
  const bool has_bottom = coefs.k2 < 0.0 && -coefs.k2 < 2.0 * coefs.k3 * lambda_last;
  return mode_at(coefs, lambda_last).a > 0.0 &&
         (!has_bottom || 4.0 * coefs.k1 * coefs.k3 > coefs.k2 * coefs.k2);
}

static double headroom(StringCoefs coefs, double lambda_last) {
  return is_pulled_back(coefs, lambda_last) ? 1.0 - 0.25 * largest_load(coefs, lambda_last)
                                            : -HUGE_VAL;
}

static bool design_is_safe(const Design* design) {
  return headroom(design_coefs(design), design->lambda_last) >= design->margin;
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

TuningTarget tuning_damped(TuningTarget target, double tau_s, double loss) {
  const double before = expm1(-2.0 / (target.tone.tau_s * target.rate_hz));
  const double after = expm1(-2.0 / (tau_s * target.rate_hz));
  target.loss = loss + (target.loss - loss) * (before / after);
  target.tone.tau_s = tau_s;
  return target;
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
    const uint32_t middle = high - (high - low) / 2;
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
