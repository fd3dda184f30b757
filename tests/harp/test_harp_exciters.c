/* Strings of the harp that are struck and bowed: how long that lasts, how it ends, and that what
 * is left is the string's own. */
#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, SECONDS = 8, STRIKE = 3, BOW = 6 };

static float left[SECONDS * RATE];
static float right[SECONDS * RATE];

static double decibels(double ratio) {
  return 20.0 * log10(ratio);
}

/* Of a tenth of a second from `at_s` on. */
static double level_db(double at_s) {
  return decibels(measure_rms(left + (size_t)(at_s * RATE), RATE / 10));
}

static void run(Harp* harp, double from_s, double to_s) {
  const size_t from = (size_t)(from_s * RATE);
  harps_run(harp, (size_t)(to_s * RATE) - from, left + from, right + from);
}

/* Played and, at a second, let go with the pedal down. */
static void play_and_let_go(Harp* harp, uint32_t key, double to_s) {
  harp_note_on(harp, 0, key, 100);
  harp_pedal(harp, 0, 1.0);
  run(harp, 0.0, 1.0);
  harp_note_off(harp, 0, key);
  run(harp, 1.0, to_s);
}

static void what_is_left_is_the_strings_own(void** state) {
  (void)state;
  double cents = 0.0;
  double decay = 0.0;
  for (uint32_t way = STRIKE; way < HARPS_N_WAYS; ++way) {
    HarpPatch patch = harps_patch(way);
    patch.string.damping_per_s = 1.0;
    patch.pickup = 0.45;
    Harp* const harp = harps_new(RATE, &patch);
    for (uint32_t key = 33; key <= 96; key += 9) {
      const Tone asked = harps_tone(&patch, key, 0.0);
      const size_t from = (size_t)(1.2 * RATE);
      Tone heard = {0};
      harps_restart(harp, &patch);
      play_and_let_go(harp, key, 5.0);
      assert_true(measure_tone(left + from, 5 * RATE - from, RATE, asked, &heard));
      cents = fmax(cents, fabs(measure_cents(heard.f0_hz, asked.f0_hz)));
      decay = fmax(decay, fabs(heard.tau_s / asked.tau_s - 1.0));
    }
    harp_free(harp);
  }
  assert_within("cents", cents, 0.005);
  assert_within("decay, relative", decay, 2e-4);
}

static void a_bow_sustains_while_its_key_is_down(void** state) {
  (void)state;
  double worst = 0.0;
  for (uint32_t way = BOW; way < HARPS_N_WAYS; ++way) {
    const HarpPatch patch = harps_patch(way);
    Harp* const harp = harps_new(RATE, &patch);
    for (uint32_t key = 33; key <= 96; key += 3) {
      harps_restart(harp, &patch);
      harp_note_on(harp, 0, key, 100);
      run(harp, 0.0, 3.2);
      worst = fmax(worst, fabs(level_db(3.0) - level_db(1.0)));
      assert_true(level_db(3.0) > -50.0);
    }
    harp_free(harp);
  }
  assert_within("dB from the first second to the third", worst, 1.0);
}

/* With the pedal down too: then the string rings on with its own decay, and without it is damped.
 */
static void a_bow_is_lifted_when_its_key_goes_up(void** state) {
  (void)state;
  double worst = 0.0;
  const HarpPatch patch = harps_patch(BOW);
  Harp* const harp = harps_new(RATE, &patch);
  for (uint32_t key = 33; key <= 96; key += 7) {
    const double tau_s = harps_tone(&patch, key, 0.0).tau_s;
    harps_restart(harp, &patch);
    play_and_let_go(harp, key, 1.02);
    assert_true(harp->strings[key].voice.bow.is_active);
    run(harp, 1.02, 1.04);
    assert_false(harp->strings[key].voice.bow.is_active);
    run(harp, 1.04, 3.2);
    const double fall = decibels(exp(-1.0 / tau_s));
    worst = fmax(worst, fabs(level_db(3.0) - level_db(2.0) - fall));
    harp_pedal(harp, 0, 0.0);
    run(harp, 3.2, 4.0);
    assert_true(level_db(3.8) < level_db(3.0) - 30.0);
  }
  harp_free(harp);
  /* Partials that die faster than the fundamental have their share. */
  assert_within("dB, from the decay of the fundamental", worst, 3.0);
}

static void a_struck_string_is_damped_when_its_key_goes_up(void** state) {
  (void)state;
  const HarpPatch patch = harps_patch(STRIKE);
  Harp* const harp = harps_new(RATE, &patch);
  for (uint32_t key = 33; key <= 96; key += 7) {
    harps_restart(harp, &patch);
    harp_note_on(harp, 0, key, 100);
    run(harp, 0.0, 0.5);
    harp_note_off(harp, 0, key);
    run(harp, 0.5, 1.0);
    /* Three times the release, which is 0.1 s, at least. */
    assert_true(level_db(0.9) < level_db(0.3) - decibels(exp(3.0)));
    assert_true(harp->strings[key].lift == 0.0);
    run(harp, 1.0, 4.0);
    assert_int_equal(harp_report(harp).n_strings, 0);
    assert_true(left[4 * RATE - 1] == 0.0f);
  }
  harp_free(harp);
}

/* The steepest of what was bowed is the slip of its corner. */
static void a_bow_neither_comes_nor_goes_with_a_click(void** state) {
  (void)state;
  for (uint32_t way = BOW; way < HARPS_N_WAYS; ++way) {
    double start = 0.0;
    double lift = 0.0;
    double again = 0.0;
    const HarpPatch patch = harps_patch(way);
    Harp* const harp = harps_new(RATE, &patch);
    for (uint32_t key = 33; key <= 96; key += 3) {
      harps_restart(harp, &patch);
      play_and_let_go(harp, key, 1.5);
      const double bowed = harps_largest_step(left + RATE / 2, RATE / 2);
      start = fmax(start, harps_largest_step(left + 1, RATE / 25) / bowed);
      lift = fmax(lift, harps_largest_step(left + RATE, RATE / 10) / bowed);
      harp_note_on(harp, 0, key, 100);
      run(harp, 1.5, 1.7);
      harp_note_on(harp, 0, key, 100);
      run(harp, 1.7, 2.0);
      again = fmax(again, harps_largest_step(left + RATE * 3 / 2, RATE / 2) / bowed);
    }
    print_message("  %s\n", harps_pickup_type(patch.pickup_type));
    /* Before it has found its motion a string may have a corner more, and one that is bowed again
     * while it rings has two. */
    assert_within("    largest step of the start, of the bowed wave's", start, 1.5);
    assert_within("    of the lift", lift, 1.5);
    assert_within("    of bowing it again", again, 2.0);
    harp_free(harp);
  }
}

static void all_sound_off_and_reset_silence_all_ways(void** state) {
  (void)state;
  double worst_s = 0.0;
  for (uint32_t way = 0; way < HARPS_N_WAYS; ++way) {
    const HarpPatch patch = harps_patch(way);
    Harp* const harp = harps_new(RATE, &patch);
    for (uint32_t key = 33; key <= 96; key += 9) {
      for (int in_contact = 0; in_contact < 2; ++in_contact) {
        const double to_s = in_contact ? 0.001 : 0.3;
        harps_restart(harp, &patch);
        harp_note_on(harp, 0, key, 127);
        run(harp, 0.0, to_s);
        harp_silence(harp);
        run(harp, to_s, 1.5);
        size_t last = (size_t)(to_s * RATE);
        for (size_t i = last; i < RATE * 3 / 2; ++i) {
          last = left[i] != 0.0f || right[i] != 0.0f ? i + 1 : last;
        }
        worst_s = fmax(worst_s, (double)last / RATE - to_s);
        harp_note_on(harp, 0, key, 127);
        run(harp, 0.0, to_s);
        harp_reset(harp);
        run(harp, 0.0, 0.1);
        assert_true(measure_peak(left, RATE / 10) == 0.0);
        assert_int_equal(harp_report(harp).n_strings, 0);
      }
    }
    print_message("  %s, %s: %.3f s\n", harps_exciter(patch.exciter),
                  harps_pickup_type(patch.pickup_type), worst_s);
    harp_free(harp);
  }
  assert_within("longest until exact silence [s]", worst_s, 0.15);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_left_is_the_strings_own),
      cmocka_unit_test(a_bow_sustains_while_its_key_is_down),
      cmocka_unit_test(a_bow_is_lifted_when_its_key_goes_up),
      cmocka_unit_test(a_struck_string_is_damped_when_its_key_goes_up),
      cmocka_unit_test(a_bow_neither_comes_nor_goes_with_a_click),
      cmocka_unit_test(all_sound_off_and_reset_silence_all_ways),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
