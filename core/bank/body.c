#include "core/bank/body.h"

#include "core/base/complex_of.h"
#include "core/base/maths.h"

#include <complex.h>
#include <math.h>

/* A band is looked at in so many places. */
enum { PLACES = 16 };

/* What is leveled [Hz]. */
static const double LOW_HZ = 80.0;
static const double HIGH_HZ = 5000.0;

static const BodyShape AS_IT_IS = {1.0, 1.0};

void body_gain(const Body* body, BodyShape shape, double hz, double complex gain[2]) {
  gain[0] = 0.0;
  gain[1] = 0.0;
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    const double ratio = mode->f0_hz / (hz * shape.size);
    /* q̈ = f/M over 1 − (F/f)² − i F/(Q f) */
    const double complex d = complex_of(1.0 - ratio * ratio, -ratio * shape.damping / mode->q);
    const double complex moved =
        conj(d) / (mode->mass_kg * (creal(d) * creal(d) + cimag(d) * cimag(d)));
    gain[0] += mode->radiation[0] * moved;
    gain[1] += mode->radiation[1] * moved;
  }
}

static double square_of(double complex z) {
  return creal(z) * creal(z) + cimag(z) * cimag(z);
}

double body_gain_square(const Body* body, BodyShape shape, double hz) {
  double complex gain[2];
  body_gain(body, shape, hz, gain);
  return 0.5 * (square_of(gain[0]) + square_of(gain[1]));
}

static double band_hz(int band) {
  return BODY_LOWEST_HZ * exp2(band / 3.0);
}

static double mean_over_band(const Body* body, double hz) {
  double sum = 0.0;
  for (int i = 0; i < PLACES; ++i) {
    sum += body_gain_square(body, AS_IT_IS, hz * exp2(((i + 0.5) / PLACES - 0.5) / 3.0));
  }
  return sum / PLACES;
}

void body_narrow(BodyMode* mode) {
  const double both = 0.5 * (mode->radiation[0] + mode->radiation[1]);
  const double most = BODY_APART * fabs(both);
  const double apart = clamp(0.5 * (mode->radiation[0] - mode->radiation[1]), -most, most);
  mode->radiation[0] = both + apart;
  mode->radiation[1] = both - apart;
}

double body_strength(const BodyMode* mode) {
  const double sides =
      mode->radiation[0] * mode->radiation[0] + mode->radiation[1] * mode->radiation[1];
  return sides * mode->q / (mode->mass_kg * mode->mass_kg);
}

/* Leave out the one that is heard least. */
static void drop_one(Body* body) {
  uint32_t least = 0;
  for (uint32_t k = 1; k < body->n_modes; ++k) {
    least = body_strength(&body->modes[k]) < body_strength(&body->modes[least]) ? k : least;
  }
  --body->n_modes;
  for (uint32_t k = least; k < body->n_modes; ++k) {
    body->modes[k] = body->modes[k + 1];
  }
}

void body_keep(Body* body, uint32_t n_modes) {
  while (body->n_modes > n_modes) {
    drop_one(body);
  }
}

void body_level(Body* body) {
  double sum = 0.0;
  int n = 0;
  for (int band = 0; band < BODY_BANDS; ++band) {
    body->power[band] = mean_over_band(body, band_hz(band));
    if (band_hz(band) >= LOW_HZ && band_hz(band) <= HIGH_HZ) {
      sum += body->power[band];
      ++n;
    }
  }
  if (!(sum > 0.0)) {
    return;
  }
  const double square = BODY_POWER * n / sum;
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    body->modes[k].radiation[0] *= sqrt(square);
    body->modes[k].radiation[1] *= sqrt(square);
  }
  for (int band = 0; band < BODY_BANDS; ++band) {
    body->power[band] *= square;
  }
}

double body_power(const Body* body, BodyShape shape, double hz) {
  const double at = clamp(3.0 * log2(hz * shape.size / BODY_LOWEST_HZ), 0.0, BODY_BANDS - 1.0);
  const int band = (int)fmin(at, BODY_BANDS - 2.0);
  const double share = at - band;
  return (body->power[band] + share * (body->power[band + 1] - body->power[band])) / shape.damping;
}

/*
  How much higher than its Q a mass peaks that is stepped:  with q = 1 − 1/z and the poles p, p* of
  modulus r, q² z²/((z − p) (z − p*)) is at the angle θ of p  4 sin²(θ/2)/((1 − r) 2 √r sin θ).
*/
static double peak_of(Pole pole, double angle) {
  return tan(0.5 * angle) / (0.5 * angle * sqrt(1.0 - pole.g));
}

void body_bank(const Body* body, BodyShape shape, double rate_hz, Bank* bank) {
  bank_clear(bank);
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    const double f0_hz = mode->f0_hz / shape.size;
    const double tau_s = mode->q / (PI * f0_hz * shape.damping);
    BankMode made = {.in = 1.0 / mode->mass_kg};
    if (f0_hz < BODY_HIGHEST * rate_hz &&
        pole_solve(rate_hz, (Tone){f0_hz, tau_s}, &made.pole) == STATUS_OK) {
      const double peak = peak_of(made.pole, 2.0 * PI * f0_hz / rate_hz);
      made.out[0] = mode->radiation[0] / peak;
      made.out[1] = mode->radiation[1] / peak;
      bank_add(bank, made);
    }
  }
}
