#include "core/string/chain.h"

#include "tests/support/chains.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { BLOCK = 4096 };

static _Alignas(CHAIN_ALIGNMENT) char memory[CHAINS_MOST_BYTES];

/* A triangle pulled at a fifth and let go, without a corner that rounding makes any sharper. */
static void pull_aside(Chain* chain) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const double place = (i + 1.0) / (chain->n_masses + 1.0);
    chain_place(chain, i, (float)(0.25 * fmin(place / 0.2, (1.0 - place) / 0.8)), 0.0f);
  }
}

static TuningTarget random_target(Random* random) {
  return (TuningTarget){
      .rate_hz = 48000.0,
      .tone = {random_log_between(random, 100.0, 400.0), HUGE_VAL},
      .inharmonicity = random_below(random, 2) ? random_log_between(random, 1e-5, 1e-2) : 0.0,
  };
}

/*
  A way between two stable strings is stable all along, and the motion stays of its size: without
  damping a glide of a period or more keeps E/ω, so that the amplitude goes as the root of the
  pitches' ratio, at most 2; a quarter more for what is not slow enough.
*/
static void glide_between_stable_strings_stays_bounded(void** state) {
  (void)state;
  static float out[BLOCK];
  float* const outs[] = {out};
  const ChainTap tap = {{0, 0}, {0.0f, 0.0f}, false};
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 300; ++trial) {
    const TuningTarget targets[2] = {random_target(&random), random_target(&random)};
    const uint32_t n_masses = tuning_max_masses(&targets[1], tuning_max_masses(&targets[0], 60));
    StringCoefs coefs[2];
    assert_int_equal(tuning_solve(&targets[0], n_masses, &coefs[0]), STATUS_OK);
    assert_int_equal(tuning_solve(&targets[1], n_masses, &coefs[1]), STATUS_OK);
    Chain chain;
    chain_init(&chain, chain_kernel(0), memory, n_masses);
    assert_true(chain_hold(&chain, trial % 2 ? CHAIN_FLOAT : CHAIN_DOUBLE));
    chain_set(&chain, coefs[0]);
    pull_aside(&chain);
    for (int turn = 0; turn < 10; ++turn) {
      chain_glide(&chain, coefs[(turn + 1) % 2], 480 + random_below(&random, 2500));
      chain_run(&chain, BLOCK, &tap, 1, outs);
      assert_int_equal(chain.n_gliding, 0);
      assert_memory_equal(&chain.now, &chain.goal, sizeof(chain.now));
    }
    for (int n = 0; n < 200; ++n) {
      chain_run(&chain, 7, &tap, 1, outs);
      worst = fmax(worst, chain_amplitude(&chain, HUGE_VAL));
    }
  }
  assert_within("amplitude after ten glides, of 0.25", worst / 0.25, 2.5);
}

static void amplitude_is_the_fundamentals(void** state) {
  (void)state;
  double worst = 0.0;
  for (int step = 0; step <= 23; ++step) {
    const double f0_hz = 50.0 * pow(1.3, step);
    const TuningTarget target = {.rate_hz = 48000.0, .tone = {f0_hz, HUGE_VAL}};
    const uint32_t n = tuning_max_masses(&target, 50);
    StringCoefs coefs = {0};
    assert_int_equal(tuning_solve(&target, n, &coefs), STATUS_OK);
    Chain chain;
    chain_init(&chain, chain_kernel(0), memory, n);
    assert_true(chain_hold(&chain, CHAIN_DOUBLE));
    chain_set(&chain, coefs);
    for (uint32_t i = 0; i < n; ++i) {
      chain_place(&chain, i, (float)(0.7 * sin(PI * (i + 1.0) / (n + 1.0))), 0.0f);
    }
    assert_true(fabs(chain_amplitude(&chain, HUGE_VAL) - 0.7) < 1e-6);
    /* At rest it is half a step from its turn: 0.7 is |C| cos(θ/2). */
    const double truth = 0.7 / cos(PI * f0_hz / 48000.0);
    const double a1 = tuning_mode(coefs, n, 1).a;
    for (uint32_t frame = 0; frame < 500; ++frame) {
      worst = fmax(worst, fabs(chain_amplitude(&chain, a1) / truth - 1.0));
      chains_run(&chain, 1);
    }
  }
  /* The shape starts as floats. */
  assert_within("ringing, relative", worst, 2.0 * (double)FLT_EPSILON);
}

static void rest_is_rest(void** state) {
  (void)state;
  static const StringCoefs settings[] = {{.k1 = 0.5}, {.k1 = 0.1, .k2 = 0.1, .z0 = 0.1}};
  for (size_t s = 0; s < 2; ++s) {
    Chain chain;
    chain_init(&chain, chain_kernel(0), memory, 100);
    assert_true(chain_hold(&chain, s == 0 ? CHAIN_DOUBLE : CHAIN_FLOAT));
    chain_set(&chain, settings[s]);
    pull_aside(&chain);
    chains_run(&chain, 100);
    assert_true(chain_amplitude(&chain, 1.0) > 0.01);
    chain_rest(&chain);
    chains_run(&chain, 100);
    assert_true(chain_amplitude(&chain, 1.0) == 0.0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(glide_between_stable_strings_stays_bounded),
      cmocka_unit_test(amplitude_is_the_fundamentals),
      cmocka_unit_test(rest_is_rest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
