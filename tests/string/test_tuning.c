#include "core/string/tuning.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { MOST_DENSE = 40 };

static double relative(double value, double truth) {
  return fabs(value - truth) / fabs(truth);
}

static StringCoefs solve(const TuningTarget* target, uint32_t n_masses) {
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(target, n_masses, &coefs), STATUS_OK);
  return coefs;
}

/* The paper's worked example: its only dampers are between masses. */
static const TuningTarget example = {.rate_hz = 6000.0, .tone = {440.0, 1.0}, .loss = 1.0};

static void worked_example_has_the_papers_oscillators(void** state) {
  (void)state;
  const StringCoefs coefs = solve(&example, 5);
  /* √(k/m) and Z/m of one spring and one damper; a few roundings on the way.  The paper prints
   * …853, within them. */
  assert_within("ω0, relative", relative(6000.0 * sqrt(coefs.k1), 5293.239300336857),
                16.0 * DBL_EPSILON);
  assert_within("γ, relative", relative(6000.0 * coefs.z1, 7.462857736414484), 16.0 * DBL_EPSILON);
  /* As Algorithm 1 in doubles finds it, where 1 − exp(−2h/τ) is 3.3e-4 and keeps twelve digits. */
  assert_within("γ, relative", relative(6000.0 * coefs.z1, 7.46285773640857), 1e-12);
  assert_true(coefs.k2 == 0.0 && coefs.z0 == 0.0);
}

/* Where the pole is in the spectrum; it is taken out, so that every eigenvalue serves once. */
static double take_nearest(double complex* spectrum, uint32_t* n_left, double complex pole) {
  uint32_t nearest = 0;
  for (uint32_t i = 1; i < *n_left; ++i) {
    if (cabs(spectrum[i] - pole) < cabs(spectrum[nearest] - pole)) {
      nearest = i;
    }
  }
  const double distance = cabs(spectrum[nearest] - pole);
  spectrum[nearest] = spectrum[--*n_left];
  return distance;
}

/* The largest distance of the closed form's 2N poles from the dense matrix's, over condition. */
static double spectrum_error(StringCoefs coefs, uint32_t n_masses) {
  double complex spectrum[2 * MOST_DENSE];
  uint32_t n_left = 2 * n_masses;
  double worst = 0.0;
  oracle_poles(coefs, n_masses, spectrum);
  for (uint32_t k = 1; k <= n_masses; ++k) {
    const Pole pole = tuning_mode(coefs, n_masses, k);
    const double half = 0.5 * (2.0 - pole.a - pole.g);
    const double complex root = csqrt(complex_of(half * half - (1.0 - pole.g), 0.0));
    /* A pair of poles at a distance feels rounding as 1/distance, and never more than as √ε. */
    const double condition = 1.0 + 1.0 / fmax(2.0 * cabs(root), 1e-8);
    worst = fmax(worst, take_nearest(spectrum, &n_left, half + root) / condition);
    worst = fmax(worst, take_nearest(spectrum, &n_left, half - root) / condition);
  }
  assert_int_equal(n_left, 0);
  return worst;
}

static void modes_are_the_eigenvalues_of_the_dense_matrix(void** state) {
  (void)state;
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 400; ++trial) {
    const uint32_t n_masses = 1 + random_below(&random, MOST_DENSE);
    const TuningTarget target = {
        .rate_hz = 48000.0,
        .tone = {48000.0 * random_log_between(&random, 1e-3, 0.45),
                 random_log_between(&random, 1e-3, 100.0)},
        .loss = random_between(&random, 0.0, 1.0),
        .inharmonicity = trial % 3 == 0 ? 0.0 : random_log_between(&random, 1e-6, 1e-1),
        .partials = (Partials)random_below(&random, 3),
    };
    StringCoefs coefs = solve(&target, n_masses);
    /* Bending down to where the top mode stands still, of which no target asks. */
    if (trial % 3 == 1) {
      coefs.k2 = -coefs.k1 * random_between(&random, 0.0, 0.25);
      coefs.k3 = coefs.k1 * random_between(&random, 0.0, 0.05);
    }
    const double size =
        1.0 + 4.0 * (coefs.k1 + coefs.z1) + 16.0 * fabs(coefs.k2) + 64.0 * coefs.k3 + coefs.z0;
    worst = fmax(worst, spectrum_error(coefs, n_masses) / (size * n_masses));
  }
  assert_within("poles, over the matrix's size and condition", worst, 8.0 * DBL_EPSILON);
}

/* Applying the dense matrices to a sine shape only scales it. */
static void sines_are_the_shapes(void** state) {
  (void)state;
  static double stiffness[MOST_DENSE * MOST_DENSE];
  static double damping[MOST_DENSE * MOST_DENSE];
  const StringCoefs coefs = {.k1 = 0.3, .k2 = 0.07, .z0 = 0.011, .z1 = 0.2, .k3 = 0.01};
  double worst = 0.0;
  for (uint32_t n = 1; n <= MOST_DENSE; ++n) {
    oracle_forces(coefs, n, stiffness, damping);
    for (uint32_t k = 1; k <= n; ++k) {
      const Pole mode = tuning_mode(coefs, n, k);
      for (uint32_t i = 0; i < n; ++i) {
        double kx = 0.0;
        double zx = 0.0;
        for (uint32_t j = 0; j < n; ++j) {
          const double shape = sin(PI * k * (j + 1.0) / (n + 1.0));
          kx += stiffness[i + (size_t)j * n] * shape;
          zx += damping[i + (size_t)j * n] * shape;
        }
        const double shape = sin(PI * k * (i + 1.0) / (n + 1.0));
        worst = fmax(worst, fmax(fabs(kx - mode.a * shape), fabs(zx - mode.g * shape)));
      }
    }
  }
  /* Arguments up to 40π have three roundings, and rows of K weigh up to 3. */
  assert_within("K φ − a φ and Z φ − g φ", worst, 400.0 * DBL_EPSILON);
}

static void fundamental_has_the_pitch_and_decay_asked_for(void** state) {
  (void)state;
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 20000; ++trial) {
    const TuningTarget target = {
        .rate_hz = random_log_between(&random, 8000.0, 400000.0),
        .tone = {random_log_between(&random, 8.0, 3900.0), random_log_between(&random, 0.05, 1e3)},
        .loss = random_between(&random, 0.0, 1.0),
        .inharmonicity = random_between(&random, 0.0, 0.1),
        .partials = (Partials)random_below(&random, 3),
    };
    const uint32_t n_masses = 1 + random_below(&random, 1024);
    const Tone tone = pole_tone(target.rate_hz, tuning_mode(solve(&target, n_masses), n_masses, 1));
    worst = fmax(worst, fmax(relative(tone.f0_hz, target.tone.f0_hz),
                             relative(tone.tau_s, target.tone.tau_s)));
  }
  assert_within("F and τ, relative", worst, 1e-12);
}

/* The share s: what the dampers between masses take of the fundamental's damping. */
static void loss_is_a_share_of_the_fundamentals_damping(void** state) {
  (void)state;
  for (int step = 0; step <= 8; ++step) {
    const double loss = 0.125 * step;
    const TuningTarget target = {.rate_hz = 48000.0, .tone = {110.0, 2.0}, .loss = loss};
    const StringCoefs coefs = solve(&target, 50);
    const double g1 = 1.0 - exp(-2.0 / (2.0 * 48000.0));
    const double lambda1 = 2.0 - 2.0 * cos(PI / 51.0);
    /* 1 − cos loses the digits of λ1, about 4e-3. */
    assert_true(fabs(coefs.z1 * lambda1 - loss * g1) <= 1e-12 * g1);
    assert_true(fabs(coefs.z0 - (1.0 - loss) * g1) <= 1e-11 * g1);
  }
}

/* The largest error of partials 2 to 5 against the stiff string's, in time fine enough not to warp.
 */
static double partials_error(uint32_t n_masses, double inharmonicity) {
  const TuningTarget target = {
      .rate_hz = 1e8, .tone = {100.0, HUGE_VAL}, .inharmonicity = inharmonicity};
  const StringCoefs coefs = solve(&target, n_masses);
  double worst = 0.0;
  for (uint32_t k = 2; k <= 5; ++k) {
    const double f_hz = pole_tone(target.rate_hz, tuning_mode(coefs, n_masses, k)).f0_hz;
    const double stiff = k * sqrt((1.0 + inharmonicity * k * k) / (1.0 + inharmonicity));
    worst = fmax(worst, relative(f_hz / 100.0, stiff));
  }
  return worst;
}

static void partials_converge_to_the_stiff_string_with_order_2(void** state) {
  (void)state;
  static const double inharmonicities[] = {0.0, 1e-4, 1e-2, 1.0};
  double worst = 0.0;
  for (size_t i = 0; i < 4; ++i) {
    for (uint32_t length = 80; length <= 320; length *= 2) {
      const double coarse = partials_error(length - 1, inharmonicities[i]);
      const double fine = partials_error(2 * length - 1, inharmonicities[i]);
      worst = fmax(worst, fabs(log2(coarse / fine) - 2.0));
    }
  }
  assert_within("order of convergence, from 2", worst, 0.02);
  assert_within("error with 1024 masses", partials_error(1024, 1e-2), 1e-4);
}

static void nonsense_is_refused_and_nothing_is_written(void** state) {
  (void)state;
  const double nan = (double)NAN;
  const TuningTarget bad[] = {
      {0.0, {440.0, 1.0}, 0.5, 0.0, PARTIALS_LUMPED},
      {nan, {440.0, 1.0}, 0.5, 0.0, PARTIALS_LUMPED},
      {48000.0, {24000.0, 1.0}, 0.5, 0.0, PARTIALS_LUMPED},
      {48000.0, {0.0, 1.0}, 0.5, 0.0, PARTIALS_LUMPED},
      {48000.0, {nan, 1.0}, 0.5, 0.0, PARTIALS_LUMPED},
      {48000.0, {440.0, nan}, 0.5, 0.0, PARTIALS_LUMPED},
      {48000.0, {440.0, 0.0}, 0.5, 0.0, PARTIALS_LUMPED},
      {48000.0, {440.0, 1.0}, nan, 0.0, PARTIALS_LUMPED},
      {48000.0, {440.0, 1.0}, -0.01, 0.0, PARTIALS_LUMPED},
      {48000.0, {440.0, 1.0}, 1.01, 0.0, PARTIALS_LUMPED},
      {48000.0, {440.0, 1.0}, 0.5, -1e-9, PARTIALS_LUMPED},
      {48000.0, {440.0, 1.0}, 0.5, nan, PARTIALS_LUMPED},
      {48000.0, {440.0, 1.0}, 0.5, HUGE_VAL, PARTIALS_LUMPED},
      {48000.0, {440.0, 1.0}, 0.5, 0.0, (Partials)3},
      {48000.0, {440.0, 1.0}, 0.5, 0.0, (Partials)-1},
  };
  const size_t n_bad = sizeof(bad) / sizeof(bad[0]);
  const TuningTarget good = {48000.0, {440.0, 1.0}, 0.5, 0.0, PARTIALS_LUMPED};
  for (size_t i = 0; i <= n_bad; ++i) {
    const TuningTarget* const target = i < n_bad ? &bad[i] : &good;
    const uint32_t n_masses = i < n_bad ? 10 : 0;
    StringCoefs coefs = {1.0, 2.0, 3.0, 4.0, 5.0};
    assert_int_equal(tuning_solve(target, n_masses, &coefs), STATUS_BAD_ARGUMENT);
    assert_int_equal(tuning_fit(target, n_masses, &coefs), STATUS_BAD_ARGUMENT);
    assert_true(coefs.k1 == 1.0 && coefs.k2 == 2.0 && coefs.z0 == 3.0 && coefs.z1 == 4.0);
    assert_true(coefs.k3 == 5.0);
    assert_int_equal(tuning_max_masses(target, n_masses), 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(worked_example_has_the_papers_oscillators),
      cmocka_unit_test(modes_are_the_eigenvalues_of_the_dense_matrix),
      cmocka_unit_test(sines_are_the_shapes),
      cmocka_unit_test(fundamental_has_the_pitch_and_decay_asked_for),
      cmocka_unit_test(loss_is_a_share_of_the_fundamentals_damping),
      cmocka_unit_test(partials_converge_to_the_stiff_string_with_order_2),
      cmocka_unit_test(nonsense_is_refused_and_nothing_is_written),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
