/* Fixed point neither gains nor loses: a string dies when it should, and what its rounding adds is
 * as little as was said. */
#include "core/string/chain.h"

#include "core/base/complex_of.h"
#include "core/string/chain_fixed.h"
#include "core/string/chain_numbers.h"
#include "tests/support/chains.h"
#include "tests/support/oracle.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static _Alignas(CHAIN_ALIGNMENT) char memory[2][CHAINS_MOST_BYTES];

/* Mode k of a motion: x is its real part, and a step turns it by the pole. */
static double complex
mode_of(StringCoefs coefs, uint32_t n, uint32_t k, const double* x, const double* u) {
  const Pole pole = tuning_mode(coefs, n, k);
  const double angle = pole_angle(pole);
  const double r = pole_radius(pole);
  double x_k = 0.0;
  double u_k = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    const double shape = 2.0 / (n + 1.0) * sin(PI * k * (i + 1.0) / (n + 1.0));
    x_k += shape * x[i];
    u_k += shape * u[i];
  }
  const double next = x_k + (1.0 - pole.g) * u_k - pole.a * x_k;
  return complex_of(x_k, (r * cos(angle) * x_k - next) / (r * sin(angle)));
}

/* The size of the chain's fundamental, in true units. */
static double fundamental(const Chain* chain) {
  double x[CHAIN_MAX_MASSES];
  double u[CHAIN_MAX_MASSES];
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    x[i] = chain_numbers_position(chain, i);
    u[i] = chain_numbers_velocity(chain, i);
  }
  return cabs(mode_of(chain->now, chain->n_masses, 1, x, u));
}

/* A triangle let go: all partials begin in step, and meet again in every period. */
static void pull_aside(Chain* chain, double corner) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const double place = (i + 1.0) / (chain->n_masses + 1.0);
    chain_place(chain, i, (float)(0.25 * fmin(place / corner, (1.0 - place) / (1.0 - corner))),
                0.0f);
  }
}

/* In fixed point, or false where the string is better in doubles. */
static bool
start(Chain* chain, uint32_t kernel, const TuningTarget* target, uint32_t most, double corner) {
  const uint32_t n = tuning_max_masses(target, most);
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(target, n, &coefs), STATUS_OK);
  chain_init(chain, chain_kernel(kernel), memory[0], n);
  chain_set(chain, coefs);
  pull_aside(chain, corner);
  chain_settle(chain);
  return chain->numbers == CHAIN_FIXED;
}

/* How much too soon or too late the fundamental dies, over its τ. */
static double error_of_tau(Chain* chain, uint32_t n_frames) {
  const double before = fundamental(chain);
  const double r = pole_radius(tuning_mode(chain->now, chain->n_masses, 1));
  chains_run(chain, n_frames);
  return fabs(log(fundamental(chain) / before) / (n_frames * log(r)) - 1.0);
}

typedef struct {
  double rate_hz;
  double f0_hz;
  double tau_s;
  double loss;
  uint32_t most;
  Partials partials;
} Case;

static TuningTarget target_of(const Case* a_case) {
  return (TuningTarget){.rate_hz = a_case->rate_hz,
                        .tone = {a_case->f0_hz, a_case->tau_s},
                        .loss = a_case->loss,
                        .partials = a_case->partials};
}

/*
  The first are at their limit, with k1 all but 1, where everything on the string comes back in
  every period: rounded without dither it dies up to a part in twenty too soon or too late.
*/
static void strings_die_when_they_should(void** state) {
  (void)state;
  static const Case cases[] = {
      {48000.0, 110.0, 10.0, 0.0, 1024, PARTIALS_LUMPED},
      {48000.0, 220.0, 20.0, 0.0, 1024, PARTIALS_LUMPED},
      {48000.0, 240.0, 20.0, 0.0, 1024, PARTIALS_LUMPED},
      {48000.0, 440.0, 5.0, 0.0, 1024, PARTIALS_LUMPED},
      {48000.0, 436.4, 20.0, 1e-4, 1024, PARTIALS_LUMPED},
      {96000.0, 440.0, 10.0, 0.01, 1024, PARTIALS_LUMPED},
      {48000.0, 55.0, 50.0, 0.0, 80, PARTIALS_LUMPED},
      {48000.0, 55.0, 20.0, 0.5, 80, PARTIALS_TRUEST},
      {48000.0, 110.0, 20.0, 1.0, 40, PARTIALS_TRUE},
      {44100.0, 82.4, 8.0, 0.01, 40, PARTIALS_TRUEST},
      {192000.0, 110.0, 50.0, 0.1, 160, PARTIALS_LUMPED},
      {192000.0, 440.0, 10.0, 0.01, 100, PARTIALS_TRUE},
      {192000.0, 880.0, 4.0, 0.01, 100, PARTIALS_LUMPED},
      {8000.0, 110.0, 20.0, 0.0, 30, PARTIALS_LUMPED},
  };
  double worst = 0.0;
  for (size_t c = 0; c < sizeof(cases) / sizeof(cases[0]); ++c) {
    const TuningTarget target = target_of(&cases[c]);
    Chain chain;
    if (!start(&chain, c % 2 && chain_kernel(1), &target, cases[c].most, c % 3 ? 0.2 : 0.5)) {
      print_message("  %g Hz at %g Hz, tau %g s, %u masses: not in fixed point\n", cases[c].f0_hz,
                    cases[c].rate_hz, cases[c].tau_s, chain.n_masses);
      continue;
    }
    const double steps = target.rate_hz * target.tone.tau_s;
    const double error = error_of_tau(&chain, (uint32_t)fmin(fmax(steps, 1e5), 5e5));
    print_message("  %g Hz at %g Hz, tau %g s, %u masses: %.2g\n", cases[c].f0_hz, cases[c].rate_hz,
                  cases[c].tau_s, chain.n_masses, error);
    worst = fmax(worst, error);
  }
  assert_within("τ, relative", worst, 1e-4);
}

/* The same numbers in doubles, with the very coefficients of the loop. */
static void copy_to_doubles(const Chain* whole, Chain* exact) {
  static double x[CHAIN_MAX_MASSES];
  static double u[CHAIN_MAX_MASSES];
  chains_read(whole, x, u);
  chain_init(exact, whole->kernel, memory[1], whole->n_masses);
  assert_true(chain_hold(exact, CHAIN_DOUBLE));
  chain_set(exact, chains_seen(whole));
  for (uint32_t i = 0; i < whole->n_masses; ++i) {
    chain_numbers_place(exact, i, x[i], u[i]);
  }
}

/* Of the difference to doubles after one τ, over what was said of the fundamental: the square of
 * its own, and of a mass in the mean over them all and over that of as many alike. */
typedef struct {
  double first;
  double all;
} Noise;

static Noise noise_of(const TuningTarget* target, uint32_t most, uint32_t chance) {
  const uint32_t n_frames = (uint32_t)(target->rate_hz * target->tone.tau_s);
  double x[2][CHAIN_MAX_MASSES];
  double u[2][CHAIN_MAX_MASSES];
  Noise noise = {0};
  Chain whole;
  Chain exact;
  ChainFixed design;
  assert_true(start(&whole, 0, target, most, 0.2));
  const uint32_t n = whole.n_masses;
  assert_true(chain_fixed_design(whole.now, n, chain_numbers_sum(&whole), &design));
  const double a1 = tuning_mode(whole.now, n, 1).a;
  const double said = design.noise * chain_amplitude(&whole, a1);
  copy_to_doubles(&whole, &exact);
  whole.chance = chance;
  chains_run(&whole, n_frames);
  chains_run(&exact, n_frames);
  chains_read(&whole, x[0], u[0]);
  chains_read(&exact, x[1], u[1]);
  for (uint32_t i = 0; i < n; ++i) {
    x[0][i] -= x[1][i];
    u[0][i] -= u[1][i];
    noise.all += x[0][i] * x[0][i] * (whole.gain / said) * (whole.gain / said) * 2.0 / n;
  }
  noise.all /= 0.5 * n;
  noise.first = whole.gain / said * cabs(mode_of(whole.fixed, n, 1, x[0], u[0]));
  noise.first *= noise.first;
  return noise;
}

/*
  From nothing to one τ a mode's noise comes to √((1 − e⁻²)/2) = 0.66 of what it would be if nothing
  of it died, and the estimate is on the safe side.  Other modes have as much each; but at the
  limit, the first case, the uppermost are near their resonance at Nyquist and have more.
*/
static void noise_is_what_was_said(void** state) {
  (void)state;
  enum { TRIALS = 12 };
  static const Case cases[] = {
      {48000.0, 220.0, 0.5, 0.0, 1024, PARTIALS_LUMPED},
      {48000.0, 110.0, 0.5, 0.0, 80, PARTIALS_LUMPED},
      {48000.0, 220.0, 0.5, 0.001, 40, PARTIALS_LUMPED},
      {96000.0, 220.0, 1.0, 0.0, 40, PARTIALS_TRUEST},
      {48000.0, 880.0, 0.5, 0.0, 8, PARTIALS_LUMPED},
  };
  for (size_t c = 0; c < sizeof(cases) / sizeof(cases[0]); ++c) {
    const TuningTarget target = target_of(&cases[c]);
    double first = 0.0;
    double all = 0.0;
    for (uint32_t trial = 0; trial < TRIALS; ++trial) {
      const Noise noise = noise_of(&target, cases[c].most, trial * 2654435769u);
      first += noise.first / TRIALS;
      all += noise.all / TRIALS;
    }
    assert_within("the fundamental's noise, over what was said", sqrt(first), 0.8);
    assert_within("what was said, over the fundamental's noise", 1.0 / sqrt(first), 6.0);
    assert_within("the noise of all over that of N fundamentals", sqrt(all), c == 0 ? 3.5 : 0.8);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strings_die_when_they_should),
      cmocka_unit_test(noise_is_what_was_said),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
