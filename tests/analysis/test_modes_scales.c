/* Masses of 10⁻⁹ beside 10³ and springs of 10⁻⁶ beside 10¹²: right answers or a refusal. */

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

/* 113 bits where the compiler has them: the range of ω² here is 30 decades. */
#if defined(__x86_64__) || defined(__i386__)
__extension__ typedef __float128 Quad;
#else
typedef long double Quad;
#endif

/* 12 decades of masses, 18 of springs. */
static const NetworkKind EXTREME = {12, 6.0, 9.0, 0.0, false};
static const NetworkKind EXTREME_DAMPED = {12, 6.0, 9.0, 3.0, true};

static Quad quad_sqrt(Quad value) {
  Quad root = (Quad)sqrt((double)value);
  for (int i = 0; i < 3 && root > 0; ++i) {
    root = (root + value / root) / 2;
  }
  return root;
}

/* The springs' edges √k (e_a/√m_a − e_b/√m_b), n_springs × n, column-major. */
static void fill_edges(const Network* network, Quad* edges) {
  const size_t m = network->springs.n;
  size_t row = 0;
  for (uint32_t p = 0; p < network->n_points; ++p) {
    for (size_t s = 0; s < m && !network->is_ground[p]; ++s) {
      const NetworkLink spring = network->springs.link[s];
      const Quad size = quad_sqrt((Quad)spring.value / (Quad)network->mass_kg[p]);
      edges[s + row * m] = spring.from == p ? size : spring.to == p ? -size : 0;
    }
    row += network->is_ground[p] ? 0 : 1;
  }
}

/* Make two columns orthogonal (Hestenes); whether they were not.  Below `least` is rounding. */
static bool rotate(size_t m, Quad least, Quad* x, Quad* y) {
  Quad xx = 0;
  Quad yy = 0;
  Quad xy = 0;
  for (size_t i = 0; i < m; ++i) {
    xx += x[i] * x[i];
    yy += y[i] * y[i];
    xy += x[i] * y[i];
  }
  if (xy * xy <= (Quad)1e-60 * xx * yy || xx <= least || yy <= least) {
    return false;
  }
  const Quad ratio = (yy - xx) / (2 * xy);
  const Quad hypotenuse = quad_sqrt(1 + ratio * ratio);
  const Quad tangent = ratio < 0 ? 1 / (ratio - hypotenuse) : 1 / (ratio + hypotenuse);
  const Quad cosine = 1 / quad_sqrt(1 + tangent * tangent);
  for (size_t i = 0; i < m; ++i) {
    const Quad old = x[i];
    x[i] = cosine * (old - tangent * y[i]);
    y[i] = cosine * (tangent * old + y[i]);
  }
  return true;
}

/* ω, rising, by one-sided Jacobi rotations in quadruple precision. */
static void quad_omegas(const Network* network, double* omega) {
  const size_t m = network->springs.n;
  const size_t n = network->n_masses;
  Quad* const edges = calloc(m * n, sizeof(Quad));
  assert_non_null(edges);
  fill_edges(network, edges);
  Quad all = 0;
  for (size_t e = 0; e < m * n; ++e) {
    all += edges[e] * edges[e];
  }
  bool is_done = false;
  for (int sweep = 0; sweep < 200 && !is_done; ++sweep) {
    is_done = true;
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = i + 1; j < n; ++j) {
        is_done &= !rotate(m, (Quad)1e-50 * all, edges + i * m, edges + j * m);
      }
    }
  }
  assert_true(is_done);
  for (size_t i = 0; i < n; ++i) {
    Quad square = 0;
    for (size_t e = 0; e < m; ++e) {
      square += edges[e + i * m] * edges[e + i * m];
    }
    const double value = (double)quad_sqrt(square);
    size_t at = i;
    for (; at > 0 && omega[at - 1] > value; --at) {
      omega[at] = omega[at - 1];
    }
    omega[at] = value;
  }
  free(edges);
}

/* What drifts has no frequency beside it, and leaves the others as right as they are. */
static void extremes_that_drift_are_right_to_rounding(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  uint32_t n_drifting = 0;
  const int n_trials = networks_is_long() ? 1000 : 100;
  for (int trial = 0; trial < n_trials; ++trial) {
    Network* const network = networks_random(&random, &EXTREME);
    for (uint32_t s = 0; s < network->springs.n; ++s) {
      NetworkLink* const spring = &network->springs.link[s];
      const bool is_cut = network->is_ground[spring->from] || network->is_ground[spring->to];
      spring->value *= is_cut ? 0.0 : 1.0;
    }
    assert_int_equal(network_check(network, NULL), STATUS_OK);
    double omega[12];
    quad_omegas(network, omega);
    Modes* modes = NULL;
    assert_int_equal(modes_solve(network, 48000.0, 0, &modes), STATUS_OK);
    for (uint32_t k = 0; k < modes->n_modes; ++k) {
      const double got = cabs(modes->mode[k].analog[0]);
      n_drifting += modes->mode[k].is_free ? 1 : 0;
      if (modes->mode[k].is_free) {
        assert_true(got == 0.0 && omega[k] <= 1e-15 * omega[modes->n_modes - 1]);
      } else {
        worst = fmax(worst, fabs(got / omega[k] - 1.0));
      }
    }
    modes_free(modes);
    network_free(network);
  }
  assert_true(n_drifting > (uint32_t)n_trials);
  assert_within("ω, relative", worst, 1e-10);
}

static void extremes_without_dampers_are_right_to_rounding(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  double widest = 0.0;
  const int n_trials = networks_is_long() ? 2000 : 150;
  for (int trial = 0; trial < n_trials; ++trial) {
    Network* const network = networks_random(&random, &EXTREME);
    double omega[12];
    quad_omegas(network, omega);
    Modes* modes = NULL;
    assert_int_equal(modes_solve(network, 48000.0, 0, &modes), STATUS_OK);
    for (uint32_t k = 0; k < modes->n_modes; ++k) {
      const double got = cabs(modes->mode[k].analog[0]);
      worst = fmax(worst, fabs(got / omega[k] - 1.0));
    }
    const double step_s = 2.0 / omega[network->n_masses - 1];
    worst = fmax(worst, fabs(modes->largest_step_s / step_s - 1.0));
    widest = fmax(widest, omega[network->n_masses - 1] / omega[0]);
    modes_free(modes);
    network_free(network);
  }
  print_message("  frequencies over up to %.0f decades in one network\n", log10(widest));
  /* Roundings times the condition of the edges once rows and columns are brought to one size, which
   * loops of unlike springs raise to some ten thousands in a thousand networks. */
  assert_within("ω and the limit, relative", worst, 1e-10);
}

/* Masses by themselves, each with its own damper: closed form. */
static void extremes_with_dampers_are_right_or_refused(void** state) {
  (void)state;
  enum { MOST = 6 };
  Random random = random_start();
  int n_refused = 0;
  double worst = 0.0;
  double worst_limit = 0.0;
  const int n_trials = networks_is_long() ? 10000 : 1000;
  for (int trial = 0; trial < n_trials; ++trial) {
    Network* const network = network_new();
    uint32_t ground = 0;
    network_add_ground(network, &ground);
    double complex expected[2 * MOST];
    double limit_s = HUGE_VAL;
    for (int i = 0; i < MOST; ++i) {
      const double mass_kg = random_log_between(&random, 1e-9, 1e3);
      const double stiffness = random_log_between(&random, 1e-6, 1e12);
      const double damping = sqrt(mass_kg * stiffness) * random_log_between(&random, 1e-3, 1e3);
      uint32_t point = 0;
      network_add_mass(network, mass_kg, &point);
      network_add_spring(network, ground, point, stiffness);
      network_add_damper(network, point, ground, damping);
      const double half = 0.5 * damping / mass_kg;
      const double k = stiffness / mass_kg;
      const double complex s = -half - csqrt(half * half - k);
      expected[2 * (size_t)i] = s;
      expected[2 * (size_t)i + 1] = k / s;
      limit_s = fmin(limit_s, pole_largest_step_s(sqrt(k), 2.0 * half));
    }
    assert_int_equal(network_check(network, NULL), STATUS_OK);
    double step_s = 0.0;
    assert_int_equal(modes_largest_step(network, NULL, &step_s), STATUS_OK);
    worst_limit = fmax(worst_limit, fabs(step_s / limit_s - 1.0));
    Modes* modes = NULL;
    const Status status = modes_solve(network, 1.0 / step_s, 0, &modes);
    n_refused += status ? 1 : 0;
    assert_true(!status || status == STATUS_ILL_SCALED);
    for (size_t i = 0; i < 2 * MOST && !status; ++i) {
      double nearest = HUGE_VAL;
      for (size_t j = 0; j < 2 * MOST; ++j) {
        const double complex got = modes->mode[j / 2].analog[j % 2];
        nearest = fmin(nearest, cabs(got / expected[i] - 1.0));
      }
      worst = fmax(worst, nearest);
    }
    modes_free(modes);
    network_free(network);
  }
  print_message("  %d of %d refused\n", n_refused, n_trials);
  assert_within("s, relative", worst, 1e-6);
  assert_within("limit, relative", worst_limit, 16.0 * DBL_EPSILON);
}

/* What all modes must be together: Π s = det K/det M, Σ s = −tr M⁻¹Z. */
static void extremes_of_networks_keep_their_invariants(void** state) {
  (void)state;
  Random random = random_start();
  int n_refused = 0;
  double worst_product = 0.0;
  double worst_sum = 0.0;
  const int n_trials = networks_is_long() ? 5000 : 500;
  for (int trial = 0; trial < n_trials; ++trial) {
    Network* const network = networks_random(&random, &EXTREME_DAMPED);
    double omega[12];
    quad_omegas(network, omega);
    Modes* modes = NULL;
    const Status status = modes_solve(network, 1.0, 0, &modes);
    n_refused += status ? 1 : 0;
    assert_true(!status || status == STATUS_ILL_SCALED);
    double log_product = 0.0;
    double sum = 0.0;
    double size = 0.0;
    for (uint32_t k = 0; k < (status ? 0 : modes->n_modes); ++k) {
      const double complex* const s = modes->mode[k].analog;
      log_product += log(cabs(s[0])) + log(cabs(s[1])) - 2.0 * log(omega[k]);
      sum += creal(s[0] + s[1]);
      size = fmax(size, cabs(s[1]));
    }
    for (uint32_t d = 0; d < network->dampers.n; ++d) {
      const NetworkLink damper = network->dampers.link[d];
      sum +=
          damper.value / network->mass_kg[damper.from] + damper.value / network->mass_kg[damper.to];
    }
    if (!status) {
      worst_product = fmax(worst_product, fabs(log_product));
      worst_sum = fmax(worst_sum, fabs(sum) / size);
    }
    modes_free(modes);
    network_free(network);
  }
  print_message("  %d of %d refused\n", n_refused, n_trials);
  assert_within("ln Π s", worst_product, 1e-3);
  assert_within("Σ s, of the largest", worst_sum, 1e-9);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(extremes_without_dampers_are_right_to_rounding),
      cmocka_unit_test(extremes_that_drift_are_right_to_rounding),
      cmocka_unit_test(extremes_with_dampers_are_right_or_refused),
      cmocka_unit_test(extremes_of_networks_keep_their_invariants),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
