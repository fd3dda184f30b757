/* Every preset in stereo: both sides are as loud, and nothing is lost where they are added. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 512, LOWEST = 33, HIGHEST = 96, N_PARTIALS = 16 };

/* What is promised [dB]: of the sum, of each partial in it, and between the sides; and how far
 * under the loudest a partial is none. */
static const double MOST_LOST = 1.0;
static const double MOST_LOST_OF_ONE = 1.5;
static const double MOST_APART = 1.5;
static const double HEARD = -50.0;

/* Two ears before a body hear each of its modes a little differently, now one more, now the other:
 * so one note may be further apart, but not all of them; and what is weak is so because it lies
 * between two modes that undo each other, which may be at another frequency for each ear. */
static const double HEARD_BY_BODY = -30.0;
static const double MOST_LOST_OF_ONE_BY_BODY = 2.5;
static const double MOST_APART_BY_BODY = 3.0;

static bool has_body(Host* host) {
  return host_get(host, "body") > 0.0f && host_get(host, "body_mix") > 0.0f;
}

typedef struct {
  double lost, one_lost, apart;
  double left, right; /* Of all notes, each as loud as any other */
} Worst;

static double power_at(const float* samples, size_t n, double hz) {
  const double amplitude = measure_near(samples, n, RATE, hz);
  return amplitude * amplitude;
}

static double mean_square(const float* samples, size_t n) {
  const double rms = measure_rms(samples, n);
  return rms * rms;
}

/* Where stiff strings have their partials. */
static double partial_hz(const Host* host, uint32_t key, uint32_t k) {
  const double least = 1e-6;
  const double b = (double)host_get(host, "stiffness");
  const double stiff = b > 1.5 * least ? b : 0.0;
  return k * 440.0 * exp2((key - 69.0) / 12.0) * sqrt((1.0 + stiff * k * k) / (1.0 + stiff));
}

/* Each partial that is heard, in the sum. */
static void
hear_partials(Host* host, const Sound* s, const float* mono, uint32_t key, Worst* worst) {
  const size_t from = s->n_frames / 4;
  const size_t n = s->n_frames - from;
  double each[N_PARTIALS + 1] = {0.0};
  double most = 0.0;
  for (uint32_t k = 1; k <= N_PARTIALS && partial_hz(host, key, k) < 0.45 * RATE; ++k) {
    const double hz = partial_hz(host, key, k);
    each[k] = 0.5 * (power_at(s->left + from, n, hz) + power_at(s->right + from, n, hz));
    most = fmax(most, each[k]);
  }
  const double heard = pow(10.0, 0.1 * (has_body(host) ? HEARD_BY_BODY : HEARD));
  for (uint32_t k = 1; k <= N_PARTIALS; ++k) {
    if (each[k] > most * heard) {
      const double kept = power_at(mono + from, n, partial_hz(host, key, k));
      worst->one_lost = fmax(worst->one_lost, 10.0 * log10(each[k] / kept));
    }
  }
}

static void hear(Host* host, uint32_t key, Worst* worst) {
  Sound s = sound_new(RATE / 2);
  strings_restart(host);
  strings_note_on(host, 0, key, 90);
  strings_run(host, &s, 0, s.n_frames, BLOCK);
  float* const mono = calloc(s.n_frames, sizeof(float));
  assert_non_null(mono);
  for (size_t i = 0; i < s.n_frames; ++i) {
    mono[i] = 0.5f * (s.left[i] + s.right[i]);
  }
  const double left = mean_square(s.left, s.n_frames);
  const double right = mean_square(s.right, s.n_frames);
  const double sum = mean_square(mono, s.n_frames);
  assert_true(sum > 1e-9);
  worst->lost = fmax(worst->lost, 10.0 * log10(0.5 * (left + right) / sum));
  worst->apart = fmax(worst->apart, fabs(10.0 * log10(left / right)));
  worst->left += left / (left + right);
  worst->right += right / (left + right);
  if (key % 3 == 0) {
    hear_partials(host, &s, mono, key, worst);
  }
  free(mono);
  sound_free(&s);
}

static void check_presets(Host* host) {
  const uint32_t step = getenv("HOOKE_TEST_LONG") ? 1 : 21;
  for (uint32_t p = 0; p < host_n_presets(host); ++p) {
    Worst worst = {0};
    assert_true(host_preset(host, host_preset_label(host, p)));
    strings_set(host, "limiter", 0.0);
    for (uint32_t key = LOWEST; key <= HIGHEST; key += step) {
      hear(host, key, &worst);
    }
    const double aside = fabs(10.0 * log10(worst.left / worst.right));
    print_message("%-24s lost %5.2f dB, of a partial %5.2f, apart %5.2f, all %5.2f\n",
                  host_preset_label(host, p), worst.lost, worst.one_lost, worst.apart, aside);
    assert_true(worst.lost < MOST_LOST && aside < MOST_APART);
    assert_true(worst.one_lost < (has_body(host) ? MOST_LOST_OF_ONE_BY_BODY : MOST_LOST_OF_ONE));
    assert_true(worst.apart < (has_body(host) ? MOST_APART_BY_BODY : MOST_APART));
  }
  host_free(host);
}

static void strings_lose_nothing_in_mono(void** state) {
  (void)state;
  check_presets(strings_open(RATE, BLOCK));
}

static void guitars_lose_nothing_in_mono(void** state) {
  (void)state;
  check_presets(guitar_open(RATE, BLOCK));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strings_lose_nothing_in_mono),
      cmocka_unit_test(guitars_lose_nothing_in_mono),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
