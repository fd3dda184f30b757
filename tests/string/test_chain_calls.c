#include "core/string/chain.h"

#include "tests/support/chains.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { FRAMES = 2000, N_SIZES = 9 };

static const uint32_t sizes[N_SIZES] = {1, 2, 3, 7, 8, 9, 50, 129, 1024};
static const char CANARY = 0x5A;

static _Alignas(CHAIN_ALIGNMENT) char memory[2 * CHAINS_MOST_BYTES];

/* What a run leaves behind. */
typedef struct {
  float out[CHAIN_MAX_TAPS][FRAMES];
  char memory[CHAINS_MOST_BYTES];
  StringCoefs now;
  double gain;
  uint32_t chance;
  uint32_t n_gliding;
} Trace;

static const StringCoefs flexible = {.k1 = 0.8, .z0 = 1e-3, .z1 = 2e-3};
static const StringCoefs bending = {.k1 = 0.2, .k2 = 0.15, .z0 = 2e-6, .z1 = 1e-5};
static const StringCoefs straightened = {.k1 = 0.3, .k2 = 0.07, .k3 = 0.02, .z0 = 1e-6};

/* Frames of the next call: a fixed number, or at random where it is 0. */
static uint32_t next_cut(uint32_t cut, Random* random) {
  return cut > 0 ? cut : 1 + random_below(random, 100);
}

/* What is done to a string in a run: in these numbers, and glide from here on. */
typedef struct {
  uint32_t start;
  ChainNumbers numbers;
  const StringCoefs* goal; /* NULL: it stands still */
  uint32_t n_glide;
} Turn;

/* Glides into bending, one that is overtaken, and one into all there is; and fixed point, into
 * which a glide breaks as well. */
static const Turn turns[] = {
    {0, CHAIN_FLOAT, NULL, 0},          {301, CHAIN_DOUBLE, &bending, 400},
    {500, CHAIN_FLOAT, &flexible, 257}, {850, CHAIN_DOUBLE, &bending, 150},
    {1033, CHAIN_FIXED, NULL, 0},       {1250, CHAIN_FIXED, &straightened, 257},
    {1600, CHAIN_FIXED, NULL, 0},       {FRAMES, CHAIN_FLOAT, NULL, 0},
};

enum { N_TURNS = sizeof(turns) / sizeof(turns[0]) - 1 };

static void do_turn(Chain* chain, const Turn* turn) {
  assert_true(chain_hold(chain, turn->numbers));
  assert_int_equal(chain->numbers, turn->numbers);
  if (turn->goal) {
    chain_glide(chain, *turn->goal, turn->n_glide);
  }
}

static void
trace(Trace* trace, const ChainKernel* kernel, uint32_t n, uint32_t n_taps, uint32_t cut) {
  const ChainTap taps[] = {
      {{0, n - 1}, {0.25f, 0.5f}, false},     {{n / 2, n / 2}, {1.0f, 0.0f}, false},
      {{n - 1, 0}, {-1.0f, 0.5f}, true},      {{n / 3, n / 2}, {0.5f, 0.5f}, false},
      {{n / 4, n - 1}, {-0.25f, 1.0f}, true}, {{n / 2, n / 5}, {0.5f, 0.5f}, false}};
  Random random = {.state = n};
  Random cuts = {.state = n + 1};
  Chain chain;
  memset(trace, 0, sizeof(*trace));
  memset(memory, 0, sizeof(memory));
  chain_init(&chain, kernel, memory, n);
  chain_set(&chain, flexible);
  chains_place_noise(&chain, &random);
  for (size_t turn = 0; turn < N_TURNS; ++turn) {
    do_turn(&chain, &turns[turn]);
    for (uint32_t done = turns[turn].start; done < turns[turn + 1].start;) {
      const uint32_t left = turns[turn + 1].start - done;
      const uint32_t wanted = next_cut(cut, &cuts);
      const uint32_t now = wanted < left ? wanted : left;
      float* out[CHAIN_MAX_TAPS];
      for (uint32_t t = 0; t < CHAIN_MAX_TAPS; ++t) {
        out[t] = trace->out[t] + done;
      }
      chain_run(&chain, now, taps, n_taps, out);
      done += now;
    }
  }
  memcpy(trace->memory, memory, chain_size(n));
  trace->now = chain.now;
  trace->gain = chain.gain;
  trace->chance = chain.chance;
  trace->n_gliding = chain.n_gliding;
}

static void cutting_into_calls_does_not_change_a_bit(void** state) {
  (void)state;
  static const uint32_t cuts[] = {1, 3, 16, 64, 0};
  static const uint32_t counts[] = {1, 2, 4, CHAIN_MAX_TAPS};
  static Trace whole;
  static Trace cut;
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t s = 0; s < N_SIZES; ++s) {
      for (int count = 0; count < 4; ++count) {
        const uint32_t n_taps = counts[count];
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

static void as_few_taps_as_there_are_loops_for(void** state) {
  (void)state;
  static const uint32_t wanted[] = {0, 1, 2, 4, 4, 6, 6};
  Chain chain;
  for (uint32_t n_taps = 1; n_taps <= CHAIN_MAX_TAPS; ++n_taps) {
    assert_int_equal(chain_taps(n_taps), wanted[n_taps]);
    chain_init(&chain, chain_kernel(0), memory, 9);
    chain_set(&chain, flexible);
    assert_true(chain_loop(&chain, chain_taps(n_taps)));
  }
}

static void glide_ends_exactly_on_its_goal(void** state) {
  (void)state;
  static float out[FRAMES];
  float* const outs[] = {out};
  const ChainTap tap = {{0, 0}, {0.0f, 0.0f}, false};
  for (uint32_t n_glide = 0; n_glide < FRAMES - 1; n_glide = 1 + n_glide + n_glide / 3) {
    Chain chain;
    chain_init(&chain, chain_kernel(0), memory, 10);
    chain_set(&chain, flexible);
    chain_glide(&chain, bending, n_glide);
    if (n_glide > 1) {
      chain_run(&chain, n_glide - 1, &tap, 1, outs);
      assert_true(chain.now.k1 != bending.k1 && chain.now.k2 != bending.k2);
      /* All but the last of steps by the same factor, each known to some roundings. */
      const double last = pow(flexible.k1 / bending.k1, 1.0 / n_glide);
      assert_true(fabs(chain.now.k1 / (bending.k1 * last) - 1.0) < 1e-14 * n_glide);
      assert_int_equal(chain.n_gliding, 1);
    }
    chain_run(&chain, 1, &tap, 1, outs);
    assert_memory_equal(&chain.now, &bending, sizeof(bending));
    assert_int_equal(chain.n_gliding, 0);
  }
}

/* Which numbers belong to a mass, found by filling the masses alone. */
static void find_masses(Chain* chain, bool* is_mass) {
  chain_rest(chain);
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    chain_place(chain, i, 1.0f, 1.0f);
  }
  for (size_t m = 0; m < chains_n_numbers(chain); ++m) {
    is_mass[m] = chains_number(chain, m) == 1.0;
  }
}

static void check_rest(Chain* chain, const bool* is_mass) {
  size_t n_found = 0;
  for (size_t m = 0; m < chains_n_numbers(chain); ++m) {
    assert_true(is_mass[m] || chains_number(chain, m) == 0.0);
    n_found += is_mass[m];
  }
  assert_int_equal(n_found, 2 * chain->n_masses);
}

/* Floats and fixed point lie in the same places. */
static void what_is_no_mass_stays_exactly_at_rest(void** state) {
  (void)state;
  static const StringCoefs* const coefs[] = {&flexible, &bending, &straightened};
  static bool is_mass[CHAINS_MOST_BYTES];
  Random random = random_start();
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t n = 1; n <= 70; ++n) {
      Chain chain;
      chain_init(&chain, chain_kernel(kernel), memory, n);
      for (int turn = 0; turn < 18; ++turn) {
        chain_set(&chain, *coefs[turn % 3]);
        assert_true(chain_hold(&chain, turn % 4 < 2 ? CHAIN_FLOAT : CHAIN_DOUBLE));
        find_masses(&chain, is_mass);
        chains_place_noise(&chain, &random);
        chains_run(&chain, 5);
        check_rest(&chain, is_mass);
        chain_glide(&chain, *coefs[turn / 3 % 3], 20);
        chains_run(&chain, 20);
        check_rest(&chain, is_mass);
        if (turn % 4 < 2 && turn / 3 % 3 > 0) {
          assert_true(chain_hold(&chain, CHAIN_FIXED));
          chains_run(&chain, 20);
          check_rest(&chain, is_mass);
        }
      }
    }
  }
}

/* A string between canaries, as close as harps lay them. */
static void neighbours_in_memory_are_not_touched(void** state) {
  (void)state;
  static float out[FRAMES];
  float* const outs[] = {out};
  const ChainTap tap = {{0, 0}, {1.0f, 0.0f}, false};
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
        chains_place_noise(&chain, &random);
        chain_set(&chain, turn % 2 ? straightened : bending);
        assert_true(chain_hold(&chain, CHAIN_FIXED));
        chains_run(&chain, 10);
        chain_set(&chain, turn % 2 ? straightened : flexible);
        assert_true(chain_hold(&chain, turn % 2 ? CHAIN_DOUBLE : CHAIN_FLOAT));
        chain_run(&chain, 20, &tap, 1, outs);
        chain_glide(&chain, turn % 2 ? flexible : straightened, 10);
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
  const ChainTap tap = {{3, 11}, {0.75f, -2.0f}, false};
  Random random = random_start();
  Chain chain;
  chain_init(&chain, chain_kernel(0), memory, N);
  chain_set(&chain, flexible);
  chains_place_noise(&chain, &random);
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
      cmocka_unit_test(as_few_taps_as_there_are_loops_for),
      cmocka_unit_test(glide_ends_exactly_on_its_goal),
      cmocka_unit_test(what_is_no_mass_stays_exactly_at_rest),
      cmocka_unit_test(neighbours_in_memory_are_not_touched),
      cmocka_unit_test(taps_are_added_to_what_is_there),
      cmocka_unit_test(push_adds_to_velocity_alone),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
