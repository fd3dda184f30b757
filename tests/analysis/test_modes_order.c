/* The order of elimination: what it fills, against elimination by hand; and the factors in it. */

#include "core/analysis/modes.h"
#include "core/analysis/modes_order.h"
#include "core/analysis/modes_sparse.h"

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

static const NetworkKind ANY = {40, 0.5, 0.5, 0.5, true};

static Frame frame_of(const Network* network) {
  Frame frame;
  assert_int_equal(frame_init(&frame, network), STATUS_OK);
  return frame;
}

/* A hub on the ground, `n` leaves on it, and a rim through all of them or none. */
static Network* hub_of(uint32_t n, double leaf_kg, double stiffness, bool has_rim) {
  Network* const network = network_new();
  assert_non_null(network);
  network_add_mass(network, 1.0, NULL);
  network_add_ground(network, NULL);
  network_add_spring(network, 0, 1, 1000.0);
  for (uint32_t i = 0; i < n; ++i) {
    network_add_mass(network, leaf_kg, NULL);
    network_add_spring(network, 0, 2 + i, stiffness);
    if (has_rim && i > 0) {
      network_add_spring(network, 1 + i, 2 + i, stiffness);
    }
  }
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  return network;
}

/* What elimination in this order fills, in a dense table of who is linked to whom. */
static void claim_filled(const Frame* frame, const Order* order) {
  const size_t n = frame->n;
  bool* const is_filled = calloc(n * n, sizeof(bool));
  assert_non_null(is_filled);
  for (uint32_t l = 0; l < frame->n_links; ++l) {
    const FrameLink link = frame->link[l];
    if (link.b != FRAME_GROUND) {
      const size_t p = order->place[link.a];
      const size_t q = order->place[link.b];
      is_filled[p + q * n] = is_filled[q + p * n] = true;
    }
  }
  for (size_t j = 0; j < n; ++j) {
    for (size_t p = j + 1; p < n; ++p) {
      for (size_t q = j + 1; q < n; ++q) {
        is_filled[p + q * n] |= p != q && is_filled[p + j * n] && is_filled[q + j * n];
      }
    }
  }
  for (size_t j = 0; j < n; ++j) {
    size_t e = order->start[j];
    assert_int_equal(order->row[e++], j);
    for (size_t i = j + 1; i < n; ++i) {
      if (is_filled[i + j * n]) {
        assert_true(e < order->start[j + 1] && order->row[e] == i);
        ++e;
      }
    }
    assert_int_equal(e, order->start[j + 1]);
  }
  free(is_filled);
}

/* Every mass has a place of its own. */
static void claim_permutation(const Order* order) {
  bool* const is_taken = calloc(order->n, sizeof(bool));
  assert_non_null(is_taken);
  for (uint32_t i = 0; i < order->n; ++i) {
    assert_true(order->place[i] < order->n && !is_taken[order->place[i]]);
    is_taken[order->place[i]] = true;
  }
  free(is_taken);
}

static void the_pattern_is_what_elimination_fills(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 300; ++trial) {
    Network* const network = networks_random(&random, &ANY);
    /* From trees to all with all. */
    for (uint32_t more = random_below(&random, 1U << random_below(&random, 12)); more > 0; --more) {
      const uint32_t a = random_below(&random, network->n_points);
      const uint32_t b = random_below(&random, network->n_points);
      if (a != b) {
        network_add_spring(network, a, b, 1.0);
      }
    }
    assert_int_equal(network_check(network, NULL), STATUS_OK);
    Frame frame = frame_of(network);
    Order order;
    assert_int_equal(order_init(&order, &frame), STATUS_OK);
    claim_permutation(&order);
    claim_filled(&frame, &order);
    order_clear(&order);
    frame_clear(&frame);
    network_free(network);
  }
}

static void trees_fill_nothing(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 30; ++trial) {
    Network* const network = network_new();
    assert_non_null(network);
    const uint32_t n = 2 + random_below(&random, 3000);
    for (uint32_t i = 0; i < n; ++i) {
      network_add_mass(network, 1.0, NULL);
      if (i > 0) {
        network_add_spring(network, i, trial ? random_below(&random, i) : i - 1, 1.0);
      }
    }
    assert_int_equal(network_check(network, NULL), STATUS_OK);
    Frame frame = frame_of(network);
    Order order;
    assert_int_equal(order_init(&order, &frame), STATUS_OK);
    claim_permutation(&order);
    assert_int_equal(order.start[n], n + (n - 1));
    order_clear(&order);
    frame_clear(&frame);
    network_free(network);
  }
}

/* A rim adds two links a leaf, the last ones apart. */
static void hubs_come_last(void** state) {
  (void)state;
  for (int has_rim = 0; has_rim < 2; ++has_rim) {
    Network* const network = hub_of(1000, 1e-3, 1000.0, has_rim);
    Frame frame = frame_of(network);
    Order order;
    assert_int_equal(order_init(&order, &frame), STATUS_OK);
    assert_in_range(order.place[0], 998, 1000);
    assert_int_equal(order.start[1001], has_rim ? 1001 + 1000 + 999 : 1001 + 1000);
    order_clear(&order);
    frame_clear(&frame);
    network_free(network);
  }
}

/* (I + 2 Ẑ + 3 K̂) x = b, put in again. */
static void factors_solve_what_they_are_of(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    Network* const network = networks_random(&random, &ANY);
    Frame frame = frame_of(network);
    const size_t n = frame.n;
    double* const matrix = networks_zeros(2 * n * n + 3 * n);
    double* const damping = matrix + n * n;
    double* const x = damping + n * n;
    double* const b = x + n;
    Sparse sparse;
    assert_int_equal(sparse_init(&sparse, &frame), STATUS_OK);
    sparse_fill(&sparse, &frame, 1.0, 2.0, 3.0);
    assert_int_equal(sparse_factor(&sparse), STATUS_OK);
    for (size_t i = 0; i < n; ++i) {
      x[i] = b[i] = random_between(&random, -1.0, 1.0);
    }
    sparse_solve(&sparse, 1, x, b + n);
    frame_fill_stiffness(&frame, matrix);
    frame_fill_damping(&frame, damping);
    for (size_t i = 0; i < n; ++i) {
      double sum = x[i] - b[i];
      double size = fabs(x[i]) + fabs(b[i]);
      for (size_t j = 0; j < n; ++j) {
        const double entry = 2.0 * damping[i + j * n] + 3.0 * matrix[i + j * n];
        sum += entry * x[j];
        size += fabs(entry * x[j]);
      }
      worst = fmax(worst, fabs(sum) / size);
    }
    /* −I has none. */
    sparse_fill(&sparse, &frame, -1.0, 0.0, 0.0);
    assert_int_equal(sparse_factor(&sparse), STATUS_ILL_SCALED);
    sparse_clear(&sparse);
    free(matrix);
    frame_clear(&frame);
    network_free(network);
  }
  assert_within("residual, of its terms", worst, 1e-14);
}

/* Of equal leaves the hub feels the sum s: two masses, M x'' = −K x + n k (s/n − x) and so on. */
static void a_hub_of_thousands_is_judged_at_once(void** state) {
  (void)state;
  const uint32_t n = 20000;
  Network* const network = hub_of(n, 1e-3, 1000.0, false);
  double step_s = 0.0;
  const clock_t start = clock();
  assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_OK);
  const double taken_s = (double)(clock() - start) / CLOCKS_PER_SEC;
  const double hub = 1000.0 + n * 1000.0;
  const double leaf = 1000.0 / 1e-3;
  const double square =
      0.5 * (hub + leaf) + sqrt(0.25 * (hub - leaf) * (hub - leaf) + n * 1000.0 * 1000.0 / 1e-3);
  assert_within("step, relative", fabs(step_s / (2.0 / sqrt(square)) - 1.0), 1e-13);
  print_message("  %lu masses on a hub: %.2f s\n", (unsigned long)n, taken_s);
  assert_within("s", taken_s, 2.0);
  network_free(network);
}

static void remember(void* self, double share) {
  double* const last = self;
  assert_true(share >= *last - 1e-9 && share <= 1.0 + 1e-9);
  *last = share;
}

static void what_is_done_is_told(void** state) {
  (void)state;
  double last = 0.0;
  double step_s = 0.0;
  double untold_s = 0.0;
  const ModesWatch watch = {remember, &last};
  Network* const network = networks_string(300, 1.0, 1e6, 3.0);
  assert_int_equal(modes_largest_step(network, &watch, &step_s), STATUS_OK);
  assert_within("left to do", 1.0 - last, 0.1);
  assert_int_equal(modes_largest_step(network, NULL, &untold_s), STATUS_OK);
  assert_true(step_s == untold_s);
  network_free(network);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_pattern_is_what_elimination_fills),
      cmocka_unit_test(trees_fill_nothing),
      cmocka_unit_test(hubs_come_last),
      cmocka_unit_test(factors_solve_what_they_are_of),
      cmocka_unit_test(a_hub_of_thousands_is_judged_at_once),
      cmocka_unit_test(what_is_done_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
