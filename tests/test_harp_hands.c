/* Who plays which string: hands, guests, and the pedals under them. */
#include "tests/harps.h"
#include "tests/measure.h"
#include "tests/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RATE = 48000, KEY = 57, MOST = 2 * RATE };

static const double RELEASE_S = 0.05;

static float left[MOST];

static Patch patch(void) {
  Patch plain = harps_patch(0);
  plain.release_s = RELEASE_S;
  plain.vibrato_hz = 5.5;
  return plain;
}

static Harp* new_harp(void) {
  const Patch plain = patch();
  return harps_new(RATE, &plain);
}

/* The tone that a string has once its last gesture is over, by its coefficients. */
static Tone tone_of(Harp* harp, const HarpString* string) {
  harps_run(harp, harp->n_gesture, NULL, NULL);
  assert_true(string->wire.is_awake && string->wire.chain.n_gliding == 0);
  return pole_tone(RATE, tuning_mode(string->wire.chain.now, string->wire.chain.n_masses, 1));
}

static void check_pitch(Harp* harp, const HarpString* string, double bend) {
  const Patch plain = patch();
  const Tone asked = harps_tone(&plain, string->key, bend);
  const Tone has = tone_of(harp, string);
  assert_within("cents", fabs(measure_cents(has.f0_hz, asked.f0_hz)), 1e-4);
}

static void check_decay(Harp* harp, const HarpString* string, double tau_s) {
  assert_within("τ, relative", fabs(tone_of(harp, string).tau_s / tau_s - 1.0), 1e-6);
}

static double open_s(uint32_t key) {
  const Patch plain = patch();
  return harps_tone(&plain, key, 0.0).tau_s;
}

/* The guest's string that a key has; there has to be one. */
static const HarpString* guest_at(const Harp* harp, uint32_t key) {
  for (uint32_t i = HARP_KEYS; i < HARP_STRINGS; ++i) {
    const HarpString* const guest = &harp->strings[i];
    if (guest->wire.is_awake && guest->key == key) {
      return guest;
    }
  }
  fail();
  return NULL;
}

static void two_hands_have_a_string_each_at_one_key(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  harp_bend(harp, 3, 0.5);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  assert_int_equal(harp_report(harp).n_strings, 2);
  check_pitch(harp, &harp->strings[KEY], 0.0);
  check_pitch(harp, guest_at(harp, KEY), 0.5);
  harp_bend(harp, 2, -7.0);
  check_pitch(harp, &harp->strings[KEY], -7.0);
  check_pitch(harp, guest_at(harp, KEY), 0.5);
  harp_free(harp);
}

static void a_hand_lets_up_its_own_key_only(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  harp_note_off(harp, 4, KEY);
  check_decay(harp, &harp->strings[KEY], open_s(KEY));
  harp_note_off(harp, 3, KEY);
  check_decay(harp, &harp->strings[KEY], open_s(KEY));
  check_decay(harp, guest_at(harp, KEY), RELEASE_S);
  harp_all_notes_off(harp, 2);
  check_decay(harp, &harp->strings[KEY], RELEASE_S);
  harp_free(harp);
}

static void one_hand_has_one_string_at_a_key(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  assert_int_equal(harp_report(harp).n_strings, 2);
  assert_int_equal(harp->strings[KEY].hand, 2);
  harp_free(harp);
}

static void a_guest_that_rings_is_left_alone(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  for (uint32_t key = KEY; key < KEY + 3; ++key) {
    harp_pedal(harp, 3, 1.0);
    harp_note_on(harp, 2, key, 100);
    harp_note_on(harp, 3, key, 100);
    harp_note_off(harp, 3, key);
  }
  assert_int_equal(harp_report(harp).n_strings, 6);
  for (uint32_t key = KEY; key < KEY + 3; ++key) {
    check_pitch(harp, guest_at(harp, key), 0.0);
  }
  /* But by the same key it is played again. */
  harp_note_on(harp, 3, KEY + 1, 100);
  assert_int_equal(harp_report(harp).n_strings, 6);
  harp_free(harp);
}

static void a_key_that_is_up_is_taken_over(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  harp_pedal(harp, 2, 1.0);
  harp_bend(harp, 3, 2.0);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_off(harp, 2, KEY);
  harp_note_on(harp, 3, KEY, 100);
  assert_int_equal(harp_report(harp).n_strings, 1);
  check_pitch(harp, &harp->strings[KEY], 2.0);
  harp_note_off(harp, 3, KEY);
  check_decay(harp, &harp->strings[KEY], RELEASE_S);
  harp_free(harp);
}

/* Sixteen hands at three keys: three strings of their own, and 45 guests wanted where 32 are. */
static void when_guests_run_out_no_string_is_stolen(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  for (uint32_t hand = 0; hand < HARP_HANDS; ++hand) {
    for (uint32_t key = KEY; key < KEY + 3; ++key) {
      harp_note_on(harp, hand, key, 100);
      harps_run(harp, 64, NULL, NULL);
    }
  }
  assert_int_equal(harp_report(harp).n_strings, 3 + HARP_GUESTS);
  for (uint32_t i = HARP_KEYS; i < HARP_STRINGS; ++i) {
    assert_true(harp->strings[i].is_down);
  }
  for (uint32_t hand = 0; hand < HARP_HANDS; ++hand) {
    harp_all_notes_off(harp, hand);
  }
  harps_run(harp, RATE, NULL, NULL);
  harps_run(harp, RATE, NULL, NULL);
  assert_int_equal(harp_report(harp).n_strings, 0);
  harp_free(harp);
}

static void a_guest_can_have_any_key_in_turn(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  for (uint32_t key = 30; key < 100; key += 7) {
    harp_note_on(harp, 2, key, 100);
    harp_note_on(harp, 3, key, 100);
    check_pitch(harp, guest_at(harp, key), 0.0);
    check_decay(harp, guest_at(harp, key), open_s(key));
    harp_all_sound_off(harp);
    harps_run(harp, RATE / 2, NULL, NULL);
    assert_int_equal(harp_report(harp).n_strings, 0);
  }
  harp_free(harp);
}

static void what_is_let_go_keeps_its_touch_but_not_its_pedal(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  const HarpString* const held = &harp->strings[KEY + 5];
  const HarpString* const string = &harp->strings[KEY];
  harp_pedal(harp, 2, 1.0);
  harp_bend(harp, 2, 1.0);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 2, KEY + 5, 100);
  harp_note_off(harp, 2, KEY);
  harp_bend(harp, 2, 2.0);
  check_pitch(harp, string, 2.0);
  harp_let_go(harp, 2);
  harp_bend(harp, 2, 3.0);
  check_pitch(harp, string, 2.0);
  check_pitch(harp, held, 3.0);
  harp_pedal(harp, 2, 0.0);
  check_decay(harp, string, RELEASE_S);
  harp_note_on(harp, 2, KEY, 100);
  harp_bend(harp, 2, 4.0);
  check_pitch(harp, string, 4.0);
  harp_free(harp);
}

static void a_pedal_in_part_damps_in_part(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  const HarpString* const string = &harp->strings[KEY];
  double last_s = 0.0;
  harp_note_on(harp, 0, KEY, 100);
  harp_note_off(harp, 0, KEY);
  for (int step = 0; step <= 4; ++step) {
    const double lift = 0.25 * step;
    const double tau_s = RELEASE_S * pow(open_s(KEY) / RELEASE_S, lift);
    harp_pedal(harp, 0, lift);
    assert_true(tau_s > last_s);
    check_decay(harp, string, tau_s);
    last_s = tau_s;
  }
  harp_free(harp);
}

/* Nor does one that would not damp it make it ring for longer. */
static void a_damper_in_part_never_lengthens(void** state) {
  (void)state;
  Patch slow = patch();
  slow.release_s = 10.0;
  Harp* const harp = harps_new(RATE, &slow);
  harp_note_on(harp, 0, KEY, 100);
  harp_note_off(harp, 0, KEY);
  harp_pedal(harp, 0, 0.5);
  check_decay(harp, &harp->strings[KEY], open_s(KEY));
  harp_free(harp);
}

static void a_pedal_is_its_hands_own(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  harp_pedal(harp, 2, 1.0);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY + 1, 100);
  harp_note_off(harp, 2, KEY);
  harp_note_off(harp, 3, KEY + 1);
  check_decay(harp, &harp->strings[KEY], open_s(KEY));
  check_decay(harp, &harp->strings[KEY + 1], RELEASE_S);
  harp_free(harp);
}

static void sostenuto_holds_what_was_down(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  const HarpString* const caught = &harp->strings[KEY];
  const HarpString* const later = &harp->strings[KEY + 2];
  harp_note_on(harp, 0, KEY, 100);
  harp_sostenuto(harp, 0, true);
  harp_note_on(harp, 0, KEY + 2, 100);
  harp_note_off(harp, 0, KEY);
  harp_note_off(harp, 0, KEY + 2);
  check_decay(harp, caught, open_s(KEY));
  check_decay(harp, later, RELEASE_S);
  /* Said again it catches nothing more, and a key played again is not let go by it. */
  harp_note_on(harp, 0, KEY + 2, 100);
  harp_sostenuto(harp, 0, true);
  harp_note_off(harp, 0, KEY + 2);
  check_decay(harp, later, RELEASE_S);
  harp_sostenuto(harp, 0, false);
  check_decay(harp, caught, RELEASE_S);
  /* What another hand takes over is that hand's. */
  harp_note_on(harp, 0, KEY, 100);
  harp_sostenuto(harp, 0, true);
  harp_note_off(harp, 0, KEY);
  harp_note_on(harp, 1, KEY, 100);
  harp_note_off(harp, 1, KEY);
  check_decay(harp, caught, RELEASE_S);
  /* And all sound off lets the pedal up. */
  harp_all_sound_off(harp);
  harp_note_on(harp, 0, KEY, 100);
  harp_sostenuto(harp, 0, true);
  harp_note_off(harp, 0, KEY);
  check_decay(harp, caught, open_s(KEY));
  harp_free(harp);
}

static void pedals_hold_together(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  harp_note_on(harp, 0, KEY, 100);
  harp_sostenuto(harp, 0, true);
  harp_pedal(harp, 0, 1.0);
  harp_note_off(harp, 0, KEY);
  harp_sostenuto(harp, 0, false);
  check_decay(harp, &harp->strings[KEY], open_s(KEY));
  harp_sostenuto(harp, 0, true);
  harp_pedal(harp, 0, 0.0);
  check_decay(harp, &harp->strings[KEY], RELEASE_S);
  harp_free(harp);
}

static double loudness(Harp* harp, double softness) {
  const Patch plain = patch();
  harps_restart(harp, &plain);
  harp_soften(harp, 0, softness);
  harp_note_on(harp, 0, KEY, 100);
  harps_run(harp, RATE, left, NULL);
  return measure_rms(left, RATE);
}

static void the_soft_pedal_softens_the_next_notes(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  const double loud = loudness(harp, 0.0);
  const double half = loudness(harp, 0.5);
  const double soft = loudness(harp, 1.0);
  assert_true(half < 0.9 * loud && soft < 0.9 * half && soft > 0.3 * loud);
  harp_reset(harp);
  harp_note_on(harp, 0, KEY, 100);
  harps_run(harp, RATE, left, NULL);
  assert_true(measure_rms(left, RATE) == loud);
  harp_free(harp);
}

static void a_reset_harp_knows_no_hand(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  harp_note_on(harp, 5, KEY, 100);
  harp_note_on(harp, 6, KEY, 100);
  harp_bend(harp, 5, 3.0);
  harp_bend(harp, 0, 3.0);
  harp_pedal(harp, 0, 1.0);
  harp_swell(harp, 0.1);
  harp_sostenuto(harp, 5, true);
  const Patch plain = patch();
  harps_restart(harp, &plain);
  Harp* const fresh = new_harp();
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
      cmocka_unit_test(two_hands_have_a_string_each_at_one_key),
      cmocka_unit_test(a_hand_lets_up_its_own_key_only),
      cmocka_unit_test(one_hand_has_one_string_at_a_key),
      cmocka_unit_test(a_guest_that_rings_is_left_alone),
      cmocka_unit_test(a_key_that_is_up_is_taken_over),
      cmocka_unit_test(when_guests_run_out_no_string_is_stolen),
      cmocka_unit_test(a_guest_can_have_any_key_in_turn),
      cmocka_unit_test(what_is_let_go_keeps_its_touch_but_not_its_pedal),
      cmocka_unit_test(a_pedal_in_part_damps_in_part),
      cmocka_unit_test(a_damper_in_part_never_lengthens),
      cmocka_unit_test(a_pedal_is_its_hands_own),
      cmocka_unit_test(sostenuto_holds_what_was_down),
      cmocka_unit_test(pedals_hold_together),
      cmocka_unit_test(the_soft_pedal_softens_the_next_notes),
      cmocka_unit_test(a_reset_harp_knows_no_hand),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
