#include "core/analysis/network.h"

#include "tests/support/networks.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <time.h>

#include <cmocka.h>

static double now_s(void) {
  struct timespec now;
  assert_true(timespec_get(&now, TIME_UTC) == TIME_UTC);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static Network* build(uint32_t n) {
  Network* const network = network_new();
  assert_non_null(network);
  assert_int_equal(network_add_string(network, n, 1.0, 1.0, 0.01, NULL), STATUS_OK);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  return network;
}

/* The shortest of several: seconds a mass and step, with `n_steps` a try. */
static double step_time_s(Network* network, int n_steps) {
  double best = HUGE_VAL;
  for (int attempt = 0; attempt < 5; ++attempt) {
    const double start = now_s();
    for (int n = 0; n < n_steps; ++n) {
      network_step(network, 1.0);
    }
    best = fmin(best, (now_s() - start) / n_steps / network->n_masses);
  }
  return best;
}

static void million_masses_hold_and_step_in_linear_time(void** state) {
  (void)state;
  enum { FEW = 10000, MANY = 1000000 };
  Network* const few = build(FEW);
  const double start = now_s();
  Network* const many = build(MANY);
  const double built_s = now_s() - start;
  few->x[FEW / 2] = many->x[MANY / 2] = 1.0;
  const double few_s = step_time_s(few, 100);
  const double many_s = step_time_s(many, 5);
  print_message("  built in %.2f s; ns a mass and step: %.1f of ten thousand, %.1f of a million\n",
                built_s, 1e9 * few_s, 1e9 * many_s);
  /* Seconds would be a quadratic build; the ratio allows for leaving the caches. */
  assert_within("build, s", built_s, 5.0);
  assert_within("a mass of a million, of one of ten thousand", many_s / few_s, 12.0);
  network_free(few);
  network_free(many);
}

/* What is felt after n steps lies n masses away at most. */
static void wave_goes_one_mass_a_step_at_most(void** state) {
  (void)state;
  enum { N = 100000, STEPS = 50 };
  Network* const network = build(N);
  network->v[N / 2] = 1.0;
  for (int n = 0; n < STEPS; ++n) {
    network_step(network, 1.0);
  }
  for (uint32_t p = 0; p < N; ++p) {
    const long apart = labs((long)p - N / 2);
    assert_true(apart <= STEPS || network->x[p] == 0.0);
    assert_true(apart != STEPS || network->x[p] != 0.0);
  }
  network_free(network);
}

static void memory_grows_with_masses_and_links(void** state) {
  (void)state;
  Network* const network = build(1000000);
  const double point = 5.0 * sizeof(double) + sizeof(bool);
  const double bytes =
      network->capacity * point +
      (network->springs.capacity + network->dampers.capacity) * (double)sizeof(NetworkLink);
  print_message("  %.0f bytes a mass with its spring and damper\n", bytes / 1e6);
  /* 41 a point and 16 a link; doubling may leave up to half of it unused. */
  assert_within("bytes a mass", bytes / 1e6, 2.0 * (point + 2.0 * sizeof(NetworkLink)) + 1.0);
  network_free(network);
}

static void free_parts_are_found_in_a_million_masses(void** state) {
  (void)state;
  enum { N = 1000000 };
  Network* const network = build(N);
  uint32_t* const part = malloc(network->n_points * sizeof(uint32_t));
  assert_non_null(part);
  network->springs.link[N / 2].value = 0.0;
  network->springs.link[N / 2 + 10].value = 0.0;
  uint32_t n_free = 0;
  const double start = now_s();
  assert_int_equal(network_find_free(network, false, part, &n_free), STATUS_OK);
  assert_within("s", now_s() - start, 2.0);
  assert_int_equal(n_free, 1);
  free(part);
  network_free(network);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(million_masses_hold_and_step_in_linear_time),
      cmocka_unit_test(wave_goes_one_mass_a_step_at_most),
      cmocka_unit_test(memory_grows_with_masses_and_links),
      cmocka_unit_test(free_parts_are_found_in_a_million_masses),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
