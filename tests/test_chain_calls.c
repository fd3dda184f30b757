#include "core/chain.h"

#include "tests/oracle.h"
#include "tests/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { FRAMES = 2000, MOST_BYTES = 32 * CHAIN_MAX_MASSES, N_SIZES = 9 };

static const uint32_t sizes[N_SIZES] = {1, 2, 3, 7, 8, 9, 50, 129, 1024};
static const char CANARY = 0x5A;

static _Alignas(CHAIN_ALIGNMENT) char memory[2 * MOST_BYTES];

/* What a run leaves behind. */
typedef struct {
  float out[CHAIN_MAX_TAPS][FRAMES];
  char memory[MOST_BYTES];
  StringCoefs now;
  uint32_t n_gliding;
} Trace;

static const StringCoefs flexible = {.k1 = 0.8, .z0 = 1e-3, .z1 = 2e-3};
static const StringCoefs bending = {.k1 = 0.2, .k2 = 0.15, .z0 = 2e-5, .z1 = 1e-5};

static void place_noise(Chain* chain, Random* random) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    chain_place(chain, i, (float)random_between(random, -1.0, 1.0),
                (float)random_between(random, -1.0, 1.0));
  }
}

/* Frames of the next call: a fixed number, or at random where it is 0. */
static uint32_t next_cut(uint32_t cut, Random* random) {
  return cut > 0 ? cut : 1 + random_below(random, 100);
}

/* A string with a glide into bending, one that is overtaken, and one back, all in one run. */
static void
trace(Trace* trace, const ChainKernel* kernel, uint32_t n, uint32_t n_taps, uint32_t cut) {
  static const uint32_t turns[] = {0, 301, 500, 1033, FRAMES};
  const ChainTap taps[] = {{{0, n - 1}, {0.25f, 0.5f}},
                           {{n / 2, n / 2}, {1.0f, 0.0f}},
                           {{n - 1, 0}, {-1.0f, 0.5f}},
                           {{n / 3, n / 2}, {0.5f, 0.5f}}};
  Random random = {.state = n};
  Random cuts = {.state = n + 1};
  Chain chain;
  memset(trace, 0, sizeof(*trace));
  memset(memory, 0, sizeof(memory));
  chain_init(&chain, kernel, memory, n);
  chain_set(&chain, flexible);
  place_noise(&chain, &random);
  for (size_t turn = 0; turn < 4; ++turn) {
    if (turn > 0) {
      assert_true(chain_hold(&chain, turn % 2 ? CHAIN_DOUBLE : CHAIN_FLOAT));
      chain_glide(&chain, turn % 2 ? bending : flexible, turn == 1 ? 400 : 257);
    }
    for (uint32_t done = turns[turn]; done < turns[turn + 1];) {
      const uint32_t left = turns[turn + 1] - done;
      const uint32_t wanted = next_cut(cut, &cuts);
      const uint32_t now = wanted < left ? wanted : left;
      float* const out[] = {trace->out[0] + done, trace->out[1] + done, trace->out[2] + done,
                            trace->out[3] + done};
      chain_run(&chain, now, taps, n_taps, out);
      done += now;
    }
  }
  memcpy(trace->memory, memory, chain_size(n));
  trace->now = chain.now;
  trace->n_gliding = chain.n_gliding;
}

static void cutting_into_calls_does_not_change_a_bit(void** state) {
  (void)state;
  static const uint32_t cuts[] = {1, 3, 16, 64, 0};
  static Trace whole;
  static Trace cut;
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t s = 0; s < N_SIZES; ++s) {
      for (uint32_t n_taps = 1; n_taps <= CHAIN_MAX_TAPS; n_taps *= 2) {
        trace(&whole, chain_kernel(kernel), sizes[s], n_taps, FRAMES);
        assert_true(whole.out[0][FRAMES - 1] != 0.0f);
        for (size_t c = 0; c < 5; ++c) {
          trace(&cut, chain_kernel(kernel), sizes[s], n_taps, cuts[c]);
          assert_memory_equal(&whole, &cut, sizeof(whole));
        }
      }
    }
  }
}

static void glide_ends_exactly_on_its_goal(void** state) {
  (void)state;
  static float out[FRAMES];
  float* const outs[] = {out};
  const ChainTap tap = {{0, 0}, {0.0f, 0.0f}};
  for (uint32_t n_glide = 0; n_glide < FRAMES - 1; n_glide = 1 + n_glide + n_glide / 3) {
    Chain chain;
    chain_init(&chain, chain_kernel(0), memory, 10);
    chain_set(&chain, flexible);
    chain_glide(&chain, bending, n_glide);
    if (n_glide > 1) {
      chain_run(&chain, n_glide - 1, &tap, 1, outs);
      assert_true(chain.now.k1 != bending.k1 && chain.now.k2 != bending.k2);
      /* All but the last step of a straight line, each known to a rounding of a number below 1. */
      const double left = (flexible.k1 - bending.k1) / n_glide;
      assert_true(fabs(chain.now.k1 - bending.k1 - left) < 1e-16 * n_glide);
      assert_int_equal(chain.n_gliding, 1);
    }
    chain_run(&chain, 1, &tap, 1, outs);
    assert_memory_equal(&chain.now, &bending, sizeof(bending));
    assert_int_equal(chain.n_gliding, 0);
  }
}

static size_t n_numbers(const Chain* chain) {
  return (size_t)chain->n_cells * 2 * chain->loops->n_lanes;
}

static double number(const Chain* chain, size_t m) {
  return chain->numbers == CHAIN_DOUBLE ? ((const double*)chain->cells)[m]
                                        : (double)((const float*)chain->cells)[m];
}

/* Which numbers belong to a mass, found by filling the masses alone. */
static void find_masses(Chain* chain, bool* is_mass) {
  chain_rest(chain);
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    chain_place(chain, i, 1.0f, 1.0f);
  }
  for (size_t m = 0; m < n_numbers(chain); ++m) {
    is_mass[m] = number(chain, m) == 1.0;
  }
}

static void what_is_no_mass_stays_exactly_at_rest(void** state) {
  (void)state;
  static bool is_mass[MOST_BYTES];
  static float out[FRAMES];
  float* const outs[] = {out};
  const ChainTap tap = {{0, 0}, {1.0f, 0.0f}};
  Random random = random_start();
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t n = 1; n <= 70; ++n) {
      Chain chain;
      chain_init(&chain, chain_kernel(kernel), memory, n);
      for (int turn = 0; turn < 20; ++turn) {
        chain_set(&chain, turn % 2 ? flexible : bending);
        assert_true(chain_hold(&chain, turn % 4 < 2 ? CHAIN_FLOAT : CHAIN_DOUBLE));
        find_masses(&chain, is_mass);
        place_noise(&chain, &random);
        chain_run(&chain, 5, &tap, 1, outs);
        chain_glide(&chain, turn % 2 ? bending : flexible, 30);
        chain_run(&chain, 20, &tap, 1, outs);
        size_t n_found = 0;
        for (size_t m = 0; m < n_numbers(&chain); ++m) {
          assert_true(is_mass[m] || number(&chain, m) == 0.0);
          n_found += is_mass[m];
        }
        assert_int_equal(n_found, 2 * n);
      }
    }
  }
}

/* A string between canaries, as close as harps lay them. */
static void neighbours_in_memory_are_not_touched(void** state) {
  (void)state;
  static float out[FRAMES];
  float* const outs[] = {out};
  const ChainTap tap = {{0, 0}, {1.0f, 0.0f}};
  Random random = random_start();
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t n = 1; n <= 1024; n += n < 70 ? 1 : 106) {
      const size_t before = chain_size(1);
      const size_t size = chain_size(n);
      assert_int_equal(size % CHAIN_ALIGNMENT, 0);
      assert_true(before + size + before <= sizeof(memory));
      memset(memory, CANARY, before + size + before);
      Chain chain;
      chain_init(&chain, chain_kernel(kernel), memory + before, n);
      for (int turn = 0; turn < 4; ++turn) {
        place_noise(&chain, &random);
        chain_set(&chain, turn % 2 ? bending : flexible);
        assert_true(chain_hold(&chain, turn % 2 ? CHAIN_DOUBLE : CHAIN_FLOAT));
        chain_run(&chain, 20, &tap, 1, outs);
        chain_glide(&chain, turn % 2 ? flexible : bending, 10);
        chain_run(&chain, 20, &tap, 1, outs);
        chain_rest(&chain);
      }
      for (size_t m = 0; m < before; ++m) {
        assert_true(memory[m] == CANARY && memory[before + size + m] == CANARY);
      }
    }
  }
}

static void taps_are_added_to_what_is_there(void** state) {
  (void)state;
  enum { N = 20, RUN = 100 };
  float first[RUN];
  float out[RUN] = {0};
  float* const outs[] = {out};
  const ChainTap tap = {{3, 11}, {0.75f, -2.0f}};
  Random random = random_start();
  Chain chain;
  chain_init(&chain, chain_kernel(0), memory, N);
  chain_set(&chain, flexible);
  place_noise(&chain, &random);
  for (uint32_t n = 0; n < RUN; ++n) {
    float* const here[] = {out + n};
    chain_run(&chain, 1, &tap, 1, here);
    first[n] = 0.75f * chain_position(&chain, 3) - 2.0f * chain_position(&chain, 11);
    /* The loop may fuse its products and sums: one rounding of numbers up to 8. */
    assert_true(fabs((double)(first[n] - out[n])) < 2e-6);
  }
  const float level = 16.0f;
  for (uint32_t n = 0; n < RUN; ++n) {
    out[n] = level;
  }
  chain_rest(&chain);
  chain_run(&chain, RUN, &tap, 1, outs);
  for (uint32_t n = 0; n < RUN; ++n) {
    assert_true(out[n] == level);
  }
}

static void push_adds_to_velocity_alone(void** state) {
  (void)state;
  Chain chain;
  chain_init(&chain, chain_kernel(0), memory, 30);
  chain_place(&chain, 17, 0.5f, 0.25f);
  chain_push(&chain, 17, 1.0f);
  for (uint32_t i = 0; i < 30; ++i) {
    assert_true(chain_position(&chain, i) == (i == 17 ? 0.5f : 0.0f));
    assert_true(chain_velocity(&chain, i) == (i == 17 ? 1.25f : 0.0f));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cutting_into_calls_does_not_change_a_bit),
      cmocka_unit_test(glide_ends_exactly_on_its_goal),
      cmocka_unit_test(what_is_no_mass_stays_exactly_at_rest),
      cmocka_unit_test(neighbours_in_memory_are_not_touched),
      cmocka_unit_test(taps_are_added_to_what_is_there),
      cmocka_unit_test(push_adds_to_velocity_alone),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
