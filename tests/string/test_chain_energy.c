#include "core/string/chain.h"

#include "tests/support/chains.h"
#include "tests/support/oracle.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_DENSE = 64 };

static const char* const names[] = {"in floats", "in doubles", "in fixed point"};

static _Alignas(CHAIN_ALIGNMENT) char memory[CHAINS_MOST_BYTES];

/* The largest change of energy plus what the dampers took, over the energy, in `n_frames`. */
static double energy_drift(Chain* chain, uint32_t n_frames) {
  static double stiffness[MOST_DENSE * MOST_DENSE];
  static double damping[MOST_DENSE * MOST_DENSE];
  double x[MOST_DENSE];
  double u[MOST_DENSE];
  double u_old[MOST_DENSE];
  const uint32_t n = chain->n_masses;
  double taken = 0.0;
  double worst = 0.0;
  oracle_forces(chains_seen(chain), n, stiffness, damping);
  chains_read(chain, x, u);
  const double begin = oracle_energy(stiffness, n, x, u);
  assert_true(begin > 0.0);
  for (uint32_t frame = 0; frame < n_frames; ++frame) {
    memcpy(u_old, u, sizeof(u));
    chains_run(chain, 1);
    chains_read(chain, x, u);
    taken += oracle_loss(damping, n, u_old, u);
    worst = fmax(worst, fabs(oracle_energy(stiffness, n, x, u) + taken - begin) / begin);
  }
  return worst;
}

/*
  2000 steps whose roundings change E by an ε of it each and may all agree; they do not, so a tenth
  of that in floats, and in doubles; in fixed point an ε is what the dither is of the motion.
*/
static double most_drift(ChainNumbers numbers) {
  return 0.1 * 2000.0 * (numbers == CHAIN_DOUBLE ? DBL_EPSILON : (double)FLT_EPSILON);
}

static void check_energy(ChainDamping damping) {
  for (int numbers = 0; numbers < N_CHAIN_NUMBERS; ++numbers) {
    double worst = 0.0;
    for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
      for (uint32_t n = 1; n <= MOST_DENSE; n += n < 20 ? 1 : 11) {
        for (int elasticity = 0; elasticity < N_CHAIN_ELASTICITIES; ++elasticity) {
          Chain chain;
          chains_start(&chain, chain_kernel(kernel), memory, (ChainNumbers)numbers, damping,
                       (ChainElasticity)elasticity, n);
          worst = fmax(worst, energy_drift(&chain, 2000));
        }
      }
    }
    assert_within(names[numbers], worst, most_drift((ChainNumbers)numbers));
  }
}

static void ideal_chain_keeps_its_energy(void** state) {
  (void)state;
  check_energy(CHAIN_UNDAMPED);
}

static void dampers_take_all_the_energy_that_is_lost(void** state) {
  (void)state;
  check_energy(CHAIN_GROUND);
  check_energy(CHAIN_BETWEEN);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ideal_chain_keeps_its_energy),
      cmocka_unit_test(dampers_take_all_the_energy_that_is_lost),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
