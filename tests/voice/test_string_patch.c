/* What is printed about a player's settings of strings (doc/instruments.md, the panel, the
 * headers), computed as it is printed. */

#include "core/voice/string_patch.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double RATE_HZ = 48000.0;

static const StringPatch USUAL = {
    .damping_per_s = 0.6,
    .tracking = 0.5,
    .loss = 0.01,
    .partials = PARTIALS_TRUEST,
    .release_s = 0.1,
    .tuning_hz = 440.0,
    .max_masses = 128,
};

/* The string of a key with these settings, as it is stepped. */
static StringCoefs string_of(const StringPatch* patch, int key, double rate_hz, uint32_t n_masses) {
  StringCoefs coefs = {0};
  const TuningTarget target =
      string_patch_target(patch, rate_hz, key - 69, string_patch_pitch_hz(patch, key - 69));
  assert_int_equal(tuning_solve(&target, n_masses, &coefs), STATUS_OK);
  return coefs;
}

/* "the damping is damping · 2^(tracking · (key − 69)/12)": 1/τ of the fundamental that is heard. */
static void tracking_is_a_power_of_two_an_octave(void** state) {
  (void)state;
  double worst = 0.0;
  for (int key = 21; key <= 93; key += 6) {
    for (int step = 0; step <= 4; ++step) {
      StringPatch patch = USUAL;
      patch.tracking = 0.25 * step;
      const StringCoefs coefs = string_of(&patch, key, RATE_HZ, 8);
      const Tone tone = pole_tone(RATE_HZ, tuning_mode(coefs, 8, 1));
      const double printed = 0.6 * pow(2.0, patch.tracking * (key - 69) / 12.0);
      worst = fmax(worst, fabs(1.0 / tone.tau_s / printed - 1.0));
    }
  }
  assert_within("1/τ, relative", worst, 1e-9);
}

/* "partial k lies at k f1 √((1 + B k²)/(1 + B)), where f1 is the pitch": of a string of many
 * masses, over the whole range of B; √(1 + B k²) alone is 82 cents off at B = 0.1. */
static void stiffness_stretches_partials_as_printed(void** state) {
  (void)state;
  double worst = 0.0;
  double worst_pitch = 0.0;
  double other = 0.0;
  for (double b = 1e-6; b < 0.11; b *= 10.0) {
    StringPatch patch = USUAL;
    patch.inharmonicity = b;
    patch.damping_per_s = 1e-3;
    const double rate_hz = 4.8e6;
    const StringCoefs coefs = string_of(&patch, 33, rate_hz, 600);
    const double f1_hz = 440.0 * pow(2.0, (33 - 69) / 12.0);
    for (uint32_t k = 1; k <= 10; ++k) {
      const double heard_hz = pole_tone(rate_hz, tuning_mode(coefs, 600, k)).f0_hz;
      const double printed_hz = k * f1_hz * sqrt((1.0 + b * k * k) / (1.0 + b));
      double* const value = k == 1 ? &worst_pitch : &worst;
      *value = fmax(*value, fabs(1200.0 * log2(heard_hz / printed_hz)));
      other = fmax(other, fabs(1200.0 * log2(heard_hz / (k * f1_hz * sqrt(1.0 + b * k * k)))));
    }
  }
  assert_within("pitch [cents]", worst_pitch, 1e-6);
  assert_within("partials 2 to 10 [cents]", worst, 0.05);
  assert_true(other > 80.0);
}

/* "the loss is loss · 2^(loss_tracking · (key − 69)/12), at most 1": the share of the fundamental's
 * damping that is between the masses, as it is stepped. */
static void loss_follows_the_key_as_printed(void** state) {
  (void)state;
  double worst = 0.0;
  double most = 0.0;
  for (int key = 21; key <= 108; key += 3) {
    for (int step = -4; step <= 8; ++step) {
      StringPatch patch = USUAL;
      patch.loss_tracking = 0.5 * step;
      const StringCoefs coefs = string_of(&patch, key, 1e6, 8);
      const double between = coefs.z1 * (2.0 - 2.0 * cos(acos(-1.0) / 9.0));
      const double printed = fmin(1.0, 0.01 * pow(2.0, patch.loss_tracking * (key - 69) / 12.0));
      worst = fmax(worst, fabs(between / (coefs.z0 + between) / printed - 1.0));
      most = fmax(most, printed);
    }
  }
  assert_within("share, relative", worst, 1e-9);
  assert_true(most == 1.0);
}

/* "B follows stiffness alike, at most 0.1": from partial 5 of a string of many masses. */
static void stiffness_follows_the_key_as_printed(void** state) {
  (void)state;
  double worst = 0.0;
  double most = 0.0;
  for (int key = 21; key <= 108; key += 3) {
    for (int step = 0; step <= 8; ++step) {
      StringPatch patch = USUAL;
      patch.inharmonicity = 1e-3;
      patch.inharmonicity_tracking = 0.5 * step;
      patch.damping_per_s = 1e-3;
      const double rate_hz = 1e8;
      const StringCoefs coefs = string_of(&patch, key, rate_hz, 1000);
      const double first_hz = pole_tone(rate_hz, tuning_mode(coefs, 1000, 1)).f0_hz;
      const double r = pole_tone(rate_hz, tuning_mode(coefs, 1000, 5)).f0_hz / (5.0 * first_hz);
      const double b = (r * r - 1.0) / (25.0 - r * r);
      const double printed =
          fmin(0.1, 1e-3 * pow(2.0, patch.inharmonicity_tracking * (key - 69) / 12.0));
      worst = fmax(worst, fabs(b - printed));
      most = fmax(most, printed);
    }
  }
  assert_within("B", worst, 1e-6);
  assert_true(most == 0.1);
}

/* "the release is release · 2^(−release_tracking · (key − 69)/12), at least 5 ms". */
static void release_follows_the_key_as_printed(void** state) {
  (void)state;
  double worst = 0.0;
  double least = HUGE_VAL;
  for (int key = 21; key <= 108; ++key) {
    for (int step = 0; step <= 8; ++step) {
      StringPatch patch = USUAL;
      patch.release_tracking = 0.25 * step;
      const double printed_s =
          fmax(0.005, 0.1 * pow(2.0, -patch.release_tracking * (key - 69) / 12.0));
      worst = fmax(worst, fabs(string_patch_release_s(&patch, key - 69) / printed_s - 1.0));
      least = fmin(least, printed_s);
    }
  }
  assert_within("τ, relative", worst, 1e-12);
  assert_true(least == 0.005);
}

/* Bit by bit, whatever the key, even where it is set outright to more than tracking may reach. */
static void what_follows_by_nothing_is_what_it_is_set_to(void** state) {
  (void)state;
  StringPatch patch = USUAL;
  patch.inharmonicity = (double)0.1f;
  patch.release_s = (double)0.005f;
  patch.loss = (double)0.3f;
  for (int key = 0; key <= 127; ++key) {
    const TuningTarget target = string_patch_target(&patch, RATE_HZ, key - 69, 440.0);
    assert_true(target.loss == patch.loss && target.inharmonicity == patch.inharmonicity);
    assert_true(string_patch_release_s(&patch, key - 69) == patch.release_s);
  }
}

/* What rings hears of each. */
static void another_tracking_or_tension_does_not_ring_alike(void** state) {
  (void)state;
  StringPatch others[] = {USUAL, USUAL, USUAL, USUAL, USUAL};
  others[1].loss_tracking = 1e-6;
  others[2].inharmonicity_tracking = 1e-6;
  others[3].release_tracking = 1e-6;
  others[4].tension = 1e-6;
  for (int i = 0; i < 5; ++i) {
    assert_int_equal(string_patch_rings_alike(&USUAL, &others[i]), i == 0);
  }
}

/* "frequency of A4, which all keys follow". */
static void keys_follow_a4_in_equal_steps(void** state) {
  (void)state;
  double worst = 0.0;
  StringPatch patch = USUAL;
  patch.tuning_hz = 415.0;
  double printed = 415.0;
  for (int key = 69; key <= 108; ++key) {
    worst = fmax(worst, fabs(string_patch_pitch_hz(&patch, key - 69) / printed - 1.0));
    printed *= pow(2.0, 1.0 / 12.0);
  }
  assert_within("pitch, relative", worst, 1e-13);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(tracking_is_a_power_of_two_an_octave),
      cmocka_unit_test(stiffness_stretches_partials_as_printed),
      cmocka_unit_test(loss_follows_the_key_as_printed),
      cmocka_unit_test(stiffness_follows_the_key_as_printed),
      cmocka_unit_test(release_follows_the_key_as_printed),
      cmocka_unit_test(what_follows_by_nothing_is_what_it_is_set_to),
      cmocka_unit_test(another_tracking_or_tension_does_not_ring_alike),
      cmocka_unit_test(keys_follow_a4_in_equal_steps),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
