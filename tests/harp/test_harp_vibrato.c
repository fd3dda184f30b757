/* Vibrato of the harp, by the wheel and by pressure: how deep, how exact in its mean, and whose. */
#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RATE = 48000, KEY = 57, MOST = 2 * RATE, SWING = RATE / 5 };

static const double PI = 3.14159265358979323846;

static float left[MOST];
static float other[MOST];

/* The phase [cycles] of what is heard around `at`, against a steady tone of `f_hz`. */
static double phase_at(const float* samples, size_t at, size_t n_window, double f_hz) {
  double re = 0.0;
  double im = 0.0;
  for (size_t i = 0; i < n_window; ++i) {
    const double angle = 2.0 * PI * f_hz * (double)(at + i) / RATE;
    const double w = 1.0 - cos(2.0 * PI * ((double)i + 0.5) / (double)n_window);
    re += w * (double)samples[at + i] * cos(angle);
    im -= w * (double)samples[at + i] * sin(angle);
  }
  return atan2(im, re) / (2.0 * PI);
}

/* How far the mean of what is heard over `n` frames, so many whole swings, is above `f_hz`. */
static double mean_above_hz(const float* samples, size_t n, double f_hz) {
  enum { HOP = 300 };
  const size_t n_window = (size_t)(8.0 * RATE / f_hz);
  double last = phase_at(samples, 0, n_window, f_hz);
  double cycles = 0.0;
  for (size_t at = HOP; at <= n; at += HOP) {
    const double now = phase_at(samples, at, n_window, f_hz);
    cycles += (now - last) - round(now - last);
    last = now;
  }
  return cycles * RATE / (double)n;
}

/* Over nine whole swings. */
static void a_vibrato_is_exact_in_its_mean(void** state) {
  (void)state;
  HarpPatch patch = harps_touched_patch(0);
  patch.string.damping_per_s = 0.05;
  Harp* const harp = harps_new(RATE, &patch);
  const double f0_hz = harps_tone(&patch, KEY, 0.0).f0_hz;
  harp_note_on(harp, 0, KEY, 127);
  harp_vibrato(harp, 0, 0.5);
  harps_run(harp, RATE, left, NULL);
  double lowest = 1.0;
  double highest = 0.0;
  for (uint32_t n = 0; n < 2 * RATE; n += 32) {
    const HarpString* const string = &harp->strings[KEY];
    harps_run(harp, 32, left + n, NULL);
    const double f_hz =
        pole_tone(RATE, tuning_mode(string->voice.chain.now, string->voice.chain.n_masses, 1))
            .f0_hz;
    lowest = fmin(lowest, measure_cents(f_hz, f0_hz));
    highest = fmax(highest, measure_cents(f_hz, f0_hz));
  }
  assert_within("sharp side, off half a semitone [cents]", fabs(highest - 50.0), 0.2);
  assert_within("flat side, off the same in Hz [cents]",
                fabs(lowest - 1200.0 * log2(2.0 - exp2(0.5 / 12.0))), 0.2);
  const double above_hz = mean_above_hz(left, 9 * SWING, f0_hz);
  assert_within("mean, off in cents", fabs(measure_cents(f0_hz + above_hz, f0_hz)), 0.01);
  harp_vibrato(harp, 0, 0.0);
  harps_run(harp, 2000, NULL, NULL);
  assert_within("cents once it is over",
                fabs(measure_cents(harps_string_tone(&harp->strings[KEY]).f0_hz, f0_hz)), 1e-4);
  harp_free(harp);
}

/* Largest way from its place that a string's pitch is on within half a second [cents]. */
static double swing_of(Harp* harp, uint32_t key) {
  const HarpString* const string = &harp->strings[key];
  const double f0_hz = harp_string_pitch_hz(string);
  double most = 0.0;
  for (uint32_t n = 0; n < RATE / 2; n += 64) {
    harps_run(harp, 64, NULL, NULL);
    const Pole pole = tuning_mode(string->voice.chain.now, string->voice.chain.n_masses, 1);
    most = fmax(most, fabs(measure_cents(pole_tone(RATE, pole).f0_hz, f0_hz)));
  }
  return most;
}

static void pressure_swings_the_keys_that_it_is_on(void** state) {
  (void)state;
  const HarpPatch patch = harps_touched_patch(0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 1, KEY, 100);
  harp_note_on(harp, 1, KEY + 1, 100);
  harp_note_on(harp, 2, KEY + 2, 100);
  harp_press_key(harp, 1, KEY, 1.0);
  harp_press_key(harp, 2, KEY + 1, 1.0);
  assert_within("half a semitone [cents]", fabs(swing_of(harp, KEY) - 50.0), 2.0);
  assert_true(swing_of(harp, KEY + 1) < 1e-4);
  harp_press(harp, 1, 0.5);
  assert_within("the hardest counts [cents]", fabs(swing_of(harp, KEY) - 50.0), 2.0);
  assert_within("a quarter [cents]", fabs(swing_of(harp, KEY + 1) - 25.0), 1.0);
  assert_true(swing_of(harp, KEY + 2) < 1e-4);
  /* Until it is up. */
  harp_press(harp, 1, 0.0);
  harp_pedal(harp, 1, 1.0);
  harp_note_off(harp, 1, KEY);
  harps_run(harp, 1000, NULL, NULL);
  assert_true(swing_of(harp, KEY) < 1e-4);
  harp_note_on(harp, 1, KEY, 100);
  harp_press_key(harp, 1, KEY, 1.0);
  harp_silence(harp);
  harp_note_on(harp, 1, KEY, 100);
  harps_run(harp, 1000, NULL, NULL);
  assert_true(swing_of(harp, KEY) < 1e-4);
  harp_free(harp);
}

/* A note that is played under a vibrato has it, and so has one that follows another. */
static void a_vibrato_waits_for_notes(void** state) {
  (void)state;
  const HarpPatch patch = harps_touched_patch(0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_vibrato(harp, 0, 0.3);
  for (int again = 0; again < 3; ++again) {
    harp_note_on(harp, 0, KEY, 100);
    assert_within("off 30 cents", fabs(swing_of(harp, KEY) - 30.0), 1.0);
  }
  harp_free(harp);
}

/* Nor does it begin in the middle of the last one's. */
static void a_vibrato_begins_with_its_note(void** state) {
  (void)state;
  HarpPatch patch = harps_touched_patch(0);
  patch.string.damping_per_s = 50.0;
  Harp* const harp = harps_new(RATE, &patch);
  harp_vibrato(harp, 0, 0.3);
  for (int again = 0; again < 3; ++again) {
    harp_note_on(harp, 0, KEY, 100);
    harps_run(harp, RATE, again == 0 ? left : other, NULL);
    assert_int_equal(harp_report(harp).n_strings, 0);
    if (again > 0) {
      assert_memory_equal(left, other, RATE * sizeof(float));
    }
    harps_run(harp, 777, NULL, NULL);
  }
  harp_free(harp);
}

/* However many other gestures come meanwhile, it swings at its rate: a whole number of swings later
 * it is where it was. */
static void other_gestures_do_not_hurry_a_vibrato(void** state) {
  (void)state;
  const HarpPatch patch = harps_touched_patch(0);
  Harp* const harp = harps_new(RATE, &patch);
  Harp* const alone = harps_new(RATE, &patch);
  for (int h = 0; h < 2; ++h) {
    harp_note_on(h ? alone : harp, 0, KEY, 100);
    harp_vibrato(h ? alone : harp, 0, 0.3);
  }
  double most = 0.0;
  for (int n = 0; n < RATE; n += 48) {
    harp_press_key(harp, 0, KEY, n % 96 ? 1e-6 : 0.0);
    harps_run(harp, 48, NULL, NULL);
    harps_run(alone, 48, NULL, NULL);
    if (n > RATE / 10) {
      const VoiceMotion* const a = &harp->strings[KEY].voice.motion;
      const VoiceMotion* const b = &alone->strings[KEY].voice.motion;
      const double apart = a->phase - b->phase;
      most = fmax(most, fabs(apart - round(apart)));
    }
  }
  /* Both are at the ends of their pieces, of a gesture at most. */
  assert_within("of a swing", most, patch.vibrato_hz * (double)harp->n_gesture / RATE);
  harp_free(alone);
  harp_free(harp);
}

/* A host that automates something with large blocks. */
static void slow_changes_do_not_stretch_a_vibrato(void** state) {
  (void)state;
  HarpPatch patch = harps_touched_patch(0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_vibrato(harp, 0, 0.3);
  harp_note_on(harp, 0, KEY, 100);
  for (int block = 0; block < 4; ++block) {
    patch.string.damping_per_s *= 1.01;
    harp_set_patch(harp, &patch, RATE / 2);
    assert_within("off 30 cents", fabs(swing_of(harp, KEY) - 30.0), 1.0);
  }
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_vibrato_is_exact_in_its_mean),
      cmocka_unit_test(pressure_swings_the_keys_that_it_is_on),
      cmocka_unit_test(a_vibrato_waits_for_notes),
      cmocka_unit_test(a_vibrato_begins_with_its_note),
      cmocka_unit_test(other_gestures_do_not_hurry_a_vibrato),
      cmocka_unit_test(slow_changes_do_not_stretch_a_vibrato),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
