#include "core/excite/pluck.h"

#include "core/base/maths.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

static double raised_cosine(double distance) {
  return fabs(distance) < 1.0 ? 0.5 + 0.5 * cos(PI * distance) : 0.0;
}

/* What the finger pushes each mass by; masses count from 1, and past a wall all goes on upside
 * down.
 */
typedef struct {
  int64_t first;
  int64_t last;
  int64_t n_masses;
  double push[CHAIN_MAX_MASSES + 1];
} Pushes;

static double push_at(const Pushes* pushes, int64_t i) {
  const int64_t n = pushes->n_masses;
  const int64_t inside = i < 1 ? -i : i > n ? 2 * (n + 1) - i : i;
  const bool is_pushed = inside >= pushes->first && inside <= pushes->last;
  return is_pushed ? (i == inside ? 1.0 : -1.0) * pushes->push[inside] : 0.0;
}

/* K p at mass `i`, K = k1 L + k2 L² + k3 L³. */
static double pull_at(const Pushes* pushes, StringCoefs c, int64_t i) {
  const double p = push_at(pushes, i);
  const double p1 = push_at(pushes, i - 1) + push_at(pushes, i + 1);
  const double p2 = push_at(pushes, i - 2) + push_at(pushes, i + 2);
  const double p3 = push_at(pushes, i - 3) + push_at(pushes, i + 3);
  return c.k1 * (2.0 * p - p1) + c.k2 * (6.0 * p - 4.0 * p1 + p2) +
         c.k3 * (20.0 * p - 15.0 * p1 + 6.0 * p2 - p3);
}

/* Σ p (u + p/2) − ½ xᵀK p: what they add to the energy. */
static double energy_of(const Pushes* pushes, const Chain* chain) {
  const int64_t first = pushes->first > 3 ? pushes->first - 3 : 1;
  const int64_t last = pushes->last + 3 < pushes->n_masses ? pushes->last + 3 : pushes->n_masses;
  double energy = 0.0;
  for (int64_t i = first; i <= last; ++i) {
    const double p = push_at(pushes, i);
    const double x = (double)chain_position(chain, (uint32_t)i - 1);
    const double u = (double)chain_velocity(chain, (uint32_t)i - 1);
    energy += p * (u + 0.5 * p) - 0.5 * x * pull_at(pushes, chain->now, i);
  }
  return energy;
}

double pluck_add(Chain* chain, Pluck pluck, double angle1) {
  const double length = chain->n_masses + 1.0;
  const double width = fmax(
      PLUCK_NARROWEST, length * PLUCK_SOFTEST * pow(PLUCK_HARDEST / PLUCK_SOFTEST, pluck.hardness));
  const double centre = fmin(fmax(pluck.place * length, 1.0), (double)chain->n_masses);
  Pushes pushes;
  pushes.first = (int64_t)fmax(1.0, ceil(centre - width));
  pushes.last = (int64_t)fmin((double)chain->n_masses, floor(centre + width));
  pushes.n_masses = chain->n_masses;
  assert(pushes.first <= pushes.last);
  double sum = 0.0;
  for (int64_t i = pushes.first; i <= pushes.last; ++i) {
    pushes.push[i] = raised_cosine(((double)i - centre) / width);
    sum += pushes.push[i];
  }
  const double momentum = pluck.amplitude * length * (2.0 / PI) * sin(angle1);
  for (int64_t i = pushes.first; i <= pushes.last; ++i) {
    pushes.push[i] *= momentum / sum;
  }
  const double energy = energy_of(&pushes, chain);
  for (int64_t i = pushes.first; i <= pushes.last; ++i) {
    chain_push(chain, (uint32_t)i - 1, (float)pushes.push[i]);
  }
  return energy;
}
