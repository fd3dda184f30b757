#include "core/chain.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Damping g of the fundamental below which a string is stepped in doubles: a time constant of
 * 20,000 steps. */
static const double WEAK_DAMPING = 1e-4;

/* Cells up to which a chain leaves room for another to be stepped beside it. */
enum { SHORT_CELLS = 16 };

/* Where a mass is among the numbers of the cells: its position, and one vector on its velocity. */
static size_t offset_of(const Chain* chain, uint32_t i) {
  const size_t n_lanes = chain->loops->n_lanes;
  return (i % chain->n_cells) * 2 * n_lanes + i / chain->n_cells;
}

static bool is_in_double(const Chain* chain) {
  return chain->loops == chain->kernel->in_double;
}

static double number(const Chain* chain, size_t offset) {
  return is_in_double(chain) ? ((const double*)chain->cells)[offset]
                             : (double)((const float*)chain->cells)[offset];
}

static void set_number(Chain* chain, size_t offset, double value) {
  if (is_in_double(chain)) {
    ((double*)chain->cells)[offset] = value;
  } else {
    ((float*)chain->cells)[offset] = (float)value;
  }
}

static double position(const Chain* chain, uint32_t i) {
  return number(chain, offset_of(chain, i));
}

static double velocity(const Chain* chain, uint32_t i) {
  return number(chain, offset_of(chain, i) + chain->loops->n_lanes);
}

static void place(Chain* chain, uint32_t i, double x, double u) {
  set_number(chain, offset_of(chain, i), x);
  set_number(chain, offset_of(chain, i) + chain->loops->n_lanes, u);
}

static size_t cells_size(uint32_t n_masses, size_t number_size) {
  const size_t n_cells = ((size_t)n_masses + CHAIN_MAX_LANES - 1) / CHAIN_MAX_LANES;
  return n_cells * 2 * CHAIN_MAX_LANES * number_size;
}

/* Lay the masses, at rest, where those of a precision are: doubles first, floats behind them. */
static void lay(Chain* chain, const ChainLoops* loops) {
  const bool is_behind = loops == chain->kernel->in_float;
  const size_t offset = is_behind ? cells_size(chain->n_masses, sizeof(double)) : 0;
  chain->loops = loops;
  chain->cells = (char*)chain->memory + offset;
  chain->n_cells = (chain->n_masses + loops->n_lanes - 1) / loops->n_lanes;
  chain_rest(chain);
}

/* The coefficients have come to their goal: take the precision that they want, the motion with it.
 */
static void settle(Chain* chain) {
  const double g1 = tuning_mode(chain->goal, chain->n_masses, 1).g;
  const ChainLoops* const loops =
      g1 < WEAK_DAMPING ? chain->kernel->in_double : chain->kernel->in_float;
  chain->now = chain->goal;
  chain->n_gliding = 0;
  if (loops != chain->loops) {
    const Chain before = *chain;
    lay(chain, loops);
    for (uint32_t i = 0; i < chain->n_masses; ++i) {
      place(chain, i, position(&before, i), velocity(&before, i));
    }
  }
}

static ChainReader reader_of(const Chain* chain, ChainTap tap) {
  return (ChainReader){
      .offset = {offset_of(chain, tap.mass[0]), offset_of(chain, tap.mass[1])},
      .weight = {tap.weight[0], tap.weight[1]},
  };
}

/* The loop for what the string is now: nothing that it does not need is in it. */
static ChainLoop loop_of(const Chain* chain, uint32_t n_taps) {
  const bool is_moving = chain->n_gliding > 0;
  const bool is_bending = chain->now.k2 != 0.0 || (is_moving && chain->goal.k2 != 0.0);
  const ChainLoop loop = chain->loops->loops[is_bending][is_moving][n_taps];
  assert(loop);
  return loop;
}

size_t chain_size(uint32_t n_masses) {
  return cells_size(n_masses, sizeof(double)) + cells_size(n_masses, sizeof(float));
}

void chain_init(Chain* chain, const ChainKernel* kernel, void* memory, uint32_t n_masses) {
  assert(n_masses >= 1 && n_masses <= CHAIN_MAX_MASSES);
  *chain = (Chain){.kernel = kernel, .memory = memory, .n_masses = n_masses};
  lay(chain, kernel->in_float);
}

void chain_rest(Chain* chain) {
  const size_t n_numbers = (size_t)chain->n_cells * 2 * chain->loops->n_lanes;
  memset(chain->cells, 0, n_numbers * chain->loops->number_size);
}

void chain_set(Chain* chain, StringCoefs coefs) {
  chain->goal = coefs;
  settle(chain);
}

void chain_glide(Chain* chain, StringCoefs coefs, uint32_t n_frames) {
  if (n_frames == 0) {
    chain_set(chain, coefs);
    return;
  }
  const double share = 1.0 / n_frames;
  chain->goal = coefs;
  chain->n_gliding = n_frames;
  chain->change = (StringCoefs){
      .k1 = (coefs.k1 - chain->now.k1) * share,
      .k2 = (coefs.k2 - chain->now.k2) * share,
      .z0 = (coefs.z0 - chain->now.z0) * share,
      .z1 = (coefs.z1 - chain->now.z1) * share,
  };
}

float chain_position(const Chain* chain, uint32_t i) {
  return (float)position(chain, i);
}

float chain_velocity(const Chain* chain, uint32_t i) {
  return (float)velocity(chain, i);
}

void chain_place(Chain* chain, uint32_t i, float x, float u) {
  place(chain, i, (double)x, (double)u);
}

void chain_push(Chain* chain, uint32_t i, float u) {
  place(chain, i, position(chain, i), velocity(chain, i) + (double)u);
}

double chain_amplitude(const Chain* chain, double a1) {
  const bool is_moving = a1 < 4.0;
  double energy = 0.0;
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const double x = position(chain, i);
    const double u = is_moving ? velocity(chain, i) : 0.0;
    energy += x * (x - u) + u * u / a1;
  }
  const double half_step = is_moving ? 1.0 - 0.25 * a1 : 1.0;
  return sqrt(2.0 * energy / (half_step * (chain->n_masses + 1.0)));
}

uint32_t chain_stretch(const Chain* chain) {
  return chain->n_gliding > 0 ? chain->n_gliding : UINT32_MAX;
}

static ChainWork work_of(const ChainPart* part, uint32_t n_taps) {
  Chain* const chain = part->chain;
  ChainWork work = {
      .cells = chain->cells,
      .n_masses = chain->n_masses,
      .n_cells = chain->n_cells,
      .now = &chain->now,
      .change = chain->change,
  };
  for (uint32_t t = 0; t < n_taps; ++t) {
    work.readers[t] = reader_of(chain, part->taps[t]);
  }
  return work;
}

/* A glide that ends with these frames leaves the chain where it was going. */
static void finish(Chain* chain, uint32_t n_frames) {
  if (chain->n_gliding > 0) {
    chain->n_gliding -= n_frames;
    if (chain->n_gliding == 0) {
      settle(chain);
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
    const ChainLoop loop = loop_of(parts[first].chain, n_taps);
    uint32_t n = 0;
    do {
      batch[n] = work_of(&parts[first + n], n_taps);
      ++n;
    } while (n < CHAIN_MAX_BATCH && first + n < n_parts && batch[n - 1].n_cells <= SHORT_CELLS &&
             loop_of(parts[first + n].chain, n_taps) == loop);
    loop(batch, n, n_frames, out);
    for (uint32_t w = 0; w < n; ++w) {
      finish(parts[first + w].chain, n_frames);
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
