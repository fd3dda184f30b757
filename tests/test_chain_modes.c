#include "core/chain.h"

#include "tests/oracle.h"
#include "tests/random.h"

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

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];

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
  const ChainTap tap = {{mass, 0}, {1.0f, 0.0f}};
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

static StringCoefs rounded(StringCoefs coefs) {
  return (StringCoefs){
      .k1 = (double)(float)coefs.k1,
      .k2 = (double)(float)coefs.k2,
      .k3 = (double)(float)coefs.k3,
      .z0 = (double)(float)coefs.z0,
      .z1 = (double)(float)coefs.z1,
  };
}

/* A string. */
typedef struct {
  const char* what;
  double rate_hz;
  double f0_hz;
  double inharmonicity;
  uint32_t most_masses;
} Case;

/* Signal to noise of a case for as long as it rings, up to 4 s, its τ being `n_steps` long [dB]. */
static double case_snr_db(const ChainKernel* kernel, const Case* a_case, double n_steps) {
  const TuningTarget target = {
      .rate_hz = a_case->rate_hz,
      .tone = {a_case->f0_hz, n_steps / a_case->rate_hz},
      .loss = 0.01,
      .inharmonicity = a_case->inharmonicity,
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
  return snr_db(&chain, is_float ? rounded(coefs) : coefs, fmin(4.0, 8.0 * target.tone.tau_s),
                target.rate_hz);
}

/*
  What is measured: the string of the very coefficients that the loop has, against the exact sum of
  its modes in double; so it is the arithmetic of the loop alone.  What their rounding to float does
  to the pitch is the next claim's.
*/
static void chain_is_the_sum_of_its_modes(void** state) {
  (void)state;
  static const Case cases[] = {
      {"27.5 Hz at 192 kHz, 20 masses", 192000.0, 27.5, 0.0, 20},
      {"27.5 Hz at 192 kHz, 20 masses, B = 1e-3", 192000.0, 27.5, 1e-3, 20},
      {"55 Hz at 48 kHz, 80 masses", 48000.0, 55.0, 0.0, 80},
      {"110 Hz at 48 kHz, 40 masses, B = 1e-4", 48000.0, 110.0, 1e-4, 40},
      {"440 Hz at 48 kHz, at its limit", 48000.0, 440.0, 0.0, 1024},
      {"440 Hz at 48 kHz, B = 1e-3, at its limit", 48000.0, 440.0, 1e-3, 1024},
      {"4186 Hz at 44.1 kHz, at its limit", 44100.0, 4186.0, 0.0, 1024},
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
    const Tone tone = pole_tone(48000.0, tuning_mode(rounded(coefs), n_masses, 1));
    worst_cents = fmax(worst_cents, fabs(1200.0 * log2(tone.f0_hz / target.tone.f0_hz)));
    worst_tau = fmax(worst_tau, fabs(tone.tau_s / target.tone.tau_s - 1.0));
    assert_true(tuning_headroom(rounded(coefs), n_masses) > 0.0);
  }
  /* k1 is right to 2⁻²⁴ and the pitch to half of that, 5e-5 cents; more where damping is part of
   * it. */
  assert_within("cents", worst_cents, 1e-3);
  assert_within("τ, relative", worst_tau, 1e-6);
}

static TuningTarget random_target(Random* random) {
  return (TuningTarget){
      .rate_hz = 48000.0,
      .tone = {random_log_between(random, 100.0, 400.0), HUGE_VAL},
      .inharmonicity = random_below(random, 2) ? random_log_between(random, 1e-5, 1e-2) : 0.0,
  };
}

/*
  A way between two stable strings is stable all along, and the motion stays of its size: without
  damping a glide of a period or more keeps E/ω, so that the amplitude goes as the root of the
  pitches' ratio, at most 2; a quarter more for what is not slow enough.
*/
static void glide_between_stable_strings_stays_bounded(void** state) {
  (void)state;
  static float out[BLOCK];
  float* const outs[] = {out};
  const ChainTap tap = {{0, 0}, {0.0f, 0.0f}};
  double worst = 0.0;
  Random random = random_start();
  for (int trial = 0; trial < 300; ++trial) {
    const TuningTarget targets[2] = {random_target(&random), random_target(&random)};
    const uint32_t n_masses = tuning_max_masses(&targets[1], tuning_max_masses(&targets[0], 60));
    StringCoefs coefs[2];
    assert_int_equal(tuning_solve(&targets[0], n_masses, &coefs[0]), STATUS_OK);
    assert_int_equal(tuning_solve(&targets[1], n_masses, &coefs[1]), STATUS_OK);
    Chain chain;
    chain_init(&chain, chain_kernel(0), memory, n_masses);
    assert_true(chain_hold(&chain, trial % 2 ? CHAIN_FLOAT : CHAIN_DOUBLE));
    chain_set(&chain, coefs[0]);
    pull_aside(&chain);
    for (int turn = 0; turn < 10; ++turn) {
      chain_glide(&chain, coefs[(turn + 1) % 2], 480 + random_below(&random, 2500));
      chain_run(&chain, BLOCK, &tap, 1, outs);
      assert_int_equal(chain.n_gliding, 0);
      assert_memory_equal(&chain.now, &chain.goal, sizeof(chain.now));
    }
    for (int n = 0; n < 200; ++n) {
      chain_run(&chain, 7, &tap, 1, outs);
      worst = fmax(worst, chain_amplitude(&chain, HUGE_VAL));
    }
  }
  assert_within("amplitude after ten glides, of 0.25", worst / 0.25, 2.5);
}

static void run_silently(Chain* chain, uint32_t n_frames) {
  static float sink[BLOCK];
  static const ChainTap tap = {{0, 0}, {0.0f, 0.0f}};
  float* const out[] = {sink};
  chain_run(chain, n_frames, &tap, 1, out);
}

static void amplitude_is_the_fundamentals(void** state) {
  (void)state;
  double worst = 0.0;
  for (int step = 0; step <= 23; ++step) {
    const double f0_hz = 50.0 * pow(1.3, step);
    const TuningTarget target = {.rate_hz = 48000.0, .tone = {f0_hz, HUGE_VAL}};
    const uint32_t n = tuning_max_masses(&target, 50);
    StringCoefs coefs = {0};
    assert_int_equal(tuning_solve(&target, n, &coefs), STATUS_OK);
    Chain chain;
    chain_init(&chain, chain_kernel(0), memory, n);
    assert_true(chain_hold(&chain, CHAIN_DOUBLE));
    chain_set(&chain, coefs);
    for (uint32_t i = 0; i < n; ++i) {
      chain_place(&chain, i, (float)(0.7 * sin(PI * (i + 1.0) / (n + 1.0))), 0.0f);
    }
    assert_true(fabs(chain_amplitude(&chain, HUGE_VAL) - 0.7) < 1e-6);
    /* At rest it is half a step from its turn: 0.7 is |C| cos(θ/2). */
    const double truth = 0.7 / cos(PI * f0_hz / 48000.0);
    const double a1 = tuning_mode(coefs, n, 1).a;
    for (uint32_t frame = 0; frame < 500; ++frame) {
      worst = fmax(worst, fabs(chain_amplitude(&chain, a1) / truth - 1.0));
      run_silently(&chain, 1);
    }
  }
  /* The shape starts as floats. */
  assert_within("ringing, relative", worst, 2.0 * (double)FLT_EPSILON);
}

static void rest_is_rest(void** state) {
  (void)state;
  static const StringCoefs settings[] = {{.k1 = 0.5}, {.k1 = 0.1, .k2 = 0.1, .z0 = 0.1}};
  for (size_t s = 0; s < 2; ++s) {
    Chain chain;
    chain_init(&chain, chain_kernel(0), memory, 100);
    assert_true(chain_hold(&chain, s == 0 ? CHAIN_DOUBLE : CHAIN_FLOAT));
    chain_set(&chain, settings[s]);
    pull_aside(&chain);
    run_silently(&chain, 100);
    assert_true(chain_amplitude(&chain, 1.0) > 0.01);
    chain_rest(&chain);
    run_silently(&chain, 100);
    assert_true(chain_amplitude(&chain, 1.0) == 0.0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(chain_is_the_sum_of_its_modes),
      cmocka_unit_test(rounding_the_coefficients_is_not_heard),
      cmocka_unit_test(glide_between_stable_strings_stays_bounded),
      cmocka_unit_test(amplitude_is_the_fundamentals),
      cmocka_unit_test(rest_is_rest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
