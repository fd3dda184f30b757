/* The lowest modes where dampers are unequal, against all of them. */

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
#include <time.h>

#include <cmocka.h>

static Modes* solve(const Network* network, double rate_hz, uint32_t n_wanted) {
  Modes* modes = NULL;
  assert_int_equal(modes_solve(network, rate_hz, n_wanted, &modes), STATUS_OK);
  return modes;
}

/* Dampers from anywhere to anywhere, times what is critical for one mass. */
static void add_dampers(Network* network, Random* random, uint32_t n, double size) {
  while (n > 0) {
    const uint32_t a = random_below(random, network->n_points);
    const uint32_t b = random_below(random, network->n_points);
    if (a != b) {
      assert_int_equal(network_add_damper(network, a, b, size * random_between(random, 0.0, 1.0)),
                       STATUS_OK);
      --n;
    }
  }
  assert_int_equal(network_check(network, NULL), STATUS_OK);
}

/* The first of `few` beside the first of `all`, the worst of s and z, relative to themselves and to
 * z − 1. */
static double distance(const Modes* few, const Modes* all) {
  double worst = 0.0;
  assert_int_equal(few->n_modes, 6);
  assert_false(few->is_complete || few->is_proportional);
  assert_true(all->is_complete && few->is_stable == all->is_stable);
  assert_true(few->largest_step_s == all->largest_step_s);
  for (uint32_t k = 0; k < few->n_modes; ++k) {
    const Mode* const mode = &few->mode[k];
    const Mode* const other = &all->mode[k];
    for (int i = 0; i < 2; ++i) {
      worst = fmax(worst, cabs(mode->analog[i] / other->analog[i] - 1.0));
      worst = fmax(worst, cabs((mode->pole[i] - other->pole[i]) / (other->pole[i] - 1.0)));
    }
    assert_int_equal(mode->region, other->region);
  }
  return worst;
}

static void lowest_are_the_first_of_all(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  const int n_trials = networks_is_long() ? 60 : 12;
  for (int trial = 0; trial < n_trials; ++trial) {
    Network* const network = networks_string(80 + random_below(&random, 60), 1.0, 1.0, 0.0);
    for (int more = 0; more < trial; ++more) {
      const uint32_t a = random_below(&random, network->n_masses);
      const uint32_t b = random_below(&random, network->n_masses);
      if (a != b) {
        assert_int_equal(network_add_spring(network, a, b, 0.1), STATUS_OK);
      }
    }
    add_dampers(network, &random, 20, random_log_between(&random, 1e-4, 1e-2));
    Modes* const few = solve(network, random_between(&random, 0.4, 10.0), 6);
    Modes* const all = solve(network, few->rate_hz, 0);
    worst = fmax(worst, distance(few, all));
    modes_free(few);
    modes_free(all);
    network_free(network);
  }
  assert_within("s and z − 1, relative", worst, 1e-10);
}

/* Real values have no pair to be told by: all are found, and the first shown. */
static void lowest_may_be_overdamped(void** state) {
  (void)state;
  Random random = random_start();
  Network* const network = networks_string(100, 1.0, 1.0, 0.0);
  add_dampers(network, &random, 60, 100.0);
  Modes* const few = solve(network, 1000.0, 6);
  Modes* const all = solve(network, 1000.0, 0);
  assert_true(cimag(few->mode[0].analog[0]) == 0.0);
  assert_within("s and z − 1, relative", distance(few, all), 1e-10);
  modes_free(few);
  modes_free(all);
  network_free(network);
}

static void two_thousand_masses_take_seconds(void** state) {
  (void)state;
  Network* const network = networks_string(2000, 1.0, 1e8, 1.0);
  assert_int_equal(network_add_damper(network, 700, 2000, 100.0), STATUS_OK);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  const clock_t start = clock();
  Modes* const modes = solve(network, 48000.0, 10);
  const double taken_s = (double)(clock() - start) / CLOCKS_PER_SEC;
  print_message("  10 of 2000 masses: %.2f s\n", taken_s);
  assert_within("s", taken_s, 30.0);
  /* A damper so weak adds to each σ what its mass has of the shape, and no more: to first order. */
  double worst = 0.0;
  for (int k = 1; k <= 10; ++k) {
    static const double PI = 3.14159265358979323846;
    const double half = 2.0 * sin(0.5 * PI * k / 2001.0);
    const double shape = sin(PI * k * 701.0 / 2001.0);
    const double sigma = -0.5 * (half * half + 100.0 * shape * shape * 2.0 / 2001.0);
    const double complex s = modes->mode[k - 1].analog[0];
    worst = fmax(worst, fabs(creal(s) / sigma - 1.0));
    worst = fmax(worst, fabs(cimag(s) / (1e4 * half) - 1.0));
  }
  assert_within("σ and μ by first order, relative", worst, 2e-5);
  modes_free(modes);
  network_free(network);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lowest_are_the_first_of_all),
      cmocka_unit_test(lowest_may_be_overdamped),
      cmocka_unit_test(two_thousand_masses_take_seconds),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
