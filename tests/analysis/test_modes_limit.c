/* The largest stable step, found three other ways. */

#include "core/analysis/modes.h"

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

static const NetworkKind MODEST = {12, 0.5, 1.0, 0.7, true};

static double largest_step(const Network* network) {
  double step_s = 0.0;
  assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_OK);
  return step_s;
}

/* The limit again: 2/μ, with μ the largest root of det(μ² M − μ Z − K). */
static double limit_by_roots(const Network* network) {
  const size_t order = 2 * (size_t)network->n_masses;
  double* const a = networks_zeros(order * order);
  double complex* const values = calloc(order, sizeof(double complex));
  assert_non_null(values);
  networks_state_matrix(network, a);
  for (size_t j = 0; j < order; ++j) {
    for (size_t i = order / 2; i < order; ++i) {
      a[i + j * order] = -a[i + j * order];
    }
  }
  oracle_eigenvalues(order, a, values);
  double root = 0.0;
  for (size_t k = 0; k < order; ++k) {
    root = fmax(root, creal(values[k]));
  }
  free(a);
  free(values);
  return 2.0 / root;
}

static void limit_is_where_the_radius_leaves_one(void** state) {
  (void)state;
  Random random = random_start();
  double worst_roots = 0.0;
  double worst_radius = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    Network* const network = networks_random(&random, &MODEST);
    const double limit_s = largest_step(network);
    worst_roots = fmax(worst_roots, fabs(limit_by_roots(network) / limit_s - 1.0));
    double low = 0.5 * limit_s;
    double high = 2.0 * limit_s;
    /* The radius passes 1 with a slope of 2 or more, so its rounding is that of the limit. */
    for (int n = 0; n < 50; ++n) {
      const double middle = 0.5 * (low + high);
      *(networks_spectral_radius(network, middle) > 1.0 + 1e-10 ? &high : &low) = middle;
    }
    worst_radius = fmax(worst_radius, fabs(high / limit_s - 1.0));
    network_free(network);
  }
  assert_within("limit by roots, relative", worst_roots, 1e-13);
  assert_within("limit by the radius, relative", worst_radius, 1e-9);
}

static void limit_of_one_mass_is_its_own(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 1000; ++trial) {
    const double mass_kg = random_log_between(&random, 1e-9, 1e3);
    const double stiffness = random_log_between(&random, 1e-6, 1e12);
    const double damping = random_log_between(&random, 1e-9, 1e9);
    Network* const network = networks_mass(mass_kg, stiffness, damping);
    const double expected = pole_largest_step_s(sqrt(stiffness / mass_kg), damping / mass_kg);
    worst = fmax(worst, fabs(largest_step(network) / expected - 1.0));
    network_free(network);
  }
  assert_within("relative", worst, 8.0 * DBL_EPSILON);
}

static void limit_of_a_string_is_its_last_mode(void** state) {
  (void)state;
  static const double PI = 3.14159265358979323846;
  double worst = 0.0;
  for (uint32_t n = 1; n <= 4096; n *= 2) {
    Network* const network = networks_string(n, 2.0, 8e6, 30.0);
    const double half = 2.0 * cos(0.5 * PI / (n + 1.0));
    const double expected = pole_largest_step_s(half * sqrt(4e6), half * half * 15.0);
    worst = fmax(worst, fabs(largest_step(network) / expected - 1.0));
    network_free(network);
  }
  assert_within("relative", worst, 16.0 * DBL_EPSILON);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(limit_is_where_the_radius_leaves_one),
      cmocka_unit_test(limit_of_one_mass_is_its_own),
      cmocka_unit_test(limit_of_a_string_is_its_last_mode),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
