/* Levers: springs that many points pull at, against pairs of springs and dense matrices. */

#include "core/analysis/modes.h"
#include "core/analysis/network.h"
#include "core/analysis/network_schemes.h"
#include "core/base/maths.h"

#include "tests/support/networks.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const NetworkKind UNDAMPED = {20, 0.5, 1.0, 0.0, false};
static const NetworkKind DAMPED = {20, 0.5, 1.0, 0.7, true};

static Network* random_levers(Random* random, const NetworkKind* kind) {
  Network* const network = networks_random(random, kind);
  networks_add_levers(network, random, 1 + random_below(random, network->n_masses));
  return network;
}

static Network* four_masses(void) {
  Network* const network = network_new();
  for (int i = 0; i < 4; ++i) {
    assert_int_equal(network_add_mass(network, 1.0 + i, NULL), STATUS_OK);
  }
  return network;
}

static void add_lever(Network* network, double k, uint32_t n, const double* weight) {
  NetworkTerm term[4];
  for (uint32_t i = 0; i < n; ++i) {
    term[i] = (NetworkTerm){i, weight[i]};
  }
  assert_int_equal(network_add_lever(network, k, n, term), STATUS_OK);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
}

/* A moment, (x0 − 2 x1 + x2)², is springs of 2, 2 and −1; a twist, (x0 − x1 − x2 + x3)², of 1, 1,
 * −1 and so on round the square. */
static void bends_and_twists_are_pairs_of_springs(void** state) {
  (void)state;
  static const double weights[2][4] = {{1.0, -2.0, 1.0, 0.0}, {1.0, -1.0, -1.0, 1.0}};
  static const double pairs[2][4][4] = {
      {{0, 2, -1, 0}, {2, 0, 2, 0}, {-1, 2, 0, 0}, {0, 0, 0, 0}},
      {{0, 1, 1, -1}, {1, 0, -1, 1}, {1, -1, 0, 1}, {-1, 1, 1, 0}},
  };
  for (int kind = 0; kind < 2; ++kind) {
    Network* const network = four_masses();
    double mass_kg[4];
    double k[16];
    add_lever(network, 3.0, 4, weights[kind]);
    assert_int_equal(network_matrices(network, mass_kg, k, NULL), STATUS_OK);
    for (int i = 0; i < 4; ++i) {
      double sum = 0.0;
      for (int j = 0; j < 4; ++j) {
        sum += 3.0 * pairs[kind][i][j];
        assert_true(i == j || k[i + 4 * j] == -3.0 * pairs[kind][i][j]);
      }
      assert_true(k[5 * i] == sum);
    }
    network_free(network);
  }
}

static void a_step_is_that_of_the_matrices(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 50; ++trial) {
    Network* const network = random_levers(&random, &DAMPED);
    const size_t n = network->n_masses;
    const size_t order = 2 * n;
    const double step_s = 0.1;
    double* const step = networks_zeros(2 * order * order);
    double* const a = step + order * order;
    networks_step_matrix(network, step_s, step);
    networks_state_matrix(network, a);
    for (size_t j = 0; j < order; ++j) {
      for (size_t i = 0; i < n; ++i) {
        const double v = (n + i == j ? 1.0 : 0.0) + step_s * a[n + i + j * order];
        const double x = (i == j ? 1.0 : 0.0) + step_s * v;
        worst = fmax(worst, fabs(step[n + i + j * order] - v) / (1.0 + fabs(v)));
        worst = fmax(worst, fabs(step[i + j * order] - x) / (1.0 + fabs(x)));
      }
    }
    free(step);
    network_free(network);
  }
  assert_within("a step, relative", worst, 1e-13);
}

static void the_scheme_keeps_its_energy(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 30; ++trial) {
    Network* const network = random_levers(&random, &UNDAMPED);
    double step_s = 0.0;
    assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_OK);
    for (uint32_t p = 0; p < network->n_points; ++p) {
      network->v[p] = network->is_ground[p] ? 0.0 : random_between(&random, -1.0, 1.0);
    }
    step_s *= 0.7;
    const double before = network_scheme_energy(network, step_s);
    for (int n = 0; n < 2000; ++n) {
      network_step(network, step_s);
    }
    worst = fmax(worst, fabs(network_scheme_energy(network, step_s) / before - 1.0));
    network_free(network);
  }
  assert_within("energy, relative", worst, 1e-11);
}

/* The error of one step of h against e^{hA}, from the same state. */
static double error_of_step(
    Network* network, NetworkScheme scheme, const double* start, const double* a, double step_s) {
  const size_t order = 2 * (size_t)network->n_masses;
  double* const matrix = networks_zeros(order * order + 2 * order);
  double* const truth = matrix + order * order;
  double* const got = truth + order;
  networks_exponential(order, a, step_s, matrix);
  networks_apply(order, matrix, start, truth);
  networks_set(network, start);
  assert_int_equal(network_step_by(network, scheme, step_s), STATUS_OK);
  networks_get(network, got);
  double error = 0.0;
  for (size_t i = 0; i < order; ++i) {
    error = fmax(error, fabs(got[i] - truth[i]));
  }
  free(matrix);
  return error;
}

static void all_schemes_have_their_order(void** state) {
  (void)state;
  Random random = random_start();
  Network* const network = random_levers(&random, &UNDAMPED);
  const size_t order = 2 * (size_t)network->n_masses;
  double* const a = networks_zeros(order * order + order);
  double* const start = a + order * order;
  double step_s = 0.0;
  networks_state_matrix(network, a);
  assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_OK);
  assert_int_equal(network_prepare(network), STATUS_OK);
  for (size_t i = 0; i < order; ++i) {
    start[i] = random_between(&random, -1.0, 1.0);
  }
  for (int s = 0; s < NETWORK_SCHEME_COUNT; ++s) {
    const NetworkScheme scheme = (NetworkScheme)s;
    const double whole = error_of_step(network, scheme, start, a, 0.05 * step_s);
    const double half = error_of_step(network, scheme, start, a, 0.025 * step_s);
    const double slope = log2(whole / half) - network_scheme_order(scheme) - 1.0;
    assert_within(network_scheme_text(scheme), fabs(slope), 0.2);
  }
  free(a);
  network_free(network);
}

static void the_verdict_is_that_of_the_steps(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 60; ++trial) {
    Network* const network = random_levers(&random, trial % 2 ? &DAMPED : &UNDAMPED);
    double step_s = 0.0;
    assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_OK);
    assert_true(networks_spectral_radius(network, 0.999 * step_s) <= 1.0 + 1e-7);
    assert_true(networks_spectral_radius(network, 1.001 * step_s) > 1.0 + 1e-4);
    network_free(network);
  }
}

/* The sum of all poles is the step matrix's trace, and the largest its radius. */
static void modes_are_those_of_the_steps(void** state) {
  (void)state;
  Random random = random_start();
  double worst_trace = 0.0;
  double worst_radius = 0.0;
  double worst_few = 0.0;
  for (int trial = 0; trial < 60; ++trial) {
    Network* const network = random_levers(&random, trial % 2 ? &DAMPED : &UNDAMPED);
    const size_t order = 2 * (size_t)network->n_masses;
    double* const step = networks_zeros(order * order);
    double step_s = 0.0;
    double trace = 0.0;
    double sum = 0.0;
    Modes* modes = NULL;
    Modes* few = NULL;
    assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_OK);
    step_s *= 0.8;
    networks_step_matrix(network, step_s, step);
    assert_int_equal(modes_solve(network, 1.0 / step_s, 0, &modes), STATUS_OK);
    assert_int_equal(modes_solve(network, 1.0 / step_s, 2, &few), STATUS_OK);
    for (size_t i = 0; i < order; ++i) {
      trace += step[i * (order + 1)];
      sum += creal(modes->mode[i / 2].pole[i % 2]);
    }
    worst_trace = fmax(worst_trace, fabs(trace - sum) / (double)order);
    worst_radius =
        fmax(worst_radius, fabs(modes->radius - networks_spectral_radius(network, step_s)));
    for (uint32_t k = 0; k < few->n_modes; ++k) {
      worst_few = fmax(worst_few, cabs(few->mode[k].pole[0] - modes->mode[k].pole[0]));
    }
    modes_free(modes);
    modes_free(few);
    free(step);
    network_free(network);
  }
  assert_within("trace", worst_trace, 1e-12);
  assert_within("radius", worst_radius, 1e-7);
  assert_within("the lowest", worst_few, 1e-9);
}

/* 300 masses in a row, bent: many more than are wanted, and the rows of three. */
static void a_hinged_bar_has_its_closed_form(void** state) {
  (void)state;
  enum { N = 300 };
  Network* const network = network_new();
  uint32_t point[N + 2];
  assert_int_equal(network_add_ground(network, &point[0]), STATUS_OK);
  for (uint32_t i = 1; i <= N; ++i) {
    assert_int_equal(network_add_mass(network, 0.01, &point[i]), STATUS_OK);
  }
  assert_int_equal(network_add_ground(network, &point[N + 1]), STATUS_OK);
  for (uint32_t i = 1; i <= N; ++i) {
    const NetworkTerm term[] = {{point[i - 1], 1.0}, {point[i], -2.0}, {point[i + 1], 1.0}};
    assert_int_equal(network_add_lever(network, 1e7, 3, term), STATUS_OK);
  }
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  double worst[2] = {0.0, 0.0};
  for (int pass = 0; pass < 2; ++pass) {
    Modes* modes = NULL;
    assert_int_equal(modes_solve(network, 1e6, pass ? 5 : 0, &modes), STATUS_OK);
    for (uint32_t k = 1; k <= modes->n_modes; ++k) {
      const double bend = 4.0 * pow(sin(0.5 * PI * k / (N + 1)), 2.0);
      const double omega = sqrt(1e9) * bend;
      worst[pass] = fmax(worst[pass], fabs(cimag(modes->mode[k - 1].analog[0]) / omega - 1.0));
    }
    modes_free(modes);
  }
  /* Roundings of sums such as 1 − 2 + 1 are of K x, and grow as (N/π)² against what is left. */
  assert_within("all, relative", worst[0], 1e-10);
  assert_within("few, relative", worst[1], 1e-10);
  network_free(network);
}

/* A bar on no ground, of one bend alone: it drifts, turns, and has one mode, √(6 k/m). */
static void a_bar_may_be_free(void** state) {
  (void)state;
  static const double bend[] = {1.0, -2.0, 1.0};
  Network* const network = network_new();
  for (int i = 0; i < 3; ++i) {
    assert_int_equal(network_add_mass(network, 2.0, NULL), STATUS_OK);
  }
  add_lever(network, 12.0, 3, bend);
  Modes* modes = NULL;
  assert_int_equal(modes_solve(network, 1000.0, 0, &modes), STATUS_OK);
  assert_true(modes->is_stable && modes->n_modes == 3);
  assert_within("drift", cabs(modes->mode[0].analog[0]), 0.0);
  assert_within("turn [1/s]", cabs(modes->mode[1].analog[0]), 1e-6);
  assert_within("bend", fabs(cimag(modes->mode[2].analog[0]) - 6.0), 1e-12);
  modes_free(modes);
  network_free(network);
}

static void levers_that_are_none_are_refused(void** state) {
  (void)state;
  static const struct {
    double k;
    NetworkTerm term[2];
    Status status;
  } wrong[] = {
      {-1.0, {{0, 1.0}, {1, 1.0}}, STATUS_BAD_LINK},
      {NAN, {{0, 1.0}, {1, 1.0}}, STATUS_BAD_LINK},
      {INFINITY, {{0, 1.0}, {1, 1.0}}, STATUS_BAD_LINK},
      {1.0, {{0, 1.0}, {1, NAN}}, STATUS_BAD_LINK},
      {1.0, {{0, 1.0}, {4, 1.0}}, STATUS_NO_SUCH_POINT},
      {1.0, {{1, 1.0}, {1, 1.0}}, STATUS_SELF_LINK},
  };
  for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); ++i) {
    static const double twist[] = {1.0, -1.0, -1.0, 1.0};
    Network* const network = four_masses();
    NetworkFault fault = {NETWORK_POINT, 9};
    add_lever(network, 1.0, 4, twist);
    assert_int_equal(network_add_lever(network, wrong[i].k, 2, wrong[i].term), STATUS_OK);
    assert_int_equal(network_check(network, &fault), wrong[i].status);
    assert_true(fault.element == NETWORK_LEVER && fault.index == 1);
    network_free(network);
  }
}

static void copies_and_factors_reach_levers(void** state) {
  (void)state;
  Random random = random_start();
  Network* const network = random_levers(&random, &UNDAMPED);
  Network* const copy = network_copy(network);
  assert_non_null(copy);
  for (uint32_t p = 0; p < network->n_points; ++p) {
    copy->x[p] = network->x[p] = random_between(&random, -1.0, 1.0);
  }
  const double energy = network_energy(network);
  assert_true(network_energy(copy) == energy);
  network_scale(network, 4.0, 1.0);
  assert_true(network_energy(network) == 4.0 * energy && network_energy(copy) == energy);
  network_free(network);
  network_free(copy);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bends_and_twists_are_pairs_of_springs),
      cmocka_unit_test(a_step_is_that_of_the_matrices),
      cmocka_unit_test(the_scheme_keeps_its_energy),
      cmocka_unit_test(all_schemes_have_their_order),
      cmocka_unit_test(the_verdict_is_that_of_the_steps),
      cmocka_unit_test(modes_are_those_of_the_steps),
      cmocka_unit_test(a_hinged_bar_has_its_closed_form),
      cmocka_unit_test(a_bar_may_be_free),
      cmocka_unit_test(levers_that_are_none_are_refused),
      cmocka_unit_test(copies_and_factors_reach_levers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
