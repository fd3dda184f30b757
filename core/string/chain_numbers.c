#include "core/string/chain_numbers.h"

#include "core/string/chain_fixed.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Damping g of the fundamental below which floats lose count: a time constant of 20,000 steps. */
static const double WEAK_DAMPING = 1e-4;

/* Noise up to which a string is put into fixed point, relative to the motion, and up to which it
 * is then left there. */
static const double QUIET = 3e-6;
static const double QUIET_ENOUGH = 4e-6;

/* How much too large or too small the numbers may be before they are scaled anew. */
static const double TOO_SMALL = 4.0;
static const double TOO_LARGE = 0.7;

static uint32_t n_cells_of(uint32_t n_masses, uint32_t n_lanes) {
  const uint32_t n_cells = (n_masses + n_lanes - 1) / n_lanes;
  return n_cells > CHAIN_LEAST_CELLS ? n_cells : CHAIN_LEAST_CELLS;
}

static size_t cells_size(uint32_t n_masses, size_t number_size) {
  return (size_t)n_cells_of(n_masses, CHAIN_MAX_LANES) * 2 * CHAIN_MAX_LANES * number_size;
}

size_t chain_numbers_size(uint32_t n_masses) {
  return cells_size(n_masses, sizeof(double)) + cells_size(n_masses, sizeof(float));
}

/* Where the masses are in `numbers`: doubles first, floats and fixed point behind them. */
static void point_to(Chain* chain, ChainNumbers numbers) {
  const bool is_behind = numbers != CHAIN_DOUBLE;
  const size_t offset = is_behind ? cells_size(chain->n_masses, sizeof(double)) : 0;
  chain->numbers = numbers;
  chain->loops = chain->kernel->loops[numbers];
  chain->cells = (char*)chain->memory + offset;
  chain->n_cells = n_cells_of(chain->n_masses, chain->loops->n_lanes);
}

void chain_numbers_lay(Chain* chain) {
  point_to(chain, CHAIN_FLOAT);
  chain_rest(chain);
}

size_t chain_numbers_offset(const Chain* chain, uint32_t i) {
  const size_t n_lanes = chain->loops->n_lanes;
  return (i % chain->n_cells) * 2 * n_lanes + i / chain->n_cells;
}

static double number(const Chain* chain, size_t offset) {
  switch (chain->numbers) {
  case CHAIN_DOUBLE:
    return ((const double*)chain->cells)[offset];
  case CHAIN_FIXED:
    return chain->gain * ((const int32_t*)chain->cells)[offset];
  default:
    return (double)((const float*)chain->cells)[offset];
  }
}

static void set_number(Chain* chain, size_t offset, double value) {
  assert(chain->numbers != CHAIN_FIXED);
  if (chain->numbers == CHAIN_DOUBLE) {
    ((double*)chain->cells)[offset] = value;
  } else {
    ((float*)chain->cells)[offset] = (float)value;
  }
}

double chain_numbers_position(const Chain* chain, uint32_t i) {
  return number(chain, chain_numbers_offset(chain, i));
}

double chain_numbers_velocity(const Chain* chain, uint32_t i) {
  const size_t offset = chain_numbers_offset(chain, i);
  const double u = number(chain, offset + chain->loops->n_lanes);
  return chain->numbers == CHAIN_FIXED
             ? u / chain->fade + (1.0 - 1.0 / chain->fade) * number(chain, offset)
             : u;
}

/* The masses of a lane follow each other from cell to cell. */
void chain_numbers_read(const Chain* chain, double* x, double* u) {
  const size_t n_lanes = chain->loops->n_lanes;
  uint32_t i = 0;
  for (size_t lane = 0; i < chain->n_masses; ++lane) {
    size_t offset = lane;
    for (uint32_t cell = 0; cell < chain->n_cells && i < chain->n_masses; ++cell, ++i) {
      x[i] = number(chain, offset);
      u[i] = number(chain, offset + n_lanes);
      offset += 2 * n_lanes;
    }
  }
  if (chain->numbers == CHAIN_FIXED) {
    for (i = 0; i < chain->n_masses; ++i) {
      u[i] = u[i] / chain->fade + (1.0 - 1.0 / chain->fade) * x[i];
    }
  }
}

void chain_numbers_add(Chain* chain, const double* x, const double* u) {
  const size_t n_lanes = chain->loops->n_lanes;
  uint32_t i = 0;
  for (size_t lane = 0; i < chain->n_masses; ++lane) {
    size_t offset = lane;
    for (uint32_t cell = 0; cell < chain->n_cells && i < chain->n_masses; ++cell, ++i) {
      set_number(chain, offset, number(chain, offset) + x[i]);
      set_number(chain, offset + n_lanes, number(chain, offset + n_lanes) + u[i]);
      offset += 2 * n_lanes;
    }
  }
}

void chain_numbers_place(Chain* chain, uint32_t i, double x, double u) {
  const size_t offset = chain_numbers_offset(chain, i);
  set_number(chain, offset, x);
  set_number(chain, offset + chain->loops->n_lanes, u);
}

ChainSums chain_numbers_sum(const Chain* chain) {
  const ChainSums sums = chain->loops->sum(chain->cells, chain->n_masses, chain->n_cells);
  if (chain->numbers != CHAIN_FIXED) {
    return sums;
  }
  /* u = gain (U/ρ + (1 − 1/ρ) X); in the last three the difference is too small to count. */
  const double square = chain->gain * chain->gain;
  const double of_u = 1.0 / chain->fade;
  const double of_x = 1.0 - of_u;
  return (ChainSums){
      .xx = square * sums.xx,
      .xu = square * (of_u * sums.xu + of_x * sums.xx),
      .uu = square * (of_u * (of_u * sums.uu + 2.0 * of_x * sums.xu) + of_x * of_x * sums.xx),
      .slope = square * sums.slope,
      .curvature = square * sums.curvature,
      .twist = square * sums.twist,
  };
}

/* Between floats and doubles. */
static void move_to(Chain* chain, ChainNumbers numbers) {
  const Chain from = *chain;
  point_to(chain, numbers);
  chain_rest(chain);
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    chain_numbers_place(chain, i, chain_numbers_position(&from, i),
                        chain_numbers_velocity(&from, i));
  }
}

static void leave_fixed(Chain* chain) {
  chain->loops->give(chain->cells, chain->n_cells, chain->gain, chain->fade);
  point_to(chain, CHAIN_FLOAT);
}

/* Not without end: chain_hold() comes here for CHAIN_FIXED, and is called for another. */
/* NOLINTNEXTLINE(misc-no-recursion) */
static void enter_fixed(Chain* chain, const ChainFixed* fixed) {
  chain_hold(chain, CHAIN_FLOAT);
  point_to(chain, CHAIN_FIXED);
  chain->gain = fixed->gain;
  chain->fade = fixed->fade;
  chain->fixed = fixed->coefs;
  chain->loops->take(chain->cells, chain->n_cells, chain->gain, chain->fade);
}

void chain_numbers_touch(Chain* chain) {
  if (chain->numbers == CHAIN_FIXED) {
    leave_fixed(chain);
  }
}

/* NOLINTNEXTLINE(misc-no-recursion) */
bool chain_hold(Chain* chain, ChainNumbers numbers) {
  if (numbers == CHAIN_FIXED) {
    ChainFixed fixed;
    const bool is_still = chain->n_gliding == 0;
    if (!is_still ||
        !chain_fixed_design(chain->now, chain->n_masses, chain_numbers_sum(chain), &fixed)) {
      return false;
    }
    enter_fixed(chain, &fixed);
    return true;
  }
  chain_numbers_touch(chain);
  if (chain->numbers != numbers) {
    move_to(chain, numbers);
  }
  return true;
}

void chain_settle(Chain* chain) {
  const double quiet = chain->numbers == CHAIN_FIXED ? QUIET_ENOUGH : QUIET;
  ChainFixed fixed;
  if (chain->n_gliding > 0) {
    return;
  }
  if (tuning_mode(chain->now, chain->n_masses, 1).g >= WEAK_DAMPING) {
    chain_hold(chain, CHAIN_FLOAT);
  } else if (chain->is_shared ||
             !chain_fixed_design(chain->now, chain->n_masses, chain_numbers_sum(chain), &fixed) ||
             !(fixed.noise <= quiet)) {
    chain_hold(chain, CHAIN_DOUBLE);
  } else if (chain->numbers != CHAIN_FIXED || chain->gain > TOO_SMALL * fixed.gain ||
             chain->gain < TOO_LARGE * fixed.gain) {
    enter_fixed(chain, &fixed);
  }
}
