/* What is done to a key is done to all its strings, in both directions; and one string alone costs
 * what it did. */
#include "core/harp/harp.h"

#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, MOST = 4 * RATE, GESTURE = 480, LARGEST = 4096 };

static float left[MOST];
static float right[MOST];
static float other_left[MOST];
static float other_right[MOST];

static HarpPatch full_patch(void) {
  HarpPatch patch = harps_patch(0);
  patch.unisons = 3;
  patch.unison_detune = 12.0;
  patch.second = 0.5;
  patch.second_detune = 8.0;
  patch.second_decay = 2.0;
  return patch;
}

static uint32_t n_sounding(const Harp* harp) {
  return harp_report(harp).n_strings;
}

/* The `i`-th of a key, of those that were played: its leader is the first. */
static const HarpString* member(const Harp* harp, uint32_t key, uint32_t i) {
  const HarpString* const leader = &harp->strings[key];
  return i > 0 ? &leader->followers[i - 1] : leader;
}

static double hz_of(const Harp* harp, uint32_t key, uint32_t i) {
  return harps_string_tone(member(harp, key, i)).f0_hz;
}

static void a_key_plays_as_many_as_are_asked(void** state) {
  (void)state;
  for (uint32_t way = 0; way < HARPS_N_WAYS; way += HARPS_N_SENSES) {
    for (uint32_t n = 1; n <= HARP_UNISONS; ++n) {
      for (int second = 0; second < 2; ++second) {
        HarpPatch patch = harps_patch(way);
        patch.unisons = n;
        patch.second = 0.5 * second;
        Harp* const harp = harps_new(RATE, &patch);
        harp_note_on(harp, 0, 60, 100);
        const bool has_second = second && patch.exciter != EXCITER_BOW;
        assert_int_equal(n_sounding(harp), has_second ? 2 * n : n);
        harp_free(harp);
      }
    }
  }
}

/* All else may stand anywhere. */
static void alone_it_is_what_it_was(void** state) {
  (void)state;
  for (uint32_t way = 0; way < HARPS_N_WAYS; ++way) {
    HarpPatch patches[2] = {harps_patch(way), harps_patch(way)};
    patches[1].unison_detune = 20.0;
    patches[1].second_detune = 30.0;
    patches[1].second_decay = 4.0;
    for (int i = 0; i < 2; ++i) {
      Harp* const harp = harps_new(RATE, &patches[i]);
      harp_note_on(harp, 0, 45, 100);
      harp_bend(harp, 0, 0.7);
      harps_run(harp, RATE / 4, i ? other_left : left, i ? other_right : right);
      assert_int_equal(n_sounding(harp), 1);
      assert_false(harp->is_followed);
      harp_free(harp);
    }
    assert_memory_equal(left, other_left, RATE / 4 * sizeof(float));
    assert_memory_equal(right, other_right, RATE / 4 * sizeof(float));
  }
}

/* Chance plays, and it is the same whatever it is cut into. */
static void play_by_chance(Harp* harp, uint32_t most_block, float* to_left, float* to_right) {
  Random random = {12345};
  HarpPatch patch = full_patch();
  for (size_t done = 0; done < 2 * RATE;) {
    const uint32_t channel = random_below(&random, 3);
    const uint32_t key = 40 + 5 * random_below(&random, 8);
    const size_t n = 1 + random_below(&random, 2 * LARGEST);
    switch (random_below(&random, 7)) {
    case 0:
      harp_note_off(harp, channel, key);
      break;
    case 1:
      harp_bend(harp, channel, random_between(&random, -2.0, 2.0));
      break;
    case 2:
      harp_pedal(harp, channel, random_between(&random, 0.0, 1.0));
      break;
    case 3:
      harp_set_gain(harp, channel, random_between(&random, 0.0, 1.0));
      break;
    case 4:
      harp_vibrato(harp, channel, random_between(&random, 0.0, 1.0));
      break;
    case 5:
      patch.unisons = 1 + random_below(&random, 3);
      patch.unison_detune = random_between(&random, 0.0, 20.0);
      patch.second = random_below(&random, 2) ? 0.7 : 0.0;
      patch.second_detune = random_between(&random, 0.0, 30.0);
      patch.second_decay = random_log_between(&random, 0.25, 4.0);
      patch.resonance = random_below(&random, 2) ? 0.7 : 0.0;
      patch.exciter = (Exciter)random_below(&random, 3);
      harp_set_patch(harp, &patch, 64);
      break;
    default:
      harp_note_on(harp, channel, key, 1 + random_below(&random, 127));
      break;
    }
    for (size_t end = done + n; done < end && done < 2 * RATE;) {
      const size_t left_over = (end < 2 * RATE ? end : 2 * RATE) - done;
      const uint32_t block = left_over < most_block ? (uint32_t)left_over : most_block;
      harp_run(harp, block, to_left + done, to_right + done);
      done += block;
    }
  }
}

static void blocks_do_not_change_the_sound(void** state) {
  (void)state;
  const HarpPatch patch = full_patch();
  Harp* const harp = harps_new(RATE, &patch);
  play_by_chance(harp, LARGEST, left, right);
  harps_restart(harp, &patch);
  play_by_chance(harp, 1, other_left, other_right);
  assert_true(measure_peak(left, 2 * RATE) > 0.0);
  assert_memory_equal(left, other_left, 2 * RATE * sizeof(float));
  assert_memory_equal(right, other_right, 2 * RATE * sizeof(float));
  harp_free(harp);
}

static void all_of_all_keys_are_bounded(void** state) {
  (void)state;
  for (uint32_t exciter = 0; exciter < HARPS_N_EXCITERS; ++exciter) {
    HarpPatch patch = full_patch();
    patch.exciter = (Exciter)exciter;
    patch.string.max_masses = 16;
    patch.resonance = 1.0;
    Harp* const harp = harps_new(RATE, &patch);
    for (uint32_t key = 0; key < HARP_KEYS; ++key) {
      harp_note_on(harp, 0, key, 127);
      harp_note_on(harp, 1, key, 127);
    }
    const uint32_t n_each = patch.exciter == EXCITER_BOW ? 3 : 6;
    assert_int_equal(n_sounding(harp), n_each * HARP_STRINGS);
    for (int i = 0; i < 6; ++i) {
      harps_run(harp, LARGEST, left, right);
      assert_true(harp_report(harp).headroom >= 0.0);
      assert_within("peak", fmax(measure_peak(left, LARGEST), measure_peak(right, LARGEST)),
                    2.0 * HARP_STRINGS);
    }
    harp_silence(harp);
    harps_run(harp, RATE / 2, left, right);
    assert_int_equal(n_sounding(harp), 0);
    harps_run(harp, LARGEST, left, right);
    assert_true(patch.exciter == EXCITER_BOW || measure_peak(left, LARGEST) == 0.0);
    harp_free(harp);
  }
}

static void a_key_that_is_up_damps_all(void** state) {
  (void)state;
  const HarpPatch patch = full_patch();
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 60, 100);
  harps_run(harp, RATE / 4, NULL, NULL);
  harp_note_off(harp, 0, 60);
  harps_run(harp, GESTURE, NULL, NULL);
  for (uint32_t i = 0; i < HARP_MEMBERS; ++i) {
    const Tone tone = harps_string_tone(member(harp, 60, i));
    assert_true(fabs(tone.tau_s / patch.string.release_s - 1.0) < 1e-6);
  }
  harps_run(harp, 3 * RATE, NULL, NULL);
  assert_int_equal(n_sounding(harp), 0);
  harp_free(harp);
}

static void bows_leave_all(void** state) {
  (void)state;
  HarpPatch patch = full_patch();
  patch.exciter = EXCITER_BOW;
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 60, 100);
  harps_run(harp, RATE / 4, NULL, NULL);
  assert_int_equal(n_sounding(harp), 3);
  harp_note_off(harp, 0, 60);
  harps_run(harp, 3 * RATE, NULL, NULL);
  assert_int_equal(n_sounding(harp), 0);
  harp_free(harp);
}

static void a_pedal_holds_all_and_lets_all_go(void** state) {
  (void)state;
  const HarpPatch patch = full_patch();
  const double open_s = harps_tone(&patch, 60, 0.0).tau_s;
  Harp* const harp = harps_new(RATE, &patch);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 60, 100);
  harp_note_off(harp, 0, 60);
  harps_run(harp, GESTURE, NULL, NULL);
  for (uint32_t i = 0; i < HARP_MEMBERS; ++i) {
    const double asked = i < HARP_UNISONS ? open_s : 2.0 * open_s;
    assert_true(fabs(harps_string_tone(member(harp, 60, i)).tau_s / asked - 1.0) < 1e-6);
  }
  harp_pedal(harp, 0, 0.0);
  harps_run(harp, 3 * RATE, NULL, NULL);
  assert_int_equal(n_sounding(harp), 0);
  harp_free(harp);
}

static void a_bend_and_a_scale_move_all_alike(void** state) {
  (void)state;
  const HarpPatch patch = full_patch();
  Harp* const harp = harps_new(RATE, &patch);
  double before[HARP_MEMBERS];
  double scale[HARP_KEYS];
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    scale[key] = (double)key - 69.0 + 0.5;
  }
  harp_note_on(harp, 1, 60, 100);
  for (uint32_t i = 0; i < HARP_MEMBERS; ++i) {
    before[i] = hz_of(harp, 60, i);
  }
  harp_bend(harp, 1, 1.5);
  harp_set_scale(harp, 1, scale, true);
  harps_run(harp, GESTURE, NULL, NULL);
  for (uint32_t i = 0; i < HARP_MEMBERS; ++i) {
    assert_true(fabs(measure_cents(hz_of(harp, 60, i), before[i]) - 200.0) < 1e-6);
  }
  harp_free(harp);
}

/* A channel of MPE with a gain of its own: all that it plays is heard with that. */
static void a_gain_is_that_of_all(void** state) {
  (void)state;
  const HarpPatch patch = full_patch();
  Harp* const harp = harps_new(RATE, &patch);
  double worst = 0.0;
  for (int i = 0; i < 2; ++i) {
    harps_restart(harp, &patch);
    harp_set_gain(harp, 3, i ? 0.5 : 1.0);
    harps_run(harp, GESTURE, NULL, NULL);
    harp_note_on(harp, 3, 60, 100);
    harps_run(harp, RATE / 4, i ? other_left : left, i ? other_right : right);
  }
  for (size_t n = 0; n < RATE / 4; ++n) {
    worst = fmax(worst, fabs(2.0 * (double)other_left[n] - (double)left[n]));
  }
  assert_within("off", worst, 1e-9);
  harp_set_gain(harp, 3, 0.0);
  harps_run(harp, RATE / 4, left, right);
  assert_true(measure_peak(left + GESTURE, RATE / 4 - GESTURE) == 0.0);
  harp_free(harp);
}

/* A harp on which the second directions of key 60 ring still, held by a pedal of channel 0. */
static Harp* harp_with_a_sleeping_leader(void) {
  HarpPatch patch = full_patch();
  patch.string.damping_per_s = 20.0;
  patch.second_decay = 4.0;
  Harp* const harp = harps_new(RATE, &patch);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 60, 100);
  harp_note_off(harp, 0, 60);
  for (int i = 0; i < 400 && harp->strings[60].voice.is_awake; ++i) {
    harps_run(harp, GESTURE, NULL, NULL);
  }
  assert_int_equal(n_sounding(harp), 3);
  return harp;
}

static void what_follows_a_string_that_sleeps_is_damped_by_its_pedal(void** state) {
  (void)state;
  Harp* const harp = harp_with_a_sleeping_leader();
  harp_pedal(harp, 2, 1.0);
  harp_pedal(harp, 0, 0.0);
  harps_run(harp, GESTURE, NULL, NULL);
  const double tau_s = harps_string_tone(member(harp, 60, 3)).tau_s;
  assert_true(fabs(tau_s / harp->patch.string.release_s - 1.0) < 1e-6);
  harp_free(harp);
}

/* It is the channel's still, and what has another gain plays another. */
static void what_follows_a_string_that_sleeps_is_still_its_keys(void** state) {
  (void)state;
  Harp* const harp = harp_with_a_sleeping_leader();
  harp_set_gain(harp, 1, 0.5);
  harp_note_on(harp, 1, 60, 100);
  assert_int_equal(n_sounding(harp), 9); /* On a spare string */
  harp_all_sound_off(harp, 0);
  harps_run(harp, RATE / 4, NULL, NULL);
  assert_int_equal(n_sounding(harp), 6);
  harp_free(harp);
}

/* But a finger stops them all; and where nothing rings it costs nothing. */
static void what_is_struck_with_less_lets_the_others_ring_out(void** state) {
  (void)state;
  HarpPatch patch = full_patch();
  patch.exciter = EXCITER_STRIKE;
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 60, 100);
  harps_run(harp, GESTURE, NULL, NULL);
  const double apart = hz_of(harp, 60, 2);
  patch.unisons = 1;
  patch.second = 0.0;
  harp_set_patch(harp, &patch, 0);
  harps_run(harp, GESTURE, NULL, NULL);
  assert_true(fabs(measure_cents(hz_of(harp, 60, 2), apart)) < 1e-6);
  harp_note_on(harp, 0, 60, 100);
  harps_run(harp, GESTURE, NULL, NULL);
  assert_int_equal(n_sounding(harp), 6);
  assert_true(fabs(measure_cents(hz_of(harp, 60, 0), harps_tone(&patch, 60, 0.0).f0_hz)) < 1e-6);
  assert_true(fabs(measure_cents(hz_of(harp, 60, 2), apart)) < 1e-6);
  harp_note_off(harp, 0, 60);
  harps_run(harp, 3 * RATE, NULL, NULL);
  assert_int_equal(n_sounding(harp), 0);
  assert_false(harp->is_followed);
  harp_note_on(harp, 0, 60, 100);
  assert_int_equal(n_sounding(harp), 1);
  harp_free(harp);
}

static void what_rings_is_detuned_as_the_patch_has_it(void** state) {
  (void)state;
  HarpPatch patch = full_patch();
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 60, 100);
  harps_run(harp, GESTURE, NULL, NULL);
  patch.unison_detune = 20.0;
  patch.second_detune = 30.0;
  patch.second_decay = 0.5;
  harp_set_patch(harp, &patch, 64);
  harps_run(harp, GESTURE, NULL, NULL);
  assert_true(fabs(measure_cents(hz_of(harp, 60, 2), hz_of(harp, 60, 0)) - 20.0) < 1e-6);
  assert_true(fabs(measure_cents(hz_of(harp, 60, 3), hz_of(harp, 60, 0)) - 30.0) < 1e-6);
  const double first_s = harps_string_tone(member(harp, 60, 1)).tau_s;
  const double second_s = harps_string_tone(member(harp, 60, 4)).tau_s;
  assert_true(fabs(second_s / first_s - 0.5) < 1e-6);
  harp_free(harp);
}

/* The bridge ties and wakes leaders alone, and those in tune, whatever was played before. */
static void the_bridge_is_the_leaders(void** state) {
  (void)state;
  HarpPatch patch = full_patch();
  patch.resonance = 1.0;
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, 43, 127);
  harps_run(harp, GESTURE, NULL, NULL);
  assert_true(harp->strings[43].cents != 0.0);
  harp_all_sound_off(harp, 0);
  harps_run(harp, RATE / 2, NULL, NULL);
  harp_pedal(harp, 0, 1.0);
  for (uint32_t key = 36; key <= 84; key += 12) {
    harp_note_on(harp, 0, key, 127);
  }
  harps_run(harp, RATE, left, right);
  assert_true(harp_report(harp).headroom >= 0.0);
  assert_true(n_sounding(harp) > 5 * 6 + 20);
  assert_true(harp->strings[43].voice.is_awake);
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    const HarpString* const leader = &harp->strings[i];
    assert_true(!leader->voice.is_awake || tie_is_on(&leader->voice.tie));
    assert_true(!leader->voice.is_awake || leader->holders || leader->cents == 0.0);
    for (uint32_t k = 0; k < HARP_FOLLOWERS; ++k) {
      const bool is_played = leader->holders;
      assert_int_equal(leader->followers[k].voice.is_awake, is_played);
      assert_false(tie_is_on(&leader->followers[k].voice.tie));
    }
  }
  assert_true(measure_peak(left, RATE) < 4.0);
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_key_plays_as_many_as_are_asked),
      cmocka_unit_test(alone_it_is_what_it_was),
      cmocka_unit_test(blocks_do_not_change_the_sound),
      cmocka_unit_test(all_of_all_keys_are_bounded),
      cmocka_unit_test(a_key_that_is_up_damps_all),
      cmocka_unit_test(bows_leave_all),
      cmocka_unit_test(a_pedal_holds_all_and_lets_all_go),
      cmocka_unit_test(a_bend_and_a_scale_move_all_alike),
      cmocka_unit_test(a_gain_is_that_of_all),
      cmocka_unit_test(what_follows_a_string_that_sleeps_is_damped_by_its_pedal),
      cmocka_unit_test(what_follows_a_string_that_sleeps_is_still_its_keys),
      cmocka_unit_test(what_is_struck_with_less_lets_the_others_ring_out),
      cmocka_unit_test(what_rings_is_detuned_as_the_patch_has_it),
      cmocka_unit_test(the_bridge_is_the_leaders),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
