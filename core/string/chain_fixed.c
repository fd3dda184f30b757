#include "core/string/chain_fixed.h"

#include <math.h>

/* What no number may pass: half of what it can hold, for a pull may be twice as large as the
 * largest velocity. */
static const double FULL = 0x1p30;

/* (z0/2)² in units of a1 up to which what is left of the air shifts no partial by 0.01 cent. */
static const double AUDIBLE_AIR = 1.15e-5;

/* Share of k1 that must be left where bending is negative. */
static const double LEAST_PULL = 0.1;

static double positive(double value) {
  return fmax(value, 0.0);
}

/* The least that k1 + k2 λ + k3 λ² can be. */
static double least_pull(StringCoefs c) {
  return c.k1 - 4.0 * positive(-c.k2) - 16.0 * positive(-c.k3);
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
  The largest that any number can become.  With y = x − u/2 and the dampers Z = z1 L,

      2H = yᵀ K y + uᵀ (1 − K/4 − Z/2) u

  falls in every step (without dampers it is the scheme's energy, and stays), and so does that of
  L y and L u, of which each mode has λ² times as much.  Then, k being the least pull,

      (Δy)² ≤ 2H/k  everywhere, and since (L⁻¹)_ii ≤ (N + 1)/4,  y² ≤ 2H (N + 1)/(4k).

  |u|² ≤ 2H/headroom would do, but near the limit there is little headroom, and that only in modes
  which have little of the energy: above λ = 2 there is at most a quarter of L u's.
*/
static double largest(StringCoefs c, uint32_t n_masses, ChainSums sums) {
  const double middle = 2.0;
  const double stiffest = c.k1 + 4.0 * positive(c.k2) + 16.0 * positive(c.k3);
  const double least = least_pull(c);
  const double energy = stiffest * sums.slope + sums.uu;
  const double energy_of_curvature = stiffest * sums.twist + sums.curvature;
  const double headroom = tuning_headroom(c, n_masses);
  const double headroom_below = 1.0 - middle * (0.25 * stiffest + 0.5 * c.z1);
  const double above = fmin(energy, energy_of_curvature / (middle * middle));
  const double u_split = sqrt(energy / positive(headroom_below)) + sqrt(above / headroom);
  const double u = fmin(sqrt(energy / headroom), u_split);
  const double y = sqrt(energy * (n_masses + 1.0) / (4.0 * least));
  const double slope = sqrt(energy / least) + u;
  const double twist = sqrt(energy_of_curvature / least) + sqrt(energy_of_curvature / headroom);
  double most = fmax(y + 0.5 * u, slope + u);
  if (c.k2 != 0.0 || c.k3 != 0.0) {
    most = fmax(most, fmin(twist, 4.0 * slope));
  }
  return c.k3 != 0.0 ? fmax(most, 4.0 * fmin(twist, 4.0 * slope)) : most;
}

/* In each step each link errs by its dither and its rounding, 1/√12 of a number each, and by a part
 * of its own last place; over one time constant that adds up in a mode as the steps' square root.
 */
static double noise_of(const ChainFixed* fixed, uint32_t n_masses, ChainSums sums, Pole first) {
  const double length = n_masses + 1.0;
  const double k1 = fixed->coefs.k1;
  const double link = k1 * sqrt(sums.slope / length);
  const double error = 0.41 * hypot(fixed->gain, 0x1p-24 * link);
  const double amplitude = sqrt(2.0 / length * (sums.xx - sums.xu + sums.uu / first.a));
  return error * sqrt(2.0 / (length * first.g * k1)) / amplitude;
}

bool chain_fixed_design(StringCoefs coefs, uint32_t n_masses, ChainSums sums, ChainFixed* fixed) {
  const Pole first = tuning_mode(coefs, n_masses, 1);
  const double half_air = 0.5 * coefs.z0;
  if (!(first.g > 0.0) || !(half_air * half_air <= AUDIBLE_AIR * first.a)) {
    return false;
  }
  const double fade = sqrt(1.0 - coefs.z0);
  ChainFixed design = {.coefs = without_air(coefs, n_masses, fade), .fade = fade};
  const StringCoefs* const c = &design.coefs;
  const double size = largest(*c, n_masses, sums);
  if (!(least_pull(*c) > LEAST_PULL * c->k1) || !isfinite(size) || !(size > 0.0)) {
    return false;
  }
  design.gain = size / FULL;
  design.noise = noise_of(&design, n_masses, sums, first);
  *fixed = design;
  return true;
}
