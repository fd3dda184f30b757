#include "core/chain_whole.h"

#include <math.h>

/* What no number may pass; half of what it can hold, for a glance at x instead of X, and for noise.
 */
static const double FULL = 0x1p30;

/* (z0/2)² in units of a1 up to which what is left of the air shifts no partial by 0.01 cent. */
static const double AUDIBLE_AIR = 1.15e-5;

/* Share of k1 that must be left where bending is negative. */
static const double LEAST_PULL = 0.1;

static double positive(double value) {
  return fmax(value, 0.0);
}

static StringCoefs without_air(StringCoefs coefs, uint32_t n_masses, double fade) {
  const double lambda1 = tuning_lambda(n_masses, 1);
  const Pole first = tuning_mode(coefs, n_masses, 1);
  const double z1 = coefs.z1 / (1.0 - coefs.z0);
  const double a1 = 2.0 - z1 * lambda1 - (2.0 - first.a - first.g) / fade;
  const double k2 = coefs.k2 / fade;
  const double k3 = coefs.k3 / fade;
  return (StringCoefs){
      .k1 = a1 / lambda1 - (k2 + k3 * lambda1) * lambda1,
      .k2 = k2,
      .k3 = k3,
      .z1 = z1,
  };
}

/*
  The largest that any number can become, by the scheme's energy, with y = x − u/2,

      2E = yᵀ K y + uᵀ (1 − K/4) u.

  So |u|² ≤ 2E/headroom, and every |Δy| ≤ √(2E/k), k being the least pull, and since (L⁻¹)_ii ≤
  (N + 1)/4 every y² ≤ 2E (N + 1)/(4k).  Differences of a higher order are at most twice those
  before.
*/
static double largest(StringCoefs c, uint32_t n_masses, ChainSums sums) {
  const double stiffest = c.k1 + 4.0 * positive(c.k2) + 16.0 * positive(c.k3);
  const double least = c.k1 - 4.0 * positive(-c.k2) - 16.0 * positive(-c.k3);
  const double headroom = tuning_headroom(c, n_masses);
  const double energy2 = stiffest * sums.yy + sums.uu;
  const double u = sqrt(energy2 / headroom);
  const double y = sqrt(energy2 * (n_masses + 1.0) / (4.0 * least));
  const double slope = sqrt(energy2 / least) + u;
  const double order = c.k3 != 0.0 ? 16.0 : c.k2 != 0.0 ? 4.0 : 1.0;
  return fmax(fmax(2.0 * u, y + 0.5 * u), order * slope);
}

/* In each step each link errs by its dither and its rounding, 1/√12 of a number each, and by a part
 * of its own last place; over one time constant that adds up in a mode as the steps' square root.
 */
static double noise_of(const ChainWhole* whole, uint32_t n_masses, ChainSums sums, Pole first) {
  const double length = n_masses + 1.0;
  const double k1 = whole->coefs.k1;
  const double link = k1 * sqrt(sums.yy / length);
  const double error = 0.41 * hypot(whole->gain, 0x1p-24 * link);
  const double amplitude = sqrt(2.0 / length * (sums.xx - sums.xu + sums.uu / first.a));
  return error * sqrt(2.0 / (length * first.g * k1)) / amplitude;
}

bool chain_whole_design(StringCoefs coefs, uint32_t n_masses, ChainSums sums, ChainWhole* whole) {
  const Pole first = tuning_mode(coefs, n_masses, 1);
  const double half_air = 0.5 * coefs.z0;
  if (!(first.g > 0.0) || !(half_air * half_air <= AUDIBLE_AIR * first.a)) {
    return false;
  }
  const double fade = sqrt(1.0 - coefs.z0);
  ChainWhole design = {.coefs = without_air(coefs, n_masses, fade), .fade = fade};
  const StringCoefs* const c = &design.coefs;
  const double size = largest(*c, n_masses, sums);
  if (!(c->k1 - 4.0 * positive(-c->k2) - 16.0 * positive(-c->k3) > LEAST_PULL * c->k1) ||
      !isfinite(size) || !(size > 0.0)) {
    return false;
  }
  design.gain = size / (0.5 * FULL);
  design.noise = noise_of(&design, n_masses, sums, first);
  *whole = design;
  return true;
}
