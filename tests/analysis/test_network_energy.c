#include "core/analysis/modes.h"
#include "core/analysis/network.h"

#include "tests/support/networks.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const NetworkKind UNDAMPED = {12, 0.5, 0.5, 1.0, false};
static const NetworkKind DAMPED = {12, 0.5, 0.5, 1.0, true};

static double largest_step(const Network* network) {
  double step_s = 0.0;
  assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_OK);
  return step_s;
}

static void shake(Network* network, Random* random) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p]) {
      network->x[p] = random_between(random, -1.0, 1.0);
      network->v[p] = random_between(random, -1.0, 1.0);
    }
  }
}

/* The energies again, in matrices: ½ vᵀMv + ½ xᵀK(x − h v). */
static double dense_energy(const Network* network, double step_s) {
  const size_t n = network->n_masses;
  double* const mass_kg = networks_zeros(n + n * n + 3 * n);
  double* const stiffness = mass_kg + n;
  double* const state = stiffness + n * n;
  double* const force = state + 2 * n;
  assert_int_equal(network_matrices(network, mass_kg, stiffness, NULL), STATUS_OK);
  networks_get(network, state);
  networks_apply(n, stiffness, state, force);
  double energy = 0.0;
  for (size_t i = 0; i < n; ++i) {
    const double v = state[n + i];
    energy += 0.5 * mass_kg[i] * v * v + 0.5 * force[i] * (state[i] - step_s * v);
  }
  free(mass_kg);
  return energy;
}

static void energies_are_the_quadratic_forms(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    Network* const network = networks_random(&random, &DAMPED);
    shake(network, &random);
    const double h = random_between(&random, 0.0, 0.5);
    const double physical = network_energy(network);
    worst = fmax(worst, fabs(dense_energy(network, 0.0) - physical) / physical);
    worst =
        fmax(worst, fabs(dense_energy(network, h) - network_scheme_energy(network, h)) / physical);
    network_free(network);
  }
  assert_within("of the physical energy", worst, 1e-13);
}

/* The most by which the scheme's energy leaves its first value, relative. */
static double drift(Network* network, double step_s, long n_steps) {
  const double first = network_scheme_energy(network, step_s);
  double worst = 0.0;
  for (long n = 1; n <= n_steps; ++n) {
    network_step(network, step_s);
    if (n % 1009 == 0 || n == n_steps) {
      worst = fmax(worst, fabs(network_scheme_energy(network, step_s) / first - 1.0));
    }
  }
  return worst;
}

/* The rounding of a step is one of x and one of v; taken as all of one sign it would be ε a step,
 * and as chance has it √steps of them: allow a hundred times that. */
static double rounding_of(long n_steps) {
  return 100.0 * sqrt((double)n_steps) * DBL_EPSILON;
}

static void one_mass_keeps_its_energy(void** state) {
  (void)state;
  const long n_steps = networks_is_long() ? 100000000 : 3000000;
  static const double warps[] = {0.01, 0.3, 1.0, 1.9};
  for (size_t i = 0; i < (networks_is_long() ? 1 : 4); ++i) {
    const double warp = networks_is_long() ? 0.3 : warps[i];
    Network* const network = networks_mass(1.0, warp * warp, 0.0);
    network->x[0] = 1.0;
    print_message("  ω0 h = %g, %ld steps\n", warp, n_steps);
    assert_within("drift", drift(network, 1.0, n_steps), rounding_of(n_steps));
    network_free(network);
  }
}

static void undamped_network_keeps_its_energy(void** state) {
  (void)state;
  const long n_steps = networks_is_long() ? 1000000 : 30000;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 10; ++trial) {
    Network* const network = networks_random(&random, &UNDAMPED);
    shake(network, &random);
    worst = fmax(worst, drift(network, 0.95 * largest_step(network), n_steps));
    network_free(network);
  }
  print_message("  %ld steps\n", n_steps);
  assert_within("drift", worst, rounding_of(n_steps));
}

/* The lowest eigenvalue of the form that the scheme's energy is, by its values on pairs of unit
 * states scaled to unit physical energy each. */
static double lowest_energy(Network* network, double step_s) {
  const size_t order = 2 * (size_t)network->n_masses;
  double* const form = networks_zeros(order * order + 2 * order);
  double* const unit = form + order * order;
  double* const scale = unit + order;
  double complex* const values = calloc(order, sizeof(double complex));
  assert_non_null(values);
  for (size_t i = 0; i < order; ++i) {
    unit[i] = 1.0;
    networks_set(network, unit);
    scale[i] = 1.0 / sqrt(network_energy(network));
    unit[i] = 0.0;
  }
  for (size_t j = 0; j < order; ++j) {
    for (size_t i = 0; i < order; ++i) {
      double sign[2];
      for (int s = 0; s < 2; ++s) {
        unit[j] = scale[j];
        unit[i] += s ? -scale[i] : scale[i];
        networks_set(network, unit);
        sign[s] = network_scheme_energy(network, step_s);
        unit[i] = unit[j] = 0.0;
      }
      form[i + j * order] = 0.25 * (sign[0] - sign[1]);
    }
  }
  oracle_eigenvalues(order, form, values);
  double lowest = HUGE_VAL;
  for (size_t i = 0; i < order; ++i) {
    lowest = fmin(lowest, creal(values[i]));
  }
  free(form);
  free(values);
  return lowest;
}

static void energy_is_positive_exactly_where_the_step_is_stable(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 100; ++trial) {
    Network* const network = networks_random(&random, &UNDAMPED);
    const double limit_s = largest_step(network);
    const double margin = random_log_between(&random, 1e-9, 0.5);
    assert_true(lowest_energy(network, limit_s * (1.0 - margin)) > 0.0);
    assert_true(lowest_energy(network, limit_s * (1.0 + margin)) < 0.0);
    network_free(network);
  }
}

/* What a step takes: E' − E = ½ h (v' + v)ᵀ (F − Z v). */
static void energy_goes_where_dampers_and_forces_take_it(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    Network* const network = networks_random(&random, &DAMPED);
    const size_t n = network->n_masses;
    const double h = random_between(&random, 0.1, 0.9) * largest_step(network);
    double* const mass_kg = networks_zeros(n + n * n + 5 * n);
    double* const damping = mass_kg + n;
    double* const old = damping + n * n;
    double* const new = old + 2 * n;
    double* const drag = new + 2 * n;
    uint32_t* const point = calloc(n, sizeof(uint32_t));
    assert_non_null(point);
    networks_masses(network, point);
    assert_int_equal(network_matrices(network, mass_kg, NULL, damping), STATUS_OK);
    shake(network, &random);
    for (size_t i = 0; i < n; ++i) {
      network->force[point[i]] = random_between(&random, -1.0, 1.0);
    }
    for (int step = 0; step < 20; ++step) {
      const double before = network_scheme_energy(network, h);
      networks_get(network, old);
      network_step(network, h);
      networks_get(network, new);
      networks_apply(n, damping, old + n, drag);
      double given = 0.0;
      double size = before + network_energy(network);
      for (size_t i = 0; i < n; ++i) {
        const double sum = 0.5 * h * (new[n + i] + old[n + i]);
        given += sum * (network->force[point[i]] - drag[i]);
        size += fabs(sum) * (fabs(network->force[point[i]]) + fabs(drag[i]));
      }
      worst = fmax(worst, fabs(network_scheme_energy(network, h) - before - given) / size);
    }
    free(mass_kg);
    free(point);
    network_free(network);
  }
  assert_within("balance, of its terms", worst, 64.0 * DBL_EPSILON);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(energies_are_the_quadratic_forms),
      cmocka_unit_test(one_mass_keeps_its_energy),
      cmocka_unit_test(undamped_network_keeps_its_energy),
      cmocka_unit_test(energy_is_positive_exactly_where_the_step_is_stable),
      cmocka_unit_test(energy_goes_where_dampers_and_forces_take_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
