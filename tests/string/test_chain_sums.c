#include "core/string/chain.h"

#include "core/string/chain_numbers.h"
#include "tests/support/chains.h"
#include "tests/support/oracle.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* Masses, the walls, and the wall's neighbour beyond it. */
enum { MOST_PLACES = CHAIN_MAX_MASSES + 4 };

static const char* const names[] = {"in floats", "in doubles", "in fixed point"};

static _Alignas(CHAIN_ALIGNMENT) char memory[CHAINS_MOST_BYTES];

static double square(double value) {
  return value * value;
}

/* L of f at place i of a line that is nought far out. */
static double bend(const double* f, uint32_t i) {
  return 2.0 * f[i] - f[i - 1] - f[i + 1];
}

/* The sums as they are defined; mass i is at place i + 2, and a hinge has no L. */
static ChainSums sums_of(const double* x, const double* u, uint32_t n) {
  double y[MOST_PLACES] = {0};
  double v[MOST_PLACES] = {0};
  double bow[MOST_PLACES] = {0};
  ChainSums sums = {0};
  for (uint32_t i = 0; i < n; ++i) {
    y[i + 2] = x[i] - 0.5 * u[i];
    v[i + 2] = u[i];
    sums.xx += x[i] * x[i];
    sums.xu += x[i] * u[i];
    sums.uu += u[i] * u[i];
  }
  for (uint32_t i = 0; i < n; ++i) {
    sums.curvature += square(bend(v, i + 2));
    bow[i + 2] = bend(y, i + 2);
  }
  for (uint32_t i = 2; i < n + 3; ++i) {
    sums.slope += square(y[i] - y[i - 1]);
    sums.twist += square(bow[i] - bow[i - 1]);
  }
  return sums;
}

static double difference(ChainSums a, ChainSums b) {
  const double all[][2] = {{a.xx, b.xx},
                           {a.uu, b.uu},
                           {a.slope, b.slope},
                           {a.twist, b.twist},
                           {a.curvature, b.curvature},
                           {a.xu + b.uu, b.xu + b.uu}};
  double worst = 0.0;
  for (size_t s = 0; s < sizeof(all) / sizeof(all[0]); ++s) {
    worst = fmax(worst, fabs(all[s][0] / all[s][1] - 1.0));
  }
  return worst;
}

/* A chain with noise on it, or with a shape as round as there is. */
static void place(Chain* chain, bool is_noise) {
  Random random = {.state = chain->n_masses};
  if (is_noise) {
    chains_place_noise(chain, &random);
    return;
  }
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const double shape = sin(PI * (i + 1.0) / (chain->n_masses + 1.0));
    chain_place(chain, i, (float)(0.3 * shape), (float)(-0.001 * shape));
  }
}

static double check_sums(const Chain* chain) {
  double x[CHAIN_MAX_MASSES];
  double u[CHAIN_MAX_MASSES];
  chains_read(chain, x, u);
  return difference(chain->loops->sum(chain->cells, chain->n_masses, chain->n_cells),
                    sums_of(x, u, chain->n_masses));
}

static void sums_are_what_they_say(void** state) {
  (void)state;
  /* A part of Σ (ΔL y)² is as small as π³/N³ of y, whose last place counts ε; N is up to 129 there.
   * Noise is all of a size, but is rounded as often as there are masses. */
  const double most[] = {200.0 * (double)FLT_EPSILON, 200.0 * DBL_EPSILON,
                         200.0 * (double)FLT_EPSILON};
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (int numbers = 0; numbers < N_CHAIN_NUMBERS; ++numbers) {
      double worst = 0.0;
      for (uint32_t size = 0; size < CHAINS_N_SIZES; ++size) {
        Chain chain;
        chain_init(&chain, chain_kernel(kernel), memory, chains_size(size));
        chain_set(&chain, (StringCoefs){.k1 = 0.9, .z0 = 1e-6});
        place(&chain, true);
        assert_true(chain_hold(&chain, (ChainNumbers)numbers));
        worst = fmax(worst, check_sums(&chain));
      }
      print_message("  %s:\n", chain_kernel(kernel)->name);
      assert_within(names[numbers], worst, most[numbers]);
    }
  }
}

/* What a fundamental has of each: x = 0.3 s, u = −0.001 s, y = 0.3005 s. */
static void sums_of_a_round_shape_are_its_modes(void** state) {
  (void)state;
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (int numbers = 0; numbers < N_CHAIN_NUMBERS; ++numbers) {
      double worst = 0.0;
      double worst_bent = 0.0;
      for (uint32_t n = 1; n <= CHAINS_N_SMALL; ++n) {
        const double half = 0.5 * (n + 1.0);
        const double lambda = tuning_lambda(n, 1);
        const double y = square(0.3005) * half;
        Chain chain;
        chain_init(&chain, chain_kernel(kernel), memory, n);
        chain_set(&chain, (StringCoefs){.k1 = 0.9, .z0 = 1e-6 / (n * n)});
        place(&chain, false);
        assert_true(chain_hold(&chain, (ChainNumbers)numbers));
        const ChainSums sums = chain_numbers_sum(&chain);
        worst = fmax(worst, fabs(sums.xx / (0.09 * half) - 1.0));
        worst = fmax(worst, fabs(sums.xu / (-3e-4 * half) - 1.0));
        worst = fmax(worst, fabs(sums.uu / (1e-6 * half) - 1.0));
        worst = fmax(worst, fabs(sums.slope / (lambda * y) - 1.0));
        worst_bent = fmax(worst_bent, fabs(sums.curvature / (square(lambda) * 1e-6 * half) - 1.0));
        worst_bent = fmax(worst_bent, fabs(sums.twist / (square(lambda) * lambda * y) - 1.0));
      }
      assert_within(names[numbers], worst, 1e-5);
      assert_within(names[numbers], worst_bent, 1e-3);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sums_are_what_they_say),
      cmocka_unit_test(sums_of_a_round_shape_are_its_modes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
