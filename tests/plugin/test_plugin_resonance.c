/* The port `resonance` through a host: open strings answer, in tune, and 0 is no bridge at all. */
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256, LENGTH = 2 * RATE };

static double value_of(const Host* host, const char* symbol) {
  return (double)host_get(host, symbol);
}

/* A note with the pedal down or up. */
static void play(Host* host, Sound* sound, uint32_t key, double resonance, bool is_open) {
  strings_set(host, "resonance", resonance);
  strings_restart(host);
  strings_controller(host, 0, STRINGS_PEDAL, is_open ? 127 : 0);
  strings_note_on(host, 0, key, 110);
  strings_run(host, sound, 0, LENGTH, BLOCK);
}

static void pedal_opens_the_strings_of_a_piano(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(LENGTH);
  play(host, &sound, 57, 0.5, true);
  assert_true(value_of(host, "sounding") == 88.0);
  assert_true(value_of(host, "headroom") > 0.0);
  play(host, &sound, 57, 0.5, false);
  assert_true(value_of(host, "sounding") == 1.0);
  play(host, &sound, 57, 0.0, true);
  assert_true(value_of(host, "sounding") == 1.0);
  sound_free(&sound);
  host_free(host);
}

/* At 0 the pedal changes nothing of a note that is held. */
static void without_resonance_the_pedal_is_not_heard(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound open = sound_new(LENGTH);
  Sound shut = sound_new(LENGTH);
  play(host, &open, 57, 0.0, true);
  play(host, &shut, 57, 0.0, false);
  assert_true(sound_is_same(&open, &shut));
  play(host, &open, 57, 0.5, true);
  assert_false(sound_is_same(&open, &shut));
  sound_free(&open);
  sound_free(&shut);
  host_free(host);
}

static void notes_among_open_strings_are_in_tune(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(LENGTH);
  double worst = 0.0;
  strings_set_plain(host);
  for (uint32_t key = 33; key <= 105; key += 12) {
    Tone tone = {0};
    play(host, &sound, key, 0.5, true);
    const Tone asked = strings_tone(host, key, 0.0);
    assert_true(measure_tone(sound.left + RATE / 5, RATE, RATE, asked, &tone));
    worst = fmax(worst, fabs(measure_cents(tone.f0_hz, asked.f0_hz)));
  }
  assert_within("pitch [cents]", worst, 0.05);
  sound_free(&sound);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pedal_opens_the_strings_of_a_piano),
      cmocka_unit_test(without_resonance_the_pedal_is_not_heard),
      cmocka_unit_test(notes_among_open_strings_are_in_tune),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
