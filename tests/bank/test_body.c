/* What bodies are as modes at some rate: their frequency, decay and loudness. */
#include "core/bank/body.h"

#include "core/bank/bodies.h"
#include "core/base/complex_of.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <complex.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static const BodyShape AS_IT_IS = {1.0, 1.0};

enum { N_RATES = 3 };
static const double rates_hz[N_RATES] = {44100.0, 48000.0, 96000.0};

static int by_frequency(const void* a, const void* b) {
  const BodyMode* const one = a;
  const BodyMode* const other = b;
  return (one->f0_hz > other->f0_hz) - (one->f0_hz < other->f0_hz);
}

static void draw_body(Body* body, Random* random, uint32_t n_modes, double highest_hz) {
  *body = (Body){.n_modes = n_modes};
  for (uint32_t k = 0; k < n_modes; ++k) {
    body->modes[k] = (BodyMode){
        .f0_hz = random_log_between(random, 60.0, highest_hz),
        .q = random_log_between(random, 10.0, 50.0),
        .mass_kg = random_log_between(random, 0.05, 2.0),
        .radiation = {random_between(random, -1.0, 1.0), random_between(random, -1.0, 1.0)},
    };
  }
  qsort(body->modes, n_modes, sizeof(BodyMode), by_frequency);
}

static double in_db(double power) {
  return 10.0 * log10(power);
}

/* By brute force, over so many frequencies that no resonance falls between them. */
static double mean_gain(const Body* body, BodyShape shape, double hz) {
  enum { MANY = 4000 };
  double sum = 0.0;
  for (int i = 0; i < MANY; ++i) {
    sum += body_gain_square(body, shape, hz * exp2(((i + 0.5) / MANY - 0.5) / 3.0));
  }
  return sum / MANY;
}

static double band_hz(int band) {
  return BODY_LOWEST_HZ * exp2(band / 3.0);
}

/* q̈ of one mode by complex amplitudes: −ω² q, (ω0² − ω² + j ω0 ω/Q) q = f/M. */
static double gain_of_equation(const Body* body, double hz) {
  const double omega = 2.0 * PI * hz;
  double sum = 0.0;
  for (int side = 0; side < 2; ++side) {
    double complex heard = 0.0;
    for (uint32_t k = 0; k < body->n_modes; ++k) {
      const BodyMode* const mode = &body->modes[k];
      const double omega0 = 2.0 * PI * mode->f0_hz;
      const double complex spring =
          complex_of(omega0 * omega0 - omega * omega, omega0 * omega / mode->q);
      heard -= mode->radiation[side] * omega * omega / (mode->mass_kg * spring);
    }
    sum += 0.5 * creal(heard * conj(heard));
  }
  return sum;
}

static void gain_is_that_of_the_equation(void** state) {
  (void)state;
  Random random = random_start();
  Body body;
  double worst = 0.0;
  draw_body(&body, &random, 80, 8000.0);
  for (int i = 0; i < 2000; ++i) {
    const double hz = random_log_between(&random, 10.0, 20000.0);
    const double expected = gain_of_equation(&body, hz);
    worst = fmax(worst, fabs(body_gain_square(&body, AS_IT_IS, hz) / expected - 1.0));
  }
  assert_within("gain, relative", worst, 1e-9);
}

static void shape_is_a_body_of_its_own(void** state) {
  (void)state;
  Random random = random_start();
  const BodyShape shape = {1.4, 0.6};
  Body body;
  double worst = 0.0;
  draw_body(&body, &random, 80, 8000.0);
  Body shaped = body;
  for (uint32_t k = 0; k < body.n_modes; ++k) {
    shaped.modes[k].f0_hz /= shape.size;
    shaped.modes[k].q /= shape.damping;
  }
  for (int i = 0; i < 2000; ++i) {
    const double hz = random_log_between(&random, 10.0, 20000.0);
    const double expected = body_gain_square(&shaped, AS_IT_IS, hz);
    worst = fmax(worst, fabs(body_gain_square(&body, shape, hz) / expected - 1.0));
  }
  assert_within("gain, relative", worst, 1e-9);
}

/* Over all bands from 80 Hz to 5 kHz, which are those of 80.6 Hz to 4064 Hz. */
static double leveled_power(const Body* body) {
  double sum = 0.0;
  int n = 0;
  for (int band = 0; band < BODY_BANDS; ++band) {
    if (band_hz(band) >= 80.0 && band_hz(band) <= 5000.0) {
      sum += mean_gain(body, AS_IT_IS, band_hz(band));
      ++n;
    }
  }
  assert_int_equal(n, 18);
  return sum / n;
}

static void leveled_bodies_are_equally_loud(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    Body body;
    draw_body(&body, &random, 1 + random_below(&random, 120), 8000.0);
    const Body before = body;
    body_level(&body);
    worst = fmax(worst, fabs(in_db(leveled_power(&body) / BODY_POWER)));
    /* By one factor for all. */
    const double factor = body.modes[0].radiation[0] / before.modes[0].radiation[0];
    for (uint32_t k = 0; k < body.n_modes; ++k) {
      for (int side = 0; side < 2; ++side) {
        const double expected = factor * before.modes[k].radiation[side];
        assert_true(fabs(body.modes[k].radiation[side] - expected) <= 1e-14 * fabs(expected));
      }
      assert_true(body.modes[k].f0_hz == before.modes[k].f0_hz);
    }
  }
  /* Bands are known from 16 places, which are a half of the width of Q 50 apart. */
  assert_within("loudness [dB]", worst, 0.1);
  worst = 0.0;
  for (int choice = BODIES_NONE + 1; choice < BODIES_FILE; ++choice) {
    worst = fmax(worst, fabs(in_db(leveled_power(bodies_shipped((BodiesChoice)choice)))));
  }
  assert_within("of shipped ones [dB]", worst, 0.5);
}

static void leveling_again_changes_nothing(void** state) {
  (void)state;
  Random random = random_start();
  Body body;
  draw_body(&body, &random, 60, 8000.0);
  body_level(&body);
  const Body once = body;
  body_level(&body);
  double worst = 0.0;
  for (int band = 0; band < BODY_BANDS; ++band) {
    worst = fmax(worst, fabs(body.power[band] / once.power[band] - 1.0));
  }
  assert_within("power, relative", worst, 1e-13);
}

static void body_that_radiates_nothing_is_left(void** state) {
  (void)state;
  Random random = random_start();
  Body body;
  draw_body(&body, &random, 10, 8000.0);
  for (uint32_t k = 0; k < body.n_modes; ++k) {
    body.modes[k].radiation[0] = 0.0;
    body.modes[k].radiation[1] = 0.0;
  }
  const Body before = body;
  body_level(&body);
  assert_memory_equal(&body, &before, sizeof(body));
  body.n_modes = 0;
  body_level(&body);
  assert_true(body_power(&body, AS_IT_IS, 440.0) == 0.0);
}

static void power_is_the_mean_gain_of_its_band(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  double worst_sized = 0.0;
  double worst_between = 0.0;
  for (int trial = 0; trial < 10; ++trial) {
    Body body;
    const BodyShape shape = {random_log_between(&random, 0.5, 2.0), 1.0};
    draw_body(&body, &random, 100, 8000.0);
    body_level(&body);
    for (int band = 0; band < BODY_BANDS; ++band) {
      const double hz = band_hz(band);
      const double expected = mean_gain(&body, AS_IT_IS, hz);
      worst = fmax(worst, fabs(in_db(body_power(&body, AS_IT_IS, hz) / expected)));
      const double sized = body_power(&body, shape, hz / shape.size);
      worst_sized =
          fmax(worst_sized, fabs(in_db(sized / mean_gain(&body, shape, hz / shape.size))));
    }
    for (int band = 9; band < 28; ++band) {
      const double hz = band_hz(band) * exp2(1.0 / 6.0);
      const double between = 0.5 * (body.power[band] + body.power[band + 1]);
      worst_between = fmax(worst_between, fabs(body_power(&body, AS_IT_IS, hz) / between - 1.0));
    }
  }
  /* From 16 places. */
  assert_within("in a band [dB]", worst, 0.5);
  assert_within("of another size [dB]", worst_sized, 0.5);
  assert_within("between bands, of a straight line", worst_between, 1e-12);
}

static void power_ends_where_bands_do(void** state) {
  (void)state;
  const Body* const body = bodies_shipped(BODIES_GUITAR);
  assert_true(body_power(body, AS_IT_IS, 1e-3) == body->power[0]);
  assert_true(fabs(body_power(body, AS_IT_IS, 1e6) / body->power[BODY_BANDS - 1] - 1.0) < 1e-14);
}

/* A resonance that loses twice as much is half as high and twice as wide. */
static void power_goes_as_damping_does(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  Body body;
  draw_body(&body, &random, 200, 8000.0);
  body_level(&body);
  for (double damping = 0.5; damping <= 2.0; damping *= 2.0) {
    double known = 0.0;
    double found = 0.0;
    for (int band = 12; band < 27; ++band) {
      known += body_power(&body, (BodyShape){1.0, damping}, band_hz(band));
      found += mean_gain(&body, (BodyShape){1.0, damping}, band_hz(band));
    }
    worst = fmax(worst, fabs(in_db(known / found)));
  }
  assert_within("all bands together [dB]", worst, 1.0);
}

static void modes_have_their_frequency_and_q(void** state) {
  (void)state;
  Random random = random_start();
  double worst_f0 = 0.0;
  double worst_q = 0.0;
  for (int trial = 0; trial < 60; ++trial) {
    const BodyShape shape = {random_log_between(&random, 0.5, 2.0),
                             random_log_between(&random, 0.3, 3.0)};
    const double rate_hz = rates_hz[trial % N_RATES];
    Body body;
    Bank bank;
    draw_body(&body, &random, 100, 0.4 * rate_hz * shape.size);
    body_bank(&body, shape, rate_hz, &bank);
    assert_int_equal(bank.n_added, body.n_modes);
    for (uint32_t k = 0; k < bank.n_added; ++k) {
      const BodyMode* const mode = &body.modes[k];
      const Tone tone = pole_tone(rate_hz, (Pole){bank.a[k], bank.g[k]});
      const double q = PI * tone.f0_hz * tone.tau_s;
      worst_f0 = fmax(worst_f0, fabs(tone.f0_hz * shape.size / mode->f0_hz - 1.0));
      worst_q = fmax(worst_q, fabs(q * shape.damping / mode->q - 1.0));
      assert_true(bank.in[k] == 1.0 / mode->mass_kg);
      assert_true(bank.x[k] == 0.0 && bank.u[k] == 0.0);
    }
  }
  /* The pole feels its roundings as 1/sin θ, as in test_pole.c. */
  assert_within("F, relative", worst_f0, 1e-13);
  assert_within("Q, relative", worst_q, 1e-13);
}

static void highest_modes_are_left_out(void** state) {
  (void)state;
  const double limit_hz = BODY_HIGHEST * 48000.0;
  const Body body = {
      .n_modes = 5,
      .modes = {{100.0, 20.0, 1.0, {1.0, 1.0}},
                {limit_hz * (1.0 - DBL_EPSILON), 20.0, 2.0, {1.0, 1.0}},
                {limit_hz, 20.0, 3.0, {1.0, 1.0}},
                {24000.0, 20.0, 4.0, {1.0, 1.0}},
                {1e6, 20.0, 5.0, {1.0, 1.0}}},
  };
  Bank bank;
  body_bank(&body, AS_IT_IS, 48000.0, &bank);
  assert_int_equal(bank.n_added, 2);
  assert_true(bank.in[0] == 1.0 && bank.in[1] == 0.5);
  body_bank(&body, (BodyShape){1.01, 1.0}, 48000.0, &bank);
  assert_int_equal(bank.n_added, 3);
  body_bank(&body, (BodyShape){0.99, 1.0}, 48000.0, &bank);
  assert_int_equal(bank.n_added, 1);
  body_bank(&body, (BodyShape){100.0, 1.0}, 48000.0, &bank);
  assert_int_equal(bank.n_added, 5);
  body_bank(&(Body){.n_modes = 0}, AS_IT_IS, 48000.0, &bank);
  assert_int_equal(bank.n_added, 0);
}

/* What is heard of a body at a rate, from its answer to one sample of 1. */

enum { MOST_FRAMES = 3 * 96000 / 2 };

static float answer[2][MOST_FRAMES];

static uint32_t ring(const Body* body, double rate_hz) {
  static float knock[MOST_FRAMES];
  Bank bank;
  knock[0] = 1.0f;
  memset(answer, 0, sizeof(answer));
  body_bank(body, AS_IT_IS, rate_hz, &bank);
  bank_run(&bank, knock, (uint32_t)(1.5 * rate_hz), answer[0], answer[1]);
  return (uint32_t)(1.5 * rate_hz);
}

static double answer_square(uint32_t n_frames, double rate_hz, double hz) {
  const double complex turn = cexp(complex_of(0.0, -2.0 * PI * hz / rate_hz));
  double complex at = 1.0;
  double complex sum[2] = {0.0, 0.0};
  for (uint32_t n = 0; n < n_frames; ++n) {
    sum[0] += (double)answer[0][n] * at;
    sum[1] += (double)answer[1][n] * at;
    at *= turn;
  }
  return 0.5 * (creal(sum[0] * conj(sum[0])) + creal(sum[1] * conj(sum[1])));
}

static double mean_answer(uint32_t n_frames, double rate_hz, double hz) {
  enum { FEW = 12 };
  double sum = 0.0;
  for (int i = 0; i < FEW; ++i) {
    sum += answer_square(n_frames, rate_hz, hz * exp2(((i + 0.5) / FEW - 0.5) / 3.0));
  }
  return sum / FEW;
}

static double mean_over_same_places(const Body* body, double hz) {
  enum { FEW = 12 };
  double sum = 0.0;
  for (int i = 0; i < FEW; ++i) {
    sum += body_gain_square(body, AS_IT_IS, hz * exp2(((i + 0.5) / FEW - 0.5) / 3.0));
  }
  return sum / FEW;
}

static void one_mode_peaks_as_high_at_every_rate(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 60; ++trial) {
    const double rate_hz = rates_hz[trial % N_RATES];
    const double f0_hz = random_log_between(&random, 100.0, 0.4 * rate_hz);
    const double q = random_log_between(&random, 10.0, 50.0);
    const Body body = {.n_modes = 1, .modes = {{f0_hz, q, 0.3, {0.3, 0.3}}}};
    const uint32_t n_frames = ring(&body, rate_hz);
    worst = fmax(worst, fabs(in_db(answer_square(n_frames, rate_hz, f0_hz) / (q * q))));
  }
  assert_within("peak [dB]", worst, 0.05);
}

/* Worst of thirds of octaves, in those up to shares of the rate [dB]. */
typedef struct {
  double to_tenth;
  double to_fifth;
  double to_four_tenths;
} Miss;

static void measure_miss(const Body* body, double rate_hz, Miss* miss) {
  const uint32_t n_frames = ring(body, rate_hz);
  for (double hz = 80.0; hz < 0.4 * rate_hz / exp2(1.0 / 6.0); hz *= exp2(1.0 / 3.0)) {
    const double off =
        fabs(in_db(mean_answer(n_frames, rate_hz, hz) / mean_over_same_places(body, hz)));
    miss->to_tenth = hz < 0.1 * rate_hz ? fmax(miss->to_tenth, off) : miss->to_tenth;
    miss->to_fifth = hz < 0.2 * rate_hz ? fmax(miss->to_fifth, off) : miss->to_fifth;
    miss->to_four_tenths = fmax(miss->to_four_tenths, off);
  }
}

static void bank_is_as_loud_as_its_body(void** state) {
  (void)state;
  Random random = random_start();
  for (int r = 0; r < N_RATES; ++r) {
    Miss miss = {0};
    Body body;
    draw_body(&body, &random, 100, 0.4 * rates_hz[r]);
    body_level(&body);
    measure_miss(&body, rates_hz[r], &miss);
    measure_miss(bodies_shipped(BODIES_GUITAR), rates_hz[r], &miss);
    measure_miss(bodies_shipped(BODIES_KALIMBA), rates_hz[r], &miss);
    print_message("  at %g Hz\n", rates_hz[r]);
    assert_within("to a tenth of the rate [dB]", miss.to_tenth, 0.1);
    assert_within("to a fifth [dB]", miss.to_fifth, 0.35);
    assert_within("to four tenths [dB]", miss.to_four_tenths, 0.5);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gain_is_that_of_the_equation),
      cmocka_unit_test(shape_is_a_body_of_its_own),
      cmocka_unit_test(leveled_bodies_are_equally_loud),
      cmocka_unit_test(leveling_again_changes_nothing),
      cmocka_unit_test(body_that_radiates_nothing_is_left),
      cmocka_unit_test(power_is_the_mean_gain_of_its_band),
      cmocka_unit_test(power_ends_where_bands_do),
      cmocka_unit_test(power_goes_as_damping_does),
      cmocka_unit_test(modes_have_their_frequency_and_q),
      cmocka_unit_test(highest_modes_are_left_out),
      cmocka_unit_test(one_mode_peaks_as_high_at_every_rate),
      cmocka_unit_test(bank_is_as_loud_as_its_body),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
