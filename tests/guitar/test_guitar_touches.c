/* Harmonics, and the palm. */
#include "core/guitar/guitar_string.h"

#include "tests/support/guitars.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;
static const double complex J = (double complex)I;

enum { MOST_FRAMES = 192000, MOST_PARTIALS = 64 };

/* Periods of a touch, and of the window that hears the partials after it: cos⁴, 130 dB down 16 bins
 * away. */
static const double TOUCH_PERIODS = 20.0;
static const double WINDOW_PERIODS = 16.0;
static const double HIGHEST_HZ = 5000.0;

static float sound[MOST_FRAMES];
static double bells[MOST_FRAMES];

/* Levels of the partials below HIGHEST_HZ [dB], up to half the masses: those above are so flat that
 * they would be taken for others. */
typedef struct {
  uint32_t n;
  double db[MOST_PARTIALS + 1]; /* From 1 */
} Levels;

static void hear(Levels* levels, uint32_t start, double rate_hz, double f0_hz, uint32_t most) {
  const uint32_t length = (uint32_t)(WINDOW_PERIODS * rate_hz / f0_hz);
  levels->n = 0;
  for (uint32_t i = 0; i < length; ++i) {
    const double bell = sin(PI * (i + 0.5) / length);
    bells[i] = bell * bell * bell * bell;
  }
  for (uint32_t k = 1; k * f0_hz < HIGHEST_HZ && k <= most; ++k) {
    const double complex turn = cexp(-J * (2.0 * PI * k * f0_hz / rate_hz));
    double complex wave = 1.0;
    double complex sum = 0.0;
    for (uint32_t i = 0; i < length; ++i) {
      const double bell = bells[i] * (double)sound[start + i];
      sum += bell * wave;
      wave *= turn;
    }
    levels->n = k;
    levels->db[k] = 20.0 * log10(cabs(sum) / (0.1875 * length) + 1e-12);
  }
}

/* A string plucked, and read, at the same part of what sounds of it, where none of the lower
 * partials has a node, and touched at 1/m (0: not at all) for 20 periods. */
static void
pluck_and_touch(Guitar* guitar, uint32_t string, double fret, uint32_t m, Levels* levels) {
  GuitarPatch patch = guitars_patch();
  const double rate_hz = guitar_rate_hz(guitar);
  const double sounding = exp2(-fret / 12.0);
  const double f0_hz = guitars_tone(&patch, string, fret).f0_hz;
  const double touch_s = TOUCH_PERIODS / f0_hz;
  const uint32_t start = (uint32_t)((touch_s + 0.001) * rate_hz);
  patch.pickups[0].place *= sounding;
  guitar_reset(guitar);
  guitar_set_patch(guitar, &patch, 0);
  guitar_fret(guitar, string, fret);
  guitar_pluck(guitar, string, (GuitarPluck){1.0, 0.13 * sounding, 0.8});
  const uint32_t n_masses = guitar_report(guitar).n_masses;
  if (m > 0) {
    guitar_touch(guitar, string, 1.0 / m, touch_s);
  }
  guitars_run(guitar, start + (uint32_t)((WINDOW_PERIODS + 1.0) * rate_hz / f0_hz), sound);
  hear(levels, start, rate_hz, f0_hz, n_masses / 2);
}

typedef struct {
  double least_lost;   /* By those without a node, against a pluck without a touch [dB] */
  double least_over;   /* The first with a node over all that have none [dB] */
  double most_changed; /* Of those with a node, against a pluck without a touch [dB] */
} Harmonic;

static void
try_harmonic(Guitar* guitar, uint32_t string, double fret, uint32_t m, Harmonic* harmonic) {
  Levels open;
  Levels touched;
  double loudest = -HUGE_VAL;
  double over = -HUGE_VAL;
  pluck_and_touch(guitar, string, fret, 0, &open);
  pluck_and_touch(guitar, string, fret, m, &touched);
  for (uint32_t k = 1; k <= open.n; ++k) {
    if (k % m != 0) {
      loudest = fmax(loudest, touched.db[k]);
      if (open.db[k] > open.db[m] - 30.0) {
        harmonic->least_lost = fmin(harmonic->least_lost, open.db[k] - touched.db[k]);
      }
    } else if (open.db[k] > open.db[m] - 60.0) {
      /* One that the pluck or the pickup has a node at has nothing to keep. */
      over = fmax(over, touched.db[k]);
      harmonic->most_changed = fmax(harmonic->most_changed, fabs(touched.db[k] - open.db[k]));
    }
  }
  if (over - loudest < 40.0) {
    print_message("  string %u fret %g, 1/%u at %g Hz: %.1f dB over the others\n", string, fret, m,
                  guitar_rate_hz(guitar), over - loudest);
  }
  harmonic->least_over = fmin(harmonic->least_over, over - loudest);
}

static void harmonic_is_all_that_a_touch_leaves(void** state) {
  (void)state;
  static const double rates_hz[] = {44.1e3, 48e3, 96e3};
  static const double frets[] = {0.0, 5.0, 12.0};
  Harmonic worst = {HUGE_VAL, HUGE_VAL, 0.0};
  const GuitarPatch patch = guitars_patch();
  for (int r = 0; r < 3; ++r) {
    Guitar* const guitar = guitars_new(rates_hz[r], &patch);
    for (uint32_t string = 0; string < 6; ++string) {
      for (int f = 0; f < 3; ++f) {
        for (uint32_t m = 2; m <= 4; ++m) {
          try_harmonic(guitar, string, frets[f], m, &worst);
        }
      }
    }
    guitar_free(guitar);
  }
  assert_within("least that they are over the others [-dB]", -worst.least_over, -40.0);
  assert_within("least that any of the others loses [-dB]", -worst.least_lost, -30.0);
  assert_within("most that they lose [dB]", worst.most_changed, 1.0);
}

/* After it the string is let be: touching and letting go is not damping. */
static void touch_ends_after_its_time(void** state) {
  (void)state;
  enum { TOUCH = 960, AFTER = 48000 };
  const GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitars_new(48e3, &patch);
  const Tone asked = {2.0 * guitars_tone(&patch, 4, 0.0).f0_hz, guitars_tone(&patch, 4, 0.0).tau_s};
  Tone heard = {0};
  guitars_pluck(guitar, 4, 1.0);
  guitar_touch(guitar, 4, 0.5, TOUCH / 48e3);
  guitars_run(guitar, TOUCH + 1000, NULL);
  guitars_run(guitar, AFTER, sound);
  assert_true(measure_tone(sound, AFTER, 48e3, asked, &heard));
  assert_within("cents off the octave", fabs(measure_cents(heard.f0_hz, asked.f0_hz)), 1.0);
  /* The octave's own decay: g2 = z0 + z1 λ2, λ2 being four times λ1 but for the masses. */
  assert_within("decay of the octave, relative", fabs(heard.tau_s * 1.03 / asked.tau_s - 1.0),
                0.005);
  guitar_free(guitar);
}

/* τ of partial k under a palm, by hand from what is printed: "it adds 40 palm² 1/s to their
 * damping" (doc/instruments.md), of which 0.02 sits between the masses. */
static double palmed_tau_s(
    const GuitarPatch* patch, Tone open, double weight, uint32_t k, uint32_t n, double rate_hz) {
  const double tau_s = 1.0 / (1.0 / open.tau_s + 40.0 * weight * weight);
  const double g_open = 1.0 - exp(-2.0 / (open.tau_s * rate_hz));
  const double g = 1.0 - exp(-2.0 / (tau_s * rate_hz));
  const double between = g_open * patch->string.loss + (g - g_open) * 0.02;
  const double ratio =
      pow(sin(0.5 * PI * k / (n + 1.0)), 2.0) / pow(sin(0.5 * PI / (n + 1.0)), 2.0);
  return -2.0 / (rate_hz * log(1.0 - (g - between) - between * ratio));
}

static double worst_palm(Guitar* guitar, double of_patch, double of_hand, double* tau_s) {
  const double rate_hz = guitar_rate_hz(guitar);
  GuitarPatch patch = guitars_patch();
  double worst = 0.0;
  patch.palm = of_patch;
  const Tone open = guitars_tone(&patch, 0, 0.0);
  guitar_reset(guitar);
  guitar_set_patch(guitar, &patch, 0);
  guitar_palm(guitar, of_hand);
  guitars_pluck(guitar, 0, 1.0);
  const uint32_t n_masses = guitar_report(guitar).n_masses;
  guitars_run(guitar, 96000, sound);
  for (uint32_t k = 1; k <= 3; ++k) {
    const double wanted =
        palmed_tau_s(&patch, open, fmin(1.0, of_patch + of_hand), k, n_masses, rate_hz);
    Tone heard = {0};
    const Tone near = {k * open.f0_hz, wanted};
    const uint32_t n = (uint32_t)fmin(96000.0, fmax(6.0 * wanted, 20.0 / open.f0_hz) * rate_hz);
    assert_true(measure_partial(sound + 300, n - 300, rate_hz, near, open.f0_hz, &heard));
    worst = fmax(worst, fabs(heard.tau_s / wanted - 1.0));
    tau_s[k] = heard.tau_s;
  }
  return worst;
}

static void palm_damps_and_dulls_as_its_formula_says(void** state) {
  (void)state;
  static const double weights[][2] = {{0.0, 0.0}, {0.2, 0.0}, {0.0, 0.4},
                                      {0.3, 0.3}, {0.8, 0.0}, {0.0, 1.0}};
  const GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitars_new(48e3, &patch);
  double worst = 0.0;
  double last[4] = {0.0, HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double last_dull = 0.0;
  for (int i = 0; i < 6; ++i) {
    double tau_s[4];
    worst = fmax(worst, worst_palm(guitar, weights[i][0], weights[i][1], tau_s));
    for (int k = 1; k <= 3; ++k) {
      assert_true(tau_s[k] < last[k]);
      last[k] = tau_s[k];
    }
    /* Duller: what the third loses over the fundamental, a second. */
    const double dull = 1.0 / tau_s[3] - 1.0 / tau_s[1];
    assert_true(dull > last_dull);
    last_dull = dull;
  }
  assert_within("τ of three partials, relative", worst, 5e-3);
  double over[4];
  double full[4];
  (void)worst_palm(guitar, 1.0, 0.0, full);
  assert_true(worst_palm(guitar, 0.7, 0.7, over) < 5e-3);
  assert_true(over[1] == full[1]);
  guitar_free(guitar);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(harmonic_is_all_that_a_touch_leaves),
      cmocka_unit_test(touch_ends_after_its_time),
      cmocka_unit_test(palm_damps_and_dulls_as_its_formula_says),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
