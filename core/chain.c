#include "core/chain.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/*
  Damping g of the fundamental below which sums are compensated.  Rounding was measured to change
  what a step takes from the amplitude, g/2, by 1e-10 at the most: 1 part in 10,000 of this.
*/
static const double EXACT_BELOW = 2e-6;

/* Where the position of a mass is among the floats of the cells; its velocity is one vector on. */
static size_t offset_of(const Chain* chain, uint32_t i) {
  const size_t n_lanes = chain->kernel->n_lanes;
  return (i % chain->n_cells) * 2 * n_lanes + i / chain->n_cells;
}

static size_t n_floats(const Chain* chain) {
  return (size_t)chain->n_cells * 2 * chain->kernel->n_lanes;
}

static ChainCoefs narrow(StringCoefs coefs) {
  return (ChainCoefs){(float)coefs.k1, (float)coefs.k2, (float)coefs.z0, (float)coefs.z1};
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
  const bool is_bending = chain->now.k2 != 0.0f || (is_moving && chain->goal.k2 != 0.0f);
  const ChainMode mode = is_moving ? CHAIN_MOVING : chain->is_exact ? CHAIN_EXACT : CHAIN_STILL;
  const ChainLoop loop = chain->kernel->loops[is_bending][mode][n_taps];
  assert(loop);
  return loop;
}

static float* residues(const Chain* chain) {
  return chain->cells + n_floats(chain);
}

/* The coefficients have come to their goal. */
static void settle(Chain* chain) {
  const double lambda1 = tuning_lambda(chain->n_masses, 1);
  chain->now = chain->goal;
  chain->n_gliding = 0;
  chain->is_exact = (double)chain->goal.z0 + (double)chain->goal.z1 * lambda1 < EXACT_BELOW;
  memset(residues(chain), 0, n_floats(chain) * sizeof(float));
}

size_t chain_floats(uint32_t n_masses) {
  const size_t n_cells = ((size_t)n_masses + CHAIN_MAX_LANES - 1) / CHAIN_MAX_LANES;
  return n_cells * 4 * CHAIN_MAX_LANES;
}

void chain_init(Chain* chain, const ChainKernel* kernel, float* cells, uint32_t n_masses) {
  assert(n_masses >= 1 && n_masses <= CHAIN_MAX_MASSES);
  *chain = (Chain){
      .kernel = kernel,
      .cells = cells,
      .n_masses = n_masses,
      .n_cells = (n_masses + kernel->n_lanes - 1) / kernel->n_lanes,
  };
  chain_rest(chain);
}

void chain_rest(Chain* chain) {
  memset(chain->cells, 0, 2 * n_floats(chain) * sizeof(float));
}

void chain_set(Chain* chain, StringCoefs coefs) {
  chain->goal = narrow(coefs);
  settle(chain);
}

void chain_glide(Chain* chain, StringCoefs coefs, uint32_t n_frames) {
  if (n_frames == 0) {
    chain_set(chain, coefs);
    return;
  }
  const float share = 1.0f / (float)n_frames;
  chain->goal = narrow(coefs);
  chain->n_gliding = n_frames;
  chain->change = (ChainCoefs){
      .k1 = (chain->goal.k1 - chain->now.k1) * share,
      .k2 = (chain->goal.k2 - chain->now.k2) * share,
      .z0 = (chain->goal.z0 - chain->now.z0) * share,
      .z1 = (chain->goal.z1 - chain->now.z1) * share,
  };
}

float chain_position(const Chain* chain, uint32_t i) {
  return chain->cells[offset_of(chain, i)];
}

float chain_velocity(const Chain* chain, uint32_t i) {
  return chain->cells[offset_of(chain, i) + chain->kernel->n_lanes];
}

void chain_place(Chain* chain, uint32_t i, float x, float u) {
  chain->cells[offset_of(chain, i)] = x;
  chain->cells[offset_of(chain, i) + chain->kernel->n_lanes] = u;
}

void chain_push(Chain* chain, uint32_t i, float u) {
  chain->cells[offset_of(chain, i) + chain->kernel->n_lanes] += u;
}

double chain_amplitude(const Chain* chain, double a1) {
  double xx = 0.0;
  double uu = 0.0;
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const double x = chain_position(chain, i);
    const double u = chain_velocity(chain, i);
    xx += x * x;
    uu += u * u;
  }
  return sqrt(2.0 * (xx + uu / a1) / (chain->n_masses + 1.0));
}

/* Run on until the coefficients are there, or the frames are over; the frames that were run. */
static uint32_t run_stretch(Chain* chain, ChainWork work, uint32_t n_taps) {
  const bool is_moving = chain->n_gliding > 0;
  if (is_moving && chain->n_gliding < work.n_frames) {
    work.n_frames = chain->n_gliding;
  }
  loop_of(chain, n_taps)(work);
  if (is_moving) {
    chain->n_gliding -= work.n_frames;
    if (chain->n_gliding == 0) {
      settle(chain);
    }
  }
  return work.n_frames;
}

void chain_run(
    Chain* chain, uint32_t n_frames, const ChainTap* taps, uint32_t n_taps, float* const* out) {
  ChainReader readers[CHAIN_MAX_TAPS];
  float* rest[CHAIN_MAX_TAPS];
  for (uint32_t t = 0; t < n_taps; ++t) {
    readers[t] = reader_of(chain, taps[t]);
    rest[t] = out[t];
  }
  for (uint32_t done = 0; done < n_frames;) {
    const uint32_t n = run_stretch(chain,
                                   (ChainWork){
                                       .cells = chain->cells,
                                       .residues = residues(chain),
                                       .n_masses = chain->n_masses,
                                       .n_cells = chain->n_cells,
                                       .n_frames = n_frames - done,
                                       .now = &chain->now,
                                       .change = chain->change,
                                       .readers = readers,
                                       .out = rest,
                                   },
                                   n_taps);
    for (uint32_t t = 0; t < n_taps; ++t) {
      rest[t] += n;
    }
    done += n;
  }
}
