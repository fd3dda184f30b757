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

static const double PI = 3.14159265358979323846;

/* What a modest simulation is made of. */
static const NetworkKind MODEST = {12, 0.5, 0.5, 1.0, true};

/* The scheme in matrices: v' = (I − h M⁻¹Z) v − h M⁻¹K x, x' = x + h v'. */
static void step_is_the_step_matrix(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    Network* const network = networks_random(&random, &MODEST);
    const size_t n = network->n_masses;
    const size_t order = 2 * n;
    const double h = 0.01;
    double* const space = networks_zeros(2 * order * order);
    double* const a = space + order * order;
    networks_step_matrix(network, h, space);
    networks_state_matrix(network, a);
    for (size_t j = 0; j < order; ++j) {
      for (size_t i = 0; i < n; ++i) {
        const double new_v = (n + i == j ? 1.0 : 0.0) + h * a[n + i + j * order];
        const double new_x = (i == j ? 1.0 : 0.0) + h * new_v;
        worst = fmax(worst, fabs(space[n + i + j * order] - new_v));
        worst = fmax(worst, fabs(space[i + j * order] - new_x));
      }
    }
    free(space);
    network_free(network);
  }
  assert_within("entries", worst, 16.0 * DBL_EPSILON);
}

static void simulation_is_the_powers_of_the_step_matrix(void** state) {
  (void)state;
  enum { STEPS = 1000 };
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 30; ++trial) {
    Network* const network = networks_random(&random, &MODEST);
    const size_t order = 2 * (size_t)network->n_masses;
    double* const matrix = networks_zeros(order * order + 3 * order);
    double* const start = matrix + order * order;
    double* const next = start + order;
    double* const got = next + order;
    networks_step_matrix(network, 0.05, matrix);
    for (size_t i = 0; i < order; ++i) {
      start[i] = random_between(&random, -1.0, 1.0);
    }
    networks_set(network, start);
    double largest = 0.0;
    double off = 0.0;
    for (int n = 0; n < STEPS; ++n) {
      network_step(network, 0.05);
      networks_get(network, got);
      networks_apply(order, matrix, start, next);
      memcpy(start, next, order * sizeof(double));
      for (size_t i = 0; i < order; ++i) {
        largest = fmax(largest, fabs(next[i]));
        off = fmax(off, fabs(got[i] - next[i]));
      }
    }
    worst = fmax(worst, off / largest);
    free(matrix);
    network_free(network);
  }
  /* A rounding a step in each of up to 24 numbers, none forgotten where nothing damps. */
  assert_within("of the largest, over 1000 steps", worst, STEPS * 24 * DBL_EPSILON);
}

static void external_force_moves_the_rest_position(void** state) {
  (void)state;
  Network* const network = networks_mass(2.0, 50.0, 20.0);
  network->force[0] = 3.0;
  for (int n = 0; n < 5000; ++n) {
    network_step(network, 0.01);
  }
  assert_within("x = F/k", fabs(network->x[0] - 0.06), 1e-15);
  network_rest(network);
  assert_true(network->x[0] == 0.0 && network->v[0] == 0.0 && network->force[0] == 0.0);
  network_free(network);
}

static void displaced_ground_carries_what_hangs_on_it(void** state) {
  (void)state;
  Network* const network = networks_mass(2.0, 50.0, 20.0);
  network->x[1] = 0.25;
  for (int n = 0; n < 5000; ++n) {
    network_step(network, 0.01);
  }
  assert_within("x", fabs(network->x[0] - 0.25), 1e-15);
  assert_true(network->v[1] == 0.0 && network->x[1] == 0.25);
  network_free(network);
}

static void parts_do_not_touch_even_when_one_explodes(void** state) {
  (void)state;
  Network* const network = networks_mass(1.0, 1.0, 0.1);
  Network* const alone = networks_mass(1.0, 1.0, 0.1);
  uint32_t wild = 0;
  network_add_mass(network, 1.0, &wild);
  network_add_spring(network, wild, 1, 1e9);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  network->x[0] = alone->x[0] = 1.0;
  network->x[wild] = 1.0;
  for (int n = 0; n < 2000; ++n) {
    network_step(network, 0.1);
    network_step(alone, 0.1);
    assert_true(network->x[0] == alone->x[0]);
  }
  assert_true(!isfinite(network->x[wild]));
  network_free(network);
  network_free(alone);
}

static void copy_goes_its_own_way_from_the_same_place(void** state) {
  (void)state;
  Random random = random_start();
  Network* const network = networks_random(&random, &MODEST);
  network->x[0] = network->v[0] = 1.0;
  network->force[0] = 0.5;
  Network* const copy = network_copy(network);
  assert_non_null(copy);
  assert_true(copy->is_checked);
  for (int n = 0; n < 100; ++n) {
    network_step(network, 0.01);
  }
  assert_true(copy->x[0] == 1.0);
  for (int n = 0; n < 100; ++n) {
    network_step(copy, 0.01);
  }
  assert_memory_equal(copy->x, network->x, network->n_points * sizeof(double));
  network_scale(copy, 2.0, 3.0);
  assert_true(copy->springs.link[0].value == 2.0 * network->springs.link[0].value);
  uint32_t point = 0;
  network_add_mass(copy, 1.0, &point);
  assert_int_equal(point, network->n_points);
  network_free(network);
  network_free(copy);
}

/* Section 3.9: one mass of 125 Hz, γ = 50, 1000 steps a second. */
static void experiment(double x0, double v0, const char* what) {
  enum { SAMPLES = 1000 };
  const double h = 1e-3;
  const double omega0 = 2.0 * PI * 125.0;
  const double complex z = 0.97467943448090 * cexp(complex_of(0.0, 817.7132374981528 * h));
  Network* const network = networks_mass(1.0, omega0 * omega0, 50.0);
  network->x[0] = x0;
  network->v[0] = v0;
  /* x_n = Re (c zⁿ) with x_0 and x_1 as the scheme has them. */
  const double x1 = x0 + h * (v0 - h * (omega0 * omega0 * x0 + 50.0 * v0));
  const double complex c = complex_of(x0, (x0 * creal(z) - x1) / cimag(z));
  /* The paper's start: that of the continuous oscillator. */
  const double mu = sqrt(omega0 * omega0 - 625.0);
  const double complex paper = complex_of(x0, -(v0 + 25.0 * x0) / mu);
  double worst = 0.0;
  double worst_paper = 0.0;
  for (int n = 0; n < SAMPLES; ++n) {
    const double complex power = cpow(z, n);
    worst = fmax(worst, fabs(network->x[0] - creal(c * power)));
    worst_paper = fmax(worst_paper, fabs(network->x[0] - creal(paper * power)));
    network_step(network, h);
  }
  assert_within(what, worst / cabs(c), 1e-12);
  print_message("  with the continuous start condition it would be %.3g\n", worst_paper / cabs(c));
  assert_true(worst_paper > 0.02 * cabs(c));
  network_free(network);
}

static void experiments_of_section_3_9_are_met_sample_by_sample(void** state) {
  (void)state;
  experiment(1.0, 0.0, "displaced, of the amplitude");
  experiment(0.0, 1.0, "pushed, of the amplitude");
}

/* Table 1's first mode by simulation: its shape alone, a sine, moves as one mass. */
static void table_1_is_heard(void** state) {
  (void)state;
  static const double hz[5] = {440.00000, 872.76842, 1287.45585, 1662.75731, 1951.81777};
  static const double tau_s[5] = {1.000000, 0.2678272, 0.1338302, 0.0891645, 0.0716419};
  const double omega0 = 5293.239300336853;
  double worst_hz = 0.0;
  double worst_tau = 0.0;
  for (int k = 1; k <= 5; ++k) {
    Network* const network = networks_string(5, 1.0, omega0 * omega0, 7.46285773640857);
    for (uint32_t i = 0; i < 5; ++i) {
      network->x[i] = sin(PI * k * (i + 1) / 6.0);
    }
    const double x0 = network->x[0];
    network_step(network, 1.0 / 6000.0);
    const double x1 = network->x[0];
    network_step(network, 1.0 / 6000.0);
    const double x2 = network->x[0];
    network_step(network, 1.0 / 6000.0);
    const double x3 = network->x[0];
    /* Prony: x_{n+1} = 2 Re z x_n − |z|² x_{n−1}. */
    const double det = x1 * x1 - x2 * x0;
    const double sum = (x1 * x2 - x3 * x0) / det;
    const double product = (x2 * x2 - x1 * x3) / det;
    const double angle = atan2(sqrt(4.0 * product - sum * sum), sum);
    worst_hz = fmax(worst_hz, fabs(angle * 6000.0 / (2.0 * PI) - hz[k - 1]));
    worst_tau = fmax(worst_tau, fabs(-2.0 / (6000.0 * log(product)) - tau_s[k - 1]));
    network_free(network);
  }
  /* Half of the last printed digit. */
  assert_within("F, Hz", worst_hz, 0.5e-5);
  assert_within("τ, s", worst_tau, 0.5e-7 * 1.02);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(step_is_the_step_matrix),
      cmocka_unit_test(simulation_is_the_powers_of_the_step_matrix),
      cmocka_unit_test(external_force_moves_the_rest_position),
      cmocka_unit_test(displaced_ground_carries_what_hangs_on_it),
      cmocka_unit_test(parts_do_not_touch_even_when_one_explodes),
      cmocka_unit_test(copy_goes_its_own_way_from_the_same_place),
      cmocka_unit_test(experiments_of_section_3_9_are_met_sample_by_sample),
      cmocka_unit_test(table_1_is_heard),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
