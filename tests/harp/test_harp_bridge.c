/* Sympathy: what the bridge does to the harp's strings, and that it does nothing where it is not
 * asked for. */
#include "core/harp/harp.h"
#include "core/string/pickup.h"

#include "tests/support/harps.h"
#include "tests/support/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, MOST_FRAMES = 5 * RATE };

static float left[MOST_FRAMES];
static float right[MOST_FRAMES];

static HarpPatch patch_with(double resonance) {
  HarpPatch patch = harps_patch(0);
  patch.resonance = resonance;
  patch.spread = 0.0;
  return patch;
}

static bool is_bridge_at_rest(const Harp* harp) {
  return harp->bridge.bridge.y == 0.0 && bank_level(&harp->bridge.bridge.bank) == 0.0;
}

static bool is_awake(const Harp* harp, uint32_t key) {
  return harp->strings[key].voice.is_awake;
}

static void without_resonance_there_is_no_bridge(void** state) {
  (void)state;
  const HarpPatch patch = patch_with(0.0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 57, 127);
  for (int i = 0; i < 100; ++i) {
    harp_run(harp, 480, left, right);
    assert_int_equal(harp_report(harp).n_strings, 1);
    assert_int_equal(harp->bridge.n_tied, 0);
    assert_true(is_bridge_at_rest(harp));
  }
  assert_int_equal(harp->strings[57].voice.chain.numbers, CHAIN_FIXED);
  harp_free(harp);
}

/* A harp on which the bridge has moved once sounds as one on which it never did. */
static void bridge_leaves_nothing_behind(void** state) {
  (void)state;
  static float fresh[RATE];
  const HarpPatch still = patch_with(0.0);
  const HarpPatch moving = patch_with(0.7);
  Harp* const harp = harps_new(RATE, &still);
  harp_note_on(harp, 0, 57, 90);
  harp_run(harp, RATE, fresh, right);
  harp_reset(harp);
  harp_set_patch(harp, &moving, 0);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 45, 127);
  harp_run(harp, RATE, left, right);
  assert_int_equal(harp_report(harp).n_strings, 88);
  harp_set_patch(harp, &still, 480);
  harp_silence(harp);
  harp_run(harp, RATE, left, right);
  assert_int_equal(harp_report(harp).n_strings, 0);
  assert_int_equal(harp->bridge.n_tied, 0);
  assert_true(is_bridge_at_rest(harp));
  harp_note_on(harp, 0, 57, 90);
  harp_run(harp, RATE, left, right);
  assert_memory_equal(left, fresh, sizeof(fresh));
  harp_free(harp);
}

static void press_pedal_and_play(Harp* harp, uint32_t n_frames) {
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 45, 127);
  harp_run(harp, n_frames, left, right);
}

/* Nor does it remember which string woke last: strings wake in the order that they have on a new
 * harp. */
static void strings_wake_in_the_same_order_again(void** state) {
  (void)state;
  static float fresh[RATE];
  const HarpPatch patch = patch_with(0.7);
  Harp* const harp = harps_new(RATE, &patch);
  press_pedal_and_play(harp, RATE);
  memcpy(fresh, left, sizeof(fresh));
  harp_reset(harp);
  press_pedal_and_play(harp, 1000);
  assert_in_range(harp_report(harp).n_strings, 2, 87);
  harp_pedal(harp, 0, 0.0);
  harp_silence(harp);
  harp_run(harp, RATE, left, right);
  assert_int_equal(harp_report(harp).n_strings, 0);
  press_pedal_and_play(harp, RATE);
  assert_memory_equal(left, fresh, sizeof(fresh));
  harp_free(harp);
}

/* In decibels, of what the played string moves by at the same time. */
static double answer_db(uint32_t played, uint32_t answering, double resonance, double after_s) {
  static float middle[RATE / 4];
  static float other[RATE / 4];
  const HarpPatch patch = patch_with(resonance);
  Harp* const harp = harps_new(RATE, &patch);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, played, 110);
  harp_run(harp, (uint32_t)(after_s * RATE), left, right);
  for (size_t i = 0; i < RATE / 4; ++i) {
    harp_run(harp, 1, left, right);
    const Chain* const a = &harp->strings[played].voice.chain;
    const Chain* const b = &harp->strings[answering].voice.chain;
    middle[i] = chain_position(a, a->n_masses / 3);
    other[i] = chain_position(b, b->n_masses / 3);
  }
  harp_free(harp);
  return 20.0 * log10(measure_rms(other, RATE / 4) / measure_rms(middle, RATE / 4));
}

static void open_octaves_answer_and_others_less(void** state) {
  (void)state;
  const double above = answer_db(57, 69, 0.5, 1.0);
  const double below = answer_db(57, 45, 0.5, 1.0);
  const double beside = answer_db(57, 58, 0.5, 1.0);
  const double rich = answer_db(57, 69, 1.0, 1.0);
  print_message("  octave above %.1f dB, below %.1f, semitone %.1f; at full resonance %.1f\n",
                above, below, beside, rich);
  assert_true(above > -40.0 && above < -25.0);
  assert_true(below > -43.0 && below < -28.0);
  assert_true(beside < above - 20.0 && beside < below - 20.0);
  assert_true(rich > -20.0 && rich < -6.0);
}

/* What the pedal adds to the second second of a note, in decibels of the note. */
static double halo_db(uint32_t key, double resonance) {
  static float dry[2 * RATE];
  const HarpPatch patch = patch_with(resonance);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, key, 110);
  harp_run(harp, 2 * RATE, dry, right);
  harp_reset(harp);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, key, 110);
  harp_run(harp, 2 * RATE, left, right);
  for (size_t i = 0; i < 2 * RATE; ++i) {
    left[i] -= dry[i];
  }
  harp_free(harp);
  return 20.0 * log10(measure_rms(left + RATE, RATE) / measure_rms(dry + RATE, RATE));
}

static void pedal_is_heard(void** state) {
  (void)state;
  for (uint32_t key = 33; key <= 81; key += 12) {
    const double half = halo_db(key, 0.5);
    const double full = halo_db(key, 1.0);
    print_message("  key %u: %.1f dB at half resonance, %.1f at full\n", key, half, full);
    assert_true(half > -40.0 && half < -15.0);
    assert_true(full > half + 6.0 && full < 3.0);
  }
}

static void damped_strings_sleep_on(void** state) {
  (void)state;
  const HarpPatch patch = patch_with(1.0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 57, 127);
  harp_run(harp, RATE, left, right);
  assert_int_equal(harp_report(harp).n_strings, 1);
  assert_true(harp->bridge.bridge.y != 0.0);
  harp_free(harp);
}

/* The pedal lifts all dampers, whenever it comes down; each of the keys of a piano has a string. */
static void pedal_opens_all_strings_and_closes_them(void** state) {
  (void)state;
  const HarpPatch patch = patch_with(0.5);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 57, 127);
  harp_run(harp, RATE / 10, left, right);
  harp_pedal(harp, 0, 1.0);
  uint32_t before = 1;
  for (int i = 0; i < 88; ++i) {
    harp_run(harp, 64, left, right);
    const uint32_t now = harp_report(harp).n_strings;
    assert_true(now <= before + 2);
    before = now;
  }
  assert_int_equal(before, 88);
  assert_true(is_awake(harp, 21) && is_awake(harp, 108));
  assert_false(is_awake(harp, 20) || is_awake(harp, 109));
  harp_pedal(harp, 0, 0.0);
  harp_run(harp, 2 * RATE, left, right);
  assert_int_equal(harp_report(harp).n_strings, 1);
  assert_true(is_awake(harp, 57));
  harp_free(harp);
}

/* A key that is held opens its own string, long after it has died away. */
/* Whichever channel it is whose pedal is down, and at its gain; another's pedal lets them be. */
static void any_channels_pedal_opens_what_sleeps(void** state) {
  static float first[RATE];
  (void)state;
  const HarpPatch patch = patch_with(0.5);
  for (uint32_t channel = 0; channel < HARP_CHANNELS; channel += 5) {
    Harp* const harp = harps_new(RATE, &patch);
    harp_pedal(harp, 3, 0.3);
    harp_pedal(harp, channel, 1.0);
    harp_set_gain(harp, channel, 0.5);
    harp_bend(harp, channel, 0.25);
    harp_note_on(harp, channel, 57, 110);
    harp_run(harp, RATE / 2, left, right);
    harp_pedal(harp, 3, 0.0);
    harp_run(harp, RATE / 2, left + RATE / 2, right + RATE / 2);
    assert_true(harp_report(harp).n_strings > 60);
    if (channel > 0) {
      assert_memory_equal(left, first, sizeof(first));
    }
    memcpy(first, left, sizeof(first));
    harp_free(harp);
  }
}

static void held_key_answers(void** state) {
  (void)state;
  HarpPatch patch = patch_with(0.5);
  patch.string.damping_per_s = 10.0;
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 69, 1);
  harp_run(harp, 3 * RATE, left, right);
  assert_false(is_awake(harp, 69));
  harp_note_on(harp, 0, 57, 127);
  harp_run(harp, RATE / 10, left, right);
  assert_int_equal(harp_report(harp).n_strings, 2);
  assert_true(is_awake(harp, 69));
  assert_true(harp->strings[69].voice.loudest > 0.0);
  harp_free(harp);
}

/* A string under its damper is let go, and rings on in the numbers that it would have alone. */
static void string_whose_damper_falls_is_let_go(void** state) {
  (void)state;
  HarpPatch patch = patch_with(1.0);
  patch.string.release_s = 10.0;
  patch.string.damping_per_s = 0.1;
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 57, 127);
  harp_run(harp, RATE / 10, left, right);
  assert_int_equal(harp->bridge.n_tied, 1);
  harp_note_off(harp, 0, 57);
  harp_run(harp, RATE / 10, left, right);
  assert_true(is_awake(harp, 57));
  assert_int_equal(harp->bridge.n_tied, 0);
  assert_int_equal(harp->strings[57].voice.chain.numbers, CHAIN_FIXED);
  harp_free(harp);
}

/* Nobody plays any more: everything comes to rest by itself, in exact zeros. */
static void all_that_answers_dies_away(void** state) {
  (void)state;
  HarpPatch patch = patch_with(0.8);
  patch.string.damping_per_s = 12.0;
  patch.string.tracking = 0.0;
  Harp* const harp = harps_new(RATE, &patch);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 45, 127);
  harp_run(harp, RATE / 4, left, right);
  assert_int_equal(harp_report(harp).n_strings, 88);
  harp_run(harp, 4 * RATE, left, right);
  assert_int_equal(harp_report(harp).n_strings, 0);
  harp_run(harp, 4800, left, right);
  for (size_t i = 0; i < 4800; ++i) {
    assert_true(left[i] == 0.0f && right[i] == 0.0f);
  }
  assert_true(is_bridge_at_rest(harp) && harp->bridge.level == 0.0);
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_resonance_there_is_no_bridge),
      cmocka_unit_test(bridge_leaves_nothing_behind),
      cmocka_unit_test(strings_wake_in_the_same_order_again),
      cmocka_unit_test(open_octaves_answer_and_others_less),
      cmocka_unit_test(pedal_is_heard),
      cmocka_unit_test(damped_strings_sleep_on),
      cmocka_unit_test(pedal_opens_all_strings_and_closes_them),
      cmocka_unit_test(any_channels_pedal_opens_what_sleeps),
      cmocka_unit_test(held_key_answers),
      cmocka_unit_test(string_whose_damper_falls_is_let_go),
      cmocka_unit_test(all_that_answers_dies_away),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
