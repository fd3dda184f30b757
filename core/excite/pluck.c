#include "core/excite/pluck.h"

#include "core/base/maths.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* The force of a hand that plays with what it has as that is, and how fast it is softer. */
static const double USUAL_FORCE = 0.75;
static const double SOFTENING = 0.75;

/* A force or a shape; masses count from 1, and what is at 0 and at N + 1 is a wall. */
typedef struct {
  uint32_t n;
  double at[CHAIN_MAX_MASSES + 2];
} Shape;

static double raised_cosine(double distance) {
  return fabs(distance) < 1.0 ? 0.5 + 0.5 * cos(PI * distance) : 0.0;
}

/* What the finger pulls each mass with, of 1 in all. */
static void press(Shape* force, const Pluck* pluck) {
  const double length = force->n + 1.0;
  const double width = pluck_width(pluck, force->n);
  const double centre = fmin(fmax(pluck->place * length, 1.0), (double)force->n);
  double sum = 0.0;
  for (uint32_t i = 1; i <= force->n; ++i) {
    force->at[i] = raised_cosine(((double)i - centre) / width);
    sum += force->at[i];
  }
  assert(sum > 0.0);
  for (uint32_t i = 1; i <= force->n; ++i) {
    force->at[i] /= sum;
  }
}

/* Solve L x = f: its slope falls by f from mass to mass, and both walls are at 0. */
static void hang(Shape* shape) {
  const double length = shape->n + 1.0;
  double slope = 0.0;
  for (uint32_t i = 1; i <= shape->n; ++i) {
    slope += (1.0 - i / length) * shape->at[i];
  }
  shape->at[0] = 0.0;
  for (uint32_t i = 1; i <= shape->n; ++i) {
    const double pulled = shape->at[i];
    shape->at[i] = shape->at[i - 1] + slope;
    slope -= pulled;
  }
}

/* A row of the factors below: what is left of it and the two before, and the inverse of its
 * diagonal. */
typedef struct {
  double twice, below, inverse;
} Row;

static Row next_row(StringCoefs c, double at, Row before, Row last) {
  const double twice = c.k3 * before.inverse;
  const double left = -(c.k2 + 4.0 * c.k3) - c.k3 * last.below;
  const double below = left * last.inverse;
  return (Row){twice, below, 1.0 / (at - below * left - twice * c.k3)};
}

/*
  Solve (k1 + k2 L + k3 L²) x = f in place, which is positive definite wherever a string is: its
  five diagonals are factored into a lower triangle of two below ones, those into a diagonal, and
  back. All rows but those next to a wall are alike, so the factors soon stand still.
*/
static void stiffen(Shape* shape, StringCoefs c) {
  const uint32_t n = shape->n;
  const double at = c.k1 + 2.0 * c.k2 + 6.0 * c.k3;
  Row rows[CHAIN_MAX_MASSES];
  Row before = {0};
  Row last = {0};
  double* const x = &shape->at[1];
  for (uint32_t i = 0; i < n; ++i) {
    const double wall = (i == 0 ? c.k3 : 0.0) + (i + 1 == n ? c.k3 : 0.0);
    const bool is_still = i > 2 && wall == 0.0 && last.inverse == before.inverse &&
                          last.below == before.below && last.twice == before.twice;
    rows[i] = is_still ? last : next_row(c, at - wall, before, last);
    x[i] -= (i > 0 ? rows[i].below * x[i - 1] : 0.0) + (i > 1 ? rows[i].twice * x[i - 2] : 0.0);
    before = last;
    last = rows[i];
  }
  for (uint32_t i = n; i-- > 0;) {
    x[i] = rows[i].inverse * x[i] - (i + 1 < n ? rows[i + 1].below * x[i + 1] : 0.0) -
           (i + 2 < n ? rows[i + 2].twice * x[i + 2] : 0.0);
  }
}

double pluck_softness(double force) {
  return 1.0 - pow(force / USUAL_FORCE, SOFTENING);
}

double pluck_played(double hardness, double softness) {
  return fmax(PLUCK_SOFT, fmin(1.0, hardness + softness * (PLUCK_SOFT - hardness)));
}

double pluck_width(const Pluck* pluck, uint32_t n_masses) {
  const double softest = PLUCK_SOFTEST * (n_masses + 1.0);
  const double range = log(PLUCK_SOFTEST / PLUCK_HARDEST);
  const double most = fmax(0.0, log(softest / PLUCK_NARROWEST) / range);
  const double played = pluck_played(fmin(pluck->hardness, most), pluck->softness);
  return fmax(PLUCK_NARROWEST, softest * exp(-range * played));
}

double pluck_pull(Chain* chain, Pluck pluck) {
  const double a1 = tuning_mode(chain->now, chain->n_masses, 1).a;
  const double size = pluck.amplitude * (2.0 / PI) * (chain->n_masses + 1.0) * a1;
  const double before = chain_energy(chain);
  Shape force;
  Shape aside;
  force.n = chain->n_masses;
  press(&force, &pluck);
  aside = force;
  hang(&aside);
  stiffen(&aside, chain->now);
  for (uint32_t i = 1; i <= force.n; ++i) {
    aside.at[i] *= size;
    force.at[i] *= 0.5 * size;
  }
  chain_add(chain, &aside.at[1], &force.at[1]);
  return chain_energy(chain) - before;
}
