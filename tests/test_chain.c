#include "core/chain.h"

#include "tests/oracle.h"
#include "tests/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_FRAMES = 4096, MOST_DENSE = 64 };

/* Every way in which masses can fill the lanes, and the largest strings. */
static const uint32_t big_sizes[] = {127, 128, 129, 255, 256, 257, 1023, 1024};
enum { SMALL_SIZES = 70, N_SIZES = SMALL_SIZES + 8 };

static uint32_t size_of(uint32_t i) {
  return i < SMALL_SIZES ? i + 1 : big_sizes[i - SMALL_SIZES];
}

static const ChainTap no_tap = {{0, 0}, {0.0f, 0.0f}};

/* Cells for the largest string, and what lies behind them. */
static _Alignas(CHAIN_ALIGNMENT) float cells[4 * CHAIN_MAX_MASSES];
static float sink[MOST_FRAMES];

static void run_silently(Chain* chain, uint32_t n_frames) {
  float* const out[] = {sink};
  chain_run(chain, n_frames, &no_tap, 1, out);
}

/* A string near its limit with all that a string can have, or without some of it. */
static StringCoefs coefs_of(bool is_bending, bool is_damped) {
  const double k2 = is_bending ? 0.19 : 0.0;
  return (StringCoefs){
      .k1 = is_bending ? 0.15 : 0.9,
      .k2 = k2,
      .z0 = is_damped ? 1.7e-3 : 0.0,
      .z1 = is_damped ? 2.3e-3 : 0.0,
  };
}

/* The coefficients as the loop has them. */
static StringCoefs rounded(StringCoefs coefs) {
  return (StringCoefs){(float)coefs.k1, (float)coefs.k2, (float)coefs.z0, (float)coefs.z1};
}

static void place_noise(Chain* chain, Random* random, double* x, double* u) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    chain_place(chain, i, (float)random_between(random, -1.0, 1.0),
                (float)random_between(random, -1.0, 1.0));
    x[i] = chain_position(chain, i);
    u[i] = chain_velocity(chain, i);
  }
}

static double largest(const double* x, uint32_t n) {
  double most = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    most = fmax(most, fabs(x[i]));
  }
  return most;
}

/* How far the chain is from the oracle after `n_frames` steps from noise, over its motion. */
static double
distance_from_oracle(Chain* chain, StringCoefs coefs, uint32_t n_frames, Random* random) {
  static double x[CHAIN_MAX_MASSES];
  static double u[CHAIN_MAX_MASSES];
  double worst = 0.0;
  chain_set(chain, coefs);
  place_noise(chain, random, x, u);
  run_silently(chain, n_frames);
  for (uint32_t n = 0; n < n_frames; ++n) {
    oracle_step(rounded(coefs), chain->n_masses, x, u);
  }
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    worst = fmax(worst, fabs(x[i] - (double)chain_position(chain, i)));
    worst = fmax(worst, fabs(u[i] - (double)chain_velocity(chain, i)));
  }
  return worst / fmax(largest(x, chain->n_masses), largest(u, chain->n_masses));
}

static void every_layout_is_the_same_string(void** state) {
  (void)state;
  enum { FRAMES = 300 };
  Random random = random_start();
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    double worst = 0.0;
    for (uint32_t size = 0; size < N_SIZES; ++size) {
      for (int scene = 0; scene < 4; ++scene) {
        Chain chain;
        chain_init(&chain, chain_kernel(kernel), cells, size_of(size));
        const StringCoefs coefs = coefs_of(scene & 1, scene & 2);
        worst = fmax(worst, distance_from_oracle(&chain, coefs, FRAMES, &random));
      }
    }
    /* 300 steps that each round at a few places, all to the worse. */
    assert_within(chain_kernel(kernel)->name, worst, 300.0 * 4.0 * 0.5 * (double)FLT_EPSILON);
  }
}

static void kernels_agree(void** state) {
  (void)state;
  static _Alignas(CHAIN_ALIGNMENT) float other_cells[4 * CHAIN_MAX_MASSES];
  double worst = 0.0;
  Random random = random_start();
  for (uint32_t size = 0; size < N_SIZES && chain_kernel(1); ++size) {
    double x[CHAIN_MAX_MASSES];
    double u[CHAIN_MAX_MASSES];
    Chain one;
    Chain other;
    chain_init(&one, chain_kernel(0), cells, size_of(size));
    chain_init(&other, chain_kernel(1), other_cells, size_of(size));
    chain_set(&one, coefs_of(true, true));
    chain_set(&other, coefs_of(true, true));
    place_noise(&one, &random, x, u);
    for (uint32_t i = 0; i < one.n_masses; ++i) {
      chain_place(&other, i, (float)x[i], (float)u[i]);
    }
    run_silently(&one, 300);
    run_silently(&other, 300);
    for (uint32_t i = 0; i < one.n_masses; ++i) {
      const double difference = (double)chain_position(&one, i) - (double)chain_position(&other, i);
      worst = fmax(worst, fabs(difference));
    }
  }
  assert_within("positions up to 2, 300 steps", worst, 2.0 * 300.0 * 4.0 * (double)FLT_EPSILON);
}

static void read_state(const Chain* chain, double* x, double* u) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    x[i] = chain_position(chain, i);
    u[i] = chain_velocity(chain, i);
  }
}

/* The largest change of energy plus what the dampers took, over the energy, in `n_frames`. */
static double energy_drift(Chain* chain, StringCoefs coefs, uint32_t n_frames, Random* random) {
  static double stiffness[MOST_DENSE * MOST_DENSE];
  static double damping[MOST_DENSE * MOST_DENSE];
  double x[MOST_DENSE];
  double u[MOST_DENSE];
  double u_old[MOST_DENSE];
  const uint32_t n = chain->n_masses;
  double taken = 0.0;
  double worst = 0.0;
  oracle_forces(rounded(coefs), n, stiffness, damping);
  chain_set(chain, coefs);
  place_noise(chain, random, x, u);
  const double start = oracle_energy(stiffness, n, x, u);
  assert_true(start > 0.0);
  for (uint32_t frame = 0; frame < n_frames; ++frame) {
    memcpy(u_old, u, sizeof(u));
    run_silently(chain, 1);
    read_state(chain, x, u);
    taken += oracle_loss(damping, n, u_old, u);
    worst = fmax(worst, fabs(oracle_energy(stiffness, n, x, u) + taken - start) / start);
  }
  return worst;
}

static void check_energy(const char* what, bool is_bending, bool is_damped, double limit) {
  Random random = random_start();
  double worst = 0.0;
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t n_masses = 1; n_masses <= MOST_DENSE; n_masses += n_masses < 20 ? 1 : 11) {
      Chain chain;
      chain_init(&chain, chain_kernel(kernel), cells, n_masses);
      worst = fmax(worst, energy_drift(&chain, coefs_of(is_bending, is_damped), 2000, &random));
    }
  }
  assert_within(what, worst, limit);
}

/* 2000 steps whose roundings of x and u, half an ε each, change E by an ε of it and may all agree;
 * they do not, so a tenth of that. */
static const double ENERGY_ROUNDING = 0.1 * 2000.0 * (double)FLT_EPSILON;

static void ideal_chain_keeps_its_energy(void** state) {
  (void)state;
  check_energy("flexible", false, false, ENERGY_ROUNDING);
  check_energy("bending", true, false, ENERGY_ROUNDING);
}

static void dampers_take_all_the_energy_that_is_lost(void** state) {
  (void)state;
  check_energy("flexible", false, true, ENERGY_ROUNDING);
  check_energy("bending", true, true, ENERGY_ROUNDING);
}

/* The amplitude of the fundamental and the largest that chain_amplitude() finds in a period. */
static void amplitude_is_the_fundamentals(void** state) {
  (void)state;
  enum { N = 50 };
  const double pi = acos(-1.0);
  const StringCoefs coefs = {.k1 = 0.01};
  const Pole pole = tuning_mode(coefs, N, 1);
  Chain chain;
  chain_init(&chain, chain_kernel(0), cells, N);
  chain_set(&chain, coefs);
  for (uint32_t i = 0; i < N; ++i) {
    chain_place(&chain, i, (float)(0.7 * sin(pi * (i + 1) / (N + 1.0))), 0.0f);
  }
  assert_within("at rest, displacement alone", fabs(chain_amplitude(&chain, HUGE_VAL) - 0.7), 1e-6);
  double worst = 0.0;
  for (uint32_t frame = 0; frame < 2000; ++frame) {
    worst = fmax(worst, fabs(chain_amplitude(&chain, pole.a) / 0.7 - 1.0));
    run_silently(&chain, 1);
  }
  /* x and u are half a step apart: a ripple of θ/2 in the square. */
  assert_within("ringing, relative", worst, 0.26 * pole_angle(pole) + 1e-5);
}

static void rest_is_rest(void** state) {
  (void)state;
  double x[100];
  double u[100];
  Random random = random_start();
  Chain chain;
  chain_init(&chain, chain_kernel(0), cells, 100);
  chain_set(&chain, coefs_of(true, true));
  place_noise(&chain, &random, x, u);
  chain_rest(&chain);
  run_silently(&chain, 100);
  read_state(&chain, x, u);
  assert_true(largest(x, 100) == 0.0 && largest(u, 100) == 0.0);
  assert_true(chain_amplitude(&chain, 1.0) == 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_layout_is_the_same_string),
      cmocka_unit_test(kernels_agree),
      cmocka_unit_test(ideal_chain_keeps_its_energy),
      cmocka_unit_test(dampers_take_all_the_energy_that_is_lost),
      cmocka_unit_test(amplitude_is_the_fundamentals),
      cmocka_unit_test(rest_is_rest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
