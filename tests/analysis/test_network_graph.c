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

/* Very unlike masses, springs over 12 decades, from nearly free to heavily overdamped. */
static const NetworkKind UNLIKE = {60, 3.0, 6.0, 3.0, true};

static void expect(Network* network, Status status, NetworkElement element, uint32_t index) {
  NetworkFault fault = {NETWORK_POINT, 12345};
  assert_int_equal(network_check(network, &fault), status);
  assert_int_equal(fault.element, element);
  assert_int_equal(fault.index, index);
  assert_int_equal(network_check(network, NULL), status);
  assert_false(network->is_checked);
  network_free(network);
}

static void every_ill_formed_element_is_named(void** state) {
  (void)state;
  static const double bad[] = {-1.0, HUGE_VAL, -HUGE_VAL, (double)NAN};
  static const double no_mass[] = {0.0, -1.0, HUGE_VAL, (double)NAN};
  for (int i = 0; i < 4; ++i) {
    Network* network = networks_string(3, 1.0, 2.0, 3.0);
    network_add_mass(network, no_mass[i], NULL);
    expect(network, STATUS_BAD_MASS, NETWORK_POINT, 5);
    network = networks_string(3, 1.0, 2.0, 3.0);
    network_add_spring(network, 0, 2, bad[i]);
    expect(network, STATUS_BAD_LINK, NETWORK_SPRING, 4);
    network = networks_string(3, 1.0, 2.0, 0.0);
    network_add_damper(network, 0, 2, bad[i]);
    expect(network, STATUS_BAD_LINK, NETWORK_DAMPER, 0);
    network = network_new();
    network_add_string(network, 3, 1.0, 1.0, bad[i], NULL);
    expect(network, STATUS_BAD_LINK, NETWORK_DAMPER, 0);
  }
  Network* network = networks_string(3, 1.0, 2.0, 3.0);
  network_add_spring(network, 5, 0, 1.0);
  expect(network, STATUS_NO_SUCH_POINT, NETWORK_SPRING, 4);
  network = networks_string(3, 1.0, 2.0, 3.0);
  network_add_damper(network, 0, UINT32_MAX, 1.0);
  expect(network, STATUS_NO_SUCH_POINT, NETWORK_DAMPER, 4);
  network = networks_string(3, 1.0, 2.0, 3.0);
  network_add_spring(network, 1, 1, 1.0);
  expect(network, STATUS_SELF_LINK, NETWORK_SPRING, 4);
  network = network_new();
  network_add_ground(network, NULL);
  expect(network, STATUS_EMPTY, NETWORK_POINT, 0);
}

static void what_is_fixed_is_checked_again(void** state) {
  (void)state;
  Network* const network = networks_string(2, 1.0, 1.0, 1.0);
  assert_true(network->is_checked);
  network_add_spring(network, 0, 4, 1.0);
  assert_false(network->is_checked);
  assert_int_equal(network_check(network, NULL), STATUS_NO_SUCH_POINT);
  network_add_mass(network, 1.0, NULL);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  assert_true(network->is_checked);
  network_free(network);
}

/* What can be reached from a point, the slow way; whether that is a ground. */
static bool spread(const Network* network, bool is_by_dampers_too, uint32_t point, bool* reached) {
  const NetworkLinks* const links[] = {&network->springs, &network->dampers};
  bool has_grown = true;
  bool is_held = false;
  memset(reached, 0, network->n_points * sizeof(bool));
  reached[point] = true;
  while (has_grown) {
    has_grown = false;
    for (uint32_t kind = 0; kind < (is_by_dampers_too ? 2 : 1); ++kind) {
      for (uint32_t l = 0; l < links[kind]->n; ++l) {
        const NetworkLink link = links[kind]->link[l];
        const bool joins = link.value > 0.0 && reached[link.from] != reached[link.to];
        const uint32_t other = reached[link.from] ? link.to : link.from;
        if (joins && network->is_ground[other]) {
          is_held = true;
        } else if (joins) {
          has_grown = reached[other] = true;
        }
      }
    }
  }
  return is_held;
}

static void free_parts_are_those_that_nothing_holds(void** state) {
  (void)state;
  Random random = random_start();
  uint32_t n_of[2] = {0, 0};
  for (int trial = 0; trial < 300; ++trial) {
    Network* const network = networks_random(&random, &UNLIKE);
    const uint32_t n = network->n_points;
    for (int cut = (int)random_below(&random, 4); cut > 0; --cut) {
      network->springs.link[random_below(&random, network->springs.n)].value = 0.0;
    }
    uint32_t* const part = calloc(n, sizeof(uint32_t));
    bool* const reached = calloc(n, sizeof(bool));
    assert_true(part && reached);
    for (int too = 0; too < 2; ++too) {
      uint32_t n_free = 0;
      uint32_t n_seen = 0;
      assert_int_equal(network_find_free(network, too, part, &n_free), STATUS_OK);
      for (uint32_t p = 0; p < n; ++p) {
        if (network->is_ground[p] || spread(network, too, p, reached)) {
          assert_int_equal(part[p], UINT32_MAX);
          continue;
        }
        /* Of the lowest point of the part, or a new one. */
        uint32_t first = 0;
        while (!reached[first]) {
          ++first;
        }
        assert_int_equal(part[p], first < p ? part[first] : n_seen++);
      }
      assert_int_equal(n_free, n_seen);
      n_of[too] += n_free;
    }
    free(part);
    free(reached);
    network_free(network);
  }
  assert_true(n_of[0] > 50 && n_of[1] > 20 && n_of[1] < n_of[0]);
}

static void free_parts_are_numbered_in_order(void** state) {
  (void)state;
  Network* const network = network_new();
  for (int i = 0; i < 7; ++i) {
    network_add_mass(network, 1.0, NULL);
  }
  network_add_ground(network, NULL);
  network_add_spring(network, 5, 1, 1.0);
  network_add_spring(network, 4, 2, 1.0);
  network_add_spring(network, 2, 5, 1.0);
  network_add_spring(network, 0, 7, 1.0); /* Held */
  network_add_damper(network, 0, 3, 1.0); /* A damper holds nothing … */
  network_add_damper(network, 4, 6, 1.0);
  network_add_spring(network, 0, 3, 0.0); /* … nor does a spring without stiffness */
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  static const uint32_t by_springs[8] = {UINT32_MAX, 0, 0, 1, 0, 0, 2, UINT32_MAX};
  static const uint32_t by_all[8] = {UINT32_MAX, 0, 0, UINT32_MAX, 0, 0, 0, UINT32_MAX};
  uint32_t part[8];
  uint32_t n_free = 0;
  assert_int_equal(network_find_free(network, false, part, &n_free), STATUS_OK);
  assert_int_equal(n_free, 3);
  assert_memory_equal(part, by_springs, sizeof(part));
  assert_int_equal(network_find_free(network, true, part, &n_free), STATUS_OK);
  assert_int_equal(n_free, 1);
  assert_memory_equal(part, by_all, sizeof(part));
  network_free(network);
}

static void matrices_are_what_the_links_add_up_to(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    Network* const network = networks_random(&random, &UNLIKE);
    const size_t n = network->n_masses;
    double* const mass_kg = networks_zeros(n + 2 * n * n + 4 * n * n);
    double* const stiffness = mass_kg + n;
    double* const damping = stiffness + n * n;
    double* const a = damping + n * n;
    networks_state_matrix(network, a);
    assert_int_equal(network_matrices(network, mass_kg, stiffness, damping), STATUS_OK);
    for (size_t j = 0; j < n; ++j) {
      for (size_t i = 0; i < n; ++i) {
        const double k = -mass_kg[i] * a[n + i + j * 2 * n];
        const double z = -mass_kg[i] * a[n + i + (n + j) * 2 * n];
        worst = fmax(worst, fabs(stiffness[i + j * n] - k) / fmax(stiffness[i + i * n], 1e-300));
        worst = fmax(worst, fabs(damping[i + j * n] - z) / fmax(damping[i + i * n], 1e-300));
      }
    }
    free(mass_kg);
    network_free(network);
  }
  assert_within("K and Z, of their diagonals", worst, 64.0 * DBL_EPSILON);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_ill_formed_element_is_named),
      cmocka_unit_test(what_is_fixed_is_checked_again),
      cmocka_unit_test(free_parts_are_those_that_nothing_holds),
      cmocka_unit_test(free_parts_are_numbered_in_order),
      cmocka_unit_test(matrices_are_what_the_links_add_up_to),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
