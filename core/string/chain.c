#include "core/string/chain.h"

#include "core/string/chain_numbers.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Cells up to which a chain leaves room for another to be stepped beside it. */
enum { SHORT_CELLS = 16 };

/* The coefficients have come to their goal. */
static void arrive(Chain* chain) {
  chain->now = chain->goal;
  chain->n_gliding = 0;
}

static ChainReader reader_of(const Chain* chain, ChainTap tap) {
  return (ChainReader){
      .offset = {chain_numbers_offset(chain, tap.mass[0]),
                 chain_numbers_offset(chain, tap.mass[1])},
      .weight = {tap.weight[0], tap.weight[1]},
  };
}

/* Where the dampers of a string sit that stands still. */
static ChainDamping damping_of(StringCoefs c) {
  return c.z1 != 0.0 ? CHAIN_BETWEEN : c.z0 != 0.0 ? CHAIN_GROUND : CHAIN_UNDAMPED;
}

static ChainElasticity elasticity_of(StringCoefs c) {
  return c.k3 != 0.0 ? CHAIN_STRAIGHTENED : c.k2 != 0.0 ? CHAIN_BENDING : CHAIN_FLEXIBLE;
}

ChainLoop chain_loop(const Chain* chain, uint32_t n_taps) {
  const bool is_moving = chain->n_gliding > 0;
  ChainDamping damping = damping_of(chain->now);
  ChainElasticity elasticity = elasticity_of(chain->now);
  if (is_moving) {
    const ChainElasticity to = elasticity_of(chain->goal);
    damping = CHAIN_BETWEEN;
    elasticity = elasticity > to ? elasticity : to;
  }
  const ChainLoop loop = chain->loops->loops[damping][elasticity][is_moving][n_taps];
  assert(loop);
  return loop;
}

size_t chain_size(uint32_t n_masses) {
  return chain_numbers_size(n_masses);
}

void chain_init(Chain* chain, const ChainKernel* kernel, void* memory, uint32_t n_masses) {
  assert(n_masses >= 1 && n_masses <= CHAIN_MAX_MASSES);
  *chain = (Chain){.kernel = kernel, .memory = memory, .n_masses = n_masses};
  chain_numbers_lay(chain);
}

void chain_rest(Chain* chain) {
  const size_t n_numbers = (size_t)chain->n_cells * 2 * chain->loops->n_lanes;
  memset(chain->cells, 0, n_numbers * chain->loops->number_size);
}

void chain_set(Chain* chain, StringCoefs coefs) {
  chain_numbers_touch(chain);
  chain->goal = coefs;
  arrive(chain);
}

static bool is_same(StringCoefs a, StringCoefs b) {
  return a.k1 == b.k1 && a.k2 == b.k2 && a.k3 == b.k3 && a.z0 == b.z0 && a.z1 == b.z1;
}

void chain_glide(Chain* chain, StringCoefs coefs, uint32_t n_frames) {
  if (chain->n_gliding == 0 && is_same(coefs, chain->now)) {
    return;
  }
  if (n_frames == 0) {
    chain_set(chain, coefs);
    return;
  }
  const double share = 1.0 / n_frames;
  chain_numbers_touch(chain);
  chain->goal = coefs;
  chain->n_gliding = n_frames;
  chain->change = (StringCoefs){
      .k1 = (coefs.k1 - chain->now.k1) * share,
      .k2 = (coefs.k2 - chain->now.k2) * share,
      .k3 = (coefs.k3 - chain->now.k3) * share,
      .z0 = (coefs.z0 - chain->now.z0) * share,
      .z1 = (coefs.z1 - chain->now.z1) * share,
  };
}

float chain_position(const Chain* chain, uint32_t i) {
  return (float)chain_numbers_position(chain, i);
}

float chain_velocity(const Chain* chain, uint32_t i) {
  return (float)chain_numbers_velocity(chain, i);
}

void chain_place(Chain* chain, uint32_t i, float x, float u) {
  chain_numbers_touch(chain);
  chain_numbers_place(chain, i, (double)x, (double)u);
}

void chain_push(Chain* chain, uint32_t i, float u) {
  chain_numbers_touch(chain);
  chain_numbers_place(chain, i, chain_numbers_position(chain, i),
                      chain_numbers_velocity(chain, i) + (double)u);
}

double chain_amplitude(const Chain* chain, double a1) {
  const ChainSums sums = chain_numbers_sum(chain);
  const bool is_moving = a1 < 4.0;
  const double energy = is_moving ? sums.xx - sums.xu + sums.uu / a1 : sums.xx;
  const double half_step = is_moving ? 1.0 - 0.25 * a1 : 1.0;
  return sqrt(2.0 * energy / (half_step * (chain->n_masses + 1.0)));
}

/* Past a wall the string goes on upside down. */
static double position_at(const Chain* chain, int64_t i) {
  const int64_t n = chain->n_masses;
  const int64_t inside = i < 0 ? -2 - i : i >= n ? 2 * n - i : i;
  const bool is_mass = inside >= 0 && inside < n;
  return is_mass ? (i == inside ? 1.0 : -1.0) * chain_numbers_position(chain, (uint32_t)inside)
                 : 0.0;
}

double chain_energy(const Chain* chain) {
  const StringCoefs c = chain->now;
  double twice = 0.0;
  for (int64_t i = 0; i < chain->n_masses; ++i) {
    const double x = position_at(chain, i);
    const double u = chain_numbers_velocity(chain, (uint32_t)i);
    const double x1 = position_at(chain, i - 1) + position_at(chain, i + 1);
    const double x2 = position_at(chain, i - 2) + position_at(chain, i + 2);
    const double x3 = position_at(chain, i - 3) + position_at(chain, i + 3);
    const double pull = c.k1 * (2.0 * x - x1) + c.k2 * (6.0 * x - 4.0 * x1 + x2) +
                        c.k3 * (20.0 * x - 15.0 * x1 + 6.0 * x2 - x3);
    twice += u * u + pull * (x - u);
  }
  return 0.5 * twice;
}

void chain_share(Chain* chain, bool is_shared) {
  chain->is_shared = is_shared;
  if (is_shared) {
    chain_numbers_touch(chain);
  }
}

uint32_t chain_stretch(const Chain* chain) {
  return chain->n_gliding > 0 ? chain->n_gliding : UINT32_MAX;
}

ChainWork chain_work(const ChainPart* part, uint32_t n_taps) {
  Chain* const chain = part->chain;
  ChainWork work = {
      .cells = chain->cells,
      .n_masses = chain->n_masses,
      .n_cells = chain->n_cells,
      .now = chain->numbers == CHAIN_FIXED ? &chain->fixed : &chain->now,
      .change = chain->change,
      .gain = &chain->gain,
      .fade = chain->fade,
      .chance = &chain->chance,
  };
  for (uint32_t t = 0; t < n_taps; ++t) {
    work.readers[t] = reader_of(chain, part->taps[t]);
  }
  return work;
}

void chain_pass(Chain* chain, uint32_t n_frames) {
  if (chain->n_gliding > 0) {
    chain->n_gliding -= n_frames;
    if (chain->n_gliding == 0) {
      arrive(chain);
    }
  }
}

void chain_run_all(const ChainPart* parts,
                   uint32_t n_parts,
                   uint32_t n_frames,
                   uint32_t n_taps,
                   float* const* out) {
  ChainWork batch[CHAIN_MAX_BATCH];
  for (uint32_t first = 0; first < n_parts;) {
    const ChainLoop loop = chain_loop(parts[first].chain, n_taps);
    uint32_t n = 0;
    do {
      batch[n] = chain_work(&parts[first + n], n_taps);
      ++n;
    } while (n < CHAIN_MAX_BATCH && first + n < n_parts && batch[n - 1].n_cells <= SHORT_CELLS &&
             chain_loop(parts[first + n].chain, n_taps) == loop);
    loop(batch, n, n_frames, out);
    for (uint32_t w = 0; w < n; ++w) {
      chain_pass(parts[first + w].chain, n_frames);
    }
    first += n;
  }
}

void chain_run(
    Chain* chain, uint32_t n_frames, const ChainTap* taps, uint32_t n_taps, float* const* out) {
  ChainPart part = {.chain = chain};
  float* rest[CHAIN_MAX_TAPS];
  for (uint32_t t = 0; t < n_taps; ++t) {
    part.taps[t] = taps[t];
    rest[t] = out[t];
  }
  while (n_frames > 0) {
    const uint32_t stretch = chain_stretch(chain);
    const uint32_t n = stretch < n_frames ? stretch : n_frames;
    chain_run_all(&part, 1, n, n_taps, rest);
    for (uint32_t t = 0; t < n_taps; ++t) {
      rest[t] += n;
    }
    n_frames -= n;
  }
}
