/* Presets that are named after real instruments die away as those do: T60 of partials 1 to 3 and 5
 * to 8, in the median over keys and partials, beside that of recordings. */
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/plugins.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum {
  RATE = 48000,
  BLOCK = PLUGINS_BLOCK,
  N_KEYS = 3,
  SECONDS = 3,
  WINDOW = 2048,
  HOP = 1024,
  MOST = 64
};

/* How far a median may be from the recorded one. */
static const double MOST_OFF = 0.3;

/* From where on a decay is seen, and down to where [dB]. */
static const double FLOOR = -50.0;

typedef struct {
  int plugin;
  const char* preset;
  double low_s, high_s; /* Recorded T60 of partials 1 to 3, and 5 to 8 */
} Row;

static const Row rows[] = {
    {0, "Nylon Guitar", 5.7, 2.5},      {0, "Steel Guitar", 8.0, 4.0},
    {0, "Concert Harp", 10.0, 2.6},     {0, "Felt Piano", 7.2, 7.8},
    {0, "Iron Frame", 7.0, 8.0},        {0, "Harpsichord", 9.0, 6.0},
    {0, "Hammered Dulcimer", 3.0, 1.8}, {0, "Upright Bass", 3.8, 4.1},
    {0, "Finger Bass", 14.0, 10.0},     {0, "Jazz Electric", 8.0, 3.0},
    {1, "Steel Acoustic", 8.0, 4.0},    {1, "Nylon Fingers", 5.7, 2.5},
    {1, "Clean Neck", 8.0, 3.0},        {1, "Electric Bass", 14.0, 10.0},
};

/* A preset's own stiffness of a key. */
static double stiffness_of(const Host* host, uint32_t key) {
  const double least = 1e-6;
  const double at_a4 = (double)host_get(host, "stiffness");
  const double tracked = exp2((double)host_get(host, "stiffness_tracking") * (key - 69.0) / 12.0);
  return at_a4 > 1.5 * least ? at_a4 * tracked : 0.0;
}

static double partial_hz(const Host* host, uint32_t key, int k) {
  const double b = stiffness_of(host, key);
  return k * 440.0 * exp2((key - 69.0) / 12.0) * sqrt((1.0 + b * k * k) / (1.0 + b));
}

static double level_db(const float* samples, double hz) {
  return 20.0 * log10(measure_near(samples, WINDOW, RATE, hz) + 1e-15);
}

/* The straight line through the levels, from a tenth of a second on, as far as they are seen. */
static double t60_of(const Sound* sound, double hz) {
  double n = 0.0, t = 0.0, y = 0.0, tt = 0.0, ty = 0.0;
  const size_t first = RATE / 10;
  const double start = level_db(sound->left + first, hz);
  for (size_t at = first; at + WINDOW <= sound->n_frames; at += HOP) {
    const double db = level_db(sound->left + at, hz);
    if (db < start + FLOOR) {
      break;
    }
    const double now = (double)at / RATE;
    n += 1.0;
    t += now;
    y += db;
    tt += now * now;
    ty += now * db;
  }
  return -60.0 * (n * tt - t * t) / (n * ty - t * y);
}

static int by_size(const void* a, const void* b) {
  const double x = *(const double*)a;
  const double y = *(const double*)b;
  return (x > y) - (x < y);
}

static double median(double* values, size_t n) {
  qsort(values, n, sizeof(double), by_size);
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

static void presets_die_away_as_recordings_do(void** state) {
  (void)state;
  static const uint32_t keys[N_KEYS] = {45, 60, 74};
  double worst = 0.0;
  for (size_t r = 0; r < sizeof(rows) / sizeof(rows[0]); ++r) {
    const Row* const row = &rows[r];
    Host* const host = plugins_open(row->plugin);
    double low[MOST];
    double high[MOST];
    size_t n_low = 0;
    size_t n_high = 0;
    assert_true(host_preset(host, row->preset));
    for (int k = 0; k < N_KEYS; ++k) {
      Sound sound = sound_new(SECONDS * RATE);
      strings_restart(host);
      strings_note_on(host, 0, keys[k], 80);
      strings_run(host, &sound, 0, sound.n_frames, BLOCK);
      for (int p = 1; p <= 8; ++p) {
        const double t60 = p == 4 ? 0.0 : t60_of(&sound, partial_hz(host, keys[k], p));
        if (p <= 3) {
          low[n_low++] = t60;
        } else if (p >= 5) {
          high[n_high++] = t60;
        }
      }
      sound_free(&sound);
    }
    const double of_low = median(low, n_low);
    const double of_high = median(high, n_high);
    print_message("| %-18s | %5.1f / %4.1f | %5.1f / %4.1f |\n", row->preset, of_low, row->low_s,
                  of_high, row->high_s);
    worst = fmax(worst, fmax(fabs(of_low / row->low_s - 1.0), fabs(of_high / row->high_s - 1.0)));
    host_free(host);
  }
  assert_within("median of T60, off the recorded", worst, MOST_OFF);
}

/* The lowest string of a preset has partials up to 8 kHz. */
static void low_strings_reach_eight_kilohertz(void** state) {
  (void)state;
  static const struct {
    int plugin;
    const char* preset;
    uint32_t key;
  } low[] = {{0, "Nylon Guitar", 40},  {0, "Steel Guitar", 40},   {0, "Clean Electric", 40},
             {0, "Finger Bass", 28},   {0, "Pick Bass", 28},      {0, "Felt Piano", 33},
             {0, "Iron Frame", 33},    {0, "Harpsichord", 33},    {1, "Clean Bridge", 40},
             {1, "Clean Neck", 40},    {1, "Steel Acoustic", 40}, {1, "Nylon Fingers", 40},
             {1, "Twelve-String", 40}, {1, "Electric Bass", 28}};
  for (size_t i = 0; i < sizeof(low) / sizeof(low[0]); ++i) {
    Host* const host = plugins_open(low[i].plugin);
    Sound sound = sound_new(RATE / 10);
    assert_true(host_preset(host, low[i].preset));
    strings_set(host, low[i].plugin ? "course" : "spread", 0.0);
    strings_note_on(host, 0, low[i].key, 100);
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    const double masses = (double)(host_get(host, "mass_count") / host_get(host, "sounding"));
    const double hz = masses * 440.0 * exp2((low[i].key - 69.0) / 12.0);
    print_message("%-16s %5.0f masses, %5.0f Hz\n", low[i].preset, masses, hz);
    assert_true(hz >= 8000.0);
    sound_free(&sound);
    host_free(host);
  }
}

/* What lies above 2 kHz at key 40, of all [dB], against recordings: no less than 6 dB under them.
 */
static void low_strings_are_as_bright_as_recordings(void** state) {
  (void)state;
  static const struct {
    const char* preset;
    double recorded_db;
  } bright[] = {{"Nylon Guitar", -37.0}, {"Iron Frame", -20.0}, {"Upright Bass", -53.0}};
  for (size_t i = 0; i < sizeof(bright) / sizeof(bright[0]); ++i) {
    Host* const host = plugins_open(0);
    Sound sound = sound_new(RATE / 2);
    double high = 0.0;
    double all = 0.0;
    assert_true(host_preset(host, bright[i].preset));
    /* One string, as it is plucked in the mean. */
    strings_set(host, "resonance", 0.0);
    strings_set(host, "unisons", 1.0);
    strings_set(host, "second", 0.0);
    strings_set(host, "variation", 0.0);
    strings_note_on(host, 0, 40, 100);
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    for (int k = 1; k < 200 && partial_hz(host, 40, k) < 12000.0; ++k) {
      const double power =
          pow(10.0, 0.1 * level_db(sound.left + RATE / 20, partial_hz(host, 40, k)));
      all += power;
      high += partial_hz(host, 40, k) > 2000.0 ? power : 0.0;
    }
    const double db = 10.0 * log10(high / all);
    print_message("%-16s %5.1f dB, recorded %5.1f\n", bright[i].preset, db, bright[i].recorded_db);
    assert_true(db > bright[i].recorded_db - 6.0);
    sound_free(&sound);
    host_free(host);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(presets_die_away_as_recordings_do),
      cmocka_unit_test(low_strings_reach_eight_kilohertz),
      cmocka_unit_test(low_strings_are_as_bright_as_recordings),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
