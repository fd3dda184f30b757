#include "tests/support/chains.h"

#include "core/string/chain_numbers.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const uint32_t big_sizes[] = {127, 128, 129, 255, 256, 257, 1023, 1024};

uint32_t chains_size(uint32_t i) {
  return i < CHAINS_N_SMALL ? i + 1 : big_sizes[i - CHAINS_N_SMALL];
}

StringCoefs chains_coefs(ChainDamping damping, ChainElasticity elasticity) {
  static const double k1[] = {0.9, 0.15, 0.3};
  static const double k2[] = {0.0, 0.19, 0.07};
  static const double k3[] = {0.0, 0.0, 0.02};
  static const double z0[] = {0.0, 1.7e-3, 1e-5};
  static const double z1[] = {0.0, 0.0, 2.3e-3};
  return (StringCoefs){
      .k1 = k1[elasticity],
      .k2 = k2[elasticity],
      .k3 = k3[elasticity],
      .z0 = z0[damping],
      .z1 = z1[damping],
  };
}

StringCoefs chains_rounded(StringCoefs coefs) {
  return (StringCoefs){
      .k1 = (double)(float)coefs.k1,
      .k2 = (double)(float)coefs.k2,
      .k3 = (double)(float)coefs.k3,
      .z0 = (double)(float)coefs.z0,
      .z1 = (double)(float)coefs.z1,
  };
}

StringCoefs chains_seen(const Chain* chain) {
  switch (chain->numbers) {
  case CHAIN_DOUBLE:
    return chain->now;
  case CHAIN_FIXED:
    return chains_rounded(chain->fixed);
  default:
    return chains_rounded(chain->now);
  }
}

size_t chains_n_numbers(const Chain* chain) {
  return (size_t)chain->n_cells * 2 * chain->loops->n_lanes;
}

double chains_number(const Chain* chain, size_t m) {
  switch (chain->numbers) {
  case CHAIN_DOUBLE:
    return ((const double*)chain->cells)[m];
  case CHAIN_FIXED:
    return ((const int32_t*)chain->cells)[m];
  default:
    return (double)((const float*)chain->cells)[m];
  }
}

void chains_read(const Chain* chain, double* x, double* u) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const size_t m = chain_numbers_offset(chain, i);
    x[i] = chains_number(chain, m);
    u[i] = chains_number(chain, m + chain->loops->n_lanes);
  }
}

void chains_place_noise(Chain* chain, Random* random) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    chain_place(chain, i, (float)random_between(random, -1.0, 1.0),
                (float)random_between(random, -1.0, 1.0));
  }
}

void chains_start(Chain* chain,
                  const ChainKernel* kernel,
                  void* memory,
                  ChainNumbers numbers,
                  ChainDamping damping,
                  ChainElasticity elasticity,
                  uint32_t n) {
  Random random = {.state = n};
  StringCoefs coefs = chains_coefs(damping, elasticity);
  if (numbers == CHAIN_FIXED) {
    coefs.z0 = 5e-6;
  }
  chain_init(chain, kernel, memory, n);
  chain_set(chain, coefs);
  chains_place_noise(chain, &random);
  assert_true(chain_hold(chain, numbers));
  assert_int_equal(chain->numbers, numbers);
  if (numbers == CHAIN_FIXED && damping == CHAIN_UNDAMPED) {
    chain->now.z0 = 0.0;
    chain->fade = 1.0;
  }
}

void chains_run(Chain* chain, uint32_t n_frames) {
  enum { BLOCK = 4096 };
  static float sink[BLOCK];
  static const ChainTap nowhere = {{0, 0}, {0.0f, 0.0f}, false};
  float* const out[] = {sink};
  for (uint32_t done = 0; done < n_frames; done += BLOCK) {
    chain_run(chain, n_frames - done < BLOCK ? n_frames - done : BLOCK, &nowhere, 1, out);
  }
}

double chains_largest(const double* x, uint32_t n) {
  double most = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    most = fmax(most, fabs(x[i]));
  }
  return most;
}

double chains_distance(const double* x, const double* y, uint32_t n) {
  double most = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    most = fmax(most, fabs(x[i] - y[i]));
  }
  return most;
}
