/* The ear that judges the instruments hears what the recommendation says. */
#include "tests/support/loudness.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { RATE = 48000 };

static const double PI = 3.14159265358979323846;

static float left[RATE];
static float right[RATE];

static double loudness_of(double f_hz, double amplitude, size_t n) {
  for (size_t i = 0; i < RATE; ++i) {
    left[i] = i < n ? (float)(amplitude * sin(2.0 * PI * f_hz * (double)i / RATE)) : 0.0f;
    right[i] = 0.0f;
  }
  return loudness_lufs(left, right, RATE);
}

/* The recommendation's own example: 997 Hz at full scale on one side. */
static void a_full_tone_on_one_side_is_three_below(void** state) {
  (void)state;
  assert_true(fabs(loudness_of(997.0, 1.0, RATE) + 3.01) < 0.02);
}

static void half_as_large_is_six_less(void** state) {
  (void)state;
  const double full = loudness_of(997.0, 1.0, RATE);
  assert_true(fabs(loudness_of(997.0, 0.5, RATE) - full + 6.0206) < 1e-3);
}

static void both_sides_are_three_louder_than_one(void** state) {
  (void)state;
  const double one = loudness_of(997.0, 1.0, RATE);
  assert_true(fabs(loudness_lufs(left, left, RATE) - one - 3.0103) < 1e-6);
}

/* The analog filters that the recommendation's are made from. */
static double shelf_db(double f_hz) {
  const double r = f_hz / 1681.974450955533;
  const double q = 0.7071752369554196;
  const double high = pow(10.0, 3.999843853973347 / 20.0);
  const double band = pow(high, 0.4996667741545416);
  const double over = hypot(1.0 - high * r * r, band * r / q);
  return 20.0 * log10(over / hypot(1.0 - r * r, r / q));
}

static double low_db(double f_hz) {
  const double r = f_hz / 38.13547087602444;
  return 20.0 * log10(r * r / hypot(1.0 - r * r, r / 0.5003270373238773));
}

static void the_ear_is_dull_below_and_keen_above(void** state) {
  (void)state;
  static const double tones_hz[] = {20.0, 30.0, 60.0, 200.0, 1500.0, 3000.0, 6000.0};
  const double middle = loudness_of(997.0, 1.0, RATE) - shelf_db(997.0) - low_db(997.0);
  for (size_t i = 0; i < sizeof(tones_hz) / sizeof(tones_hz[0]); ++i) {
    const double heard = loudness_of(tones_hz[i], 1.0, RATE) - middle;
    assert_true(fabs(heard - shelf_db(tones_hz[i]) - low_db(tones_hz[i])) < 0.05);
  }
}

static void the_loudest_400_ms_count(void** state) {
  (void)state;
  const double whole = loudness_of(997.0, 1.0, RATE);
  assert_true(fabs(loudness_of(997.0, 1.0, 2 * RATE / 5) - whole) < 0.01);
  assert_true(fabs(loudness_of(997.0, 1.0, RATE / 5) - whole + 3.0103) < 0.02);
  assert_true(isinf(loudness_of(997.0, 0.0, RATE)));
}

static void any_rate_hears_alike(void** state) {
  static float at_44[44100];
  static float at_96[96000];
  /* Bilinear filters are a little apart towards half the rate. */
  static const double tones_hz[] = {30.0, 60.0, 440.0, 3000.0};
  (void)state;
  for (int t = 0; t < 4; ++t) {
    const double turn = 2.0 * 3.14159265358979323846 * tones_hz[t];
    static float at_48[48000];
    for (int i = 0; i < 96000; ++i) {
      at_96[i] = 0.1f * (float)sin(turn * i / 96000.0);
      at_48[i / 2] = at_96[i & ~1];
    }
    for (int i = 0; i < 44100; ++i) {
      at_44[i] = 0.1f * (float)sin(turn * i / 44100.0);
    }
    const double lufs = loudness_lufs(at_48, at_48, 48000);
    assert_within("dB at 48 kHz", fabs(loudness_lufs_at(48000.0, at_48, at_48, 48000) - lufs),
                  1e-6);
    assert_within("dB at 44.1 kHz", fabs(loudness_lufs_at(44100.0, at_44, at_44, 44100) - lufs),
                  0.02);
    assert_within("dB at 96 kHz", fabs(loudness_lufs_at(96000.0, at_96, at_96, 96000) - lufs),
                  0.02);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_full_tone_on_one_side_is_three_below),
      cmocka_unit_test(half_as_large_is_six_less),
      cmocka_unit_test(both_sides_are_three_louder_than_one),
      cmocka_unit_test(the_ear_is_dull_below_and_keen_above),
      cmocka_unit_test(the_loudest_400_ms_count),
      cmocka_unit_test(any_rate_hears_alike),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
