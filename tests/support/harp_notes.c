#include "tests/support/harp_notes.h"

#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

HarpPatch harp_notes_patch(void) {
  HarpPatch plain = harps_patch(0);
  plain.string.release_s = HARP_NOTES_RELEASE_S;
  plain.vibrato_hz = 5.5;
  plain.spread = 0.0;
  return plain;
}

Harp* harp_notes_harp(void) {
  const HarpPatch plain = harp_notes_patch();
  return harps_new(HARP_NOTES_RATE, &plain);
}

/* The tone that a string has once its last gesture is over, by its coefficients. */
static Tone tone_of(Harp* harp, const HarpString* string) {
  harps_run(harp, harp->n_gesture, NULL, NULL);
  assert_true(string->voice.is_awake && string->voice.chain.n_gliding == 0);
  return pole_tone(HARP_NOTES_RATE,
                   tuning_mode(string->voice.chain.now, string->voice.chain.n_masses, 1));
}

void harp_notes_check_pitch(Harp* harp, const HarpString* string, double bend) {
  const HarpPatch plain = harp_notes_patch();
  const Tone asked = harps_tone(&plain, string->key, bend);
  const Tone has = tone_of(harp, string);
  assert_within("cents", fabs(measure_cents(has.f0_hz, asked.f0_hz)), 1e-4);
}

void harp_notes_check_decay(Harp* harp, const HarpString* string, double tau_s) {
  assert_within("τ, relative", fabs(tone_of(harp, string).tau_s / tau_s - 1.0), 1e-6);
}

double harp_notes_open_s(uint32_t key) {
  const HarpPatch plain = harp_notes_patch();
  return harps_tone(&plain, key, 0.0).tau_s;
}
