/* What hangs on no ground: drifts beside what sounds, in closed form and against dense matrices. */

#include "core/analysis/modes.h"
#include "core/analysis/retune.h"

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

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static const NetworkKind MODEST = {12, 0.3, 0.5, 0.5, true};

static Modes* solve(const Network* network, double rate_hz, uint32_t n_wanted) {
  Modes* modes = NULL;
  assert_int_equal(modes_solve(network, rate_hz, n_wanted, &modes), STATUS_OK);
  assert_non_null(modes);
  return modes;
}

static double relative(double value, double truth) {
  return fabs(value - truth) / fabs(truth);
}

/* n masses in a row, each on the next. */
static Network* chain_of(uint32_t n, double mass_kg, double stiffness, double damping) {
  Network* const network = network_new();
  assert_non_null(network);
  for (uint32_t i = 0; i < n; ++i) {
    network_add_mass(network, mass_kg, NULL);
    if (i > 0) {
      network_add_spring(network, i - 1, i, stiffness);
      network_add_damper(network, i - 1, i, damping);
    }
  }
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  return network;
}

static void claim_drifts(const Mode* mode) {
  assert_true(mode->is_free && mode->analog[0] == 0.0 && mode->analog[1] == 0.0);
  assert_true(mode->pole[0] == 1.0 && mode->pole[1] == 1.0);
  assert_true(mode->tone.f0_hz == 0.0 && mode->tone.tau_s == HUGE_VAL);
  assert_true(mode->radius == 1.0 && isnan(mode->warp_cents));
  assert_int_equal(mode->region, POLE_REAL_AT_ZERO);
}

static void two_masses_on_a_spring_swing_against_each_other(void** state) {
  (void)state;
  Network* const network = network_new();
  network_add_mass(network, 1.0, NULL);
  network_add_mass(network, 2.0, NULL);
  network_add_spring(network, 0, 1, 50.0);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  Modes* const modes = solve(network, 1e6, 0);
  assert_int_equal(modes->n_modes, 2);
  claim_drifts(&modes->mode[0]);
  const double f_hz = cimag(modes->mode[1].analog[0]) / (2.0 * PI);
  assert_within("F − 1.378322 Hz", fabs(f_hz - 1.378322), 5e-7);
  assert_within("√(k (1/m + 1/M)), relative", relative(2.0 * PI * f_hz, sqrt(75.0)),
                4.0 * DBL_EPSILON);
  assert_true(modes->is_stable);
  assert_within("step", relative(modes->largest_step_s, 2.0 / sqrt(75.0)), 8.0 * DBL_EPSILON);
  modes_free(modes);
  network_free(network);
}

/* 2 √(k/m) sin(jπ/2N), j = 0 … N − 1, of all and of few. */
static void free_chains_have_their_closed_form(void** state) {
  (void)state;
  double worst = 0.0;
  double worst_few = 0.0;
  for (uint32_t n = 1; n <= 300; n += n < 8 ? 1 : n / 2) {
    Network* const network = chain_of(n, 0.5, 3e6, 20.0);
    for (int pass = 0; pass < 2; ++pass) {
      Modes* const modes = solve(network, 48000.0, pass ? 4 : 0);
      assert_true(modes->is_proportional);
      claim_drifts(&modes->mode[0]);
      double* const value = pass ? &worst_few : &worst;
      for (uint32_t j = 1; j < modes->n_modes; ++j) {
        const double omega = 2.0 * sqrt(3e6 / 0.5) * sin(j * PI / (2.0 * n));
        const double damping = 20.0 / 3e6 * omega * omega;
        const double complex s = modes->mode[j].analog[0];
        assert_false(modes->mode[j].is_free);
        *value = fmax(*value, relative(cabs(s), omega));
        *value = fmax(*value, relative(-2.0 * creal(s), damping));
      }
      modes_free(modes);
    }
    network_free(network);
  }
  assert_within("all, |s| and −2σ, relative", worst, 300 * 4 * DBL_EPSILON);
  assert_within("the lowest four", worst_few, 300 * 4 * DBL_EPSILON);
}

/* Struck, it slows down as exp(−t/τ), by 1 − h Z/m a step, and comes to rest at v0 m/Z. */
static void a_mass_on_a_damper_stops(void** state) {
  (void)state;
  Network* const network = networks_mass(0.5, 0.0, 3.0);
  Modes* const modes = solve(network, 1000.0, 0);
  const Mode* const mode = &modes->mode[0];
  assert_true(modes->n_modes == 1 && modes->is_proportional && modes->is_stable && mode->is_free);
  assert_true(mode->analog[0] == 0.0 && mode->tone.f0_hz == 0.0 && mode->radius == 1.0);
  assert_within("Z/m", relative(-creal(mode->analog[1]), 6.0), 4.0 * DBL_EPSILON);
  assert_within("step, m/Z times 2", relative(modes->largest_step_s, 1.0 / 3.0), 8.0 * DBL_EPSILON);
  network->v[0] = 2.0;
  const uint32_t n_steps = 200;
  for (uint32_t i = 0; i < n_steps; ++i) {
    network_step(network, 1e-3);
  }
  const double expected = 2.0 * exp(-1e-3 * n_steps / mode->tone.tau_s);
  assert_within("v after 0.2 s", relative(network->v[0], expected), 1e-12);
  for (uint32_t i = 0; i < 20000; ++i) {
    network_step(network, 1e-3);
  }
  assert_within("rest", relative(network->x[0], (2.0 - 6e-3 * 2.0) / 6.0), 1e-12);
  modes_free(modes);
  /* A step too long makes it swing and grow. */
  Modes* const unstable = solve(network, 2.9, 0);
  assert_true(!unstable->is_stable && unstable->mode[0].region == POLE_UNSTABLE);
  assert_within("radius", relative(unstable->mode[0].radius, 6.0 / 2.9 - 1.0), 1e-14);
  modes_free(unstable);
  network_free(network);
}

static void what_is_linked_to_nothing_drifts_at_any_rate(void** state) {
  (void)state;
  Network* const network = network_new();
  for (int i = 0; i < 3; ++i) {
    network_add_mass(network, 1.0 + i, NULL);
  }
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  Modes* const modes = solve(network, 1.0, 0);
  for (int i = 0; i < 3; ++i) {
    claim_drifts(&modes->mode[i]);
  }
  assert_true(modes->is_stable && modes->largest_step_s == HUGE_VAL);
  modes_free(modes);
  network_free(network);
}

/* Some of its parts let go of the ground, of dampers and springs or of springs alone. */
static Network* free_network(Random* random) {
  Network* const network = networks_random(random, &MODEST);
  for (uint32_t p = 0; p < network->n_points; ++p) {
    const bool lets_springs_go = network->is_ground[p] && random_below(random, 3) > 0;
    const bool lets_dampers_go = lets_springs_go && random_below(random, 2) > 0;
    for (uint32_t s = 0; s < network->springs.n && lets_springs_go; ++s) {
      NetworkLink* const spring = &network->springs.link[s];
      spring->value *= spring->from == p || spring->to == p ? 0.0 : 1.0;
    }
    for (uint32_t d = 0; d < network->dampers.n && lets_dampers_go; ++d) {
      NetworkLink* const damper = &network->dampers.link[d];
      damper->value *= damper->from == p || damper->to == p ? 0.0 : 1.0;
    }
  }
  /* A damper between two parts. */
  const uint32_t a = random_below(random, network->n_points);
  const uint32_t b = random_below(random, network->n_points);
  if (a != b && random_below(random, 2)) {
    network_add_damper(network, a, b, 1.0);
  }
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  return network;
}

/* The farthest of those values that are not 0 from one of `truth`, which is left out then. */
static double distance(size_t order, double complex* truth, const double complex* value) {
  double worst = 0.0;
  for (size_t k = 0; k < order; ++k) {
    size_t best = 0;
    for (size_t i = 1; i < order; ++i) {
      best = cabs(truth[i] - value[k]) < cabs(truth[best] - value[k]) ? i : best;
    }
    /* A 0 twice is one to the root of a rounding. */
    const double miss = cabs(truth[best] - value[k]);
    worst = fmax(worst, value[k] == 0.0 ? 1e-4 * miss : miss);
    truth[best] = HUGE_VAL;
  }
  return worst;
}

/* All eigenvalues of A and of the step, by dense matrices that know of no parts; and how many there
 * are of 0. */
static void free_networks_have_the_eigenvalues_of_their_matrices(void** state) {
  (void)state;
  Random random = random_start();
  double worst_s = 0.0;
  double worst_z = 0.0;
  uint32_t n_drifting = 0;
  uint32_t n_stopping = 0;
  uint32_t n_general = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Network* const network = free_network(&random);
    const size_t n = network->n_masses;
    double* const matrix = networks_zeros(4 * n * n);
    double complex* const truth = calloc(4 * n, sizeof(double complex));
    assert_non_null(truth);
    Modes* const modes = solve(network, random_log_between(&random, 1.0, 100.0), 0);
    double complex* const value = truth + 2 * n;
    networks_state_matrix(network, matrix);
    oracle_eigenvalues(2 * n, matrix, truth);
    uint32_t n_zeros = 0;
    for (size_t k = 0; k < n; ++k) {
      const Mode* const mode = &modes->mode[k];
      value[2 * k] = mode->analog[0];
      value[2 * k + 1] = mode->analog[1];
      n_drifting += mode->is_free && mode->analog[1] == 0.0 ? 1 : 0;
      n_stopping += mode->is_free && mode->analog[1] != 0.0 ? 1 : 0;
      assert_true(mode->is_free == (mode->analog[0] == 0.0));
      assert_true(!mode->is_free || mode->pole[0] == 1.0 || mode->pole[1] == 1.0);
    }
    for (size_t k = 0; k < 2 * n; ++k) {
      n_zeros += cabs(truth[k]) < 1e-5 ? 1 : 0;
      n_zeros -= value[k] == 0.0 ? 1 : 0;
    }
    assert_int_equal(n_zeros, 0);
    worst_s = fmax(worst_s, distance(2 * n, truth, value));
    networks_step_matrix(network, 1.0 / modes->rate_hz, matrix);
    oracle_eigenvalues(2 * n, matrix, truth);
    for (size_t k = 0; k < 2 * n; ++k) {
      value[k] = modes->mode[k / 2].pole[k % 2] - 1.0;
      truth[k] -= 1.0;
    }
    worst_z = fmax(worst_z, distance(2 * n, truth, value));
    n_general += modes->is_proportional ? 0 : 1;
    modes_free(modes);
    free(truth);
    free(matrix);
    network_free(network);
  }
  print_message("  %u drift, %u stop; %u of 400 are not proportional\n", n_drifting, n_stopping,
                n_general);
  assert_true(n_drifting > 50 && n_stopping > 50 && n_general > 100);
  assert_within("s [1/s]", worst_s, 1e-8);
  assert_within("z", worst_z, 1e-8);
}

/* One damper within a chain leaves its drift alone, and no other mode. */
static void the_lowest_of_many_are_the_first_of_all(void** state) {
  (void)state;
  Network* const network = chain_of(150, 1.0, 1.0, 0.0);
  network_add_damper(network, 20, 70, 0.01);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  Modes* const few = solve(network, 10.0, 6);
  Modes* const all = solve(network, 10.0, 0);
  double worst = 0.0;
  assert_true(!few->is_proportional && !few->is_complete);
  claim_drifts(&few->mode[0]);
  claim_drifts(&all->mode[0]);
  for (int k = 1; k < 6; ++k) {
    worst = fmax(worst, cabs(few->mode[k].analog[0] / all->mode[k].analog[0] - 1.0));
    worst = fmax(
        worst, cabs((few->mode[k].pole[0] - all->mode[k].pole[0]) / (all->mode[k].pole[0] - 1.0)));
  }
  assert_within("s and z − 1, relative", worst, 1e-10);
  modes_free(few);
  modes_free(all);
  network_free(network);
}

/* A damper to the ground stops the chain: of all the masses at once, if it is weak. */
static void a_weak_damper_stops_a_chain_as_a_whole(void** state) {
  (void)state;
  Network* const network = chain_of(150, 1.0, 1.0, 0.0);
  network_add_ground(network, NULL);
  network_add_damper(network, 20, 150, 1e-4);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  Modes* const modes = solve(network, 10.0, 6);
  assert_true(modes->mode[0].is_free && !modes->mode[1].is_free);
  assert_within("Z/M", relative(-creal(modes->mode[0].analog[1]), 1e-4 / 150.0), 1e-3);
  assert_within("1/τ", relative(1.0 / modes->mode[0].tone.tau_s, 1e-4 / 150.0), 1e-3);
  modes_free(modes);
  network_free(network);
}

/* What is tuned is heard; a drift has nothing to be tuned. */
static void what_sounds_beside_a_drift_is_tuned(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  int n_tuned = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Network* const network = free_network(&random);
    Modes* const before = solve(network, 1.0, 0);
    uint32_t n_free = 0;
    while (n_free < before->n_modes && before->mode[n_free].is_free) {
      ++n_free;
    }
    Retuning retuning = {0};
    const Tone tone = {100.0, HUGE_VAL};
    for (uint32_t k = 1; k <= n_free; ++k) {
      assert_int_equal(retune_solve(network, 48000.0, tone, k, &retuning), STATUS_FREE);
    }
    const Status status = retune_solve(network, 48000.0, tone, 0, &retuning);
    assert_int_equal(status, n_free < before->n_modes ? STATUS_OK : STATUS_FREE);
    if (!status) {
      network_scale(network, retuning.stiffness_factor, retuning.damping_factor);
      Modes* const after = solve(network, 48000.0, 0);
      worst = fmax(worst, relative(after->mode[n_free].tone.f0_hz, 100.0));
      modes_free(after);
      ++n_tuned;
    }
    modes_free(before);
    network_free(network);
  }
  assert_true(n_tuned > 30);
  assert_within("F, relative", worst, 1e-11);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(two_masses_on_a_spring_swing_against_each_other),
      cmocka_unit_test(free_chains_have_their_closed_form),
      cmocka_unit_test(a_mass_on_a_damper_stops),
      cmocka_unit_test(what_is_linked_to_nothing_drifts_at_any_rate),
      cmocka_unit_test(free_networks_have_the_eigenvalues_of_their_matrices),
      cmocka_unit_test(the_lowest_of_many_are_the_first_of_all),
      cmocka_unit_test(a_weak_damper_stops_a_chain_as_a_whole),
      cmocka_unit_test(what_sounds_beside_a_drift_is_tuned),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
