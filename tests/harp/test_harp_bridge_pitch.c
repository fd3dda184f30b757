/* Sympathy: the harp's strings on their bridge are as much in tune as they are without. */
#include "core/harp/harp.h"

#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { RATE = 48000 };

static float left[2 * RATE];
static float right[2 * RATE];

static HarpPatch patch_with(double resonance) {
  HarpPatch patch = harps_patch(0);
  patch.resonance = resonance;
  patch.spread = 0.0;
  return patch;
}

/* Measured on what is heard, from a tenth of a second on. */
static Tone heard(const HarpPatch* patch, uint32_t key, double bend, double lift, size_t n_frames) {
  Tone tone = {0};
  Harp* const harp = harps_new(RATE, patch);
  harp_pedal(harp, 0, lift);
  harp_bend(harp, 0, bend == 0.0 ? 0.0 : -bend);
  harp_note_on(harp, 0, key, 110);
  harp_run(harp, RATE / 10, left, right);
  harp_bend(harp, 0, bend);
  harp_run(harp, RATE / 10, left, right);
  harp_run(harp, (uint32_t)n_frames, left, right);
  assert_true(measure_tone(left, n_frames, RATE, harps_tone(patch, key, bend), &tone));
  harp_free(harp);
  return tone;
}

/* Where no other string moves, the solver knows the bridge. */
static void string_alone_is_exact(void** state) {
  (void)state;
  static const double resonances[] = {0.3, 0.6, 1.0};
  double worst_cents = 0.0;
  double worst_decay = 0.0;
  for (uint32_t i = 0; i < 3; ++i) {
    HarpPatch patch = patch_with(resonances[i]);
    patch.string.damping_per_s = 2.0;
    for (uint32_t key = 24; key < 108; key += 7) {
      const double bend = i == 1 ? 2.0 : 0.0;
      const Tone asked = harps_tone(&patch, key, bend);
      const Tone tone = heard(&patch, key, bend, 0.0, RATE);
      worst_cents = fmax(worst_cents, fabs(measure_cents(tone.f0_hz, asked.f0_hz)));
      worst_decay = fmax(worst_decay, fabs(tone.tau_s / asked.tau_s - 1.0));
    }
  }
  assert_within("pitch [cents]", worst_cents, 0.001);
  assert_within("decay", worst_decay, 1e-3);
}

/* The promise: a moderate resonance, the pedal down, all strings open. */
static void moderate_resonance_leaves_the_pitch(void** state) {
  (void)state;
  const HarpPatch patch = patch_with(0.5);
  double worst = 0.0;
  for (uint32_t key = 21; key <= 108; key += 8) {
    const Tone tone = heard(&patch, key, 0.0, 1.0, RATE);
    worst = fmax(worst, fabs(measure_cents(tone.f0_hz, harps_tone(&patch, key, 0.0).f0_hz)));
  }
  assert_within("pitch among open strings [cents]", worst, 0.05);
}

/* A bend that takes masses from a string and gives them back at the next note. */
static void tie_follows_the_masses(void** state) {
  (void)state;
  HarpPatch patch = patch_with(1.0);
  patch.string.damping_per_s = 2.0;
  Harp* const harp = harps_new(RATE, &patch);
  const HarpString* const string = &harp->strings[69];
  Tone tone = {0};
  harp_note_on(harp, 0, 69, 110);
  harp_run(harp, RATE / 10, left, right);
  const uint32_t n_masses = string->voice.chain.n_masses;
  harp_bend(harp, 0, 24.0);
  harp_run(harp, RATE / 10, left, right);
  assert_true(string->voice.chain.n_masses < n_masses);
  assert_int_equal(string->voice.tie.n_masses, string->voice.chain.n_masses);
  harp_run(harp, RATE / 2, left, right);
  const Tone asked = harps_tone(&patch, 69, 24.0);
  assert_true(measure_tone(left, RATE / 2, RATE, asked, &tone));
  assert_within("bent far [cents]", fabs(measure_cents(tone.f0_hz, asked.f0_hz)), 0.01);
  /* It pulls as one that is made for that pitch. */
  const double lever = sqrt(bridge_mass(1760.0) / bridge_mass(440.0));
  const BridgeTie tie =
      bridge_tie(&harp->bridge.bridge, string->voice.chain.now, string->voice.chain.n_masses,
                 (BridgeHold){bridge_mass(440.0), lever});
  assert_true(fabs(string->voice.tie.pull.value / tie.pull - 1.0) < 1e-9);
  assert_true(fabs(string->voice.tie.weight / tie.weight - 1.0) < 1e-9);
  assert_true(fabs(string->voice.tie.spring.value / tie.spring - 1.0) < 1e-9);
  harp_free(harp);
}

/* How far a string's middle moves while the harp runs `n` frames, and where it was. */
static void run_and_watch(Harp* harp, uint32_t key, size_t n, float* middle) {
  for (size_t i = 0; i < n; ++i) {
    harp_run(harp, 1, left, right);
    const Chain* const chain = &harp->strings[key].voice.chain;
    assert_true(harp->strings[key].voice.is_awake);
    middle[i] = chain_position(chain, chain->n_masses / 2);
  }
}

/* The fundamental of a string that nobody played, while it answers its octave. */
static void answering_string_is_in_tune(void** state) {
  (void)state;
  const HarpPatch patch = patch_with(0.5);
  Harp* const harp = harps_new(RATE, &patch);
  Tone tone = {0};
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 57, 110);
  harp_run(harp, RATE / 2, left, right);
  static float middle[2 * RATE];
  run_and_watch(harp, 69, 2 * RATE, middle);
  assert_true(measure_tone(middle, 2 * RATE, RATE, harps_tone(&patch, 69, 0.0), &tone));
  assert_within("answer [cents]", fabs(measure_cents(tone.f0_hz, 440.0)), 0.2);
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(string_alone_is_exact),
      cmocka_unit_test(moderate_resonance_leaves_the_pitch),
      cmocka_unit_test(answering_string_is_in_tune),
      cmocka_unit_test(tie_follows_the_masses),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
