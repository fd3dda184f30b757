#include "core/excite/pluck.h"

#include "core/base/maths.h"

#include <assert.h>
#include <math.h>
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

/*
  Solve (k1 + k2 L + k3 L²) x = f in place, which is positive definite wherever a string is: its
  five diagonals are factored into a lower triangle of two below ones, those into a diagonal, and
  back.
*/
static void stiffen(Shape* shape, StringCoefs c) {
  const uint32_t n = shape->n;
  const double one = -(c.k2 + 4.0 * c.k3);
  double diagonal[CHAIN_MAX_MASSES + 2];
  double below[CHAIN_MAX_MASSES + 2];
  double twice[CHAIN_MAX_MASSES + 2];
  if (c.k2 == 0.0 && c.k3 == 0.0) {
    for (uint32_t i = 1; i <= n; ++i) {
      shape->at[i] /= c.k1;
    }
    return;
  }
  for (uint32_t i = 1; i <= n; ++i) {
    const double end = (i == 1 ? c.k3 : 0.0) + (i == n ? c.k3 : 0.0);
    const double d1 = i > 1 ? diagonal[i - 1] : 0.0;
    const double d2 = i > 2 ? diagonal[i - 2] : 0.0;
    twice[i] = i > 2 ? c.k3 / d2 : 0.0;
    below[i] = i > 1 ? (one - twice[i] * d2 * (i > 2 ? below[i - 1] : 0.0)) / d1 : 0.0;
    diagonal[i] =
        c.k1 + 2.0 * c.k2 + 6.0 * c.k3 - end - below[i] * below[i] * d1 - twice[i] * twice[i] * d2;
    shape->at[i] -=
        (i > 1 ? below[i] * shape->at[i - 1] : 0.0) + (i > 2 ? twice[i] * shape->at[i - 2] : 0.0);
  }
  for (uint32_t i = n; i >= 1; --i) {
    shape->at[i] = shape->at[i] / diagonal[i] -
                   (i + 1 <= n ? below[i + 1] * shape->at[i + 1] : 0.0) -
                   (i + 2 <= n ? twice[i + 2] * shape->at[i + 2] : 0.0);
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
  const double force = pluck.amplitude * (2.0 / PI) * (chain->n_masses + 1.0) * a1;
  const double before = chain_energy(chain);
  Shape push = {.n = chain->n_masses};
  Shape aside;
  press(&push, &pluck);
  aside = push;
  hang(&aside);
  stiffen(&aside, chain->now);
  for (uint32_t i = 1; i <= chain->n_masses; ++i) {
    const double x = (double)chain_position(chain, i - 1) + force * aside.at[i];
    const double u = (double)chain_velocity(chain, i - 1) + 0.5 * force * push.at[i];
    chain_place(chain, i - 1, (float)x, (float)u);
  }
  return chain_energy(chain) - before;
}

double pluck_push(Chain* chain, Pluck pluck) {
  const double angle1 = pole_angle(tuning_mode(chain->now, chain->n_masses, 1));
  const double momentum = pluck.amplitude * (2.0 / PI) * (chain->n_masses + 1.0) * sin(angle1);
  const double before = chain_energy(chain);
  Shape push = {.n = chain->n_masses};
  press(&push, &pluck);
  for (uint32_t i = 1; i <= chain->n_masses; ++i) {
    if (push.at[i] > 0.0) {
      chain_push(chain, i - 1, (float)(momentum * push.at[i]));
    }
  }
  return chain_energy(chain) - before;
}
