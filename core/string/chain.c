#include "core/string/chain.h"

#include "core/string/chain_numbers.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Cells up to which a chain leaves room for another to be stepped beside it. */
enum { SHORT_CELLS = 16 };

/* Change of k1, relative, up to which a glide may as well go in even steps. */
static const double LEAST_HASTE = 1e-4;

/* The coefficients have come to their goal. */
static void arrive(Chain* chain) {
  chain->now = chain->goal;
  chain->n_gliding = 0;
  chain->kept = 1.0;
}

/* In fixed point u = gain (U + (ρ − 1) X)/ρ. */
static ChainReader reader_of(const Chain* chain, ChainTap tap) {
  const size_t of_u = tap.is_velocity ? chain->loops->n_lanes : 0;
  ChainReader reader = {
      .offset = {chain_numbers_offset(chain, tap.mass[0]) + of_u,
                 chain_numbers_offset(chain, tap.mass[1]) + of_u},
      .weight = {tap.weight[0], tap.weight[1]},
  };
  if (tap.is_velocity && chain->numbers == CHAIN_FIXED) {
    reader.weight[0] = (float)((double)tap.weight[0] / chain->fade);
    reader.weight[1] = (float)((double)tap.weight[1] / chain->fade);
    reader.lean = (float)(chain->fade - 1.0);
  }
  return reader;
}

/* Where the dampers of a string sit that stands still. */
static ChainDamping damping_of(StringCoefs c) {
  return c.z1 != 0.0 ? CHAIN_BETWEEN : c.z0 != 0.0 ? CHAIN_GROUND : CHAIN_UNDAMPED;
}

static ChainElasticity elasticity_of(StringCoefs c) {
  return c.k3 != 0.0 ? CHAIN_STRAIGHTENED : c.k2 != 0.0 ? CHAIN_BENDING : CHAIN_FLEXIBLE;
}

uint32_t chain_taps(uint32_t n_taps) {
  return n_taps <= 2 ? n_taps : n_taps <= 4 ? 4 : 6;
}

ChainLoop chain_loop(const Chain* chain, uint32_t n_taps) {
  const bool is_moving = chain->n_gliding > 0;
  ChainDamping damping = n_taps > 4 ? CHAIN_BETWEEN : damping_of(chain->now);
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
  *chain = (Chain){.kernel = kernel,
                   .memory = memory,
                   .n_masses = n_masses,
                   .lambda1 = tuning_lambda(n_masses, 1),
                   .kept = 1.0};
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

/* By how much a glide's steps grow, from one to the next, for the pitch to move evenly.  What is
 * tied to others goes in even steps, as its tie does. */
static double haste_of(const Chain* chain, StringCoefs goal, uint32_t n_frames) {
  const bool is_even = chain->is_shared || !(goal.k1 > 0.0 && chain->now.k1 > 0.0);
  return is_even ? 1.0 : pow(goal.k1 / chain->now.k1, 1.0 / n_frames);
}

static void set_out(Chain* chain, StringCoefs coefs, uint32_t n_frames) {
  const double haste = haste_of(chain, coefs, n_frames);
  const double more = haste - 1.0;
  const bool is_even = fabs(more * n_frames) < LEAST_HASTE;
  const double share = is_even ? 1.0 / n_frames : more / (coefs.k1 / chain->now.k1 - 1.0);
  chain_numbers_touch(chain);
  chain->goal = coefs;
  chain->n_gliding = n_frames;
  chain->kept = 1.0;
  chain->haste = is_even ? 1.0 : haste;
  chain->change = (StringCoefs){
      .k1 = (coefs.k1 - chain->now.k1) * share,
      .k2 = (coefs.k2 - chain->now.k2) * share,
      .k3 = (coefs.k3 - chain->now.k3) * share,
      .z0 = (coefs.z0 - chain->now.z0) * share,
      .z1 = (coefs.z1 - chain->now.z1) * share,
  };
}

void chain_glide(Chain* chain, StringCoefs coefs, uint32_t n_frames) {
  if (chain->n_gliding > 0 || !is_same(coefs, chain->now)) {
    set_out(chain, coefs, n_frames > 0 ? n_frames : 1);
  }
}

void chain_drain(Chain* chain, double share, uint32_t n_frames) {
  if (chain->n_gliding == 0) {
    set_out(chain, chain->now, n_frames > 0 ? n_frames : 1);
  }
  chain->kept = pow(share, 0.5 / chain->n_gliding);
}

double chain_pace(const Chain* chain) {
  return chain_pace_of(chain->now, chain->lambda1);
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

void chain_add(Chain* chain, const double* x, const double* u) {
  chain_numbers_touch(chain);
  chain_numbers_add(chain, x, u);
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

/* A field over the string, from [REACH] on; past a wall it goes on upside down. */
enum { REACH = 3 };
typedef double Field[CHAIN_MAX_MASSES + 2 * REACH];

static void mirror(Field field, uint32_t n_masses) {
  double* const wall = field + REACH - 1;
  double* const far = field + REACH + n_masses;
  *wall = 0.0;
  *far = 0.0;
  for (uint32_t i = 1; i < REACH; ++i) {
    wall[-(int)i] = -wall[i];
    far[i] = -far[-(int)i];
  }
}

double chain_energy(const Chain* chain) {
  const StringCoefs c = chain->now;
  const double at = 2.0 * c.k1 + 6.0 * c.k2 + 20.0 * c.k3;
  const double beside = c.k1 + 4.0 * c.k2 + 15.0 * c.k3;
  const double farther = c.k2 + 6.0 * c.k3;
  double twice = 0.0;
  Field field;
  double velocities[CHAIN_MAX_MASSES];
  double* const x = field + REACH;
  chain_numbers_read(chain, x, velocities);
  mirror(field, chain->n_masses);
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const double* const y = x + i;
    const double u = velocities[i];
    const double pull =
        at * y[0] - beside * (y[-1] + y[1]) + farther * (y[-2] + y[2]) - c.k3 * (y[-3] + y[3]);
    twice += u * u + pull * (y[0] - u);
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
      .change = &chain->change,
      .haste = chain->haste,
      .lambda1 = chain->lambda1,
      .kept = chain->kept,
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
