/* Who plays which string: channels and spare strings. */
#include "core/harp/harp_channels.h"
#include "tests/support/harp_notes.h"
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

enum { RATE = HARP_NOTES_RATE, KEY = 57 };

static float left[RATE];

/* The spare string that a key has; there has to be one. */
static const HarpString* spare_at(const Harp* harp, uint32_t key) {
  for (uint32_t i = HARP_KEYS; i < HARP_STRINGS; ++i) {
    const HarpString* const spare = &harp->strings[i];
    if (spare->voice.is_awake && spare->key == key) {
      return spare;
    }
  }
  fail();
  return NULL;
}

static void two_channels_have_a_string_each_at_one_key(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  harp_bend(harp, 3, 0.5);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  assert_int_equal(harp_report(harp).n_strings, 2);
  harp_notes_check_pitch(harp, &harp->strings[KEY], 0.0);
  harp_notes_check_pitch(harp, spare_at(harp, KEY), 0.5);
  harp_bend(harp, 2, -7.0);
  harp_notes_check_pitch(harp, &harp->strings[KEY], -7.0);
  harp_notes_check_pitch(harp, spare_at(harp, KEY), 0.5);
  harp_free(harp);
}

static void a_channel_lets_up_its_own_key_only(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  harp_note_off(harp, 4, KEY);
  harp_notes_check_decay(harp, &harp->strings[KEY], harp_notes_open_s(KEY));
  harp_note_off(harp, 3, KEY);
  harp_notes_check_decay(harp, &harp->strings[KEY], harp_notes_open_s(KEY));
  harp_notes_check_decay(harp, spare_at(harp, KEY), HARP_NOTES_RELEASE_S);
  harp_all_notes_off(harp, 2);
  harp_notes_check_decay(harp, &harp->strings[KEY], HARP_NOTES_RELEASE_S);
  harp_free(harp);
}

static void one_channel_has_one_string_at_a_key(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  assert_int_equal(harp_report(harp).n_strings, 2);
  assert_int_equal(harp->strings[KEY].channel, 2);
  harp_free(harp);
}

static void a_spare_string_that_rings_is_left_alone(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  for (uint32_t key = KEY; key < KEY + 3; ++key) {
    harp_pedal(harp, 3, 1.0);
    harp_note_on(harp, 2, key, 100);
    harp_note_on(harp, 3, key, 100);
    harp_note_off(harp, 3, key);
  }
  assert_int_equal(harp_report(harp).n_strings, 6);
  for (uint32_t key = KEY; key < KEY + 3; ++key) {
    harp_notes_check_pitch(harp, spare_at(harp, key), 0.0);
  }
  /* But by the same key it is played again. */
  harp_note_on(harp, 3, KEY + 1, 100);
  assert_int_equal(harp_report(harp).n_strings, 6);
  harp_free(harp);
}

static void a_key_that_is_up_is_taken_over(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  harp_pedal(harp, 2, 1.0);
  harp_bend(harp, 3, 2.0);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_off(harp, 2, KEY);
  harp_note_on(harp, 3, KEY, 100);
  assert_int_equal(harp_report(harp).n_strings, 1);
  harp_notes_check_pitch(harp, &harp->strings[KEY], 2.0);
  harp_note_off(harp, 3, KEY);
  harp_notes_check_decay(harp, &harp->strings[KEY], HARP_NOTES_RELEASE_S);
  harp_free(harp);
}

/* Sixteen channels at three keys: three strings of their own, and 45 spare ones wanted where 32
 * are. */
static void when_spare_strings_run_out_none_is_stolen(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    for (uint32_t key = KEY; key < KEY + 3; ++key) {
      harp_note_on(harp, channel, key, 100);
      harps_run(harp, 64, NULL, NULL);
    }
  }
  assert_int_equal(harp_report(harp).n_strings, 3 + HARP_SPARES);
  for (uint32_t i = HARP_KEYS; i < HARP_STRINGS; ++i) {
    assert_true(harp->strings[i].holders);
  }
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    harp_all_notes_off(harp, channel);
  }
  harps_run(harp, RATE, NULL, NULL);
  harps_run(harp, RATE, NULL, NULL);
  assert_int_equal(harp_report(harp).n_strings, 0);
  harp_free(harp);
}

static uint32_t n_holders(const HarpString* string) {
  uint32_t n = 0;
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    n += string->holders >> channel & 1;
  }
  return n;
}

/* With no spare string left, the last channels share the string of the key. */
static void a_shared_string_sounds_until_the_last_lets_go(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    for (uint32_t key = KEY; key < KEY + 3; ++key) {
      harp_note_on(harp, channel, key, 100);
    }
  }
  const HarpString* const shared = &harp->strings[KEY];
  assert_true(n_holders(shared) > 1);
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    const bool is_last = n_holders(shared) == 1 && harp_channels_holds(shared, channel);
    harp_note_off(harp, channel, KEY);
    harp_notes_check_decay(harp, shared, is_last ? HARP_NOTES_RELEASE_S : harp_notes_open_s(KEY));
    if (is_last) {
      harp_free(harp);
      return;
    }
  }
  fail();
}

/* What two channels play, one of them at a quarter of its loudness, is the sum of both alone. */
static void a_channel_has_a_gain_of_its_own(void** state) {
  (void)state;
  enum { QUIET = 1, LOUD = 4, OTHER_KEY = KEY + 7 };
  static float alone[2][RATE];
  for (int is_tied = 0; is_tied < 2; ++is_tied) {
    HarpPatch patch = harp_notes_patch();
    patch.resonance = is_tied ? 1e-4 : 0.0;
    Harp* const harp = harps_new(RATE, &patch);
    Harp* const first = harps_new(RATE, &patch);
    Harp* const second = harps_new(RATE, &patch);
    harp_set_gain(harp, QUIET, 0.25);
    harps_run(harp, harp->n_gesture, NULL, NULL);
    harp_note_on(harp, QUIET, KEY, 100);
    harp_note_on(harp, LOUD, OTHER_KEY, 100);
    harp_note_on(first, QUIET, KEY, 100);
    harp_note_on(second, LOUD, OTHER_KEY, 100);
    harps_run(harp, RATE, left, NULL);
    harps_run(first, RATE, alone[0], NULL);
    harps_run(second, RATE, alone[1], NULL);
    double error = 0.0;
    for (uint32_t n = 0; n < RATE; ++n) {
      const double sum = 0.25 * (double)alone[0][n] + (double)alone[1][n];
      error = fmax(error, fabs((double)left[n] - sum));
    }
    assert_within("of full scale", error, 2e-6);
    assert_true(measure_peak(alone[0], RATE) > 0.05);
    harp_free(harp);
    harp_free(first);
    harp_free(second);
  }
}

/* A gain that moves while a note rings goes there in a straight line, at its channel alone,
 * whatever pickups hear. */
static void a_gain_moves_in_a_straight_line(void** state) {
  (void)state;
  static float as_it_is[RATE];
  for (int type = 0; type < 3; ++type) {
    HarpPatch patch = harp_notes_patch();
    patch.pickup_type = (PickupType)type;
    Harp* const harp = harps_new(RATE, &patch);
    Harp* const still = harps_new(RATE, &patch);
    harp_note_on(harp, 2, KEY, 100);
    harp_note_on(still, 2, KEY, 100);
    harps_run(harp, 1000, NULL, NULL);
    harps_run(still, 1000, NULL, NULL);
    harp_set_gain(harp, 2, 0.0);
    harp_set_gain(harp, 3, 7.0);
    harps_run(harp, RATE / 4, left, NULL);
    harps_run(still, RATE / 4, as_it_is, NULL);
    double error = 0.0;
    for (uint32_t n = 0; n < RATE / 4; ++n) {
      const double gain = fmax(0.0, 1.0 - (n + 1.0) / harp->n_gesture);
      error = fmax(error, fabs((double)left[n] - gain * (double)as_it_is[n]));
    }
    assert_within("of full scale", error, 1e-6);
    assert_true(measure_peak(as_it_is, RATE / 4) > 0.05);
    harp_free(still);
    harp_free(harp);
  }
}

/* Of a channel that is silent a gain holds at once: a note of the same moment has it from its first
 * frame, whatever others play. */
static void a_gain_set_in_silence_holds_at_once(void** state) {
  (void)state;
  enum { N = RATE / 10, SECOND = 3 };
  static float as_it_is[N];
  static float alone[N];
  Harp* const harps[] = {harp_notes_harp(), harp_notes_harp(), harp_notes_harp()};
  for (size_t k = 0; k < 2; ++k) {
    harp_note_on(harps[k], 0, KEY, 100);
  }
  harp_set_gain(harps[0], SECOND, 0.25);
  harp_note_on(harps[0], SECOND, KEY + 7, 100);
  harp_note_on(harps[2], SECOND, KEY + 7, 100);
  harps_run(harps[0], N, left, NULL);
  harps_run(harps[1], N, alone, NULL);
  harps_run(harps[2], N, as_it_is, NULL);
  double error = 0.0;
  for (uint32_t n = 0; n < N; ++n) {
    error = fmax(error, fabs((double)left[n] - (double)alone[n] - 0.25 * (double)as_it_is[n]));
  }
  assert_true(measure_peak(as_it_is, N) > 0.01);
  /* Floats of sums. */
  assert_within("of full scale", error, 1e-6);
  for (size_t k = 0; k < 3; ++k) {
    harp_free(harps[k]);
  }
}

/* What rings softly does not become loud when another channel takes its key. */
static void what_rings_with_another_gain_is_left_alone(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  Harp* const twin = harp_notes_harp();
  harp_set_gain(harp, 1, 0.25);
  harp_set_gain(twin, 1, 0.25);
  harp_pedal(harp, 1, 1.0);
  harp_pedal(twin, 1, 1.0);
  harps_run(harp, harp->n_gesture, NULL, NULL);
  harps_run(twin, twin->n_gesture, NULL, NULL);
  harp_note_on(harp, 1, KEY, 127);
  harp_note_on(twin, 1, KEY, 127);
  harps_run(harp, RATE / 10, NULL, NULL);
  harps_run(twin, RATE / 10, NULL, NULL);
  harp_note_off(harp, 1, KEY);
  harp_note_off(twin, 1, KEY);
  harp_note_on(harp, 0, KEY, 1);
  assert_int_equal(harp->strings[KEY].channel, 1);
  assert_int_equal(spare_at(harp, KEY)->channel, 0);
  static float other[RATE];
  harps_run(harp, RATE / 10, left, NULL);
  harps_run(twin, RATE / 10, other, NULL);
  double most = 0.0;
  for (uint32_t n = 0; n < RATE / 10; ++n) {
    most = fmax(most, fabs((double)left[n] - (double)other[n]));
  }
  /* As soft as velocity 1 is: (1/127)² of the loudest. */
  assert_within("that a note of velocity 1 adds", most, 1e-3);
  harp_free(twin);
  harp_free(harp);
}

/* All spare strings are held, and KEY + 2 has three strings: its own is the first channel's. */
static Harp* crowded_harp(void) {
  Harp* const harp = harp_notes_harp();
  for (uint32_t key = KEY; key < KEY + 3; ++key) {
    const uint32_t n = key < KEY + 2 ? HARP_CHANNELS : 3;
    for (uint32_t channel = 0; channel < n; ++channel) {
      harp_note_on(harp, channel, key, 100);
    }
  }
  assert_int_equal(harp_report(harp).n_strings, 3 + HARP_SPARES);
  return harp;
}

/*
  A key that is shared is plucked anew, as loud as if it had its own string, whoever takes it with
  whatever gain: what it did is gone, without a step, and all else rings on.  Handed back it is
  still what it was.
*/
static void a_shared_string_is_plucked_anew(void** state) {
  (void)state;
  enum { SECOND = 3, N = RATE / 10, ONSET = 720 };
  static float alone[RATE];
  static float without[RATE];
  static const double gains[][2] = {{1.0, 0.25}, {0.5, 1.0}, {0.25, 0.5}, {0.5, 0.5}, {1.0, 0.0}};
  for (int type = 0; type < 2; ++type) {
    for (size_t i = 0; i < sizeof(gains) / sizeof(gains[0]); ++i) {
      Harp* const harps[] = {crowded_harp(), crowded_harp(), harp_notes_harp()};
      HarpPatch patch = harp_notes_patch();
      patch.pickup_type = (PickupType)type;
      for (size_t k = 0; k < 3; ++k) {
        harp_set_patch(harps[k], &patch, 0);
        harp_set_gain(harps[k], 0, gains[i][0]);
        harp_set_gain(harps[k], SECOND, gains[i][1]);
        harps_run(harps[k], N, k == 0 ? left : NULL, NULL);
      }
      const float last = left[N - 1];
      harp_note_on(harps[0], SECOND, KEY + 2, 60);
      harp_note_on(harps[2], SECOND, KEY + 2, 60);
      voice_sleep(&harps[1]->strings[KEY + 2].voice);
      assert_int_equal(harps[0]->strings[KEY + 2].holders, 1 | 1 << SECOND);
      harps_run(harps[0], N, left, NULL);
      harps_run(harps[1], N, without, NULL);
      harps_run(harps[2], N, alone, NULL);
      double error = 0.0;
      for (uint32_t n = ONSET; n < N; ++n) {
        error = fmax(error, fabs((double)left[n] - (double)without[n] - (double)alone[n]));
      }
      const double step =
          fmax(fabs((double)left[0] - (double)last), harps_largest_step(left + 1, ONSET));
      assert_within("step, of what there is later",
                    step / harps_largest_step(left + ONSET, N - ONSET), 1.0);
      /* Sums of 35 strings in floats, and differences of such sums. */
      const double most = type == PICKUP_VELOCITY ? 1e-4 : 1e-5;
      assert_within("of full scale", error, most);
      assert_true(measure_peak(alone, N) > (gains[i][1] > 0.0 ? 0.01 : -1.0));
      /* Handed back, it is still what it was. */
      harp_note_off(harps[0], SECOND, KEY + 2);
      harps_run(harps[0], N, left, NULL);
      harps_run(harps[1], N, without, NULL);
      harps_run(harps[2], N, alone, NULL);
      error = 0.0;
      for (uint32_t n = 0; n < N; ++n) {
        error = fmax(error, fabs((double)left[n] - (double)without[n] - (double)alone[n]));
      }
      assert_within("of full scale once it is handed back", error, most);
      for (size_t k = 0; k < 3; ++k) {
        harp_free(harps[k]);
      }
    }
  }
}

/* What is heard with a gain that was lent is heard with its channel's again from the next note on,
 * once it has died away. */
static void a_loan_of_a_gain_ends_with_the_sound(void** state) {
  (void)state;
  enum { SECOND = 3 };
  Harp* const harp = crowded_harp();
  const HarpString* const shared = &harp->strings[KEY + 2];
  HarpPatch patch = harp_notes_patch();
  patch.exciter = EXCITER_STRIKE;
  harp_set_patch(harp, &patch, 0);
  harp_set_gain(harp, SECOND, 0.25);
  harps_run(harp, harp->n_gesture, NULL, NULL);
  harp_note_on(harp, SECOND, KEY + 2, 60);
  assert_int_equal(harp_channels_heard(shared), 0);
  assert_int_equal(shared->channel, SECOND);
  harp_silence(harp);
  harps_run(harp, RATE, NULL, NULL);
  assert_int_equal(harp_report(harp).n_strings, 0);
  harps_run(harp, 1, NULL, NULL);
  assert_int_equal(harp_channels_heard(shared), shared->channel);
  harp_note_on(harp, SECOND, KEY + 2, 60);
  assert_int_equal(harp_channels_heard(shared), SECOND);
  harp_free(harp);
}

/* What each channel holds, as a keyboard knows it, and what the harp's strings say: they agree
 * after each of many notes, many more than there are strings. */
static void check_holders(const Harp* harp, bool held[HARP_CHANNELS][HARP_KEYS]) {
  uint32_t found[HARP_KEYS] = {0};
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    const HarpString* const string = &harp->strings[i];
    assert_int_equal(found[string->key] & string->holders, 0);
    found[string->key] |= string->holders;
  }
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
      assert_int_equal(found[key] >> channel & 1, held[channel][key]);
    }
  }
}

static void no_note_off_is_lost_however_many_hold_a_key(void** state) {
  (void)state;
  enum { N_NOTES = 20000, N_KEYS = 5 };
  static bool held[HARP_CHANNELS][HARP_KEYS];
  memset(held, 0, sizeof(held));
  Random random = random_start();
  Harp* const harp = harp_notes_harp();
  uint32_t most = 0;
  for (int i = 0; i < N_NOTES; ++i) {
    const uint32_t channel = random_below(&random, HARP_CHANNELS);
    const uint32_t key = KEY + random_below(&random, N_KEYS);
    const uint32_t what = random_below(&random, 100);
    if (what < 60) {
      harp_note_on(harp, channel, key, 1 + random_below(&random, 127));
      held[channel][key] = true;
    } else if (what < 98) {
      harp_note_off(harp, channel, key);
      held[channel][key] = false;
    } else {
      (what == 98 ? harp_all_notes_off : harp_all_sound_off)(harp, channel);
      memset(held[channel], 0, sizeof(held[channel]));
    }
    harp_set_gain(harp, channel, random_below(&random, 3) / 2.0);
    if (i % 50 == 0) {
      harps_run(harp, 64, NULL, NULL);
    }
    uint32_t n_spares = 0;
    for (uint32_t k = HARP_KEYS; k < HARP_STRINGS; ++k) {
      n_spares += harp->strings[k].holders != 0;
    }
    most = n_spares > most ? n_spares : most;
    check_holders(harp, held);
  }
  assert_int_equal(most, HARP_SPARES);
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    for (uint32_t key = 0; key < HARP_KEYS; ++key) {
      harp_note_off(harp, channel, key);
    }
  }
  harps_run(harp, RATE, NULL, NULL);
  harps_run(harp, RATE, NULL, NULL);
  assert_int_equal(harp_report(harp).n_strings, 0);
  harp_free(harp);
}

/* Who holds a shared string bends it, once the one that played it last has let go; and it is no
 * longer stopped with the other's. */
static void a_shared_string_is_handed_on(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    for (uint32_t key = KEY; key < KEY + 3; ++key) {
      harp_note_on(harp, channel, key, 100);
    }
  }
  const HarpString* const shared = &harp->strings[KEY];
  const uint32_t last = shared->channel;
  assert_true(n_holders(shared) > 1);
  harp_bend(harp, last, 3.0);
  harp_note_off(harp, last, KEY);
  assert_true(shared->channel != last && harp_channels_holds(shared, shared->channel));
  harp_bend(harp, shared->channel, -2.0);
  harp_notes_check_pitch(harp, shared, -2.0);
  harp_all_sound_off(harp, last);
  harp_notes_check_decay(harp, shared, harp_notes_open_s(KEY));
  while (n_holders(shared) > 1) {
    harp_note_off(harp, shared->channel, KEY);
  }
  harp_all_sound_off(harp, shared->channel);
  harps_run(harp, RATE / 2, NULL, NULL);
  assert_false(shared->voice.is_awake || shared->holders);
  harp_free(harp);
}

static void a_spare_string_can_have_any_key_in_turn(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  for (uint32_t key = 30; key < 100; key += 7) {
    harp_note_on(harp, 2, key, 100);
    harp_note_on(harp, 3, key, 100);
    harp_notes_check_pitch(harp, spare_at(harp, key), 0.0);
    harp_notes_check_decay(harp, spare_at(harp, key), harp_notes_open_s(key));
    harp_silence(harp);
    harps_run(harp, RATE / 2, NULL, NULL);
    assert_int_equal(harp_report(harp).n_strings, 0);
  }
  harp_free(harp);
}

static void what_is_let_go_keeps_its_touch_but_not_its_pedal(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  const HarpString* const held = &harp->strings[KEY + 5];
  const HarpString* const string = &harp->strings[KEY];
  harp_pedal(harp, 2, 1.0);
  harp_bend(harp, 2, 1.0);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 2, KEY + 5, 100);
  harp_note_off(harp, 2, KEY);
  harp_bend(harp, 2, 2.0);
  harp_notes_check_pitch(harp, string, 2.0);
  harp_let_go(harp, 2);
  harp_bend(harp, 2, 3.0);
  harp_notes_check_pitch(harp, string, 2.0);
  harp_notes_check_pitch(harp, held, 3.0);
  harp_pedal(harp, 2, 0.0);
  harp_notes_check_decay(harp, string, HARP_NOTES_RELEASE_S);
  harp_note_on(harp, 2, KEY, 100);
  harp_bend(harp, 2, 4.0);
  harp_notes_check_pitch(harp, string, 4.0);
  harp_free(harp);
}

static void a_reset_harp_knows_no_channel(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  harp_note_on(harp, 5, KEY, 100);
  harp_note_on(harp, 6, KEY, 100);
  harp_bend(harp, 5, 3.0);
  harp_bend(harp, 0, 3.0);
  harp_pedal(harp, 0, 1.0);
  harp_set_gain(harp, 0, 0.1);
  harp_sostenuto(harp, 5, true);
  const HarpPatch plain = harp_notes_patch();
  harps_restart(harp, &plain);
  Harp* const fresh = harp_notes_harp();
  static float other[RATE];
  harp_note_on(harp, 0, KEY, 100);
  harp_note_on(fresh, 0, KEY, 100);
  harp_note_off(harp, 0, KEY);
  harp_note_off(fresh, 0, KEY);
  harps_run(harp, RATE, left, NULL);
  harps_run(fresh, RATE, other, NULL);
  assert_memory_equal(left, other, sizeof(other));
  harp_free(fresh);
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(two_channels_have_a_string_each_at_one_key),
      cmocka_unit_test(a_channel_lets_up_its_own_key_only),
      cmocka_unit_test(one_channel_has_one_string_at_a_key),
      cmocka_unit_test(a_spare_string_that_rings_is_left_alone),
      cmocka_unit_test(a_key_that_is_up_is_taken_over),
      cmocka_unit_test(when_spare_strings_run_out_none_is_stolen),
      cmocka_unit_test(a_shared_string_sounds_until_the_last_lets_go),
      cmocka_unit_test(a_channel_has_a_gain_of_its_own),
      cmocka_unit_test(a_gain_moves_in_a_straight_line),
      cmocka_unit_test(a_gain_set_in_silence_holds_at_once),
      cmocka_unit_test(what_rings_with_another_gain_is_left_alone),
      cmocka_unit_test(a_shared_string_is_plucked_anew),
      cmocka_unit_test(a_loan_of_a_gain_ends_with_the_sound),
      cmocka_unit_test(no_note_off_is_lost_however_many_hold_a_key),
      cmocka_unit_test(a_shared_string_is_handed_on),
      cmocka_unit_test(a_spare_string_can_have_any_key_in_turn),
      cmocka_unit_test(what_is_let_go_keeps_its_touch_but_not_its_pedal),
      cmocka_unit_test(a_reset_harp_knows_no_channel),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
