#include "core/string/chain.h"

#include "tests/support/chains.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { BLOCK = 4096 };

/* The least that single precision must keep of a string that rings for seconds [dB]. */
static const double LEAST_SNR_DB = 98.0;

/* Doubles are read as floats: 24 bits, of which a quiet sample among loud ones has all. */
static const double LEAST_DOUBLE_SNR_DB = 145.0;

/* τ up to which a string stays in floats, where g = 1 − exp(−2/n) is 1e-4 [steps]. */
static const double LONGEST_IN_FLOAT = 20000.0;

static _Alignas(CHAIN_ALIGNMENT) char memory[CHAINS_MOST_BYTES];

/* A mode that rings by itself: Re(amplitude), and what a step makes of it. */
typedef struct {
  double complex amplitude;
  double complex step;
} Ringing;

/* Mode k of what the chain is doing now, as read at `place`; the sine transform of its state. */
static Ringing mode_of(const Chain* chain, StringCoefs coefs, uint32_t k, double place) {
  const uint32_t n = chain->n_masses;
  const Pole pole = tuning_mode(coefs, n, k);
  double x = 0.0;
  double u = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    const double shape = 2.0 / (n + 1.0) * sin(PI * k * (i + 1.0) / (n + 1.0));
    x += shape * (double)chain_position(chain, i);
    u += shape * (double)chain_velocity(chain, i);
  }
  const double r = pole_radius(pole);
  const double angle = pole_angle(pole);
  const double complex z = complex_of(r * cos(angle), r * sin(angle));
  const double next = x + (1.0 - pole.g) * u - pole.a * x;
  const double complex c = complex_of(x, (creal(z) * x - next) / cimag(z));
  assert_true(pole_is_complex(pole));
  return (Ringing){.amplitude = c * sin(PI * k * place), .step = z};
}

/* A triangle pulled at a fifth and let go, without a corner that rounding makes any sharper. */
static void pull_aside(Chain* chain) {
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const double place = (i + 1.0) / (chain->n_masses + 1.0);
    chain_place(chain, i, (float)(0.25 * fmin(place / 0.2, (1.0 - place) / 0.8)), 0.0f);
  }
}

/* Signal to noise [dB] of `seconds` of the chain against the sum of its modes, read at a mass. */
static double snr_db(Chain* chain, StringCoefs coefs, double seconds, double rate_hz) {
  static float out[BLOCK];
  float* const outs[] = {out};
  const uint32_t n = chain->n_masses;
  const uint32_t mass = n / 3;
  const ChainTap tap = {{mass, 0}, {1.0f, 0.0f}, false};
  Ringing* const modes = calloc(n, sizeof(Ringing));
  double signal = 0.0;
  double noise = 0.0;
  assert_non_null(modes);
  for (uint32_t k = 1; k <= n; ++k) {
    modes[k - 1] = mode_of(chain, coefs, k, (mass + 1.0) / (n + 1.0));
  }
  const uint32_t n_blocks = (uint32_t)(seconds * rate_hz / BLOCK);
  for (uint32_t block = 0; block < n_blocks; ++block) {
    for (uint32_t m = 0; m < BLOCK; ++m) {
      out[m] = 0.0f;
    }
    chain_run(chain, BLOCK, &tap, 1, outs);
    for (uint32_t m = 0; m < BLOCK; ++m) {
      double sum = 0.0;
      for (uint32_t k = 0; k < n; ++k) {
        const double complex c = modes[k].amplitude;
        const double complex z = modes[k].step;
        /* By hand: the complex product of C minds infinities, and takes ten times as long. */
        modes[k].amplitude = complex_of(creal(c) * creal(z) - cimag(c) * cimag(z),
                                        creal(c) * cimag(z) + cimag(c) * creal(z));
        sum += creal(modes[k].amplitude);
      }
      signal += sum * sum;
      noise += ((double)out[m] - sum) * ((double)out[m] - sum);
    }
  }
  free(modes);
  return 10.0 * log10(signal / noise);
}

typedef struct {
  const char* what;
  double rate_hz;
  double f0_hz;
  double inharmonicity;
  uint32_t most_masses;
  Partials partials;
} Case;

/* Signal to noise of a case for as long as it rings, up to 4 s, its τ being `n_steps` long [dB]. */
static double case_snr_db(const ChainKernel* kernel, const Case* a_case, double n_steps) {
  const TuningTarget target = {
      .rate_hz = a_case->rate_hz,
      .tone = {a_case->f0_hz, n_steps / a_case->rate_hz},
      .loss = 0.01,
      .inharmonicity = a_case->inharmonicity,
      .partials = a_case->partials,
  };
  const uint32_t n_masses = tuning_max_masses(&target, a_case->most_masses);
  StringCoefs coefs = {0};
  Chain chain;
  assert_int_equal(tuning_solve(&target, n_masses, &coefs), STATUS_OK);
  const bool is_float = n_steps < LONGEST_IN_FLOAT;
  chain_init(&chain, kernel, memory, n_masses);
  assert_true(chain_hold(&chain, is_float ? CHAIN_FLOAT : CHAIN_DOUBLE));
  chain_set(&chain, coefs);
  pull_aside(&chain);
  return snr_db(&chain, is_float ? chains_rounded(coefs) : coefs,
                fmin(4.0, 8.0 * target.tone.tau_s), target.rate_hz);
}

/*
  What is measured: the string of the very coefficients that the loop has, against the exact sum of
  its modes in double; so it is the arithmetic of the loop alone.  What their rounding to float does
  to the pitch is the next claim's.
*/
static void chain_is_the_sum_of_its_modes(void** state) {
  (void)state;
  static const Case cases[] = {
      {"27.5 Hz at 192 kHz, 20 masses", 192000.0, 27.5, 0.0, 20, PARTIALS_LUMPED},
      {"27.5 Hz at 192 kHz, 20 masses, B = 1e-3", 192000.0, 27.5, 1e-3, 20, PARTIALS_LUMPED},
      {"55 Hz at 48 kHz, 80 masses", 48000.0, 55.0, 0.0, 80, PARTIALS_LUMPED},
      {"110 Hz at 48 kHz, 40 masses, B = 1e-4", 48000.0, 110.0, 1e-4, 40, PARTIALS_LUMPED},
      {"440 Hz at 48 kHz, at its limit", 48000.0, 440.0, 0.0, 1024, PARTIALS_LUMPED},
      {"440 Hz at 48 kHz, B = 1e-3, at its limit", 48000.0, 440.0, 1e-3, 1024, PARTIALS_LUMPED},
      {"55 Hz at 48 kHz, 80 masses, truest partials", 48000.0, 55.0, 0.0, 80, PARTIALS_TRUEST},
      {"440 Hz at 48 kHz, 40 masses, true, B = 1e-3", 48000.0, 440.0, 1e-3, 40, PARTIALS_TRUE},
      {"4186 Hz at 44.1 kHz, at its limit", 44100.0, 4186.0, 0.0, 1024, PARTIALS_LUMPED},
  };
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (size_t c = 0; c < sizeof(cases) / sizeof(cases[0]); ++c) {
      const double in_float = case_snr_db(chain_kernel(kernel), &cases[c], 0.9 * LONGEST_IN_FLOAT);
      const double in_double = case_snr_db(chain_kernel(kernel), &cases[c], 1e5);
      print_message("  %s, %s:\n", cases[c].what, chain_kernel(kernel)->name);
      assert_within("noise over signal in float, dB", -in_float, -LEAST_SNR_DB);
      assert_within("noise over signal in double, dB", -in_double, -LEAST_DOUBLE_SNR_DB);
    }
  }
}

/* x of every mass after `n_frames` steps, from the modes of what the chain is doing now. */
static void foretell(const Chain* chain, uint32_t n_frames, double* x) {
  const uint32_t n = chain->n_masses;
  for (uint32_t i = 0; i < n; ++i) {
    x[i] = 0.0;
  }
  for (uint32_t k = 1; k <= n; ++k) {
    const Pole pole = tuning_mode(chain->now, n, k);
    const double complex c = mode_of(chain, chain->now, k, 0.5 / k).amplitude;
    const double size = pow(pole_radius(pole), n_frames);
    const double angle = n_frames * pole_angle(pole);
    const double now = size * (creal(c) * cos(angle) - cimag(c) * sin(angle));
    for (uint32_t i = 0; i < n; ++i) {
      x[i] += now * sin(PI * k * (i + 1.0) / (n + 1.0));
    }
  }
}

static void doubles_are_the_modes_to_their_last_places(void** state) {
  (void)state;
  enum { STEPS = 20000, N = 60 };
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    double worst = 0.0;
    for (int scene = 0; scene < N_CHAIN_DAMPINGS * N_CHAIN_ELASTICITIES; ++scene) {
      double x[N];
      double u[N];
      double truth[N];
      StringCoefs coefs = chains_coefs((ChainDamping)(scene % 3), (ChainElasticity)(scene / 3));
      Chain chain;
      coefs.z0 *= 0.01;
      coefs.z1 *= 0.01;
      chain_init(&chain, chain_kernel(kernel), memory, N);
      assert_true(chain_hold(&chain, CHAIN_DOUBLE));
      chain_set(&chain, coefs);
      pull_aside(&chain);
      foretell(&chain, STEPS, truth);
      chains_run(&chain, STEPS);
      chains_read(&chain, x, u);
      worst = fmax(worst, chains_distance(x, truth, N));
    }
    assert_within(chain_kernel(kernel)->name, worst, 2e-12);
  }
}

static void rounding_the_coefficients_is_not_heard(void** state) {
  (void)state;
  double worst_cents = 0.0;
  double worst_tau = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 20000; ++trial) {
    const TuningTarget target = {
        .rate_hz = 48000.0,
        .tone = {random_log_between(&random, 8.0, 12600.0), random_log_between(&random, 0.01, 0.4)},
        .loss = random_between(&random, 0.0, 1.0),
        .inharmonicity = random_log_between(&random, 1e-6, 1e-2),
        .partials = (Partials)random_below(&random, 3),
    };
    const uint32_t n_masses = tuning_max_masses(&target, 1024);
    StringCoefs coefs = {0};
    assert_int_equal(tuning_solve(&target, n_masses, &coefs), STATUS_OK);
    const Tone tone = pole_tone(48000.0, tuning_mode(chains_rounded(coefs), n_masses, 1));
    worst_cents = fmax(worst_cents, fabs(1200.0 * log2(tone.f0_hz / target.tone.f0_hz)));
    worst_tau = fmax(worst_tau, fabs(tone.tau_s / target.tone.tau_s - 1.0));
    assert_true(tuning_headroom(chains_rounded(coefs), n_masses) > 0.0);
  }
  /* k1 is right to 2⁻²⁴ and the pitch to half of that, 5e-5 cents; more where damping is part of
   * it. */
  assert_within("cents", worst_cents, 1e-3);
  assert_within("τ, relative", worst_tau, 1e-6);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(chain_is_the_sum_of_its_modes),
      cmocka_unit_test(doubles_are_the_modes_to_their_last_places),
      cmocka_unit_test(rounding_the_coefficients_is_not_heard),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
