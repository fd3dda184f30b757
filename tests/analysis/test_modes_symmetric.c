/* Modes without dampers, or with dampers that leave them as they are. */

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
#include <time.h>

#include <cmocka.h>

static const NetworkKind UNDAMPED = {30, 0.5, 1.0, 0.0, false};

static Modes* solve(const Network* network, double rate_hz, uint32_t n_wanted) {
  Modes* modes = NULL;
  assert_int_equal(modes_solve(network, rate_hz, n_wanted, &modes), STATUS_OK);
  assert_non_null(modes);
  return modes;
}

static double relative(double value, double truth) {
  return fabs(value - truth) / fabs(truth);
}

static void strings_have_their_closed_form(void** state) {
  (void)state;
  double worst = 0.0;
  double worst_few = 0.0;
  for (uint32_t n = 1; n <= 200; n += n < 8 ? 1 : n / 3) {
    Network* const network = networks_string(n, 2.0, 3e6, 5.0);
    for (int pass = 0; pass < 2; ++pass) {
      Modes* const modes = solve(network, 44100.0, pass ? 3 : 0);
      assert_int_equal(modes->n_modes, pass && n > 3 ? 3 : n);
      assert_true(modes->is_proportional && modes->is_complete == (modes->n_modes == n));
      double* const value = pass ? &worst_few : &worst;
      for (uint32_t k = 1; k <= modes->n_modes; ++k) {
        const double lambda = tuning_lambda(n, k);
        const Pole pole = pole_from_analog(44100.0, sqrt(1.5e6 * lambda), 2.5 * lambda);
        const Tone tone = pole_tone(44100.0, pole);
        *value = fmax(*value, relative(modes->mode[k - 1].tone.f0_hz, tone.f0_hz));
        *value = fmax(*value, relative(modes->mode[k - 1].tone.tau_s, tone.tau_s));
      }
      modes_free(modes);
    }
    network_free(network);
  }
  /* Jacobi's rotations leave about n roundings, and F loses none of them. */
  assert_within("all, F and τ, relative", worst, 200 * 4 * DBL_EPSILON);
  assert_within("the lowest three, F and τ, relative", worst_few, 200 * 4 * DBL_EPSILON);
}

static void repeated_values_are_all_listed(void** state) {
  (void)state;
  Network* const network = network_new();
  for (int i = 0; i < 7; ++i) {
    uint32_t first = 0;
    assert_int_equal(network_add_string(network, 4, 1.0, 1e4, 2.0, &first), STATUS_OK);
  }
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  double worst = 0.0;
  for (int pass = 0; pass < 3; ++pass) {
    network->dampers.link[0].value *= pass == 2 ? 1.0 + 1e-12 : 1.0;
    Modes* const modes = solve(network, 1000.0, pass == 1 ? 5 : 0);
    for (uint32_t k = 0; k < modes->n_modes; ++k) {
      const double lambda = tuning_lambda(4, 1 + k / 7);
      const Tone tone = pole_tone(1000.0, (Pole){1e-2 * lambda, 2e-3 * lambda});
      worst = fmax(worst, relative(modes->mode[k].tone.f0_hz, tone.f0_hz));
      worst = fmax(worst, relative(modes->mode[k].tone.tau_s, tone.tau_s));
    }
    modes_free(modes);
  }
  assert_within("F and τ, relative", worst, 1e-11);
  network_free(network);
}

/* Z = α M + β K is told to rounding, in decimals and in pieces; one part in 10⁹ is not rounding,
 * and changes the modes by no more. */
static void proportional_damping_is_told(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    Network* const network = networks_random(&random, &UNDAMPED);
    const double beta = trial % 3 ? random_log_between(&random, 1e-4, 1e-1) : 0.0;
    const double alpha = trial % 2 ? random_log_between(&random, 1e-3, 1.0) : 0.0;
    uint32_t ground = 0;
    assert_int_equal(network_add_ground(network, &ground), STATUS_OK);
    for (uint32_t s = 0; s < network->springs.n; ++s) {
      const NetworkLink spring = network->springs.link[s];
      assert_int_equal(
          network_add_damper(network, spring.to, spring.from, 0.3 * beta * spring.value),
          STATUS_OK);
      assert_int_equal(
          network_add_damper(network, spring.from, spring.to, 0.7 * beta * spring.value),
          STATUS_OK);
    }
    for (uint32_t p = 0; p < network->n_points; ++p) {
      if (!network->is_ground[p]) {
        assert_int_equal(network_add_damper(network, p, ground, alpha * network->mass_kg[p]),
                         STATUS_OK);
      }
    }
    assert_int_equal(network_check(network, NULL), STATUS_OK);
    Modes* const modes = solve(network, 100.0, 0);
    assert_true(modes->is_proportional);
    if (network->n_masses > 1 && (alpha > 0.0 || beta > 0.0)) {
      uint32_t d = 0;
      while (!(network->dampers.link[d].value > 0.0)) {
        ++d;
      }
      network->dampers.link[d].value *= 1.0 + 1e-9;
      Modes* const other = solve(network, 100.0, 0);
      /* A network of single masses may still be proportional. */
      for (uint32_t k = 0; k < modes->n_modes && !other->is_proportional; ++k) {
        const double complex s = modes->mode[k].analog[0];
        const double apart = cabs(s - modes->mode[k].analog[1]) / cabs(s);
        worst = fmax(worst, cabs(other->mode[k].analog[0] - s) / cabs(s) * fmin(1.0, apart));
      }
      modes_free(other);
    }
    modes_free(modes);
    network_free(network);
  }
  assert_within("s, relative", worst, 1e-7);
}

static double now_s(void) {
  return (double)clock() / CLOCKS_PER_SEC;
}

static void lowest_of_many_take_no_time(void** state) {
  (void)state;
  static const uint32_t sizes[] = {2000, 100000};
  double worst = 0.0;
  for (int i = 0; i < 2; ++i) {
    Network* const network = networks_string(sizes[i], 1.0, 1e8, 1.0);
    const double start = now_s();
    Modes* const modes = solve(network, 48000.0, i ? 2 : 10);
    print_message("  %u masses: %.2f s\n", sizes[i], now_s() - start);
    for (uint32_t k = 1; k <= modes->n_modes; ++k) {
      const double omega = sqrt(1e8 * tuning_lambda(sizes[i], k));
      worst = fmax(worst, relative(cabs(modes->mode[k - 1].analog[0]), omega));
    }
    assert_within("s", now_s() - start, 20.0);
    modes_free(modes);
    network_free(network);
  }
  assert_within("ω, relative", worst, 1e-12);
}

/* A square membrane, √λ = 2 (sin² + sin²)^½, half of its modes double. */
static void lowest_of_a_membrane_are_found(void** state) {
  (void)state;
  enum { SIDE = 40, WANTED = 12 };
  Network* const network = network_new();
  for (int i = 0; i < SIDE * SIDE; ++i) {
    network_add_mass(network, 1.0, NULL);
  }
  uint32_t ground = 0;
  network_add_ground(network, &ground);
  for (uint32_t i = 0; i < SIDE; ++i) {
    for (uint32_t j = 0; j <= SIDE; ++j) {
      network_add_spring(network, j > 0 ? i * SIDE + j - 1 : ground,
                         j < SIDE ? i * SIDE + j : ground, 1.0);
      network_add_spring(network, j > 0 ? (j - 1) * SIDE + i : ground,
                         j < SIDE ? j * SIDE + i : ground, 1.0);
    }
  }
  /* The corners' springs from ground to ground are none. */
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  double expected[SIDE * SIDE];
  for (uint32_t i = 0; i < SIDE * SIDE; ++i) {
    const double omega =
        sqrt(tuning_lambda(SIDE, 1 + i / SIDE) + tuning_lambda(SIDE, 1 + i % SIDE));
    uint32_t at = i;
    for (; at > 0 && expected[at - 1] > omega; --at) {
      expected[at] = expected[at - 1];
    }
    expected[at] = omega;
  }
  const double start = now_s();
  Modes* const modes = solve(network, 10.0, WANTED);
  print_message("  1600 masses: %.2f s\n", now_s() - start);
  double worst = 0.0;
  for (uint32_t k = 0; k < WANTED; ++k) {
    worst = fmax(worst, relative(cabs(modes->mode[k].analog[0]), expected[k]));
  }
  assert_within("ω, relative", worst, 1e-12);
  modes_free(modes);
  network_free(network);
}

static void two_hundred_masses_take_a_moment(void** state) {
  (void)state;
  for (int general = 0; general < 2; ++general) {
    Network* const network = networks_string(200, 1.0, 1e8, 1.0);
    network->dampers.link[50].value *= general ? 1000.0 : 1.0;
    const double start = now_s();
    Modes* const modes = solve(network, 48000.0, 0);
    print_message("  all of 200 masses, %s: %.2f s\n", general ? "unequal dampers" : "proportional",
                  now_s() - start);
    assert_int_equal(modes->n_modes, 200);
    assert_within("s", now_s() - start, 20.0);
    modes_free(modes);
    network_free(network);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strings_have_their_closed_form),
      cmocka_unit_test(repeated_values_are_all_listed),
      cmocka_unit_test(proportional_damping_is_told),
      cmocka_unit_test(lowest_of_many_take_no_time),
      cmocka_unit_test(lowest_of_a_membrane_are_found),
      cmocka_unit_test(two_hundred_masses_take_a_moment),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
