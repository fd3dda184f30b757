/* What hands do to strings that ring: bends, brightness, breath and swells. */
#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, KEY = 57, MOST = 4 * RATE, BOWED = 2 * HARPS_N_SENSES };

static float left[MOST];
static float other[MOST];

static void a_hand_bends_what_it_plays(void** state) {
  static const double bends[] = {0.01, 2.0, -12.0, 24.0, -48.0, 48.0, 0.0};
  (void)state;
  const HarpPatch patch = harps_touched_patch(0);
  Harp* const harp = harps_new(RATE, &patch);
  const HarpString* const bent = &harp->strings[KEY];
  const HarpString* const still = &harp->strings[KEY + 1];
  double worst = 0.0;
  for (size_t b = 0; b < sizeof(bends) / sizeof(bends[0]); ++b) {
    harp_note_on(harp, 1, KEY, 100);
    harp_note_on(harp, 2, KEY + 1, 100);
    harp_bend(harp, 1, bends[b]);
    harps_run(harp, 1000, NULL, NULL);
    worst = fmax(worst, fabs(measure_cents(harps_string_tone(bent).f0_hz,
                                           harps_tone(&patch, KEY, bends[b]).f0_hz)));
    worst = fmax(worst, fabs(measure_cents(harps_string_tone(still).f0_hz,
                                           harps_tone(&patch, KEY + 1, 0.0).f0_hz)));
  }
  assert_within("cents", worst, 1e-4);
  harp_free(harp);
}

/* A string bent by up to eight octaves, in what is heard of it: its pitch, and no step of more than
 * a pluck's. */
static void far_bends_are_exact_and_do_not_click(void** state) {
  static const double bends[] = {-36.0, 48.0, -48.0, 12.0, 0.0};
  (void)state;
  const HarpPatch patch = harps_touched_patch(0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, KEY, 127);
  harps_run(harp, RATE / 4, left, NULL);
  double worst = 0.0;
  for (size_t b = 0; b < sizeof(bends) / sizeof(bends[0]); ++b) {
    harps_restart(harp, &patch);
    harp_note_on(harp, 0, KEY, 127);
    harps_run(harp, RATE / 4, left, NULL);
    const double pluck = harps_largest_step(left + 1, RATE / 4 - 1);
    float* const bent = left + RATE / 4;
    harp_bend(harp, 0, bends[b]);
    harps_run(harp, 2 * RATE, bent, NULL);
    const double step = harps_largest_step(bent, 2 * RATE);
    const Tone asked = harps_tone(&patch, KEY, bends[b]);
    Tone heard = {0};
    assert_true(measure_tone(bent + 2000, 2 * RATE - 2000, RATE, asked, &heard));
    worst = fmax(worst, fabs(measure_cents(heard.f0_hz, asked.f0_hz)));
    /* Steps grow with the pitch; and the corner of a pull, moved onto other masses, rings a little.
     */
    assert_within("step, of a pluck's", step / pluck / fmax(1.0, exp2(bends[b] / 12.0)), 1.15);
  }
  assert_within("cents", worst, 0.005);
  harp_free(harp);
}

/* Loudness of a bowed note from a second on, in dB. */
static double bowed_db(Harp* harp) {
  harps_run(harp, RATE, NULL, NULL);
  harps_run(harp, RATE, left, NULL);
  return 20.0 * log10(fmax(measure_rms(left, RATE), 1e-9));
}

static void breath_and_pressure_are_the_bows_strength(void** state) {
  (void)state;
  const HarpPatch patch = harps_touched_patch(BOWED);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, KEY, 80);
  const double full = bowed_db(harp);
  harp_breathe(harp, 0, 0.5);
  assert_within("half a breath, dB off 6", fabs(bowed_db(harp) - full + 6.02), 1.0);
  harp_press(harp, 0, 1.0);
  assert_within("pressed as well, dB", fabs(bowed_db(harp) - full), 1.0);
  harp_breathe(harp, 0, 1.0);
  assert_within("pressed alone, dB off 6", fabs(bowed_db(harp) - full - 6.02), 1.0);
  assert_true(harp->strings[KEY].voice.motion.depth.value == 0.0);
  harp_breathe(harp, 0, 0.0);
  /* Without any it leaves the string, which rings on. */
  harps_run(harp, RATE / 10, NULL, NULL);
  const Tone open = harps_tone(&patch, KEY, 0.0);
  Tone heard = {0};
  harps_run(harp, RATE, left, NULL);
  assert_true(measure_tone(left, RATE, RATE, open, &heard));
  assert_within("τ of what rings on", fabs(heard.tau_s / open.tau_s - 1.0), 1e-3);
  /* A note is as strong as the breath that it meets. */
  harps_restart(harp, &patch);
  harp_breathe(harp, 0, 0.25);
  harp_note_on(harp, 0, KEY, 80);
  assert_within("a quarter, dB off 12", fabs(bowed_db(harp) - full + 12.04), 1.5);
  harp_free(harp);
}

static double loss_of(const HarpString* string) {
  const StringCoefs c = string->voice.chain.goal;
  const double between = c.z1 * tuning_lambda(string->voice.chain.n_masses, 1);
  return between / (c.z0 + between);
}

static void brightness_moves_what_is_between_the_masses(void** state) {
  (void)state;
  const HarpPatch patch = harps_touched_patch(0);
  const double tau_s = harps_tone(&patch, KEY, 0.0).tau_s;
  Harp* const harp = harps_new(RATE, &patch);
  double last = 1.0;
  harp_note_on(harp, 0, KEY, 100);
  for (int step = -4; step <= 4; ++step) {
    harp_brighten(harp, 0, 0.25 * step);
    harps_run(harp, 1000, NULL, NULL);
    const double loss = loss_of(&harp->strings[KEY]);
    assert_within("τ", fabs(harps_string_tone(&harp->strings[KEY]).tau_s / tau_s - 1.0), 1e-9);
    assert_true(loss < 0.8 * last);
    if (step == 0) {
      assert_within("as the patch has it", fabs(loss / patch.string.loss - 1.0), 1e-9);
    }
    last = loss;
  }
  harp_free(harp);
}

/* "towards a tenth of it". */
static void brightness_starts_from_the_loss_of_the_key(void** state) {
  (void)state;
  HarpPatch patch = harps_touched_patch(0);
  patch.string.loss_tracking = -1.5;
  const double wanted = patch.string.loss * exp2(-1.5 * (KEY - 69.0) / 12.0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, KEY, 100);
  harps_run(harp, 1000, NULL, NULL);
  assert_within("as the patch has it", fabs(loss_of(&harp->strings[KEY]) / wanted - 1.0), 1e-9);
  harp_brighten(harp, 0, 1.0);
  harps_run(harp, 1000, NULL, NULL);
  assert_within("a tenth", fabs(loss_of(&harp->strings[KEY]) / (0.1 * wanted) - 1.0), 1e-9);
  harp_free(harp);
}

/* How much of what is heard is above the first partials: mean square of the changes. */
static double sharpness(const float* samples, size_t n) {
  double sum = 0.0;
  for (size_t i = 1; i < n; ++i) {
    const double change = (double)(samples[i] - samples[i - 1]);
    sum += change * change;
  }
  const double rms = measure_rms(samples, n);
  return sqrt(sum / (double)n) / rms;
}

static void a_brighter_hand_plays_brighter_notes(void** state) {
  (void)state;
  for (uint32_t exciter = 0; exciter < 2; ++exciter) {
    const HarpPatch patch = harps_touched_patch(HARPS_N_SENSES * exciter + PICKUP_VELOCITY);
    Harp* const harp = harps_new(RATE, &patch);
    double last = 0.0;
    for (int step = -1; step <= 1; ++step) {
      harps_restart(harp, &patch);
      harp_brighten(harp, 0, step);
      harp_note_on(harp, 0, KEY, 100);
      harps_run(harp, RATE / 5, left, NULL);
      const double now = sharpness(left, RATE / 5);
      print_message("  %s, %+d: %.3g\n", harps_exciter(patch.exciter), step, now);
      assert_true(now > 1.1 * last);
      last = now;
    }
    harp_free(harp);
  }
}

/* Where it would click most. */
static void a_channels_gain_makes_no_step(void** state) {
  (void)state;
  const HarpPatch patch = harps_touched_patch(0);
  Harp* const harp = harps_new(RATE, &patch);
  uint32_t at = RATE / 2;
  harp_note_on(harp, 0, KEY, 100);
  harps_run(harp, RATE, left, NULL);
  for (uint32_t i = at; i < RATE / 2 + 500; ++i) {
    at = fabsf(left[i]) > fabsf(left[at]) ? i : at;
  }
  harps_restart(harp, &patch);
  harp_note_on(harp, 0, KEY, 100);
  harps_run(harp, at, other, NULL);
  harp_set_gain(harp, 0, 0.25);
  harps_run(harp, RATE - at, other + at, NULL);
  assert_memory_equal(left, other, at * sizeof(float));
  assert_true(harps_largest_step(other + at, RATE - at) <=
              harps_largest_step(left + at - 500, RATE - at));
  for (uint32_t i = at + harp->n_gesture; i < RATE; ++i) {
    assert_true(other[i] == 0.25f * left[i]);
  }
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_hand_bends_what_it_plays),
      cmocka_unit_test(far_bends_are_exact_and_do_not_click),
      cmocka_unit_test(breath_and_pressure_are_the_bows_strength),
      cmocka_unit_test(brightness_moves_what_is_between_the_masses),
      cmocka_unit_test(brightness_starts_from_the_loss_of_the_key),
      cmocka_unit_test(a_brighter_hand_plays_brighter_notes),
      cmocka_unit_test(a_channels_gain_makes_no_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
