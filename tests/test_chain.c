#include "core/chain.h"

#include "tests/oracle.h"
#include "tests/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
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

/* For the largest string. */
static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];
static float sink[MOST_FRAMES];

static void run_silently(Chain* chain, uint32_t n_frames) {
  float* const out[] = {sink};
  chain_run(chain, n_frames, &no_tap, 1, out);
}

/* Undamped and weakly damped strings are stepped in doubles here, and strongly damped ones in
 * floats. */
typedef enum { UNDAMPED, WEAKLY, STRONGLY, N_DAMPINGS } Damping;

/* A string near its limit with all that a string can have, or without some of it. */
static StringCoefs coefs_of(bool is_bending, Damping damping) {
  static const double z0[] = {0.0, 2e-5, 1.7e-3};
  static const double z1[] = {0.0, 1e-5, 2.3e-3};
  return (StringCoefs){
      .k1 = is_bending ? 0.15 : 0.9,
      .k2 = is_bending ? 0.19 : 0.0,
      .z0 = z0[damping],
      .z1 = z1[damping],
  };
}

static bool is_float(const Chain* chain) {
  return chain->numbers == CHAIN_FLOAT;
}

/* A chain in the numbers that its damping has here. */
static void make_chain(Chain* chain, uint32_t kernel, uint32_t n_masses, Damping damping) {
  chain_init(chain, chain_kernel(kernel), memory, n_masses);
  assert_true(chain_hold(chain, damping == STRONGLY ? CHAIN_FLOAT : CHAIN_DOUBLE));
}

/* The coefficients as the loop has them. */
static StringCoefs seen_by(const Chain* chain, StringCoefs coefs) {
  const StringCoefs rounded = {
      .k1 = (double)(float)coefs.k1,
      .k2 = (double)(float)coefs.k2,
      .k3 = (double)(float)coefs.k3,
      .z0 = (double)(float)coefs.z0,
      .z1 = (double)(float)coefs.z1,
  };
  return is_float(chain) ? rounded : coefs;
}

static void place_noise(Chain* chain, Random* random, double* x, double* u) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    chain_place(chain, i, (float)random_between(random, -1.0, 1.0),
                (float)random_between(random, -1.0, 1.0));
    x[i] = (double)chain_position(chain, i);
    u[i] = (double)chain_velocity(chain, i);
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
    oracle_step(seen_by(chain, coefs), chain->n_masses, x, u);
  }
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    worst = fmax(worst, fabs(x[i] - (double)chain_position(chain, i)));
    worst = fmax(worst, fabs(u[i] - (double)chain_velocity(chain, i)));
  }
  return worst / fmax(largest(x, chain->n_masses), largest(u, chain->n_masses));
}

static void every_layout_is_the_same_string(void** state) {
  (void)state;
  enum { STEPS = 300 };
  Random random = random_start();
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    double worst[2] = {0.0, 0.0};
    for (uint32_t size = 0; size < N_SIZES; ++size) {
      for (int scene = 0; scene < 2 * N_DAMPINGS; ++scene) {
        Chain chain;
        make_chain(&chain, kernel, size_of(size), (Damping)(scene / 2));
        const StringCoefs coefs = coefs_of(scene % 2, (Damping)(scene / 2));
        const double distance = distance_from_oracle(&chain, coefs, STEPS, &random);
        assert_int_equal(is_float(&chain), scene / 2 == STRONGLY);
        worst[is_float(&chain)] = fmax(worst[is_float(&chain)], distance);
      }
    }
    print_message("  %s:\n", chain_kernel(kernel)->name);
    /* 300 steps that each round at a few places, all to the worse; what is read is a float. */
    assert_within("in float", worst[true], STEPS * 4.0 * 0.5 * (double)FLT_EPSILON);
    assert_within("in double", worst[false], (double)FLT_EPSILON);
  }
}

/* A glide's coefficients move by the same amount in every step, the last one's being the goal's. */
static StringCoefs on_the_way(StringCoefs from, StringCoefs to, double share) {
  return (StringCoefs){
      .k1 = from.k1 + share * (to.k1 - from.k1),
      .k2 = from.k2 + share * (to.k2 - from.k2),
      .k3 = from.k3 + share * (to.k3 - from.k3),
      .z0 = from.z0 + share * (to.z0 - from.z0),
      .z1 = from.z1 + share * (to.z1 - from.z1),
  };
}

/* From floats to doubles and back, from bending to none and back, the motion kept. */
static void every_glide_is_the_same_string(void** state) {
  (void)state;
  enum { STEPS = 50, TURNS = 6 };
  static double x[CHAIN_MAX_MASSES];
  static double u[CHAIN_MAX_MASSES];
  double worst = 0.0;
  Random random = random_start();
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t size = 0; size < N_SIZES; ++size) {
      const uint32_t n_masses = size_of(size);
      Chain chain;
      StringCoefs from = coefs_of(true, STRONGLY);
      chain_init(&chain, chain_kernel(kernel), memory, n_masses);
      chain_set(&chain, from);
      place_noise(&chain, &random, x, u);
      for (int turn = 0; turn < TURNS; ++turn) {
        const StringCoefs to = coefs_of(turn % 3 == 1, (Damping)(turn % N_DAMPINGS));
        assert_true(chain_hold(&chain, turn % 2 ? CHAIN_DOUBLE : CHAIN_FLOAT));
        chain_glide(&chain, to, STEPS);
        run_silently(&chain, STEPS);
        for (int n = 1; n <= STEPS; ++n) {
          oracle_step(on_the_way(from, to, (double)n / STEPS), n_masses, x, u);
        }
        from = to;
      }
      for (uint32_t i = 0; i < n_masses; ++i) {
        worst = fmax(worst, fabs(x[i] - (double)chain_position(&chain, i)));
      }
    }
  }
  /* Half of the steps at most are in floats, whose coefficients round as well. */
  assert_within("positions up to 4", worst, 4.0 * 150.0 * 6.0 * 0.5 * (double)FLT_EPSILON);
}

static void kernels_agree(void** state) {
  (void)state;
  static _Alignas(CHAIN_ALIGNMENT) char other_memory[32 * CHAIN_MAX_MASSES];
  double worst = 0.0;
  Random random = random_start();
  for (uint32_t size = 0; size < N_SIZES && chain_kernel(1); ++size) {
    double x[CHAIN_MAX_MASSES];
    double u[CHAIN_MAX_MASSES];
    Chain one;
    Chain other;
    chain_init(&one, chain_kernel(0), memory, size_of(size));
    chain_init(&other, chain_kernel(1), other_memory, size_of(size));
    chain_set(&one, coefs_of(true, STRONGLY));
    chain_set(&other, coefs_of(true, STRONGLY));
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
    x[i] = (double)chain_position(chain, i);
    u[i] = (double)chain_velocity(chain, i);
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
  oracle_forces(seen_by(chain, coefs), n, stiffness, damping);
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

static void check_energy(const char* what, bool is_bending, Damping damping, double limit) {
  Random random = random_start();
  double worst = 0.0;
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t n_masses = 1; n_masses <= MOST_DENSE; n_masses += n_masses < 20 ? 1 : 11) {
      Chain chain;
      make_chain(&chain, kernel, n_masses, damping);
      worst = fmax(worst, energy_drift(&chain, coefs_of(is_bending, damping), 2000, &random));
    }
  }
  assert_within(what, worst, limit);
}

/* In floats, 2000 steps whose roundings change E by an ε of it each and may all agree; they do not,
 * so a tenth of that.  In doubles, the roundings of x and u as they are read, near a limit where E
 * is the difference of larger numbers. */
static const double IN_FLOAT = 0.1 * 2000.0 * (double)FLT_EPSILON;
static const double IN_DOUBLE = 10.0 * (double)FLT_EPSILON;

static void ideal_chain_keeps_its_energy(void** state) {
  (void)state;
  check_energy("flexible", false, UNDAMPED, IN_DOUBLE);
  check_energy("bending", true, UNDAMPED, IN_DOUBLE);
}

static void dampers_take_all_the_energy_that_is_lost(void** state) {
  (void)state;
  check_energy("flexible, weakly damped", false, WEAKLY, IN_DOUBLE);
  check_energy("bending, weakly damped", true, WEAKLY, IN_DOUBLE);
  check_energy("flexible, strongly damped", false, STRONGLY, IN_FLOAT);
  check_energy("bending, strongly damped", true, STRONGLY, IN_FLOAT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_layout_is_the_same_string),
      cmocka_unit_test(every_glide_is_the_same_string),
      cmocka_unit_test(kernels_agree),
      cmocka_unit_test(ideal_chain_keeps_its_energy),
      cmocka_unit_test(dampers_take_all_the_energy_that_is_lost),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
