#include "core/analysis/modes.h"

#include "core/string/tuning.h"

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

static const NetworkKind MODEST = {12, 0.5, 1.0, 0.7, true};
static const NetworkKind UNDAMPED = {30, 0.5, 1.0, 0.0, false};

/* The paper's worked example, k and Z of 1 kg. */
static const double OMEGA0 = 5293.239300336853;
static const double DAMPING = 7.46285773640857;

static Modes* solve(const Network* network, double rate_hz, uint32_t n_wanted) {
  Modes* modes = NULL;
  assert_int_equal(modes_solve(network, rate_hz, n_wanted, &modes), STATUS_OK);
  assert_non_null(modes);
  return modes;
}

static double relative(double value, double truth) {
  return fabs(value - truth) / fabs(truth);
}

static void check_table_1(const Modes* modes) {
  static const double hz[5] = {440.00000, 872.76842, 1287.45585, 1662.75731, 1951.81777};
  static const double tau_s[5] = {1.000000, 0.2678272, 0.1338302, 0.0891645, 0.0716419};
  double worst_hz = 0.0;
  double worst_tau = 0.0;
  assert_int_equal(modes->n_modes, 5);
  for (int k = 0; k < 5; ++k) {
    worst_hz = fmax(worst_hz, fabs(modes->mode[k].tone.f0_hz - hz[k]));
    worst_tau = fmax(worst_tau, fabs(modes->mode[k].tone.tau_s - tau_s[k]));
    assert_int_equal(modes->mode[k].region, POLE_COMPLEX);
  }
  assert_within("F, Hz: half a digit", worst_hz, 0.5e-5);
  assert_within("τ, s: half a digit", worst_tau, 0.5e-7);
}

static void table_1_by_the_symmetric_solver(void** state) {
  (void)state;
  Network* const network = networks_string(5, 1.0, OMEGA0 * OMEGA0, DAMPING);
  Modes* const modes = solve(network, 6000.0, 0);
  assert_true(modes->is_proportional && modes->is_stable && modes->paper_is_stable);
  check_table_1(modes);
  modes_free(modes);
  network_free(network);
}

/* Damping that is not proportional by one part in 10¹² goes the general way. */
static void table_1_by_dgeev(void** state) {
  (void)state;
  Network* const network = networks_string(5, 1.0, OMEGA0 * OMEGA0, DAMPING);
  network->dampers.link[2].value *= 1.0 + 1e-12;
  Modes* const modes = solve(network, 6000.0, 0);
  assert_false(modes->is_proportional);
  check_table_1(modes);
  modes_free(modes);
  network_free(network);
}

/* The greatest distance from one of `a` to its nearest in `b`, no one taken twice. */
static double distance(size_t n, const double complex* a, double complex* b) {
  double worst = 0.0;
  for (size_t i = 0; i < n; ++i) {
    size_t best = i;
    for (size_t j = i; j < n; ++j) {
      if (cabs(a[i] - b[j]) < cabs(a[i] - b[best])) {
        best = j;
      }
    }
    worst = fmax(worst, cabs(a[i] - b[best]));
    b[best] = b[i];
  }
  return worst;
}

/* The eigenvalues of A and of the step matrix by LAPACK, as they come. */
static void poles_are_the_eigenvalues_of_the_step(void** state) {
  (void)state;
  Random random = random_start();
  double worst_s = 0.0;
  double worst_z = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    Network* const network = networks_random(&random, trial % 3 ? &MODEST : &UNDAMPED);
    const size_t order = 2 * (size_t)network->n_masses;
    double limit_s = 0.0;
    assert_int_equal(modes_largest_step(network, NULL, &limit_s), STATUS_OK);
    const double h = limit_s * random_between(&random, 0.05, 1.5);
    Modes* const modes = solve(network, 1.0 / h, 0);
    double* const matrix = networks_zeros(order * order);
    double complex* const values = calloc(4 * order, sizeof(double complex));
    assert_non_null(values);
    double complex* const s = values + order;
    double complex* const z = s + order;
    double largest = 0.0;
    for (uint32_t k = 0; k < modes->n_modes; ++k) {
      memcpy(s + 2 * (size_t)k, modes->mode[k].analog, 2 * sizeof(double complex));
      memcpy(z + 2 * (size_t)k, modes->mode[k].pole, 2 * sizeof(double complex));
      largest = fmax(largest, cabs(s[2 * (size_t)k + 1]));
    }
    networks_state_matrix(network, matrix);
    oracle_eigenvalues(order, matrix, values);
    worst_s = fmax(worst_s, distance(order, s, values) / largest);
    networks_step_matrix(network, h, matrix);
    oracle_eigenvalues(order, matrix, values);
    worst_z = fmax(worst_z, distance(order, z, values) / fmax(1.0, modes->radius));
    free(matrix);
    free(values);
    modes_free(modes);
    network_free(network);
  }
  /* Two real values about to meet move by the root of a rounding. */
  assert_within("s, of the largest", worst_s, 4.0 * sqrt(DBL_EPSILON));
  assert_within("z, of the radius", worst_z, 4.0 * sqrt(DBL_EPSILON));
}

/* A mode by itself: simulate its real part and listen. */
static void modes_are_heard_where_they_are_listed(void** state) {
  (void)state;
  Network* const network = networks_string(6, 1.0, 4e6, 20.0);
  network_add_damper(network, 1, 6, 300.0);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  Modes* const modes = solve(network, 8000.0, 0);
  assert_false(modes->is_proportional);
  /* Any output of a linear system obeys its characteristic equation: Π (E − z) x = 0. */
  double complex polynomial[13] = {1.0};
  for (uint32_t k = 0; k < 12; ++k) {
    const double complex z = modes->mode[k / 2].pole[k % 2];
    for (uint32_t i = k + 1; i > 0; --i) {
      polynomial[i] = (i > k ? 0.0 : -z * polynomial[i]) + polynomial[i - 1];
    }
    polynomial[0] *= -z;
  }
  double x[13];
  network->x[2] = 1.0;
  network->v[4] = -100.0;
  for (int n = 0; n < 13; ++n) {
    x[n] = network->x[3];
    network_step(network, 1.0 / 8000.0);
  }
  double complex sum = 0.0;
  double size = 0.0;
  for (int n = 0; n < 13; ++n) {
    sum += polynomial[n] * x[n];
    size += cabs(polynomial[n]) * fabs(x[n]);
  }
  assert_within("Π (E − z) x, of its terms", cabs(sum) / size, 1e-13);
  modes_free(modes);
  network_free(network);
}

static void warping_is_that_of_the_paper(void** state) {
  (void)state;
  /* The eigenvalue −1 ± j2π440 at 6000 Hz sounds at 444.026 Hz. */
  const double mu = 2.0 * PI * 440.0;
  Network* const network = networks_mass(1.0, 1.0 + mu * mu, 2.0);
  Modes* const modes = solve(network, 6000.0, 0);
  assert_within("Hz from 444.026", fabs(modes->mode[0].tone.f0_hz - 444.026), 0.5e-3);
  assert_within("cents",
                fabs(modes->mode[0].warp_cents - 1200.0 * log2(modes->mode[0].tone.f0_hz / 440.0)),
                1e-9);
  assert_within("s", cabs(modes->mode[0].analog[0] - complex_of(-1.0, mu)) / mu, 4.0 * DBL_EPSILON);
  modes_free(modes);
  network_free(network);
}

static void single_masses_move_as_their_region_says(void** state) {
  (void)state;
  Random random = random_start();
  int n_of[POLE_REGION_COUNT] = {0};
  double worst = 0.0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Pole pole = {random_between(&random, 0.0, 5.0), random_between(&random, 0.0, 2.5)};
    Network* const network = networks_mass(1.0, pole.a, pole.g);
    Modes* const modes = solve(network, 1.0, 0);
    const Mode* const mode = &modes->mode[0];
    const Tone tone = pole_tone(1.0, pole);
    assert_int_equal(mode->region, pole_region(pole));
    assert_int_equal(modes->is_stable, pole_is_stable(pole));
    assert_int_equal(modes->paper_is_stable, pole_is_stable(pole));
    worst = fmax(worst, fabs(mode->radius - pole_radius(pole)));
    worst = fmax(worst, fabs(mode->tone.f0_hz - tone.f0_hz));
    assert_true(isnan(mode->warp_cents) ==
                !(cimag(mode->analog[0]) > 0.0 && pole_is_complex(pole)));
    ++n_of[mode->region];
    modes_free(modes);
    network_free(network);
  }
  assert_within("radius and F, cycles a sample", worst, 1e-9);
  for (int r = 0; r < POLE_REGION_COUNT; ++r) {
    assert_true(n_of[r] > 50);
  }
}

static void overdamped_modes_are_pairs_of_real_values(void** state) {
  (void)state;
  Network* const network = networks_string(8, 1.0, 100.0, 200.0);
  double worst = 0.0;
  for (int general = 0; general < 2; ++general) {
    network->dampers.link[0].value *= general ? 1.0 + 1e-12 : 1.0;
    Modes* const modes = solve(network, 48000.0, 0);
    assert_int_equal(modes->is_proportional, !general);
    for (uint32_t k = 1; k <= 8; ++k) {
      const Mode* const mode = &modes->mode[k - 1];
      const double lambda = tuning_lambda(8, k);
      const double half = 100.0 * lambda;
      const double faster = half + sqrt(half * half - 100.0 * lambda);
      assert_true(half * half < 100.0 * lambda || cimag(mode->analog[0]) == 0.0);
      if (half * half > 100.0 * lambda) {
        const double product = creal(mode->analog[0] * mode->analog[1]);
        worst = fmax(worst, relative(product, 100.0 * lambda));
        worst = fmax(worst, relative(-creal(mode->analog[1]), faster));
        assert_int_equal(mode->region, POLE_REAL_AT_ZERO);
        assert_true(mode->tone.f0_hz == 0.0 && isnan(mode->warp_cents));
        /* What lasts is the slower of the two. */
        worst = fmax(worst, 1e-4 * relative(mode->tone.tau_s, faster / (100.0 * lambda)));
      }
    }
    modes_free(modes);
  }
  assert_within("values, relative; τ up to h/τ", worst, 1e-7);
  network_free(network);
}

static void what_cannot_be_judged_is_refused(void** state) {
  (void)state;
  static const double bad_rates[] = {0.0, -1.0, HUGE_VAL, (double)NAN};
  Modes* modes = NULL;
  double step_s = 12345.0;
  Network* const network = networks_string(3, 1.0, 2.0, 3.0);
  for (int i = 0; i < 4; ++i) {
    assert_int_equal(modes_solve(network, bad_rates[i], 0, &modes), STATUS_BAD_ARGUMENT);
  }
  uint32_t stray = 0;
  network_add_mass(network, 1.0, &stray);
  assert_int_equal(modes_solve(network, 1.0, 0, &modes), STATUS_BAD_ARGUMENT);
  assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_BAD_ARGUMENT);
  network_add_spring(network, stray, 3, 1e300);
  network->mass_kg[stray] = 1e-300;
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  assert_int_equal(modes_solve(network, 1.0, 0, &modes), STATUS_ILL_SCALED);
  assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_ILL_SCALED);
  assert_null(modes);
  assert_true(step_s == 12345.0);
  network_free(network);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(table_1_by_the_symmetric_solver),
      cmocka_unit_test(table_1_by_dgeev),
      cmocka_unit_test(poles_are_the_eigenvalues_of_the_step),
      cmocka_unit_test(modes_are_heard_where_they_are_listed),
      cmocka_unit_test(warping_is_that_of_the_paper),
      cmocka_unit_test(single_masses_move_as_their_region_says),
      cmocka_unit_test(overdamped_modes_are_pairs_of_real_values),
      cmocka_unit_test(what_cannot_be_judged_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
