/* Stable or not: predicted from eigenvalues of symmetric matrices, and seen by stepping. */

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

/* Up to 60 masses over 6 decades, springs over 12, dampers from a thousandth of critical to a
 * thousand times that. */
static const NetworkKind UNLIKE = {60, 3.0, 6.0, 3.0, true};
static const NetworkKind MODEST = {12, 0.5, 1.0, 0.7, true};
static const NetworkKind UNDAMPED = {60, 3.0, 6.0, 0.0, false};

/* The margin inside which rounding decides, relative in the time step: the limit itself is a few
 * roundings of up to 120 numbers, and beyond it a real pole is at −1 − 2 margin or further out. */
static const double MARGIN = 1e-8;

/* From here up it is affordable to step link by link until the growth shows. */
static const double SIMULATED = 1e-3;

/* 2^36 steps: a pole beyond −1 − 2e-8 grows by e^1374, and overflows or passes this. */
enum { SQUARINGS = 36 };

/* Without dampers a pole just past the limit is at −1 − √(8 margin), and 2^24 steps grow it by
 * e^4700; more would let the rounding of the powers themselves grow. */
enum { UNDAMPED_SQUARINGS = 24 };
static const double GROWN = 1e150;

static double largest_step(const Network* network) {
  double step_s = 0.0;
  assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_OK);
  return step_s;
}

/* The step matrix in √m x and h √m v, where its entries are about 1 if it is stable. */
static void scaled_step_matrix(Network* network, double step_s, double* matrix) {
  const size_t n = network->n_masses;
  const size_t order = 2 * n;
  double* const mass_kg = networks_zeros(n);
  assert_int_equal(network_matrices(network, mass_kg, NULL, NULL), STATUS_OK);
  networks_step_matrix(network, step_s, matrix);
  for (size_t j = 0; j < order; ++j) {
    for (size_t i = 0; i < order; ++i) {
      const double row = sqrt(mass_kg[i % n]) * (i < n ? 1.0 : step_s);
      const double column = sqrt(mass_kg[j % n]) * (j < n ? 1.0 : step_s);
      matrix[i + j * order] *= row / column;
    }
  }
  free(mass_kg);
}

static double largest(const double* values, size_t n) {
  double value = 0.0;
  for (size_t i = 0; i < n; ++i) {
    value = isnan(values[i]) ? HUGE_VAL : fmax(value, fabs(values[i]));
  }
  return value;
}

/* Whether the powers of the step matrix grow without end. */
static bool explodes_by_powers(Network* network, double step_s) {
  const int n_squarings = network->dampers.n > 0 ? SQUARINGS : UNDAMPED_SQUARINGS;
  const size_t order = 2 * (size_t)network->n_masses;
  const size_t size = order * order;
  double* const matrix = networks_zeros(2 * size);
  double* const square = matrix + size;
  scaled_step_matrix(network, step_s, matrix);
  bool is_grown = false;
  for (int k = 0; k < n_squarings && !is_grown; ++k) {
    networks_multiply(order, matrix, matrix, square);
    memcpy(matrix, square, size * sizeof(double));
    is_grown = !(largest(matrix, size) < GROWN);
  }
  free(matrix);
  return is_grown;
}

/* Whether a simulation from a random state grows, in as many steps as a pole at −1 − 2 margin takes
 * to e⁸⁰ = 10³⁴. */
static bool explodes_by_stepping(Network* network, Random* random, double step_s, double margin) {
  const int n_steps = (int)(80.0 / log1p(2.0 * margin));
  network_rest(network);
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!network->is_ground[p]) {
      const double size = 1.0 / sqrt(network->mass_kg[p]);
      network->x[p] = size * random_between(random, -1.0, 1.0);
      network->v[p] = size / step_s * random_between(random, -1.0, 1.0);
    }
  }
  bool is_grown = false;
  for (int n = 0; n < n_steps && !is_grown; ++n) {
    network_step(network, step_s);
    for (uint32_t p = 0; p < network->n_points && n % 16 == 0; ++p) {
      const double scale = network->is_ground[p] ? 0.0 : sqrt(network->mass_kg[p]);
      is_grown |= !(fabs(network->x[p]) * scale < 1e20);
    }
  }
  network_rest(network);
  return is_grown;
}

typedef struct {
  int n_judged;
  int n_simulated;
  int n_refused;      /* By modes_solve, as badly scaled */
  int n_paper_rash;   /* The paper's rule: stable, and it explodes */
  int n_rash_for_all; /* Those of them where no eigenvalue is real, so that nothing was paired */
  int n_paper_afraid; /* The other way round */
} Count;

static void judge(
    Network* network, Random* random, double step_s, double margin, bool is_stable, Count* count) {
  ++count->n_judged;
  assert_int_equal(explodes_by_powers(network, step_s), !is_stable);
  if (margin > SIMULATED) {
    assert_int_equal(explodes_by_stepping(network, random, step_s, margin), !is_stable);
    ++count->n_simulated;
  }
  Modes* modes = NULL;
  const Status status = modes_solve(network, 1.0 / step_s, 0, &modes);
  if (status == STATUS_ILL_SCALED) {
    ++count->n_refused;
    return;
  }
  assert_int_equal(status, STATUS_OK);
  assert_int_equal(modes->is_stable, is_stable);
  uint32_t n_unstable = 0;
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    n_unstable += modes->mode[k].region == POLE_UNSTABLE ? 1 : 0;
  }
  assert_int_equal(n_unstable > 0, !is_stable);
  if (modes->paper_is_stable && !is_stable) {
    bool is_all_complex = true;
    for (uint32_t k = 0; k < modes->n_modes; ++k) {
      is_all_complex &= cimag(modes->mode[k].analog[0]) > 0.0;
    }
    ++count->n_paper_rash;
    count->n_rash_for_all += is_all_complex ? 1 : 0;
  }
  count->n_paper_afraid += !modes->paper_is_stable && is_stable ? 1 : 0;
  modes_free(modes);
}

static Count judge_many(const NetworkKind* kind, int n_networks, double most) {
  Random random = random_start();
  Count count = {0};
  for (int trial = 0; trial < n_networks; ++trial) {
    Network* const network = networks_random(&random, kind);
    const double limit_s = largest_step(network);
    const double margin = random_log_between(&random, MARGIN, most);
    judge(network, &random, limit_s / (1.0 + margin), margin, true, &count);
    judge(network, &random, limit_s * (1.0 + margin), margin, false, &count);
    network_free(network);
  }
  print_message(
      "  %d judged, all as predicted, %d of them link by link as well; %d too badly scaled\n"
      "  for a list of modes\n",
      count.n_judged, count.n_simulated, count.n_refused);
  return count;
}

static void prediction_is_what_happens(void** state) {
  (void)state;
  const int n_networks = networks_is_long() ? 2000 : 150;
  const Count count = judge_many(&UNLIKE, n_networks, 1.0);
  assert_int_equal(count.n_judged, 2 * n_networks);
  assert_true(count.n_simulated > n_networks / 2);
}

static void prediction_is_what_happens_without_dampers(void** state) {
  (void)state;
  const int n_networks = networks_is_long() ? 500 : 50;
  const Count count = judge_many(&UNDAMPED, n_networks, 1.0);
  assert_int_equal(count.n_refused, 0);
  /* Without dampers the paper's rule is exact. */
  assert_int_equal(count.n_paper_rash + count.n_paper_afraid, 0);
}

static void paper_misjudges_unequal_dampers(void** state) {
  (void)state;
  const int n_networks = networks_is_long() ? 4000 : 400;
  const Count count = judge_many(&MODEST, n_networks, 1.0);
  print_message(
      "  the paper's rule calls %d stable that explode, %d of them without a real eigenvalue,\n"
      "  and %d unstable that do not\n",
      count.n_paper_rash, count.n_rash_for_all, count.n_paper_afraid);
  assert_int_equal(count.n_refused, 0);
  assert_true(count.n_paper_rash > 0);
}

/* The largest step that the paper's rule allows. */
static double paper_limit(const Modes* modes) {
  double limit_s = HUGE_VAL;
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    const double complex* const s = modes->mode[k].analog;
    const double omega = sqrt(cabs(s[0]) * cabs(s[1]));
    limit_s = fmin(limit_s, pole_largest_step_s(omega, fmax(0.0, -creal(s[0] + s[1]))));
  }
  return limit_s;
}

static void paper_allows_steps_that_explode(void** state) {
  (void)state;
  Random random = random_start();
  int n_rash = 0;
  double worst = 0.0;
  double paper = 0.0;
  for (int trial = 0; trial < 500; ++trial) {
    Network* const network = networks_random(&random, &MODEST);
    Modes* modes = NULL;
    assert_int_equal(modes_solve(network, 1.0, 0, &modes), STATUS_OK);
    const double step_s = paper_limit(modes) * (1.0 - 1e-9);
    modes_free(modes);
    assert_int_equal(modes_solve(network, 1.0 / step_s, 0, &modes), STATUS_OK);
    assert_true(modes->paper_is_stable);
    n_rash += modes->is_stable ? 0 : 1;
    if (modes->radius > worst) {
      worst = modes->radius;
      paper = modes->paper_radius;
      assert_within("radius from the oracle's",
                    fabs(networks_spectral_radius(network, step_s) - worst), 1e-9);
    }
    modes_free(modes);
    network_free(network);
  }
  print_message("  %d of 500 networks explode at the largest step of the paper's rule;\n"
                "  worst: predicted radius %.6f, true %.4f\n",
                n_rash, paper, worst);
  assert_true(n_rash > 100 && worst > 1.5);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(prediction_is_what_happens),
      cmocka_unit_test(prediction_is_what_happens_without_dampers),
      cmocka_unit_test(paper_misjudges_unequal_dampers),
      cmocka_unit_test(paper_allows_steps_that_explode),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
