#include "core/analysis/network_schemes.h"

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

static const NetworkKind MODEST = {8, 0.3, 0.3, 0.5, true};
static const NetworkKind UNLIKE = {30, 1.5, 3.0, 3.0, true};

static Network* modest(Random* random) {
  Network* const network = networks_random(random, &MODEST);
  assert_int_equal(network_prepare(network), STATUS_OK);
  return network;
}

static void shake(Network* network, Random* random) {
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p]) {
      network->x[p] = random_between(random, -1.0, 1.0);
      network->v[p] = random_between(random, -1.0, 1.0);
    }
  }
}

/* The distance from `state` after `time_s` in `n_steps` to the exact one. */
static double error(Network* network,
                    NetworkScheme scheme,
                    const double* start,
                    const double* exact,
                    double time_s,
                    int n_steps) {
  const size_t order = 2 * (size_t)network->n_masses;
  double* const got = networks_zeros(order);
  networks_set(network, start);
  for (int n = 0; n < n_steps; ++n) {
    assert_int_equal(network_step_by(network, scheme, time_s / n_steps), STATUS_OK);
  }
  networks_get(network, got);
  double sum = 0.0;
  for (size_t i = 0; i < order; ++i) {
    sum += (got[i] - exact[i]) * (got[i] - exact[i]);
  }
  free(got);
  return sqrt(sum);
}

/* Against e^{tA}: the error falls by 2^order as the step is halved. */
static void error_falls_with_the_order_of_the_scheme(void** state) {
  (void)state;
  static const int steps[NETWORK_SCHEME_COUNT] = {8000, 8000, 8000, 400, 200};
  for (int s = 0; s < NETWORK_SCHEME_COUNT; ++s) {
    const NetworkScheme scheme = (NetworkScheme)s;
    double worst = 0.0;
    double mean = 0.0;
    Random random = random_start();
    for (int trial = 0; trial < 8; ++trial) {
      Network* const network = modest(&random);
      const size_t order = 2 * (size_t)network->n_masses;
      double* const a = networks_zeros(2 * order * order + 2 * order);
      double* const flow = a + order * order;
      double* const start = flow + order * order;
      double* const exact = start + order;
      shake(network, &random);
      networks_get(network, start);
      networks_state_matrix(network, a);
      networks_exponential(order, a, 2.0, flow);
      networks_apply(order, flow, start, exact);
      const double coarse = error(network, scheme, start, exact, 2.0, steps[s]);
      const double fine = error(network, scheme, start, exact, 2.0, 2 * steps[s]);
      const double slope = log2(coarse / fine);
      worst = fmax(worst, fabs(slope - network_scheme_order(scheme)));
      mean += slope / 8;
      free(a);
      network_free(network);
    }
    print_message("  %s: slope %.4f\n", network_scheme_text(scheme), mean);
    /* The next power of h is still there. */
    assert_within("slope from the order", worst, 0.1);
  }
}

static void symplectic_euler_is_the_reference(void** state) {
  (void)state;
  Random random = random_start();
  Network* const network = modest(&random);
  Network* const copy = network_copy(network);
  shake(network, &random);
  memcpy(copy->x, network->x, network->n_points * sizeof(double));
  memcpy(copy->v, network->v, network->n_points * sizeof(double));
  for (int n = 0; n < 100; ++n) {
    network_step(copy, 0.1);
    network_step_by(network, NETWORK_SYMPLECTIC, 0.1);
  }
  assert_memory_equal(copy->x, network->x, network->n_points * sizeof(double));
  network_free(network);
  network_free(copy);
}

/* The eulers' energies per step of an undamped mass: 1 + ω²h² and its inverse, exactly. */
static void eulers_gain_and_lose_energy_as_they_must(void** state) {
  (void)state;
  static const double warps[] = {0.01, 0.5, 3.0};
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int n = 0; n < 2; ++n) {
      const NetworkScheme scheme = n ? NETWORK_BACKWARD : NETWORK_FORWARD;
      const double factor = 1.0 + warps[i] * warps[i];
      Network* const network = networks_mass(2.0, 2.0 * warps[i] * warps[i], 0.0);
      assert_int_equal(network_prepare(network), STATUS_OK);
      network->x[0] = 1.0;
      network->v[0] = 0.3;
      const double before = network_energy(network);
      assert_int_equal(network_step_by(network, scheme, 1.0), STATUS_OK);
      const double ratio = network_energy(network) / before;
      worst = fmax(worst, fabs(ratio / (n ? 1.0 / factor : factor) - 1.0));
      network_free(network);
    }
  }
  assert_within("energy of a step", worst, 32.0 * DBL_EPSILON);
}

static void backward_euler_solves_its_equation(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    Network* const network = networks_random(&random, &UNLIKE);
    const double h = random_log_between(&random, 1e-4, 1e2);
    assert_int_equal(network_prepare(network), STATUS_OK);
    shake(network, &random);
    network->force[0] = network->is_ground[0] ? 0.0 : 1.0;
    const size_t n = network->n_masses;
    double* const mass_kg = networks_zeros(n + 2 * n * n + 4 * n);
    double* const stiffness = mass_kg + n;
    double* const damping = stiffness + n * n;
    double* const old = damping + n * n;
    double* const new = old + 2 * n;
    assert_int_equal(network_matrices(network, mass_kg, stiffness, damping), STATUS_OK);
    networks_get(network, old);
    assert_int_equal(network_step_by(network, NETWORK_BACKWARD, h), STATUS_OK);
    networks_get(network, new);
    /* M (v' − v)/h = F − K x' − Z v'. */
    for (size_t i = 0; i < n; ++i) {
      double sum = mass_kg[i] * (new[n + i] - old[n + i]) / h;
      double size = mass_kg[i] * (fabs(new[n + i]) + fabs(old[n + i])) / h;
      for (size_t j = 0; j < n; ++j) {
        const double spring = stiffness[i + j * n] * new[j];
        const double damper = damping[i + j * n] * new[n + j];
        sum += spring + damper;
        size += fabs(spring) + fabs(damper);
      }
      worst = fmax(worst, fabs(sum) / size);
    }
    free(mass_kg);
    network_free(network);
  }
  /* The residual is small as a whole, 1e-15; a light mass or a weak spring has its share of it. */
  assert_within("residual, of its terms", worst, 1e-8);
}

static void backward_euler_never_explodes(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 50; ++trial) {
    Network* const network = networks_random(&random, &UNLIKE);
    assert_int_equal(network_prepare(network), STATUS_OK);
    shake(network, &random);
    const double h = random_log_between(&random, 1e-3, 1e3);
    for (int n = 0; n < 20; ++n) {
      const double before = network_energy(network);
      assert_int_equal(network_step_by(network, NETWORK_BACKWARD, h), STATUS_OK);
      assert_true(network_energy(network) <= before * (1.0 + 1e-9));
    }
    network_free(network);
  }
}

/* Whether a mass of the given ω h and γ h grows within `n_steps`. */
static bool grows(NetworkScheme scheme, double warp, double g, int n_steps) {
  Network* const network = networks_mass(1.0, warp * warp, g);
  network->x[0] = 1.0;
  for (int n = 0; n < n_steps; ++n) {
    network_step_by(network, scheme, 1.0);
  }
  const bool has_grown = !(network_energy(network) < 1e6);
  network_free(network);
  return has_grown;
}

static void leapfrogs_are_stable_up_to_their_limits(void** state) {
  (void)state;
  assert_false(grows(NETWORK_LEAPFROG, 1.9999, 0.0, 100000));
  assert_true(grows(NETWORK_LEAPFROG, 2.0001, 0.0, 100000));
  assert_false(grows(NETWORK_FOURTH, 1.573, 0.0, 100000));
  assert_true(grows(NETWORK_FOURTH, 1.575, 0.0, 100000));
  /* Dampers take no share of leapfrog's limit, however strong. */
  assert_false(grows(NETWORK_LEAPFROG, 1.9999, 0.1, 100000));
  assert_false(grows(NETWORK_LEAPFROG, 1.9999, 50.0, 100000));
  assert_true(grows(NETWORK_SYMPLECTIC, 1.9999, 0.1, 100000));
}

static void leapfrog_goes_back_the_way_it_came(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    Network* const network = modest(&random);
    const size_t order = 2 * (size_t)network->n_masses;
    double* const start = networks_zeros(2 * order);
    shake(network, &random);
    networks_get(network, start);
    for (int n = 0; n < 100; ++n) {
      network_step_by(network, n % 2 ? NETWORK_LEAPFROG : NETWORK_FOURTH, 1e-3);
    }
    for (int n = 99; n >= 0; --n) {
      network_step_by(network, n % 2 ? NETWORK_LEAPFROG : NETWORK_FOURTH, -1e-3);
    }
    networks_get(network, start + order);
    for (size_t i = 0; i < order; ++i) {
      worst = fmax(worst, fabs(start[order + i] - start[i]));
    }
    free(start);
    network_free(network);
  }
  /* The dampers' decay over the whole time is undone: of γ up to 100, by e^10 roundings. */
  assert_within("from the start", worst, 1e-8);
}

static void dampers_between_masses_keep_momentum(void** state) {
  (void)state;
  for (int s = 0; s < NETWORK_SCHEME_COUNT; ++s) {
    Network* const network = network_new();
    for (int i = 0; i < 3; ++i) {
      network_add_mass(network, 1.0 + i, NULL);
    }
    network_add_damper(network, 0, 1, 0.3);
    network_add_damper(network, 1, 2, 0.4);
    network_add_spring(network, 0, 2, 0.5);
    assert_int_equal(network_check(network, NULL), STATUS_OK);
    assert_int_equal(network_prepare(network), STATUS_OK);
    network->v[0] = 1.0;
    for (int n = 0; n < 1000; ++n) {
      assert_int_equal(network_step_by(network, (NetworkScheme)s, 0.1), STATUS_OK);
    }
    const double momentum = network->v[0] + 2.0 * network->v[1] + 3.0 * network->v[2];
    assert_within(network_scheme_text((NetworkScheme)s), fabs(momentum - 1.0), 1e-12);
    network_free(network);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(error_falls_with_the_order_of_the_scheme),
      cmocka_unit_test(symplectic_euler_is_the_reference),
      cmocka_unit_test(eulers_gain_and_lose_energy_as_they_must),
      cmocka_unit_test(backward_euler_solves_its_equation),
      cmocka_unit_test(backward_euler_never_explodes),
      cmocka_unit_test(leapfrogs_are_stable_up_to_their_limits),
      cmocka_unit_test(leapfrog_goes_back_the_way_it_came),
      cmocka_unit_test(dampers_between_masses_keep_momentum),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
