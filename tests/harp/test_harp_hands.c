/* Who plays which string: hands and guests. */
#include "tests/support/hands.h"
#include "tests/support/harps.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RATE = HANDS_RATE, KEY = 57 };

static float left[RATE];

/* The guest's string that a key has; there has to be one. */
static const HarpString* guest_at(const Harp* harp, uint32_t key) {
  for (uint32_t i = HARP_KEYS; i < HARP_STRINGS; ++i) {
    const HarpString* const guest = &harp->strings[i];
    if (guest->voice.is_awake && guest->key == key) {
      return guest;
    }
  }
  fail();
  return NULL;
}

static void two_hands_have_a_string_each_at_one_key(void** state) {
  (void)state;
  Harp* const harp = hands_harp();
  harp_bend(harp, 3, 0.5);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  assert_int_equal(harp_report(harp).n_strings, 2);
  hands_check_pitch(harp, &harp->strings[KEY], 0.0);
  hands_check_pitch(harp, guest_at(harp, KEY), 0.5);
  harp_bend(harp, 2, -7.0);
  hands_check_pitch(harp, &harp->strings[KEY], -7.0);
  hands_check_pitch(harp, guest_at(harp, KEY), 0.5);
  harp_free(harp);
}

static void a_hand_lets_up_its_own_key_only(void** state) {
  (void)state;
  Harp* const harp = hands_harp();
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY, 100);
  harp_note_off(harp, 4, KEY);
  hands_check_decay(harp, &harp->strings[KEY], hands_open_s(KEY));
  harp_note_off(harp, 3, KEY);
  hands_check_decay(harp, &harp->strings[KEY], hands_open_s(KEY));
  hands_check_decay(harp, guest_at(harp, KEY), HANDS_RELEASE_S);
  harp_all_notes_off(harp, 2);
  hands_check_decay(harp, &harp->strings[KEY], HANDS_RELEASE_S);
  harp_free(harp);
}

static void one_hand_has_one_string_at_a_key(void** state) {
  (void)state;
  Harp* const harp = hands_harp();
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
  Harp* const harp = hands_harp();
  for (uint32_t key = KEY; key < KEY + 3; ++key) {
    harp_pedal(harp, 3, 1.0);
    harp_note_on(harp, 2, key, 100);
    harp_note_on(harp, 3, key, 100);
    harp_note_off(harp, 3, key);
  }
  assert_int_equal(harp_report(harp).n_strings, 6);
  for (uint32_t key = KEY; key < KEY + 3; ++key) {
    hands_check_pitch(harp, guest_at(harp, key), 0.0);
  }
  /* But by the same key it is played again. */
  harp_note_on(harp, 3, KEY + 1, 100);
  assert_int_equal(harp_report(harp).n_strings, 6);
  harp_free(harp);
}

static void a_key_that_is_up_is_taken_over(void** state) {
  (void)state;
  Harp* const harp = hands_harp();
  harp_pedal(harp, 2, 1.0);
  harp_bend(harp, 3, 2.0);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_off(harp, 2, KEY);
  harp_note_on(harp, 3, KEY, 100);
  assert_int_equal(harp_report(harp).n_strings, 1);
  hands_check_pitch(harp, &harp->strings[KEY], 2.0);
  harp_note_off(harp, 3, KEY);
  hands_check_decay(harp, &harp->strings[KEY], HANDS_RELEASE_S);
  harp_free(harp);
}

/* Sixteen hands at three keys: three strings of their own, and 45 guests wanted where 32 are. */
static void when_guests_run_out_no_string_is_stolen(void** state) {
  (void)state;
  Harp* const harp = hands_harp();
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
  Harp* const harp = hands_harp();
  for (uint32_t key = 30; key < 100; key += 7) {
    harp_note_on(harp, 2, key, 100);
    harp_note_on(harp, 3, key, 100);
    hands_check_pitch(harp, guest_at(harp, key), 0.0);
    hands_check_decay(harp, guest_at(harp, key), hands_open_s(key));
    harp_all_sound_off(harp);
    harps_run(harp, RATE / 2, NULL, NULL);
    assert_int_equal(harp_report(harp).n_strings, 0);
  }
  harp_free(harp);
}

static void what_is_let_go_keeps_its_touch_but_not_its_pedal(void** state) {
  (void)state;
  Harp* const harp = hands_harp();
  const HarpString* const held = &harp->strings[KEY + 5];
  const HarpString* const string = &harp->strings[KEY];
  harp_pedal(harp, 2, 1.0);
  harp_bend(harp, 2, 1.0);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 2, KEY + 5, 100);
  harp_note_off(harp, 2, KEY);
  harp_bend(harp, 2, 2.0);
  hands_check_pitch(harp, string, 2.0);
  harp_let_go(harp, 2);
  harp_bend(harp, 2, 3.0);
  hands_check_pitch(harp, string, 2.0);
  hands_check_pitch(harp, held, 3.0);
  harp_pedal(harp, 2, 0.0);
  hands_check_decay(harp, string, HANDS_RELEASE_S);
  harp_note_on(harp, 2, KEY, 100);
  harp_bend(harp, 2, 4.0);
  hands_check_pitch(harp, string, 4.0);
  harp_free(harp);
}

static void a_reset_harp_knows_no_hand(void** state) {
  (void)state;
  Harp* const harp = hands_harp();
  harp_note_on(harp, 5, KEY, 100);
  harp_note_on(harp, 6, KEY, 100);
  harp_bend(harp, 5, 3.0);
  harp_bend(harp, 0, 3.0);
  harp_pedal(harp, 0, 1.0);
  harp_swell(harp, 0.1);
  harp_sostenuto(harp, 5, true);
  const HarpPatch plain = hands_patch();
  harps_restart(harp, &plain);
  Harp* const fresh = hands_harp();
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
      cmocka_unit_test(a_reset_harp_knows_no_hand),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
