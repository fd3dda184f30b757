/* How true the partials are, against the ideal and the stiff string. */
#include "core/string/tuning.h"

#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { N_KINDS = 3, MOST_MASSES = 1024, MOST_DENSE = 80 };

static StringCoefs solve(const TuningTarget* target, uint32_t n_masses) {
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(target, n_masses, &coefs), STATUS_OK);
  return coefs;
}

/* Partial k of the stiff string whose fundamental is the target's. */
static double stiff_hz(const TuningTarget* target, double k) {
  const double b = target->inharmonicity;
  return k * target->tone.f0_hz * sqrt((1.0 + b * k * k) / (1.0 + b));
}

/* Of partial k of an undamped string, by the closed form. */
static double error_cents(const TuningTarget* target, uint32_t n_masses, uint32_t k) {
  const Pole mode = tuning_mode(solve(target, n_masses), n_masses, k);
  return measure_cents(pole_tone(target->rate_hz, mode).f0_hz, stiff_hz(target, k));
}

/* The table of partials 5, 10 and 20 of 55 Hz at 48 kHz. */
static const uint32_t table_partials[3] = {5, 10, 20};

static const struct {
  uint32_t n_masses;
  double inharmonicity;
  double cents[N_KINDS][3];
} table[] = {
    {80,
     0.0,
     {{-2.515652, -10.39053, -42.09460},
      {-0.01295891, -0.2057161, -3.174697},
      {-7.794974e-05, -0.004905311, -0.2934422}}},
    {40,
     0.0,
     {{-10.08885, -41.78534, -171.2067},
      {-0.2020027, -3.119379, -43.80184},
      {-0.004721324, -0.2824198, -13.90749}}},
    {20,
     0.0,
     {{-38.84905, -162.6397, -699.8986},
      {-2.856469, -40.32199, -453.9718},
      {-0.2474747, -12.31061, -346.7447}}},
    {80,
     1e-4,
     {{-2.522175, -10.49381, -43.67827},
      {-0.02593403, -0.4089396, -6.155189},
      {-0.000161405, -0.01008534, -0.5869376}}},
    {80,
     1e-2,
     {{-3.034545, -15.44688, -71.41718},
      {-1.049622, -10.35437, -63.19635},
      {-0.002193811, -0.08343958, -1.737710}}},
};

enum { N_ROWS = sizeof(table) / sizeof(table[0]) };

static TuningTarget target_of_row(size_t row, int kind) {
  return (TuningTarget){
      .rate_hz = 48000.0,
      .tone = {55.0, HUGE_VAL},
      .inharmonicity = table[row].inharmonicity,
      .partials = (Partials)kind,
  };
}

/* Half of the seventh digit; and what a few roundings of the largest a, 4, are to the smallest
 * one's pitch. */
static double allowed(double printed) {
  return 1e-6 * fabs(printed) + 1e-8;
}

static void partials_are_those_of_the_table(void** state) {
  (void)state;
  for (size_t row = 0; row < N_ROWS; ++row) {
    for (int kind = 0; kind < N_KINDS; ++kind) {
      const TuningTarget target = target_of_row(row, kind);
      for (int i = 0; i < 3; ++i) {
        const double wanted = table[row].cents[kind][i];
        const double found = error_cents(&target, table[row].n_masses, table_partials[i]);
        assert_true(fabs(found - wanted) <= allowed(wanted));
      }
    }
  }
}

static int compare(const void* a, const void* b) {
  const double x = *(const double*)a;
  const double y = *(const double*)b;
  return (x > y) - (x < y);
}

/* The same from the eigenvalues of k1 L + k2 L² + k3 L³, made of dense matrices. */
static void partials_are_those_of_the_table_by_the_dense_matrix(void** state) {
  (void)state;
  static double stiffness[MOST_DENSE * MOST_DENSE];
  static double damping[MOST_DENSE * MOST_DENSE];
  static double complex values[MOST_DENSE];
  double a[MOST_DENSE];
  double worst = 0.0;
  for (size_t row = 0; row < N_ROWS; ++row) {
    const uint32_t n = table[row].n_masses;
    for (int kind = 0; kind < N_KINDS; ++kind) {
      const TuningTarget target = target_of_row(row, kind);
      oracle_forces(solve(&target, n), n, stiffness, damping);
      oracle_eigenvalues(n, stiffness, values);
      for (uint32_t k = 0; k < n; ++k) {
        a[k] = creal(values[k]);
      }
      qsort(a, n, sizeof(double), compare);
      for (int i = 0; i < 3; ++i) {
        const double wanted = table[row].cents[kind][i];
        const double f_hz = target.rate_hz / PI * asin(0.5 * sqrt(a[table_partials[i] - 1]));
        const double found = measure_cents(f_hz, stiff_hz(&target, table_partials[i]));
        assert_true(fabs(found - wanted) <= allowed(wanted));
        worst = fmax(worst, fabs(found - error_cents(&target, n, table_partials[i])));
      }
    }
  }
  assert_within("dense against closed form, cents", worst, 1e-8);
}

/* How fast the error of partial 3 falls with more masses, as a power of N + 1, while c and β stand
 * still and so the series does. */
static double order(Partials partials, double beta, double courant, uint32_t length) {
  double error[2];
  for (uint32_t i = 0; i < 2; ++i, length *= 2) {
    const double inharmonicity = beta * PI * PI / ((double)length * length);
    const TuningTarget target = {
        .rate_hz = 2.0 * length / (courant * sqrt(1.0 + inharmonicity)),
        .tone = {1.0, HUGE_VAL},
        .inharmonicity = inharmonicity,
        .partials = partials,
    };
    error[i] = fabs(error_cents(&target, length - 1, 3));
  }
  return log2(error[0] / error[1]);
}

/* The leading term of what is left is the first that is not solved for. */
static void each_term_brings_two_orders(void** state) {
  (void)state;
  static const double betas[] = {0.0, 0.1, 3.0};
  static const double courants[] = {0.1, 0.5, 0.8};
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      worst = fmax(worst, fabs(order(PARTIALS_LUMPED, betas[i], courants[j], 200) - 2.0));
      worst = fmax(worst, fabs(order(PARTIALS_TRUE, betas[i], courants[j], 200) - 4.0));
      worst = fmax(worst, fabs(order(PARTIALS_TRUEST, betas[i], courants[j], 100) - 6.0));
    }
  }
  assert_within("order of convergence, from 2, 4 and 6", worst, 0.05);
}

static TuningTarget random_target(Random* random, uint32_t n_masses, double courant) {
  return (TuningTarget){
      .rate_hz = 48000.0,
      .tone = {24000.0 * courant / (n_masses + 1.0), random_log_between(random, 1e-3, 1e3)},
      .loss = random_between(random, 0.0, 1.0),
      .inharmonicity = random_below(random, 2) ? random_log_between(random, 1e-6, 0.1) : 0.0,
  };
}

/* Bit for bit: k1 = a1 / (λ1 (1 + b λ1)), k2 = b k1, b = B ((N + 1)/π)². */
static void lumped_partials_are_those_of_the_chain_itself(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 4000; ++trial) {
    const uint32_t n_masses = 1 + random_below(&random, MOST_MASSES);
    const TuningTarget target =
        random_target(&random, n_masses, random_between(&random, 0.01, 1.99));
    const StringCoefs coefs = solve(&target, n_masses);
    const double length = (n_masses + 1.0) / PI;
    const double b = target.inharmonicity * length * length;
    const double lambda1 = tuning_lambda(n_masses, 1);
    Pole first = {0};
    assert_int_equal(pole_solve(target.rate_hz, target.tone, &first), STATUS_OK);
    assert_true(coefs.k1 == first.a / (lambda1 * (1.0 + b * lambda1)));
    assert_true(coefs.k2 == b * coefs.k1 && coefs.k3 == 0.0);
  }
}

/* c being that of the string without its bending, and more than 1. */
static void chain_that_holds_more_than_there_is_stays_as_it_is(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 4000; ++trial) {
    const uint32_t n_masses = 1 + random_below(&random, MOST_MASSES);
    const double courant = random_log_between(&random, 1.0001, 0.999 * (n_masses + 1.0));
    TuningTarget target = random_target(&random, n_masses, courant);
    target.inharmonicity = fmin(target.inharmonicity, 0.9 * (courant * courant - 1.0));
    const StringCoefs lumped = solve(&target, n_masses);
    for (int kind = 1; kind < N_KINDS; ++kind) {
      target.partials = (Partials)kind;
      const StringCoefs coefs = solve(&target, n_masses);
      assert_memory_equal(&coefs, &lumped, sizeof(coefs));
    }
  }
}

/* Between lumped and nothing to mend there is no step: a bend is heard as a bend. */
static void terms_vanish_where_the_chain_is_true(void** state) {
  (void)state;
  for (int kind = 1; kind < N_KINDS; ++kind) {
    const TuningTarget target = {.rate_hz = 48000.0,
                                 .tone = {24000.0 / 50.0 * (1.0 - 1e-9), HUGE_VAL},
                                 .partials = (Partials)kind};
    const StringCoefs coefs = solve(&target, 49);
    assert_true(coefs.k2 > 0.0 && coefs.k2 < 1e-9 * coefs.k1);
    assert_true(coefs.k3 >= 0.0 && coefs.k3 < 1e-9 * coefs.k1);
  }
}

/* Where the stiff string is not so stiff that what the series leaves out is more than its terms. */
static void truer_settings_are_truer(void** state) {
  (void)state;
  double least = HUGE_VAL;
  Random random = random_start();
  for (int trial = 0; trial < 4000; ++trial) {
    const uint32_t n_masses = 8 + random_below(&random, 300);
    const uint32_t k = 2 + random_below(&random, n_masses / 4);
    TuningTarget target = random_target(&random, n_masses, random_between(&random, 0.01, 0.95));
    target.tone.tau_s = HUGE_VAL;
    target.inharmonicity = fmin(target.inharmonicity, 0.01 / (k * k));
    double error[N_KINDS];
    for (int kind = 0; kind < N_KINDS; ++kind) {
      target.partials = (Partials)kind;
      error[kind] = fabs(error_cents(&target, n_masses, k));
    }
    assert_true(error[2] < error[1] + 1e-9 && error[1] < error[0]);
    least = fmin(least, error[0] / error[1]);
  }
  assert_within("error of true partials, as a part of that of lumped ones", 1.0 / least, 0.25);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(partials_are_those_of_the_table),
      cmocka_unit_test(partials_are_those_of_the_table_by_the_dense_matrix),
      cmocka_unit_test(each_term_brings_two_orders),
      cmocka_unit_test(lumped_partials_are_those_of_the_chain_itself),
      cmocka_unit_test(chain_that_holds_more_than_there_is_stays_as_it_is),
      cmocka_unit_test(terms_vanish_where_the_chain_is_true),
      cmocka_unit_test(truer_settings_are_truer),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
