/* Which numbers a chain settles in, and that its motion passes from one to the other. */
#include "core/string/chain.h"

#include "core/string/chain_fixed.h"
#include "core/string/chain_numbers.h"
#include "tests/support/chains.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static _Alignas(CHAIN_ALIGNMENT) char memory[CHAINS_MOST_BYTES];

/* Weakly damped and strongly damped; and so weakly that noise would be near. */
static const StringCoefs weak = {.k1 = 0.8, .k2 = 0.01, .z0 = 2e-5, .z1 = 1e-5};
static const StringCoefs strong = {.k1 = 0.8, .k2 = 0.01, .z0 = 2e-4, .z1 = 1e-5};
static const StringCoefs endless = {.k1 = 0.8, .k2 = 0.01, .z0 = 1e-11};

static void start(Chain* chain, uint32_t kernel, uint32_t n, StringCoefs coefs, double size) {
  chain_init(chain, chain_kernel(kernel), memory, n);
  chain_set(chain, coefs);
  for (uint32_t i = 0; i < n; ++i) {
    const double shape = sin(PI * (i + 1.0) / (n + 1.0));
    chain_place(chain, i, (float)(size * shape), (float)(0.01 * size * shape * shape));
  }
}

typedef struct {
  double x[CHAIN_MAX_MASSES];
  double u[CHAIN_MAX_MASSES];
} Motion;

static void read_motion(const Chain* chain, Motion* motion) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    motion->x[i] = chain_numbers_position(chain, i);
    motion->u[i] = chain_numbers_velocity(chain, i);
    assert_true(chain_position(chain, i) == (float)motion->x[i]);
    assert_true(chain_velocity(chain, i) == (float)motion->u[i]);
  }
}

static double farthest(const Motion* a, const Motion* b, uint32_t n) {
  return fmax(chains_distance(a->x, b->x, n), chains_distance(a->u, b->u, n)) /
         chains_largest(a->x, n);
}

/* From floats to fixed point and back; among sums and amplitudes too there is no difference. */
static void motion_passes_to_whole_numbers_and_back(void** state) {
  (void)state;
  double worst = 0.0;
  double worst_amplitude = 0.0;
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t size = 0; size < CHAINS_N_SIZES; ++size) {
      static Motion motions[3];
      const uint32_t n = chains_size(size);
      double amplitude[3];
      Chain chain;
      /* As much air as there may be, so that velocities are not the numbers'. */
      StringCoefs coefs = {.k1 = 0.8};
      const double a1 = 0.8 * tuning_lambda(n, 1);
      coefs.z0 = 0.006 * sqrt(a1);
      start(&chain, kernel, n, coefs, 0.3);
      const ChainNumbers turns[] = {CHAIN_FLOAT, CHAIN_FIXED, CHAIN_FLOAT};
      for (int turn = 0; turn < 3; ++turn) {
        assert_true(chain_hold(&chain, turns[turn]));
        assert_int_equal(chain.numbers, turns[turn]);
        read_motion(&chain, &motions[turn]);
        amplitude[turn] = chain_amplitude(&chain, a1);
      }
      for (int turn = 1; turn < 3; ++turn) {
        const double off = fabs(amplitude[turn] / amplitude[0] - 1.0);
        worst_amplitude = fmax(worst_amplitude, off);
        worst = fmax(worst, farthest(&motions[0], &motions[turn], n));
      }
    }
  }
  /* Three products and a sum each way. */
  assert_within("masses, over the largest", worst, 4.0 * (double)FLT_EPSILON);
  assert_within("amplitude, relative", worst_amplitude, 20.0 * (double)FLT_EPSILON);
}

static void gain_fades_as_the_air_has_it(void** state) {
  (void)state;
  Chain chain;
  start(&chain, 0, 30, weak, 1.0);
  assert_true(chain_hold(&chain, CHAIN_FIXED));
  const double before = chain.gain;
  chains_run(&chain, 1000);
  assert_true(fabs(chain.gain / before / pow(1.0 - 2e-5, 500.0) - 1.0) < 1e-12);
  assert_true(chain.now.z0 == 2e-5 && chain.fixed.z0 == 0.0);
}

static void strings_settle_where_they_ring_best(void** state) {
  (void)state;
  Chain chain;
  start(&chain, 0, 40, weak, 1.0);
  assert_int_equal(chain.numbers, CHAIN_FLOAT);
  chain_settle(&chain);
  assert_int_equal(chain.numbers, CHAIN_FIXED);
  start(&chain, 0, 40, strong, 1.0);
  chain_settle(&chain);
  assert_int_equal(chain.numbers, CHAIN_FLOAT);
  assert_true(chain_hold(&chain, CHAIN_DOUBLE));
  chain_settle(&chain);
  assert_int_equal(chain.numbers, CHAIN_FLOAT);
  start(&chain, 0, 40, endless, 1.0);
  chain_settle(&chain);
  assert_int_equal(chain.numbers, CHAIN_DOUBLE);
  start(&chain, 0, 40, (StringCoefs){.k1 = 0.5}, 1.0);
  chain_settle(&chain);
  assert_int_equal(chain.numbers, CHAIN_DOUBLE);
  start(&chain, 0, 40, weak, 0.0);
  chain_settle(&chain);
  assert_int_equal(chain.numbers, CHAIN_DOUBLE);
}

/* The edges of what is thought quiet, going in and coming out. */
static void noise_decides(void** state) {
  (void)state;
  for (double z0 = 1e-5; z0 > 1e-11; z0 *= 0.9) {
    const StringCoefs coefs = {.k1 = 0.8, .z0 = z0};
    ChainFixed whole;
    Chain chain;
    start(&chain, 0, 8, coefs, 1.0);
    assert_true(chain_fixed_design(coefs, 8, chain_numbers_sum(&chain), &whole));
    const double noise = whole.noise;
    chain_settle(&chain);
    assert_int_equal(chain.numbers, noise < 3e-6 ? CHAIN_FIXED : CHAIN_DOUBLE);
    assert_true(chain_hold(&chain, CHAIN_FIXED));
    chain_settle(&chain);
    assert_int_equal(chain.numbers, noise < 4e-6 ? CHAIN_FIXED : CHAIN_DOUBLE);
  }
}

static void gliding_chains_stay_as_they_are(void** state) {
  (void)state;
  for (int numbers = 0; numbers <= CHAIN_DOUBLE; ++numbers) {
    Chain chain;
    StringCoefs goal = numbers == CHAIN_FLOAT ? weak : strong;
    start(&chain, 0, 40, goal, 1.0);
    assert_true(chain_hold(&chain, (ChainNumbers)numbers));
    goal.k1 *= 0.99;
    chain_glide(&chain, goal, 100);
    chain_settle(&chain);
    assert_int_equal(chain.numbers, numbers);
    assert_false(chain_hold(&chain, CHAIN_FIXED));
    assert_int_equal(chain.numbers, numbers);
    chains_run(&chain, 100);
    assert_true(chain_hold(&chain, CHAIN_FIXED));
  }
}

/* The largest number that a mass has. */
static double largest(const Chain* chain) {
  Motion motion;
  chains_read(chain, motion.x, motion.u);
  return chains_largest(motion.x, chain->n_masses);
}

static void numbers_that_have_shrunk_are_scaled_anew(void** state) {
  (void)state;
  const StringCoefs inner = {.k1 = 0.8, .z1 = 9e-5};
  Motion before;
  Motion after;
  Chain chain;
  start(&chain, 0, 3, inner, 1.0);
  chain_settle(&chain);
  assert_int_equal(chain.numbers, CHAIN_FIXED);
  const double full = largest(&chain);
  uint32_t n_scaled = 0;
  for (int call = 0; call < 400; ++call) {
    chains_run(&chain, 1000);
    read_motion(&chain, &before);
    const double gain = chain.gain;
    chain_settle(&chain);
    read_motion(&chain, &after);
    n_scaled += chain.gain != gain;
    assert_int_equal(chain.numbers, CHAIN_FIXED);
    assert_true(chain_amplitude(&chain, 0.8 * tuning_lambda(3, 1)) / chain.gain > full / 8.0);
    assert_true(farthest(&before, &after, 3) < 8.0 * (double)FLT_EPSILON);
    assert_true(chain.gain == gain || chain.gain < gain / 4.0);
  }
  /* Of 400,000 steps at 2.6e-5 each: e¹⁰, or seven times a quarter and less. */
  assert_true(n_scaled >= 3 && n_scaled <= 8);
}

/* Nothing does this to a string that is left alone; it is the last fence before an overflow. */
static void numbers_that_have_grown_are_scaled_anew(void** state) {
  (void)state;
  Chain chain;
  start(&chain, 0, 30, weak, 1.0);
  assert_true(chain_hold(&chain, CHAIN_FIXED));
  const double gain = chain.gain;
  for (size_t m = 0; m < chains_n_numbers(&chain); ++m) {
    int32_t* const number = (int32_t*)chain.cells + m;
    *number += *number / 2;
  }
  const double full = largest(&chain);
  chain_settle(&chain);
  assert_int_equal(chain.numbers, CHAIN_FIXED);
  assert_true(fabs(chain.gain / gain - 1.5) < 1e-5);
  assert_true(fabs(largest(&chain) / full - 1.0 / 1.5) < 1e-5);
}

typedef enum { SET, PUSH, PLACE, GLIDE, GLIDE_AT_ONCE, N_TOUCHES } Touch;

static void touching_leaves_whole_numbers_in_motion(void** state) {
  (void)state;
  for (int touch = 0; touch < N_TOUCHES; ++touch) {
    static Motion before;
    static Motion after;
    Chain chain;
    start(&chain, 0, 50, weak, 0.5);
    assert_true(chain_hold(&chain, CHAIN_FIXED));
    chains_run(&chain, 5000);
    read_motion(&chain, &before);
    switch ((Touch)touch) {
    case SET:
      chain_set(&chain, strong);
      break;
    case PUSH:
      chain_push(&chain, 7, 0.25f);
      before.u[7] += 0.25;
      break;
    case PLACE:
      chain_place(&chain, 7, 0.25f, 0.125f);
      before.x[7] = 0.25;
      before.u[7] = 0.125;
      break;
    default:
      chain_glide(&chain, strong, touch == GLIDE ? 100 : 0);
    }
    read_motion(&chain, &after);
    assert_int_equal(chain.numbers, CHAIN_FLOAT);
    assert_true(farthest(&before, &after, 50) < 4.0 * (double)FLT_EPSILON);
  }
}

static void touching_leaves_doubles_as_they_are(void** state) {
  (void)state;
  Chain chain;
  start(&chain, 0, 50, weak, 0.5);
  assert_true(chain_hold(&chain, CHAIN_DOUBLE));
  chain_push(&chain, 3, 0.5f);
  chain_place(&chain, 3, 0.5f, 0.5f);
  chain_set(&chain, strong);
  chain_glide(&chain, weak, 5);
  assert_int_equal(chain.numbers, CHAIN_DOUBLE);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(motion_passes_to_whole_numbers_and_back),
      cmocka_unit_test(gain_fades_as_the_air_has_it),
      cmocka_unit_test(strings_settle_where_they_ring_best),
      cmocka_unit_test(noise_decides),
      cmocka_unit_test(gliding_chains_stay_as_they_are),
      cmocka_unit_test(numbers_that_have_shrunk_are_scaled_anew),
      cmocka_unit_test(numbers_that_have_grown_are_scaled_anew),
      cmocka_unit_test(touching_leaves_whole_numbers_in_motion),
      cmocka_unit_test(touching_leaves_doubles_as_they_are),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
