#include "core/string/pole.h"

#include "core/base/maths.h"

#include <math.h>

/* b² − 4c of the characteristic polynomial (23), negative for a conjugate pair. */
static double discriminant(Pole pole) {
  return pole.a * pole.a + (2.0 * pole.g - 4.0) * pole.a + pole.g * pole.g;
}

/* μh of a mass with the given a, or NaN where it would be imaginary. */
static double mu_of(double a, double sigma_h) {
  const double square = a - sigma_h * sigma_h;
  return square >= 0.0 ? sqrt(square) : (double)NAN;
}

Pole pole_from_analog(double rate_hz, double omega0, double gamma) {
  const double warp = omega0 / rate_hz;
  return (Pole){.a = warp * warp, .g = gamma / rate_hz};
}

Status pole_solve(double rate_hz, Tone tone, Pole* pole) {
  const bool is_rate = rate_hz > 0.0 && isfinite(rate_hz);
  if (!is_rate || !(tone.f0_hz > 0.0) || !(tone.f0_hz < 0.5 * rate_hz) || !(tone.tau_s > 0.0)) {
    return STATUS_BAD_ARGUMENT;
  }
  const double decay = 1.0 / (tone.tau_s * rate_hz);
  const double radius = exp(-decay);
  const double half = sin(PI * tone.f0_hz / rate_hz);
  pole->g = -expm1(-2.0 * decay);
  /* 2 − g − 2 r cos θ = (1 − r)² + 4 r sin²(θ/2), without the cancellation at low frequencies. */
  pole->a = expm1(-decay) * expm1(-decay) + 4.0 * radius * half * half;
  return STATUS_OK;
}

double pole_angle(Pole pole) {
  const double twice_real = 2.0 - pole.a - pole.g;
  const double d = discriminant(pole);
  if (d < 0.0) {
    return atan2(sqrt(-d), twice_real);
  }
  return twice_real < 0.0 ? PI : 0.0;
}

double pole_radius(Pole pole) {
  const double d = discriminant(pole);
  if (d < 0.0) {
    return sqrt(1.0 - pole.g);
  }
  return 0.5 * (fabs(2.0 - pole.a - pole.g) + sqrt(d));
}

Tone pole_tone(double rate_hz, Pole pole) {
  const double log_radius = pole_is_complex(pole) ? 0.5 * log1p(-pole.g) : log(pole_radius(pole));
  return (Tone){
      .f0_hz = pole_angle(pole) * rate_hz / (2.0 * PI),
      .tau_s = log_radius == 0.0 ? HUGE_VAL : -1.0 / (log_radius * rate_hz),
  };
}

bool pole_is_complex(Pole pole) {
  return discriminant(pole) < 0.0;
}

bool pole_is_stable(Pole pole) {
  return pole.a >= 0.0 && pole.g >= 0.0 && pole.g < 2.0 && pole.a + 2.0 * pole.g <= 4.0;
}

PoleRegion pole_region(Pole pole) {
  if (!pole_is_stable(pole)) {
    return POLE_UNSTABLE;
  }
  if (pole_is_complex(pole)) {
    return POLE_COMPLEX;
  }
  return 2.0 - pole.a - pole.g < 0.0 ? POLE_REAL_AT_PI : POLE_REAL_AT_ZERO;
}

const char* pole_region_text(PoleRegion region) {
#define POLE_REGION_TEXT(name, text) text,
  static const char* const texts[] = {POLE_REGION_LIST(POLE_REGION_TEXT)};
#undef POLE_REGION_TEXT
  return (unsigned)region < (unsigned)POLE_REGION_COUNT ? texts[region] : "unknown region";
}

double pole_largest_step_s(double omega0, double gamma) {
  /* The root in the form that does not cancel for heavy damping: 4 / (γ + √(γ² + 4 ω0²)). */
  return 4.0 / (gamma + sqrt(gamma * gamma + 4.0 * omega0 * omega0));
}

Pole pole_from_eigenvalue(double rate_hz, double sigma, double mu) {
  const double sigma_h = sigma / rate_hz;
  const double mu_h = mu / rate_hz;
  return (Pole){.a = sigma_h * sigma_h + mu_h * mu_h, .g = -2.0 * sigma_h};
}

double pole_edge_vibrating(double mu_h) {
  if (!(mu_h >= 0.0 && mu_h <= 2.0)) {
    return (double)NAN;
  }
  /* The left side rises up to u = 3: halve until nothing is left to halve. */
  const double wanted = 4.0 * mu_h * mu_h;
  double low = 0.0;
  double high = 2.0;
  double u = 1.0;
  while (u > low && u < high) {
    if (u * u * u * (4.0 - u) < wanted) {
      low = u;
    } else {
      high = u;
    }
    u = 0.5 * (low + high);
  }
  return 0.5 * high * (high - 2.0);
}

double pole_edge_turning(double mu_h) {
  const double edge = 1.0 - sqrt(3.0 - mu_h * mu_h);
  return mu_h >= 0.0 && edge <= 0.0 ? edge : (double)NAN;
}

double pole_edge_stable(double mu_h) {
  const double edge = 2.0 - sqrt(8.0 - mu_h * mu_h);
  return mu_h >= 0.0 && edge <= 0.0 ? edge : (double)NAN;
}

double pole_line_of_frequency(double sigma_h, double angle) {
  if (!(sigma_h > -0.5 && sigma_h <= 0.0 && angle >= 0.0 && angle <= PI)) {
    return (double)NAN;
  }
  /* (1 − r)² + 4 r sin²(θ/2), as in pole_solve(). */
  const double r = sqrt(1.0 + 2.0 * sigma_h);
  const double half = sin(0.5 * angle);
  return mu_of((1.0 - r) * (1.0 - r) + 4.0 * r * half * half, sigma_h);
}

double pole_line_of_damping(double radius) {
  return radius > 0.0 && radius <= 1.0 ? -0.5 * (1.0 - radius) * (1.0 + radius) : (double)NAN;
}

double pole_branch_of_damping(double sigma_h, double radius, bool is_at_pi) {
  const double g = -2.0 * sigma_h;
  const double z = is_at_pi ? -radius : radius;
  const double other = (1.0 - g) / z;
  /* The poles' product is 1 − g and their sum 2 − a − g. */
  const bool is_larger = radius > 0.0 && sigma_h <= 0.0 && fabs(other) <= radius;
  return is_larger ? mu_of(2.0 - g - z - other, sigma_h) : (double)NAN;
}
