/* Strings that are stepped side by side move as each does alone. */
#include "core/string/chain.h"

#include "tests/support/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { N_STRINGS = 24, FRAMES = 500, MOST_MASSES = 200, MOST_BYTES = 32 * MOST_MASSES };

/* Every elasticity, strongly and weakly damped. */
static const StringCoefs kinds[] = {
    {.k1 = 0.8, .z0 = 1e-3, .z1 = 2e-3},
    {.k1 = 0.8, .z0 = 1e-6, .z1 = 1e-7},
    {.k1 = 0.2, .k2 = 0.15, .z0 = 1e-3, .z1 = 1e-5},
    {.k1 = 0.2, .k2 = 0.15, .z0 = 1e-6},
    {.k1 = 0.3, .k2 = 0.07, .k3 = 0.02, .z0 = 1e-6, .z1 = 1e-5},
};

enum { N_KINDS = sizeof(kinds) / sizeof(kinds[0]) };

/* Two rows of the same strings: one to run together, and one to run one by one. */
static _Alignas(CHAIN_ALIGNMENT) char memory[2][N_STRINGS][MOST_BYTES];
static ChainPart parts[2][N_STRINGS];
static float mix[2][2][FRAMES];

/* Runs of the same kind, so that there is something to put together, some of them gliding. */
static void make_strings(const ChainKernel* kernel, Random* random) {
  for (uint32_t s = 0; s < N_STRINGS; ++s) {
    const StringCoefs coefs = kinds[s / 5 % N_KINDS];
    const StringCoefs goal = kinds[random_below(random, N_KINDS)];
    const uint32_t n_masses = 1 + random_below(random, s % 3 ? 20 : MOST_MASSES);
    const uint32_t n_glide = s % 7 == 3 ? FRAMES + random_below(random, 2) : 0;
    /* Whole numbers are not for the strongest of the dampers. */
    const ChainNumbers numbers = (ChainNumbers)random_below(random, N_CHAIN_NUMBERS);
    const float kick = (float)random_between(random, 0.1, 1.0);
    for (uint32_t row = 0; row < 2; ++row) {
      ChainPart* const part = &parts[row][s];
      static Chain chains[2][N_STRINGS];
      part->chain = &chains[row][s];
      chain_init(part->chain, kernel, memory[row][s], n_masses);
      chain_set(part->chain, coefs);
      chain_push(part->chain, n_masses / 2, kick);
      (void)chain_hold(part->chain, numbers);
      if (n_glide > 0) {
        chain_glide(part->chain, goal, n_glide);
      }
      part->taps[0] = (ChainTap){{n_masses / 3, n_masses - 1}, {0.75f, 0.25f}, false};
      part->taps[1] = (ChainTap){{0, n_masses / 2}, {0.5f, 0.5f}, false};
    }
  }
}

static void strings_move_together_as_alone(void** state) {
  (void)state;
  uint32_t n_whole = 0;
  for (uint32_t k = 0; chain_kernel(k); ++k) {
    for (uint32_t seed = 1; seed <= 20; ++seed) {
      Random random = {.state = seed};
      memset(mix, 0, sizeof(mix));
      make_strings(chain_kernel(k), &random);
      chain_run_all(parts[0], N_STRINGS, FRAMES, 2, (float* const[]){mix[0][0], mix[0][1]});
      for (uint32_t s = 0; s < N_STRINGS; ++s) {
        chain_run(parts[1][s].chain, FRAMES, parts[1][s].taps, 2,
                  (float* const[]){mix[1][0], mix[1][1]});
      }
      assert_true(mix[0][0][FRAMES - 1] != 0.0f);
      assert_memory_equal(mix[0], mix[1], sizeof(mix[0]));
      for (uint32_t s = 0; s < N_STRINGS; ++s) {
        assert_memory_equal(memory[0][s], memory[1][s], chain_size(parts[0][s].chain->n_masses));
        assert_int_equal(parts[0][s].chain->n_gliding, parts[1][s].chain->n_gliding);
        assert_int_equal(parts[0][s].chain->chance, parts[1][s].chain->chance);
        assert_true(parts[0][s].chain->gain == parts[1][s].chain->gain);
        n_whole += parts[0][s].chain->numbers == CHAIN_FIXED;
      }
    }
  }
  assert_true(n_whole > 100);
}

static void a_glide_says_how_long_it_takes(void** state) {
  (void)state;
  Chain chain;
  chain_init(&chain, chain_kernel(0), memory[0][0], 5);
  chain_set(&chain, kinds[0]);
  assert_int_equal(chain_stretch(&chain), UINT32_MAX);
  chain_glide(&chain, kinds[1], 77);
  assert_int_equal(chain_stretch(&chain), 77);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strings_move_together_as_alone),
      cmocka_unit_test(a_glide_says_how_long_it_takes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
