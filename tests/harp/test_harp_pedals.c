/* The pedals under the hands that play the harp. */
#include "tests/support/harp_notes.h"
#include "tests/support/harps.h"
#include "tests/support/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RATE = HARP_NOTES_RATE, KEY = 57 };

static float left[RATE];

static void a_pedal_in_part_damps_in_part(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  const HarpString* const string = &harp->strings[KEY];
  double last_s = 0.0;
  harp_note_on(harp, 0, KEY, 100);
  harp_note_off(harp, 0, KEY);
  for (int step = 0; step <= 4; ++step) {
    const double lift = 0.25 * step;
    const double tau_s =
        HARP_NOTES_RELEASE_S * pow(harp_notes_open_s(KEY) / HARP_NOTES_RELEASE_S, lift);
    harp_pedal(harp, 0, lift);
    assert_true(tau_s > last_s);
    harp_notes_check_decay(harp, string, tau_s);
    last_s = tau_s;
  }
  harp_free(harp);
}

/* Nor does one that would not damp it make it ring for longer. */
static void a_damper_in_part_never_lengthens(void** state) {
  (void)state;
  HarpPatch slow = harp_notes_patch();
  slow.string.release_s = 10.0;
  Harp* const harp = harps_new(RATE, &slow);
  harp_note_on(harp, 0, KEY, 100);
  harp_note_off(harp, 0, KEY);
  harp_pedal(harp, 0, 0.5);
  harp_notes_check_decay(harp, &harp->strings[KEY], harp_notes_open_s(KEY));
  harp_free(harp);
}

static void a_pedal_is_its_hands_own(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  harp_pedal(harp, 2, 1.0);
  harp_note_on(harp, 2, KEY, 100);
  harp_note_on(harp, 3, KEY + 1, 100);
  harp_note_off(harp, 2, KEY);
  harp_note_off(harp, 3, KEY + 1);
  harp_notes_check_decay(harp, &harp->strings[KEY], harp_notes_open_s(KEY));
  harp_notes_check_decay(harp, &harp->strings[KEY + 1], HARP_NOTES_RELEASE_S);
  harp_free(harp);
}

static void sostenuto_holds_what_was_down(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  const HarpString* const caught = &harp->strings[KEY];
  const HarpString* const later = &harp->strings[KEY + 2];
  harp_note_on(harp, 0, KEY, 100);
  harp_sostenuto(harp, 0, true);
  harp_note_on(harp, 0, KEY + 2, 100);
  harp_note_off(harp, 0, KEY);
  harp_note_off(harp, 0, KEY + 2);
  harp_notes_check_decay(harp, caught, harp_notes_open_s(KEY));
  harp_notes_check_decay(harp, later, HARP_NOTES_RELEASE_S);
  /* Said again it catches nothing more, and a key played again is not let go by it. */
  harp_note_on(harp, 0, KEY + 2, 100);
  harp_sostenuto(harp, 0, true);
  harp_note_off(harp, 0, KEY + 2);
  harp_notes_check_decay(harp, later, HARP_NOTES_RELEASE_S);
  harp_sostenuto(harp, 0, false);
  harp_notes_check_decay(harp, caught, HARP_NOTES_RELEASE_S);
  /* What another hand takes over is that hand's. */
  harp_note_on(harp, 0, KEY, 100);
  harp_sostenuto(harp, 0, true);
  harp_note_off(harp, 0, KEY);
  harp_note_on(harp, 1, KEY, 100);
  harp_note_off(harp, 1, KEY);
  harp_notes_check_decay(harp, caught, HARP_NOTES_RELEASE_S);
  /* And all sound off lets the pedal up. */
  harp_silence(harp);
  harp_note_on(harp, 0, KEY, 100);
  harp_sostenuto(harp, 0, true);
  harp_note_off(harp, 0, KEY);
  harp_notes_check_decay(harp, caught, harp_notes_open_s(KEY));
  harp_free(harp);
}

static void pedals_hold_together(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
  harp_note_on(harp, 0, KEY, 100);
  harp_sostenuto(harp, 0, true);
  harp_pedal(harp, 0, 1.0);
  harp_note_off(harp, 0, KEY);
  harp_sostenuto(harp, 0, false);
  harp_notes_check_decay(harp, &harp->strings[KEY], harp_notes_open_s(KEY));
  harp_sostenuto(harp, 0, true);
  harp_pedal(harp, 0, 0.0);
  harp_notes_check_decay(harp, &harp->strings[KEY], HARP_NOTES_RELEASE_S);
  harp_free(harp);
}

static double loudness(Harp* harp, double softness) {
  const HarpPatch plain = harp_notes_patch();
  harps_restart(harp, &plain);
  harp_soften(harp, 0, softness);
  harp_note_on(harp, 0, KEY, 100);
  harps_run(harp, RATE, left, NULL);
  return measure_rms(left, RATE);
}

static void the_soft_pedal_softens_the_next_notes(void** state) {
  (void)state;
  Harp* const harp = harp_notes_harp();
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_pedal_in_part_damps_in_part),
      cmocka_unit_test(a_damper_in_part_never_lengthens),
      cmocka_unit_test(a_pedal_is_its_hands_own),
      cmocka_unit_test(sostenuto_holds_what_was_down),
      cmocka_unit_test(pedals_hold_together),
      cmocka_unit_test(the_soft_pedal_softens_the_next_notes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
