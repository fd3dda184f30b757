/* The promise of Hooke Strings, measured on its sound: exactly the pitch and exactly the decay that
 * were asked for. */
#include "tests/support/host_inside.h"
#include "tests/support/measure.h"
#include "tools/host/host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { LOWEST_KEY = 21, HIGHEST_KEY = 108, BLOCK = 1024, N_DRAWS = 3, N_DRAWS_LONG = 40 };

/* What the instrument promises. */
static const double MOST_CENTS = 0.005;
static const double MOST_DECAY_ERROR = 2e-4;

/* Decays that end sooner have too few periods to measure by. */
static const double LEAST_PERIODS = 12.0;

static const double rates_hz[] = {22050.0, 44100.0, 48000.0, 96000.0, 192000.0};

typedef struct {
  float damping, tracking, loss, stiffness, masses, tuning, partials;
} Setting;

typedef struct {
  double cents, decay;
  unsigned n_measured;
  unsigned n_broken;
} Worst;

typedef struct {
  Host* host;
  double rate_hz;
  float* samples;
  size_t capacity;
} Bench;

static uint32_t random_state;

static double random_unit(void) {
  random_state = random_state * 1664525u + 1013904223u;
  return random_state / 4294967296.0;
}

static float random_log(double low, double high) {
  return (float)(low * pow(high / low, random_unit()));
}

/* Half of the values of a setting are the ends of their ranges. */
static float draw(double low, double high) {
  const double side = random_unit();
  return side < 0.25 ? (float)low : side < 0.5 ? (float)high : random_log(low, high);
}

static double pitch_hz(const Setting* setting, uint32_t key) {
  return (double)setting->tuning * exp2(((double)key - 69.0) / 12.0);
}

static double decay_s(const Setting* setting, uint32_t key) {
  return 1.0 /
         ((double)setting->damping * exp2((double)setting->tracking * ((double)key - 69.0) / 12.0));
}

static Setting draw_setting(uint32_t key) {
  const Setting setting = {
      .tracking = (float)(random_unit() < 0.5 ? 0.0 : random_unit()),
      .loss = draw(1e-5, 1.0),
      .stiffness = draw(1e-6, 0.1),
      .masses = floorf(draw(1.0, 1024.0)),
      .tuning = random_unit() < 0.5 ? 440.0f : (float)(400.0 + 80.0 * random_unit()),
  };
  Setting wanted = setting;
  wanted.damping = 1.0f;
  const double most = pitch_hz(&wanted, key) * decay_s(&wanted, key) / LEAST_PERIODS;
  wanted.damping = draw(0.02, fmin(200.0, 0.999 * most));
  return wanted;
}

static void set_all(Host* host, const Setting* setting) {
  host_set(host, "damping", setting->damping);
  host_set(host, "tracking", setting->tracking);
  host_set(host, "loss", setting->loss);
  host_set(host, "stiffness", setting->stiffness);
  host_set(host, "masses", setting->masses);
  host_set(host, "tuning", setting->tuning);
  host_set(host, "partials", setting->partials);
  host_set(host, "pickup", 0.45f);
  host_set(host, "spread", 0.0f);
  host_set(host, "pluck", 0.4f);
}

/* From rest, one note; the samples after it. */
static size_t play(Bench* bench, uint32_t key, double seconds) {
  const uint8_t note_on[3] = {0x90, (uint8_t)key, 127};
  size_t n = (size_t)(seconds * bench->rate_hz);
  n = n < bench->capacity ? n : bench->capacity;
  host_deactivate(bench->host);
  host_activate(bench->host);
  host_midi(bench->host, 0, note_on, 3);
  for (size_t done = 0; done < n; done += BLOCK) {
    assert_true(host_run(bench->host, BLOCK));
    const size_t left = n - done;
    memcpy(bench->samples + done, host_output(bench->host, 0),
           (left < BLOCK ? left : BLOCK) * sizeof(float));
  }
  return n;
}

/* Long enough to tell a slow decay, at the most ten seconds. */
static double length_s(Tone tone) {
  return fmin(fmax(6.0 * tone.tau_s, 40.0 / tone.f0_hz), tone.tau_s > 10.0 ? 10.0 : 5.0);
}

static void check(Bench* bench, uint32_t key, const Setting* setting, Worst* worst) {
  const Tone asked = {.f0_hz = pitch_hz(setting, key), .tau_s = decay_s(setting, key)};
  Tone heard = {0};
  set_all(bench->host, setting);
  const size_t n = play(bench, key, length_s(asked));
  const size_t skip = (size_t)(2.0 * bench->rate_hz / asked.f0_hz);
  const bool is_heard =
      measure_tone(bench->samples + skip, n - skip, bench->rate_hz, asked, &heard);
  const double cents = is_heard ? fabs(measure_cents(heard.f0_hz, asked.f0_hz)) : HUGE_VAL;
  const double decay = is_heard ? fabs(heard.tau_s / asked.tau_s - 1.0) : HUGE_VAL;
  const bool is_broken = !(cents <= MOST_CENTS) || !(decay <= MOST_DECAY_ERROR) ||
                         !(host_get(bench->host, "headroom") >= 0.0f);
  worst->cents = fmax(worst->cents, cents);
  worst->decay = fmax(worst->decay, decay);
  worst->n_measured += 1;
  worst->n_broken += is_broken;
  if (is_broken) {
    print_message("key %u at %g Hz: %.5f cents, decay off by %.5f %%, headroom %g, %g masses "
                  "(damping %g tracking %g loss %g "
                  "stiffness %g masses %g tuning %g partials %g)\n",
                  key, bench->rate_hz, cents, 100.0 * decay,
                  (double)host_get(bench->host, "headroom"),
                  (double)host_get(bench->host, "mass_count"), (double)setting->damping,
                  (double)setting->tracking, (double)setting->loss, (double)setting->stiffness,
                  (double)setting->masses, (double)setting->tuning, (double)setting->partials);
  }
}

static void bench_open(Bench* bench, double rate_hz) {
  char error[256];
  bench->rate_hz = rate_hz;
  bench->host = host_new("urn:hooke:strings", rate_hz, BLOCK, error, sizeof(error));
  bench->capacity = (size_t)(10.0 * rate_hz);
  bench->samples = malloc(bench->capacity * sizeof(float));
  if (!bench->host || !bench->samples) {
    fail_msg("%s", bench->host ? "out of memory" : error);
  }
  /* What is measured is the strings. */
  assert_true(host_set(bench->host, "limiter", 0.0f));
}

static void bench_close(Bench* bench) {
  host_free(bench->host);
  free(bench->samples);
}

static void every_key_has_its_pitch_and_its_decay(void** state) {
  const double rate_hz = *(const double*)*state;
  const int n_draws = getenv("HOOKE_TEST_LONG") ? N_DRAWS_LONG : N_DRAWS;
  const uint32_t seed = (uint32_t)rate_hz;
  Worst worst = {0};
  Bench bench;
  bench_open(&bench, rate_hz);
  random_state = seed;
  for (uint32_t key = LOWEST_KEY; key <= HIGHEST_KEY; ++key) {
    for (int i = 0; i < n_draws; ++i) {
      Setting setting = draw_setting(key);
      setting.partials = (float)((key + (uint32_t)i) % 3);
      check(&bench, key, &setting, &worst);
    }
  }
  bench_close(&bench);
  print_message("%g Hz, seed %u: %u sounds, worst %.6f cents, worst decay %.6f %%\n", rate_hz, seed,
                worst.n_measured, worst.cents, 100.0 * worst.decay);
  assert_int_equal(worst.n_broken, 0);
}

int main(void) {
  struct CMUnitTest tests[sizeof(rates_hz) / sizeof(rates_hz[0])];
  double rates[sizeof(rates_hz) / sizeof(rates_hz[0])];
  for (size_t i = 0; i < sizeof(rates_hz) / sizeof(rates_hz[0]); ++i) {
    rates[i] = rates_hz[i];
    tests[i] = (struct CMUnitTest)cmocka_unit_test_prestate(every_key_has_its_pitch_and_its_decay,
                                                            &rates[i]);
  }
  return cmocka_run_group_tests(tests, NULL, NULL);
}
