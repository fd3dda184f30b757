#include "tools/bench/bench_player.h"
#include "tools/bench/bench_step.h"
#include "tools/bench/bench_survey.h"
#include "tools/bench/bench_way.h"

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

static double pitch_error(BenchWay way, TuningTarget string, uint32_t n_masses) {
  return fabs(bench_way_partial_cents(way, string, n_masses, 1));
}

/* The paper's string of five masses sounds at 444.026 Hz, if its coefficients are taken as they
 * are; without damping ω_d h = 2 asin(ωh/2). */
static void uncorrected_is_as_sharp_as_the_paper_says(void** state) {
  TuningTarget string = {.tone = {440.0, 1.0}, .loss = 1.0, .rate_hz = 6000.0};
  const BenchWay way = chain(PARTIALS_LUMPED, CHAIN_DOUBLE, false);
  const double turn = 2.0 * PI * string.tone.f0_hz / string.rate_hz;
  (void)state;
  /* Half of a unit of its last digit. */
  assert_within("444.026 Hz [cents]",
                fabs(pitch_error(way, string, 5) - 1200.0 * log2(444.026 / 440.0)), 2e-3);
  assert_within("corrected [cents]",
                pitch_error(chain(PARTIALS_LUMPED, CHAIN_DOUBLE, true), string, 5), 1e-9);
  string.tone.tau_s = HUGE_VAL;
  const double sharp_cents = 1200.0 * log2(2.0 * asin(0.5 * turn) / turn);
  assert_within("2 asin(ωh/2) [cents]", fabs(pitch_error(way, string, 5) - sharp_cents), 1e-9);
}

/* Of k1 = 0.034460524655348497 and the nearest float, 0.034460525959730148, half the ratio's
 * logarithm is heard: the damping next to nothing. */
static void floats_are_out_by_their_rounding(void** state) {
  const TuningTarget string = {.tone = {55.0, 2.0}, .loss = 0.01, .rate_hz = 48000.0};
  const double cents = 600.0 * log2(0.034460525959730148 / 0.034460524655348497);
  (void)state;
  assert_within("floats [cents]",
                fabs(pitch_error(chain(PARTIALS_LUMPED, CHAIN_FLOAT, true), string, 80) - cents),
                1e-8);
  assert_within("doubles [cents]",
                pitch_error(chain(PARTIALS_LUMPED, CHAIN_DOUBLE, true), string, 80), 1e-9);
}

/* |z|² = 1 − g + a for forward Euler, and 1/(1 + g + a) for backward. */
static void eulers_grow_and_starve_as_theory_says(void** state) {
  const TuningTarget string = {.tone = {110.0, 2.0}, .loss = 0.01, .rate_hz = 48000.0};
  const double g = 2.0 / (string.tone.tau_s * string.rate_hz);
  const double omega = hypot(2.0 * PI * string.tone.f0_hz, 1.0 / string.tone.tau_s);
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
  const TuningTarget string = {
      .tone = {440.0, 2.0}, .inharmonicity = 1e-4, .loss = 0.01, .rate_hz = 22050.0};
  const BenchWay way = chain(PARTIALS_TRUEST, CHAIN_DOUBLE, true);
  double complex poles[2 * N];
  StringCoefs coefs = {0};
  double worst = 0.0;
  (void)state;
  assert_true(bench_way_coefs(way, string, N, &coefs));
  oracle_poles(coefs, N, poles);
  for (uint32_t k = 1; k <= N; ++k) {
    double nearest = HUGE_VAL;
    for (int i = 0; i < 2 * N; ++i) {
      const double f_hz = carg(poles[i]) * string.rate_hz / (2.0 * PI);
      const double cents = 1200.0 * log2(fabs(f_hz) / bench_way_ideal_hz(string, k));
      nearest = fmin(nearest, fabs(cents - bench_way_partial_cents(way, string, N, k)));
    }
    worst = fmax(worst, nearest);
  }
  assert_within("cents", worst, 1e-7);
}

enum { BLOCK = 256 };

/* Between two states, where the numbers are coarse [s]. */
static const double LONG_S = 0.2;

typedef struct {
  double x, u;
} State;

static void run(BenchPlayer* player, uint32_t n_frames) {
  float out[BLOCK];
  for (uint32_t left = n_frames; left > 0;) {
    const uint32_t n = left < BLOCK ? left : BLOCK;
    bench_player_run(player, n, out);
    left -= n;
  }
}

/* The steps from a state to the next, so that the mode turns by about a quarter more than whole
 * turns: states of which one is a multiple of another would tell nothing. */
static uint32_t stride_of(double turn, double rate_hz, double length_s) {
  const double turns = floor(length_s * rate_hz * turn / (2.0 * PI));
  const uint32_t first = (uint32_t)fmax(1.0, floor((turns + 0.25) * 2.0 * PI / turn));
  uint32_t best = first;
  for (uint32_t m = first; m < first + 4; ++m) {
    best = fabs(sin(turn * m)) > fabs(sin(turn * best)) ? m : best;
  }
  return best;
}

static bool tone_of(const State s[3], uint32_t m, double turn, double rate_hz, Tone* tone) {
  const double volume = s[1].x * s[0].u - s[1].u * s[0].x;
  const double p = (s[2].x * s[0].u - s[2].u * s[0].x) / volume;
  const double q = (s[2].x * s[1].u - s[2].u * s[1].x) / volume;
  const double radius = sqrt(q);
  const double angle = acos(0.5 * p / radius);
  if (!isfinite(angle)) {
    return false;
  }
  /* Of all angles with this cosine, the one next to where it is about to be. */
  const double near = turn * m;
  const double up = angle + 2.0 * PI * nearbyint((near - angle) / (2.0 * PI));
  const double down = -angle + 2.0 * PI * nearbyint((near + angle) / (2.0 * PI));
  const double turned = fabs(up - near) < fabs(down - near) ? up : down;
  *tone = (Tone){.f0_hz = turned / m * rate_hz / (2.0 * PI),
                 .tau_s = -(double)m / (rate_hz * log(radius))};
  return true;
}

/* Three states of the mode, m steps apart, are tied by s[2m] = p s[m] − q s[0], whatever the
 * scheme: p and q are the sum and the product of the m-th powers of its two poles. */
static bool
measure_tone(BenchWay way, TuningTarget string, uint32_t n_masses, uint32_t k, Tone* tone) {
  State states[3];
  BenchPlayer* const player = bench_player_new(way, string, n_masses);
  if (!player) {
    return false;
  }
  const double turn = 2.0 * PI * tone->f0_hz / string.rate_hz;
  const uint32_t stride = stride_of(turn, string.rate_hz, way.kind == BENCH_NETWORK ? 0.0 : LONG_S);
  for (int i = 0; i < 3; ++i) {
    run(player, i > 0 ? stride : 0);
    bench_player_mode(player, k, &states[i].x, &states[i].u);
  }
  bench_player_free(player);
  return tone_of(states, stride, turn, string.rate_hz, tone);
}

/* The farthest that any was off. */
typedef struct {
  unsigned n;
  double cents;
  double decay_percent;
} Off;

/* Play a string, and measure what there is of some partials. */
static void check_string(Off* off, BenchWay way, TuningTarget string, uint32_t n_masses) {
  static const uint32_t partials[] = {1, 2, 5, 10, 20};
  for (unsigned i = 0; i < sizeof(partials) / sizeof(partials[0]); ++i) {
    Tone wanted = {0};
    if (partials[i] <= n_masses && bench_way_is_stable(way, string, n_masses) &&
        bench_way_tone(way, string, n_masses, partials[i], &wanted)) {
      Tone heard = wanted;
      assert_true(measure_tone(way, string, n_masses, partials[i], &heard));
      off->cents = fmax(off->cents, fabs(1200.0 * log2(heard.f0_hz / wanted.f0_hz)));
      off->decay_percent = fmax(off->decay_percent, 100.0 * fabs(heard.tau_s / wanted.tau_s - 1.0));
      ++off->n;
    }
  }
}

static void what_is_played_is_what_is_computed(void** state) {
  const TuningTarget strings[] = {
      {.tone = {55.0, 2.0}, .loss = 0.01, .rate_hz = 48000.0},
      {.tone = {1760.0, 2.0}, .inharmonicity = 1e-4, .loss = 0.01, .rate_hz = 44100.0}};
  Off off[2] = {{0}, {0}};
  (void)state;
  for (unsigned w = 0; w < BENCH_N_WAYS; ++w) {
    const BenchWay way = bench_way_at(w);
    Off* const of_numbers = &off[way.numbers == CHAIN_DOUBLE ? 0 : 1];
    check_string(of_numbers, way, strings[0], 24);
    check_string(of_numbers, way, strings[1], 5);
  }
  assert_true(off[0].n > 50 && off[1].n > 40);
  /* Chains are read as floats, 6e-8, over a fifth of a second. */
  assert_within("doubles [cents]", off[0].cents, 2e-5);
  assert_within("doubles [% of τ]", off[0].decay_percent, 2e-3);
  /* The noise of a pluck of fixed point or floats, −90 dB or less, over 70 radians or more. */
  assert_within("floats [cents]", off[1].cents, 5e-3);
  assert_within("floats [% of τ]", off[1].decay_percent, 0.3);
}

static void noise_is_that_of_the_numbers(void** state) {
  const TuningTarget string = {.tone = {110.0, 2.0}, .loss = 0.01, .rate_hz = 48000.0};
  (void)state;
  for (int numbers = 0; numbers < N_CHAIN_NUMBERS; ++numbers) {
    const BenchWay way = chain(PARTIALS_TRUE, (ChainNumbers)numbers, true);
    const double noise_db = bench_player_noise_db(way, string, 40);
    assert_within("noise [dB]", noise_db, numbers == CHAIN_DOUBLE ? -200.0 : -85.0);
    assert_true(numbers == CHAIN_DOUBLE || noise_db > -140.0);
  }
}

/* Missing ones count 1200 cents, and those above Nyquist nothing. */
static void missing_partials_are_counted(void** state) {
  const TuningTarget string = {.tone = {1760.0, 2.0}, .loss = 0.01, .rate_hz = 48000.0};
  const BenchWay bank = bench_way_at(BENCH_N_WAYS - 1);
  (void)state;
  assert_int_equal(bench_way_max_masses(bank, string), 13);
  assert_within("none", bench_way_partials_cents(bank, string, 13), 1e-9);
  assert_within("one of 13", fabs(bench_way_partials_cents(bank, string, 12) - 1200.0 / sqrt(13.0)),
                1e-6);
  assert_true(isnan(bench_way_partial_cents(bank, string, 12, 13)));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(uncorrected_is_as_sharp_as_the_paper_says),
      cmocka_unit_test(floats_are_out_by_their_rounding),
      cmocka_unit_test(eulers_grow_and_starve_as_theory_says),
      cmocka_unit_test(solved_masses_sound_as_they_were_asked_to),
      cmocka_unit_test(chain_has_the_poles_of_its_step_matrix),
      cmocka_unit_test(what_is_played_is_what_is_computed),
      cmocka_unit_test(noise_is_that_of_the_numbers),
      cmocka_unit_test(missing_partials_are_counted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
