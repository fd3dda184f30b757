/* What damps the strings of the guitar, and what lifts it. */
#include "core/guitar/guitar.h"

#include "tests/support/guitars.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static const double RATE_HZ = 48e3;

enum { FRAMES = 48000, GESTURE = 192 };

/* Both sides of a run. */
typedef struct {
  float left[FRAMES];
  float right[FRAMES];
} Sound;

static Sound first;
static Sound second;

static void run(Guitar* guitar, uint32_t n_frames, Sound* sound) {
  assert_true(n_frames <= FRAMES);
  memset(sound, 0, sizeof(*sound));
  guitar_run(guitar, n_frames, sound->left, sound->right);
}

/* As letting ring by hand at that very frame. */
static void damp_lifts_after_its_time(void** state) {
  (void)state;
  static const uint32_t times[] = {192, 193, 1000, 4801};
  const GuitarPatch patch = guitars_patch();
  for (int i = 0; i < 4; ++i) {
    for (int is_damped_by_hand = 0; is_damped_by_hand < 2; ++is_damped_by_hand) {
      Sound* const sound = is_damped_by_hand ? &second : &first;
      Guitar* const guitar = guitars_new(RATE_HZ, &patch);
      guitars_pluck(guitar, 3, 1.0);
      guitars_run(guitar, 1000, NULL);
      guitar_damp(guitar, 3, is_damped_by_hand ? HUGE_VAL : times[i] / RATE_HZ);
      guitars_run(guitar, times[i], NULL);
      if (is_damped_by_hand) {
        guitar_let_ring(guitar, 3);
      }
      run(guitar, 10000, sound);
      guitar_free(guitar);
    }
    assert_memory_equal(&first, &second, sizeof(first));
  }
}

/* τ of a string from now on, over half a second at the most. */
static double heard_tau_s(Guitar* guitar, uint32_t string, double tau_s) {
  const GuitarPatch patch = guitars_patch();
  const Tone near = {guitars_tone(&patch, string, guitar_fretted(guitar, string)).f0_hz, tau_s};
  Tone heard = {0};
  guitars_run(guitar, 2 * GESTURE, NULL);
  run(guitar, FRAMES, &first);
  assert_true(measure_tone(first.left, FRAMES, RATE_HZ, near, &heard));
  return heard.tau_s;
}

/* 0: pluck, 1: hammer-on, 2: let ring, 3: nothing. */
static double tau_after_damping(int what) {
  const GuitarPatch patch = guitars_patch();
  const Tone open = guitars_tone(&patch, 0, what == 1 ? 2.0 : 0.0);
  Guitar* const guitar = guitars_new(RATE_HZ, &patch);
  guitars_pluck(guitar, 0, 1.0);
  guitars_run(guitar, 500, NULL);
  guitar_damp(guitar, 0, HUGE_VAL);
  guitars_run(guitar, 500, NULL);
  if (what == 0) {
    guitars_pluck(guitar, 0, 1.0);
  } else if (what == 1) {
    guitar_hammer(guitar, 0, 2.0, 1.0);
  } else if (what == 2) {
    guitar_let_ring(guitar, 0);
  }
  const double wanted = what == 3 ? patch.string.release_s : open.tau_s;
  const double tau_s = heard_tau_s(guitar, 0, wanted);
  guitar_free(guitar);
  return fabs(tau_s / wanted - 1.0);
}

static void damp_dies_with_the_release_until_it_lifts(void** state) {
  (void)state;
  double worst = 0.0;
  for (int what = 0; what < 4; ++what) {
    worst = fmax(worst, tau_after_damping(what));
  }
  assert_within("τ, relative", worst, 2e-4);
}

/* A damper never makes a string ring longer. */
static void damp_is_no_gentler_than_the_air(void** state) {
  (void)state;
  GuitarPatch patch = guitars_patch();
  patch.string.release_s = 10.0;
  patch.string.damping_per_s = 5.0;
  patch.string.tracking = 0.0;
  Guitar* const guitar = guitars_new(RATE_HZ, &patch);
  guitars_pluck(guitar, 0, 1.0);
  guitar_damp(guitar, 0, HUGE_VAL);
  assert_within("τ, relative", fabs(heard_tau_s(guitar, 0, 0.2) / 0.2 - 1.0), 2e-4);
  guitar_free(guitar);
}

static void choke_is_silence_in_a_moment(void** state) {
  (void)state;
  GuitarPatch patch = guitars_patch();
  patch.course = 1.0;
  patch.string.release_s = 10.0;
  patch.string.loss = 0.0;
  Guitar* const guitar = guitars_new(RATE_HZ, &patch);
  for (uint32_t s = 0; s < 6; ++s) {
    guitar_fret(guitar, s, 3.0);
    guitars_pluck(guitar, s, 1.0);
  }
  guitars_run(guitar, 3000, NULL);
  guitar_choke(guitar);
  run(guitar, 7200, &first);
  assert_true(measure_peak(first.left + 4800, 200) < 1e-6);
  assert_true(measure_peak(first.left + 7100, 100) == 0.0);
  assert_int_equal(guitar_report(guitar).n_strings, 0);
  assert_true(guitar_fretted(guitar, 4) == 3.0);
  guitars_pluck(guitar, 0, 1.0);
  assert_true(guitar_is_awake(guitar, 0));
  run(guitar, 7200, &first);
  assert_true(measure_peak(first.left + 7000, 200) > 0.01);
  guitar_free(guitar);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(damp_lifts_after_its_time),
      cmocka_unit_test(damp_dies_with_the_release_until_it_lifts),
      cmocka_unit_test(damp_is_no_gentler_than_the_air),
      cmocka_unit_test(choke_is_silence_in_a_moment),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
