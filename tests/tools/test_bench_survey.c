#include "tools/bench/bench_step.h"
#include "tools/bench/bench_survey.h"
#include "tools/bench/bench_way.h"
#include "tools/report/trade_check.h"
#include "tools/report/trade_measure.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static BenchWay chain(Partials partials, ChainNumbers numbers, bool is_corrected) {
  return (BenchWay){.kind = BENCH_CHAIN,
                    .scheme = NETWORK_SYMPLECTIC,
                    .partials = partials,
                    .numbers = numbers,
                    .is_corrected = is_corrected};
}

static BenchWay network(NetworkScheme scheme, bool is_corrected) {
  return (BenchWay){.kind = BENCH_NETWORK,
                    .scheme = scheme,
                    .numbers = CHAIN_DOUBLE,
                    .is_corrected = is_corrected};
}

/* Without damping. */
static void partials_are_those_of_the_table(void** state) {
  static const double cents[3][3] = {
      {-2.5, -10.4, -42.0}, {-0.01, -0.21, -3.2}, {-0.0001, -0.005, -0.29}};
  static const double rounding[3][3] = {
      {0.05, 0.05, 0.5}, {0.005, 0.005, 0.05}, {5e-5, 5e-4, 5e-3}};
  static const uint32_t k[] = {5, 10, 20};
  const TradeString string = {.f0_hz = 55.0, .tau_s = HUGE_VAL, .rate_hz = 48000.0};
  (void)state;
  double worst = 0.0;
  for (int i = 0; i < 9; ++i) {
    const BenchWay method = chain((Partials)(i / 3), CHAIN_DOUBLE, true);
    const double off = bench_way_partial_cents(method, string, 80, k[i % 3]) - cents[i / 3][i % 3];
    worst = fmax(worst, fabs(off) / rounding[i / 3][i % 3]);
  }
  assert_within("in halves of the last digit", worst, 1.0);
}

/* The paper's string of five masses sounds at 444.026 Hz, if its coefficients are taken as they
 * are; without damping ω_d h = 2 asin(ωh/2). */
static void uncorrected_is_as_sharp_as_the_paper_says(void** state) {
  TradeString string = {.f0_hz = 440.0, .tau_s = 1.0, .loss = 1.0, .rate_hz = 6000.0};
  const BenchWay method = chain(PARTIALS_LUMPED, CHAIN_DOUBLE, false);
  const double turn = 2.0 * PI * string.f0_hz / string.rate_hz;
  (void)state;
  /* Half of a unit of its last digit. */
  assert_within("444.026 Hz [cents]",
                fabs(bench_way_pitch_error(method, string, 5) - 1200.0 * log2(444.026 / 440.0)),
                2e-3);
  assert_within("corrected [cents]",
                bench_way_pitch_error(chain(PARTIALS_LUMPED, CHAIN_DOUBLE, true), string, 5), 1e-9);
  string.tau_s = HUGE_VAL;
  const double sharp_cents = 1200.0 * log2(2.0 * asin(0.5 * turn) / turn);
  assert_within("2 asin(ωh/2) [cents]",
                fabs(bench_way_pitch_error(method, string, 5) - sharp_cents), 1e-9);
}

/* |z|² = 1 − g + a for forward Euler, and 1/(1 + g + a) for backward. */
static void eulers_grow_and_starve_as_theory_says(void** state) {
  const TradeString string = {.f0_hz = 110.0, .tau_s = 2.0, .loss = 0.01, .rate_hz = 48000.0};
  const double g = 2.0 / (string.tau_s * string.rate_hz);
  const double omega = hypot(2.0 * PI * string.f0_hz, 1.0 / string.tau_s);
  const double a = pow(omega / string.rate_hz, 2.0);
  Tone forward = {0};
  Tone backward = {0};
  (void)state;
  assert_true(bench_way_tone(network(NETWORK_FORWARD, false), string, 20, 1, &forward));
  assert_true(bench_way_tone(network(NETWORK_BACKWARD, false), string, 20, 1, &backward));
  assert_within("forward", fabs(forward.tau_s * string.rate_hz * log1p(a - g) / -2.0 - 1.0), 1e-9);
  assert_within("backward", fabs(backward.tau_s * string.rate_hz * log1p(a + g) / 2.0 - 1.0), 1e-9);
  assert_true(forward.tau_s < 0.0);
  assert_false(bench_way_is_stable(network(NETWORK_FORWARD, false), string, 20));
  assert_false(bench_way_is_stable(network(NETWORK_FORWARD, true), string, 20));
  assert_true(bench_way_is_stable(network(NETWORK_BACKWARD, false), string, 20));
  assert_false(bench_way_tone(network(NETWORK_BACKWARD, true), string, 20, 1, &backward));
}

static void solved_masses_sound_as_they_were_asked_to(void** state) {
  static const NetworkScheme schemes[] = {NETWORK_FORWARD, NETWORK_SYMPLECTIC, NETWORK_LEAPFROG,
                                          NETWORK_FOURTH};
  Random random = random_start();
  double worst = 0.0;
  (void)state;
  for (int n = 0; n < 2000; ++n) {
    const NetworkScheme scheme = schemes[n % 4];
    const Tone tone = {random_log_between(&random, 20.0, 5000.0),
                       random_log_between(&random, 0.1, 10.0)};
    Pole mass = {0};
    assert_true(bench_step_solve(scheme, 48000.0, tone, &mass));
    const Tone heard = bench_step_tone(scheme, 48000.0, mass);
    worst = fmax(worst, fabs(heard.f0_hz / tone.f0_hz - 1.0));
  }
  /* A rounding of the trace weighs as 1/θ², 1.5e5 at 20 Hz. */
  assert_within("pitch, relative", worst, 1e-9);
}

/* Eigenvalues by LAPACK of the whole string's step, against a mode at a time. */
static void chain_has_the_poles_of_its_step_matrix(void** state) {
  enum { N = 12 };
  const TradeString string = {
      .f0_hz = 440.0, .tau_s = 2.0, .inharmonicity = 1e-4, .loss = 0.01, .rate_hz = 22050.0};
  const BenchWay method = chain(PARTIALS_TRUEST, CHAIN_DOUBLE, true);
  double complex poles[2 * N];
  StringCoefs coefs = {0};
  double worst = 0.0;
  (void)state;
  assert_true(bench_way_coefs(method, string, N, &coefs));
  oracle_poles(coefs, N, poles);
  for (uint32_t k = 1; k <= N; ++k) {
    double nearest = HUGE_VAL;
    for (int i = 0; i < 2 * N; ++i) {
      const double f_hz = carg(poles[i]) * string.rate_hz / (2.0 * PI);
      const double cents = 1200.0 * log2(fabs(f_hz) / bench_way_ideal_hz(string, k));
      nearest = fmin(nearest, fabs(cents - bench_way_partial_cents(method, string, N, k)));
    }
    worst = fmax(worst, nearest);
  }
  assert_within("cents", worst, 1e-7);
}

static void what_is_played_is_what_is_computed(void** state) {
  const TradeString strings[] = {
      {.f0_hz = 55.0, .tau_s = 2.0, .loss = 0.01, .rate_hz = 48000.0},
      {.f0_hz = 1760.0, .tau_s = 2.0, .inharmonicity = 1e-4, .loss = 0.01, .rate_hz = 44100.0}};
  TradeCheck check = {{0}, {0}};
  (void)state;
  for (unsigned m = 0; m < BENCH_N_WAYS; ++m) {
    trade_check_string(&check, bench_way_at(m), strings[0], 24);
    trade_check_string(&check, bench_way_at(m), strings[1], 5);
  }
  assert_true(check.in_doubles.n > 50 && check.in_floats.n > 50);
  /* Chains are read as floats, 6e-8, over a fifth of a second. */
  assert_within("doubles [cents]", check.in_doubles.cents, 2e-5);
  assert_within("doubles [% of τ]", check.in_doubles.decay_percent, 2e-3);
  /* The noise of a pluck of whole numbers or floats, −90 dB or less, over 70 radians or more. */
  assert_within("floats [cents]", check.in_floats.cents, 5e-3);
  assert_within("floats [% of τ]", check.in_floats.decay_percent, 0.3);
}

static void noise_is_that_of_the_numbers(void** state) {
  const TradeString string = {.f0_hz = 110.0, .tau_s = 2.0, .loss = 0.01, .rate_hz = 48000.0};
  (void)state;
  for (int numbers = 0; numbers < N_CHAIN_NUMBERS; ++numbers) {
    const BenchWay method = chain(PARTIALS_TRUE, (ChainNumbers)numbers, true);
    const double noise_db = trade_measure_noise(method, string, 40);
    assert_within("noise [dB]", noise_db, numbers == CHAIN_DOUBLE ? -200.0 : -85.0);
    assert_true(numbers == CHAIN_DOUBLE || noise_db > -140.0);
  }
}

/* Missing ones count 1200 cents, and those above Nyquist nothing. */
static void missing_partials_are_counted(void** state) {
  const TradeString string = {.f0_hz = 1760.0, .tau_s = 2.0, .loss = 0.01, .rate_hz = 48000.0};
  const BenchWay bank = bench_way_at(BENCH_N_WAYS - 1);
  (void)state;
  assert_int_equal(bench_way_max_masses(bank, string), 13);
  assert_within("none", bench_way_partials_error(bank, string, 13), 1e-9);
  assert_within("one of 13", fabs(bench_way_partials_error(bank, string, 12) - 1200.0 / sqrt(13.0)),
                1e-6);
  assert_true(isnan(bench_way_partial_cents(bank, string, 12, 13)));
  assert_int_equal(bench_way_true_up_to(bank, string, 12, 5.0), 12);
}

static bool is_worse(const TradePoint* a, const TradePoint* b, TradeError error) {
  const double step = error == TRADE_NOISE ? 0.5 : 0.0;
  const double grain = error == TRADE_NOISE ? 1.0 : TRADE_GRAIN;
  const double level_a = trade_level(a, error);
  const double level_b = trade_level(b, error);
  return (a->share > TRADE_GRAIN * b->share && level_a >= level_b) ||
         (a->share >= b->share && level_a > grain * level_b + step);
}

/* Points with any errors, many of one price: of those on the frontier none is beaten, of the others
 * each. */
static void nothing_beats_a_frontier(void** state) {
  enum { N = 300 };
  static TradePoint points[N];
  Random random = random_start();
  unsigned n_front = 0;
  (void)state;
  for (size_t i = 0; i < N; ++i) {
    points[i] = (TradePoint){.method = bench_way_at(random_below(&random, BENCH_N_WAYS)),
                             .string = trade_string((unsigned)i / (N / 3), 0, 0),
                             .share = ldexp(1e-4, (int)random_below(&random, 12)),
                             .is_stable = random_below(&random, 10) > 0};
    points[i].error[TRADE_PITCH] = random_log_between(&random, 1e-3, 1e3);
    points[i].error[TRADE_DECAY] = i % 7 ? random_log_between(&random, 1e-3, 1e3) : (double)NAN;
    points[i].error[TRADE_PARTIALS] = 1.0;
    points[i].error[TRADE_NOISE] = random_between(&random, -130.0, -60.0);
  }
  trade_find_fronts(points, N);
  for (size_t i = 0; i < N * TRADE_N_ERRORS * TRADE_N_COMPANIES; ++i) {
    const TradePoint* const point = &points[i % N];
    const TradeError error = (TradeError)(i / N % TRADE_N_ERRORS);
    const int company = (int)(i / N / TRADE_N_ERRORS);
    const bool is_in = company == TRADE_AMONG_ALL || point->method.kind != BENCH_BANK;
    const bool is_fit = is_in && point->is_stable && !isnan(point->error[error]);
    bool has_better = false;
    for (size_t j = 0; j < N; ++j) {
      const bool is_rival = trade_is_same(points[j].string, point->string) && points[j].is_stable &&
                            (company == TRADE_AMONG_ALL || points[j].method.kind != BENCH_BANK);
      const bool is_front = points[j].is_front[company][error];
      assert_false(is_rival && point->is_front[company][error] && !isnan(points[j].error[error]) &&
                   is_worse(point, &points[j], error));
      /* By steps: a grain of each may be lost. */
      has_better =
          has_better ||
          (is_rival && is_front && j != i % N && points[j].share <= TRADE_GRAIN * point->share &&
           trade_level(&points[j], error) <= (error == TRADE_NOISE
                                                  ? 0.5 + trade_level(point, error)
                                                  : TRADE_GRAIN * trade_level(point, error)));
    }
    assert_true(!is_fit || point->is_front[company][error] || has_better);
    assert_true(is_fit || !point->is_front[company][error]);
    n_front += point->is_front[company][error];
  }
  assert_true(n_front > 30);
}

static void run_time_is_some(void** state) {
  const TradeString string = {.f0_hz = 440.0, .tau_s = 2.0, .loss = 0.01, .rate_hz = 48000.0};
  (void)state;
  for (unsigned m = 0; m < BENCH_N_WAYS; ++m) {
    TradeClock clock = {bench_way_at(m), string, 10, 0, HUGE_VAL};
    Tone tone = {0};
    const bool is_there = bench_way_tone(clock.method, string, 10, 1, &tone);
    trade_measure_time(&clock);
    trade_measure_time(&clock);
    assert_true(is_there ? clock.ns > 0.0 && clock.ns < HUGE_VAL : isnan(clock.ns));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(partials_are_those_of_the_table),
      cmocka_unit_test(uncorrected_is_as_sharp_as_the_paper_says),
      cmocka_unit_test(eulers_grow_and_starve_as_theory_says),
      cmocka_unit_test(solved_masses_sound_as_they_were_asked_to),
      cmocka_unit_test(chain_has_the_poles_of_its_step_matrix),
      cmocka_unit_test(what_is_played_is_what_is_computed),
      cmocka_unit_test(noise_is_that_of_the_numbers),
      cmocka_unit_test(missing_partials_are_counted),
      cmocka_unit_test(nothing_beats_a_frontier),
      cmocka_unit_test(run_time_is_some),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
