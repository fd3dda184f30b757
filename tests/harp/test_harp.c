#include "core/harp/harp.h"

#include "tests/support/oracle.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { MOST_FRAMES = 1 << 17, A4 = 69 };

static const double PI = 3.14159265358979323846;

static float left[MOST_FRAMES];
static float right[MOST_FRAMES];

static const HarpPatch plain = {
    .level = 1.0,
    .string.damping_per_s = 1.0,
    .string.loss = 0.01,
    .pickup = 0.12,
    .pluck = 0.2,
    .hardness = 0.5,
    .string.release_s = 0.05,
    .string.tuning_hz = 440.0,
    .string.max_masses = CHAIN_MAX_MASSES,
};

static Harp* new_harp(double rate_hz, const HarpPatch* patch) {
  Harp* const harp = harp_new(rate_hz);
  assert_non_null(harp);
  harp_set_patch(harp, patch, 0);
  return harp;
}

/* Only the last piece is left in the buffers. */
static void run_for(Harp* harp, uint32_t n_frames) {
  while (n_frames > 0) {
    const uint32_t n = n_frames < MOST_FRAMES ? n_frames : MOST_FRAMES;
    harp_run(harp, n, left, right);
    n_frames -= n;
  }
}

static double peak_of(const float* out, uint32_t n_frames) {
  double peak = 0.0;
  for (uint32_t n = 0; n < n_frames; ++n) {
    peak = fmax(peak, fabs((double)out[n]));
  }
  return peak;
}

/* The amplitude |C| of a fundamental that rings as Re(C zⁿ), from two successive samples of it. */
static double fundamental_amplitude(const HarpString* string, double tau_s) {
  const double length = string->voice.chain.n_masses + 1.0;
  const double angle = 2.0 * PI * string->voice.f0_hz / string->voice.rate_hz;
  double x = 0.0;
  double u = 0.0;
  for (uint32_t i = 0; i < string->voice.chain.n_masses; ++i) {
    const double shape = 2.0 / length * sin(PI * (i + 1.0) / length);
    x += shape * (double)chain_position(&string->voice.chain, i);
    u += shape * (double)chain_velocity(&string->voice.chain, i);
  }
  const double before = (x - u) * exp(-1.0 / (tau_s * string->voice.rate_hz));
  return hypot(x, (before - x * cos(angle)) / sin(angle));
}

static void no_string_is_stolen(void** state) {
  (void)state;
  Harp* const harp = new_harp(192000.0, &plain);
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    harp_note_on(harp, 0, key, 100);
  }
  run_for(harp, 2000);
  assert_int_equal(harp_report(harp).n_strings, HARP_KEYS);
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    assert_true(fundamental_amplitude(&harp->strings[key], 1.0) > 1e-3);
  }
  assert_true(harp_report(harp).headroom >= TUNING_MARGIN);
  harp_free(harp);
}

static void key_at_or_above_nyquist_is_silent(void** state) {
  (void)state;
  Harp* const harp = new_harp(8000.0, &plain);
  for (uint32_t key = 0; key < HARP_KEYS; ++key) {
    const double f0_hz = 440.0 * exp2((key - 69.0) / 12.0);
    harp_reset(harp);
    harp_note_on(harp, 0, key, 127);
    assert_int_equal(harp_report(harp).n_strings, f0_hz < 4000.0);
    run_for(harp, 500);
    assert_true((peak_of(left, 500) > 0.0) == (f0_hz < 4000.0));
  }
  harp_free(harp);
}

static void dead_string_sleeps_in_exact_zeros(void** state) {
  (void)state;
  HarpPatch patch = plain;
  patch.string.damping_per_s = 20.0;
  Harp* const harp = new_harp(48000.0, &patch);
  const HarpString* const string = &harp->strings[A4];
  harp_note_on(harp, 0, A4, 127);
  double loudest = 0.0;
  double before = 0.0;
  uint32_t n_frames = 0;
  while (harp_report(harp).n_strings > 0 && n_frames < 480000) {
    before = fundamental_amplitude(string, 0.05);
    loudest = fmax(loudest, before);
    run_for(harp, 16);
    n_frames += 16;
  }
  /* The last that was seen of it is 16 frames old, in which it dies by 1 %. */
  assert_within("amplitude when it fell asleep, of its loudest", before / loudest, 1e-6 * 1.01);
  assert_within("seconds from ln(10⁶) τ", fabs(n_frames / 48000.0 - log(1e6) / 20.0), 0.05);
  for (uint32_t i = 0; i < string->voice.chain.n_masses; ++i) {
    assert_true(chain_position(&string->voice.chain, i) == 0.0f);
    assert_true(chain_velocity(&string->voice.chain, i) == 0.0f);
  }
  assert_true(harp_report(harp).n_masses == 0 && harp_report(harp).headroom == 1.0);
  run_for(harp, 99);
  assert_true(peak_of(left, 99) + peak_of(right, 99) == 0.0);
  harp_free(harp);
}

static void no_string_sleeps_before_120_db(void** state) {
  (void)state;
  static const uint32_t keys[] = {21, 45, 69, 93, 108, 114, 120, 122, 124, 126, 127};
  double worst = 0.0;
  Harp* const harp = new_harp(48000.0, &plain);
  for (size_t k = 0; k < sizeof(keys) / sizeof(keys[0]); ++k) {
    for (int step = 0; step < 30; step += keys[k] < 108 ? 14 : 1) {
      const double damping = 6.0 * pow(1.08, step);
      const HarpString* const string = &harp->strings[keys[k]];
      HarpPatch patch = plain;
      patch.string.damping_per_s = damping;
      harp_reset(harp);
      harp_set_patch(harp, &patch, 0);
      harp_note_on(harp, 0, keys[k], 90);
      double last = HUGE_VAL;
      double loudest = 0.0;
      for (uint32_t n = 0; harp_report(harp).n_strings > 0; n += 16) {
        assert_true(n < 48000 * 20 / damping);
        last = fundamental_amplitude(string, 1.0 / damping);
        loudest = fmax(loudest, chain_amplitude(&string->voice.chain, HUGE_VAL));
        run_for(harp, 16);
      }
      /* Every 16 frames: it may have died by that much more since it was seen. */
      worst = fmax(worst, last / loudest * exp(-16.0 * damping / 48000.0));
    }
  }
  harp_free(harp);
  assert_within("fundamental when put to sleep, of its loudest", worst, 1e-6);
}

/* τ of a string that rings and of one that is damped [s]. */
static const double RINGS_S = 1.0;
static const double DAMPED_S = 0.05;

/* That the fundamental of a key dies with `tau_s`, once the last gesture has acted. */
static void check_decay(Harp* harp, uint32_t key, double tau_s) {
  const HarpString* const string = &harp->strings[key];
  run_for(harp, 400);
  const double before = fundamental_amplitude(string, tau_s);
  run_for(harp, 4800);
  const double loss = log(before / fundamental_amplitude(string, tau_s));
  assert_within("τ, relative", fabs(0.1 / (loss * tau_s) - 1.0), 1e-4);
}

static void damper_falls_when_the_key_goes_up(void** state) {
  (void)state;
  Harp* const harp = new_harp(48000.0, &plain);
  harp_note_on(harp, 0, 60, 100);
  check_decay(harp, 60, RINGS_S);
  harp_note_off(harp, 0, 60);
  check_decay(harp, 60, DAMPED_S);
  harp_note_on(harp, 0, 60, 100);
  check_decay(harp, 60, RINGS_S);
  harp_free(harp);
}

static void pedal_holds_what_is_let_go(void** state) {
  (void)state;
  Harp* const harp = new_harp(48000.0, &plain);
  harp_note_on(harp, 0, 60, 100);
  harp_note_on(harp, 0, 64, 100);
  harp_pedal(harp, 0, 1.0);
  harp_note_off(harp, 0, 60);
  check_decay(harp, 60, RINGS_S);
  check_decay(harp, 64, RINGS_S);
  harp_pedal(harp, 0, 0.0);
  check_decay(harp, 60, DAMPED_S);
  check_decay(harp, 64, RINGS_S);
  harp_free(harp);
}

static void key_down_again_is_not_let_go_by_the_pedal(void** state) {
  (void)state;
  Harp* const harp = new_harp(48000.0, &plain);
  harp_pedal(harp, 0, 1.0);
  harp_note_on(harp, 0, 60, 100);
  harp_note_off(harp, 0, 60);
  harp_note_on(harp, 0, 60, 100);
  harp_pedal(harp, 0, 0.0);
  check_decay(harp, 60, RINGS_S);
  harp_note_off(harp, 0, 60);
  check_decay(harp, 60, DAMPED_S);
  harp_free(harp);
}

static void pedal_raises_fallen_dampers(void** state) {
  (void)state;
  Harp* const harp = new_harp(48000.0, &plain);
  harp_note_on(harp, 0, 60, 100);
  harp_note_off(harp, 0, 60);
  check_decay(harp, 60, DAMPED_S);
  harp_pedal(harp, 0, 1.0);
  check_decay(harp, 60, RINGS_S);
  harp_free(harp);
}

static void all_notes_off_is_every_key_up(void** state) {
  (void)state;
  Harp* const harp = new_harp(48000.0, &plain);
  harp_note_on(harp, 0, 60, 100);
  harp_note_on(harp, 0, 72, 100);
  harp_all_notes_off(harp, 0);
  check_decay(harp, 60, DAMPED_S);
  harp_note_on(harp, 0, 60, 100);
  harp_pedal(harp, 0, 1.0);
  harp_all_notes_off(harp, 0);
  check_decay(harp, 60, RINGS_S);
  harp_pedal(harp, 0, 0.0);
  check_decay(harp, 60, DAMPED_S);
  harp_free(harp);
}

static void all_sound_off_is_silence_in_a_moment(void** state) {
  (void)state;
  HarpPatch patch = plain;
  patch.string.release_s = 10.0;
  Harp* const harp = new_harp(48000.0, &patch);
  harp_pedal(harp, 0, 1.0);
  for (uint32_t key = 30; key < 90; ++key) {
    harp_note_on(harp, 0, key, 127);
  }
  run_for(harp, 1000);
  harp_silence(harp);
  run_for(harp, 4800);
  assert_true(peak_of(left + 4700, 100) < 1e-6);
  run_for(harp, 9600);
  assert_int_equal(harp_report(harp).n_strings, 0);
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    assert_false(harp->strings[i].holders || harp->strings[i].is_caught);
  }
  harp_set_patch(harp, &plain, 0);
  harp_note_on(harp, 0, 60, 100);
  harp_note_off(harp, 0, 60);
  check_decay(harp, 60, DAMPED_S);
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_string_is_stolen),
      cmocka_unit_test(key_at_or_above_nyquist_is_silent),
      cmocka_unit_test(dead_string_sleeps_in_exact_zeros),
      cmocka_unit_test(no_string_sleeps_before_120_db),
      cmocka_unit_test(damper_falls_when_the_key_goes_up),
      cmocka_unit_test(pedal_holds_what_is_let_go),
      cmocka_unit_test(key_down_again_is_not_let_go_by_the_pedal),
      cmocka_unit_test(pedal_raises_fallen_dampers),
      cmocka_unit_test(all_notes_off_is_every_key_up),
      cmocka_unit_test(all_sound_off_is_silence_in_a_moment),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
