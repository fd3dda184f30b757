/* The bodies that Hooke brings along: modes fit to be stepped, where those of instruments are, and
 * unlike from key to key. */

#include "core/bank/bodies.h"

#include "core/base/maths.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const char* const NAMES[BODIES_COUNT] = {
#define NAME(name, file, text) [BODIES_##name] = (file),
    BODIES_LIST(NAME)
#undef NAME
};

static const Body* body_of(BodiesChoice choice) {
  const Body* const body = bodies_shipped(choice);
  assert_non_null(body);
  return body;
}

static double gain_db(const Body* body, double hz) {
  return 10.0 * log10(body_gain_square(body, (BodyShape){1.0, 1.0}, hz));
}

static double mean_db(const Body* body, double low_hz, double high_hz) {
  double sum = 0.0;
  for (int i = 0; i < 64; ++i) {
    sum += body_gain_square(body, (BodyShape){1.0, 1.0},
                            low_hz * pow(high_hz / low_hz, (i + 0.5) / 64));
  }
  return 10.0 * log10(sum / 64);
}

static void each_choice_is_a_body(void** state) {
  (void)state;
  assert_null(bodies_shipped(BODIES_NONE));
  assert_null(bodies_shipped(BODIES_FILE));
  assert_null(bodies_shipped(BODIES_COUNT));
  for (int i = BODIES_NONE + 1; i < BODIES_FILE; ++i) {
    const Body* const body = body_of((BodiesChoice)i);
    assert_true(body->n_modes >= 100 && body->n_modes <= BODY_MAX_MODES);
    for (uint32_t k = 0; k < body->n_modes; ++k) {
      const BodyMode* const mode = &body->modes[k];
      assert_true(k == 0 || mode->f0_hz > body->modes[k - 1].f0_hz);
      assert_true(mode->f0_hz >= 20.0 && mode->f0_hz <= 20000.0);
      assert_true(mode->q >= 5.0 && mode->q <= 100.0);
      assert_true(mode->mass_kg > 1e-4 && isfinite(mode->mass_kg));
      assert_true(isfinite(mode->radiation[0]) && isfinite(mode->radiation[1]));
    }
    assert_true(body->modes[body->n_modes - 1].f0_hz > 6900.0);
  }
}

static void bodies_are_leveled(void** state) {
  (void)state;
  double worst = 0.0;
  for (int i = BODIES_NONE + 1; i < BODIES_FILE; ++i) {
    Body body = *body_of((BodiesChoice)i);
    body_level(&body);
    for (int band = 0; band < BODY_BANDS; ++band) {
      const double power = bodies_shipped((BodiesChoice)i)->power[band];
      worst = fmax(worst, fabs(body.power[band] / power - 1.0));
    }
  }
  /* Ten digits are written. */
  assert_within("power, relative", worst, 1e-8);
}

/* The first mode from `low_hz` up whose peak is above `least_db`. */
static double strong_mode(const Body* body, double low_hz, double least_db) {
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const double hz = body->modes[k].f0_hz;
    if (hz >= low_hz && gain_db(body, hz) >= least_db) {
      return hz;
    }
  }
  return NAN;
}

static void modes_are_where_instruments_have_them(void** state) {
  (void)state;
  static const struct {
    BodiesChoice body;
    double low_hz;
    double least_db;
    double hz;
    double tolerance; /* As instruments of the kind differ */
  } claims[] = {
      {BODIES_GUITAR, 0.0, -10.0, 107.0, 0.05}, /* Air */
      {BODIES_GUITAR, 195.0, 10.0, 220.0, 0.1}, /* Top and back */
      {BODIES_GUITAR, 400.0, -10.0, 440.0, 0.05},
      {BODIES_CLASSICAL_GUITAR, 0.0, -10.0, 97.0, 0.05},
      {BODIES_CLASSICAL_GUITAR, 120.0, 5.0, 190.0, 0.05},
      {BODIES_VIOLIN, 0.0, -10.0, 281.0, 0.05},   /* 267 to 295 */
      {BODIES_VIOLIN, 440.0, -10.0, 454.0, 0.03}, /* 446 to 462 */
      {BODIES_VIOLIN, 500.0, 5.0, 535.0, 0.05},
      {BODIES_CELLO, 0.0, -10.0, 103.0, 1e-9},
      {BODIES_UPRIGHT_BASS, 0.0, -10.0, 60.0, 1e-9},
  };
  for (size_t i = 0; i < sizeof(claims) / sizeof(claims[0]); ++i) {
    char what[64];
    const double hz = strong_mode(body_of(claims[i].body), claims[i].low_hz, claims[i].least_db);
    (void)snprintf(what, sizeof(what), "%s: %.1f Hz, for %.0f", NAMES[claims[i].body], hz,
                   claims[i].hz);
    assert_within(what, fabs(hz / claims[i].hz - 1.0), claims[i].tolerance);
  }
}

static double n_between(const Body* body, double low_hz, double high_hz) {
  double n = 0.0;
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    n += body->modes[k].f0_hz >= low_hz && body->modes[k].f0_hz < high_hz ? 1.0 : 0.0;
  }
  return n;
}

static void boards_and_boxes_have_their_density(void** state) {
  (void)state;
  const BodiesChoice pianos[] = {BODIES_GRAND, BODIES_UPRIGHT};
  for (int i = 0; i < 2; ++i) {
    const double low = n_between(body_of(pianos[i]), 250.0, 350.0) / 100.0;
    const double high = n_between(body_of(pianos[i]), 4000.0, 6000.0) / 2000.0;
    printf("%s: %.3f per Hz at 300 Hz, %.3f at 5 kHz\n", NAMES[pianos[i]], low, high);
    assert_within("at 300 Hz, to 0.05", fabs(low - 0.05), 0.025);
    assert_within("higher, to 0.01", fabs(high - 0.01), 0.005);
  }
  /* One per 50 Hz and more. */
  assert_true(n_between(body_of(BODIES_GUITAR), 500.0, 1500.0) >= 20.0);
}

/* From 333 to 471 Hz, over a sixth of an octave around each. */
static void the_harp_rises_as_harps_do(void** state) {
  (void)state;
  const double rise =
      mean_db(body_of(BODIES_HARP), 445.0, 499.0) - mean_db(body_of(BODIES_HARP), 314.0, 353.0);
  assert_within("10 to 13 dB", fabs(rise - 11.5), 2.0);
}

/* Partials 1 to 8 of the keys of two octaves and a half: how unlike they are from key to key, and
 * how far formants stand out of a straight line of dB over octaves. */
static void keys_are_unlike_and_formants_stand(void** state) {
  (void)state;
  for (int i = BODIES_NONE + 1; i < BODIES_FILE; ++i) {
    enum { KEYS = 36, PARTIALS = 8 };
    const Body* const body = body_of((BodiesChoice)i);
    /* From a key on that the instrument plays. */
    const int lowest = i == BODIES_VIOLIN || i == BODIES_BANJO || i == BODIES_KALIMBA ? 55 : 40;
    double square = 0.0;
    double sums[5] = {0.0};
    for (int p = 1; p <= PARTIALS; ++p) {
      double sum = 0.0;
      double sum_square = 0.0;
      for (int key = 0; key < KEYS; ++key) {
        const double db = gain_db(body, p * 440.0 * exp2((lowest + key - 69) / 12.0));
        sum += db / KEYS;
        sum_square += db * db / KEYS;
        if (p == 1) {
          const double x = (key - 17.5) / 12.0;
          sums[0] += db / KEYS;
          sums[1] += db * db / KEYS;
          sums[2] += x * db / KEYS;
          sums[3] += x * x / KEYS;
        }
      }
      square += (sum_square - sum * sum) / PARTIALS;
    }
    const double formant = sums[1] - sums[0] * sums[0] - sums[2] * sums[2] / sums[3];
    printf("%-18s partials vary by %4.1f dB, formants by %4.1f dB rms\n", NAMES[i], sqrt(square),
           sqrt(formant));
    assert_true(sqrt(square) >= 4.0 && sqrt(square) <= 10.0);
    assert_true(sqrt(formant) >= 2.0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_choice_is_a_body),
      cmocka_unit_test(bodies_are_leveled),
      cmocka_unit_test(modes_are_where_instruments_have_them),
      cmocka_unit_test(boards_and_boxes_have_their_density),
      cmocka_unit_test(the_harp_rises_as_harps_do),
      cmocka_unit_test(keys_are_unlike_and_formants_stand),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
