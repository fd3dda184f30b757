/* Pedals and expression through a host: every decay and every level that they ask for is measured.
 */
#include "tests/support/measure.h"
#include "tests/support/mpe_files.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double RELEASE_S = 0.08;

/* A damper lifted in part takes its share of the way from the release to the open string, on a
 * scale of octaves of τ. */
static void check_half(const char* name, double lift, double from_s) {
  Host* const host = mpe_open();
  strings_set(host, "release", RELEASE_S);
  Sound sound = mpe_play(host, name, 5.0, MPE_BLOCK);
  const Tone open = strings_tone(host, 52, 0.0);
  const Tone asked = {open.f0_hz, RELEASE_S * pow(open.tau_s / RELEASE_S, lift)};
  assert_true(asked.tau_s > 1.5 * RELEASE_S && asked.tau_s < open.tau_s / 1.5);
  strings_assert_exact(name,
                       mpe_measure(&sound, from_s, fmin(from_s + 8.0 * asked.tau_s, 5.0), asked));
  sound_free(&sound);
  host_free(host);
}

static void a_pedal_half_way_down_damps_in_part(void** state) {
  (void)state;
  check_half("half", 0.5, 1.0);
  check_half("mostly", 0.75, 1.0);
}

static void a_pedal_that_goes_half_way_up_damps_in_part(void** state) {
  (void)state;
  check_half("later", 0.5, 1.0);
}

/* Keys 50 and 57; the second one dies with its release, so it is gone after twelve of them. */
static void sostenuto_holds_what_was_down_and_no_more(void** state) {
  (void)state;
  Host* const host = mpe_open();
  strings_set(host, "release", RELEASE_S);
  Sound sound = mpe_play(host, "sostenuto", 5.0, MPE_BLOCK);
  const double gone_s = 1.0 + 12.0 * RELEASE_S;
  const Tone held = strings_tone(host, 50, 0.0);
  const Tone other = strings_released_tone(host, 57, 0.0);
  const double spacing_hz = other.f0_hz - held.f0_hz;
  strings_assert_exact("held", mpe_measure(&sound, gone_s, 3.0, held));
  Tone heard = {0};
  assert_true(measure_partial(sound.left + MPE_RATE + 480, (size_t)(8.0 * RELEASE_S * MPE_RATE),
                              MPE_RATE, other, spacing_hz, &heard));
  assert_within("not held: decay", fabs(heard.tau_s / other.tau_s - 1.0), 0.0002);
  strings_assert_exact("let go",
                       mpe_measure(&sound, 3.0, 5.0, strings_released_tone(host, 50, 0.0)));
  sound_free(&sound);
  host_free(host);
}

/* 64 of 127, in dB; and it is all that is changed, so the sounds are alike to a float's rounding.
 */
static void expression_is_40_db_for_a_tenth(void** state) {
  (void)state;
  Host* const host = mpe_open();
  Sound loud = mpe_play(host, "loud", 1.0, MPE_BLOCK);
  Sound soft = mpe_play(host, "soft", 1.0, MPE_BLOCK);
  const double loud_rms = measure_rms(loud.left, loud.n_frames);
  const double soft_rms = measure_rms(soft.left, soft.n_frames);
  const double db = 20.0 * log10(soft_rms / loud_rms);
  assert_within("level [dB]", fabs(db - 40.0 * log10(64.0 / 127.0)), 1e-4);
  assert_within("shape", sound_distance(&loud, &soft), 1e-9);
  sound_free(&loud);
  sound_free(&soft);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_pedal_half_way_down_damps_in_part),
      cmocka_unit_test(a_pedal_that_goes_half_way_up_damps_in_part),
      cmocka_unit_test(sostenuto_holds_what_was_down_and_no_more),
      cmocka_unit_test(expression_is_40_db_for_a_tenth),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
