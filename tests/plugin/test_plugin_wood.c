/* Presets of instruments of wood: their bodies stand still under the keys, so that no two keys are
 * alike. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/plugins.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum {
  RATE = PLUGINS_RATE,
  LOWEST = 45,
  N_KEYS = 30,
  N_PARTIALS = 8,
  N_FRAMES = RATE / 2,
  N_BANDS = 24
};

/* What recordings have [dB rms], and what is left of it on a guitar, whose notes are not made alike
 * in loudness by what their body does: more of it would be more uneven. */
static const double LEAST_FORMANTS_DB = 2.0;
static const double LEAST_FORMANTS_OF_GUITARS_DB = 1.2;
static const double LEAST_VARIETY_DB = 3.5;
static const double MOST_VARIETY_DB = 10.0;

typedef double Levels[N_KEYS][N_PARTIALS];

static double hz_of(int key, int k) {
  return (k + 1) * 440.0 * exp2((LOWEST + key - 69) / 12.0);
}

/* The level of each partial [dB], near where a flexible string has it. */
static void hear(Host* host, Levels levels) {
  for (int key = 0; key < N_KEYS; ++key) {
    Sound s = sound_new(N_FRAMES);
    strings_restart(host);
    strings_note_on(host, 0, (uint32_t)(LOWEST + key), 80);
    strings_run(host, &s, 0, N_FRAMES, PLUGINS_BLOCK);
    for (int k = 0; k < N_PARTIALS; ++k) {
      const size_t from = N_FRAMES / 10;
      const double heard = measure_near(s.left + from, N_FRAMES - from, RATE, hz_of(key, k)) +
                           measure_near(s.right + from, N_FRAMES - from, RATE, hz_of(key, k));
      levels[key][k] = 20.0 * log10(heard + 1e-9);
    }
    sound_free(&s);
  }
}

/* How far a partial is from where it would be if all keys were alike, a straight line of dB over
 * keys. */
static double variety_of(Levels levels) {
  double square = 0.0;
  for (int k = 0; k < N_PARTIALS; ++k) {
    double mean = 0.0;
    double slope = 0.0;
    double wide = 0.0;
    for (int key = 0; key < N_KEYS; ++key) {
      const double x = key - 0.5 * (N_KEYS - 1);
      mean += levels[key][k] / N_KEYS;
      slope += x * levels[key][k];
      wide += x * x;
    }
    for (int key = 0; key < N_KEYS; ++key) {
      const double x = key - 0.5 * (N_KEYS - 1);
      const double off = levels[key][k] - mean - slope / wide * x;
      square += off * off / (N_KEYS * N_PARTIALS);
    }
  }
  return sqrt(square);
}

/* What the body adds to each third of an octave, whichever partial of whichever key is there; how
 * loud a key is does not count. */
static double formants_of(Levels with, Levels without) {
  double sums[N_BANDS] = {0.0};
  double counts[N_BANDS] = {0.0};
  for (int key = 0; key < N_KEYS; ++key) {
    double mean = 0.0;
    for (int k = 0; k < N_PARTIALS; ++k) {
      mean += (with[key][k] - without[key][k]) / N_PARTIALS;
    }
    for (int k = 0; k < N_PARTIALS; ++k) {
      const int band = (int)(3.0 * log2(hz_of(key, k) / hz_of(0, 0)));
      sums[band] += with[key][k] - without[key][k] - mean;
      counts[band] += 1.0;
    }
  }
  double square = 0.0;
  double sum = 0.0;
  double n = 0.0;
  for (int band = 0; band < N_BANDS; ++band) {
    if (counts[band] > 3.0) {
      const double db = sums[band] / counts[band];
      sum += db;
      square += db * db;
      n += 1.0;
    }
  }
  return sqrt(square / n - sum * sum / (n * n));
}

static int check_presets(Host* host, double least_formants_db) {
  static Levels with;
  static Levels without;
  int n = 0;
  for (uint32_t p = 0; p < host_n_presets(host); ++p) {
    assert_true(host_preset(host, host_preset_label(host, p)));
    if (host_get(host, "body") == 0.0f) {
      continue;
    }
    strings_set(host, "limiter", 0.0);
    strings_set(host, "variation", 0.0);
    hear(host, with);
    strings_set(host, "body_mix", 0.0);
    hear(host, without);
    const double formants = formants_of(with, without);
    const double variety = variety_of(with);
    print_message("%-20s formants %4.1f dB, partials vary by %4.1f dB\n",
                  host_preset_label(host, p), formants, variety);
    assert_true(formants >= least_formants_db);
    assert_true(variety >= LEAST_VARIETY_DB && variety <= MOST_VARIETY_DB);
    ++n;
  }
  host_free(host);
  return n;
}

static void bodies_of_strings_stand_still(void** state) {
  (void)state;
  assert_true(check_presets(plugins_open(0), LEAST_FORMANTS_DB) >= 21);
}

static void bodies_of_guitars_stand_still(void** state) {
  (void)state;
  assert_true(check_presets(plugins_open(1), LEAST_FORMANTS_OF_GUITARS_DB) >= 4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bodies_of_strings_stand_still),
      cmocka_unit_test(bodies_of_guitars_stand_still),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
