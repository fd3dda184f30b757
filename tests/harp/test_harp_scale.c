/* A harp whose keys have the pitches of a scale. */
#include "core/harp/harp.h"

#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, FRAMES = 9600 };

static const HarpPatch plain = {
    .level = 1.0,
    .string.damping_per_s = 1.0,
    .string.tracking = 0.5,
    .string.loss = 0.01,
    .pickup = 0.12,
    .spread = 0.1,
    .pluck = 0.2,
    .hardness = 0.5,
    .string.release_s = 0.05,
    .string.tuning_hz = 440.0,
    .string.max_masses = CHAIN_MAX_MASSES,
};

typedef struct {
  float left[FRAMES];
  float right[FRAMES];
} Sound;

static Harp* new_harp(void) {
  Harp* const harp = harp_new(RATE);
  assert_non_null(harp);
  harp_set_patch(harp, &plain, 0);
  return harp;
}

/* Keys `step` semitones apart, with A4 as it is. */
static void set_steps(Harp* harp, double step) {
  double semitones[HARP_KEYS];
  for (int key = 0; key < HARP_KEYS; ++key) {
    semitones[key] = step * (key - 69);
  }
  harp_set_scale(harp, 0, semitones, true);
}

static void set_key(Harp* harp, int key, double semitones) {
  double scale[HARP_KEYS];
  for (int k = 0; k < HARP_KEYS; ++k) {
    scale[k] = k - 69;
  }
  scale[key] = semitones;
  harp_set_scale(harp, 0, scale, true);
}

static void run(Harp* harp, Sound* sound, uint32_t from, uint32_t to) {
  harp_run(harp, to - from, sound->left + from, sound->right + from);
}

/* What the coefficients will be heard as, by the poles. */
static Tone tone_of(const Harp* harp, uint32_t key) {
  const Chain* const chain = &harp->strings[key].voice.chain;
  return pole_tone(harp->rate_hz, tuning_mode(chain->goal, chain->n_masses, 1));
}

static double cents_off(const Harp* harp, uint32_t key, double wanted_hz) {
  return fabs(measure_cents(tone_of(harp, key).f0_hz, wanted_hz));
}

static void every_key_has_the_pitch_of_the_scale(void** state) {
  (void)state;
  static const double steps[] = {1.0, 0.31, 0.6316, -1.0, 0.0, 1.46};
  static const double bends[] = {0.0, 1.5, -2.0};
  double worst = 0.0;
  double worst_decay = 0.0;
  Harp* const harp = new_harp();
  for (size_t s = 0; s < sizeof(steps) / sizeof(steps[0]); ++s) {
    for (size_t b = 0; b < 3; ++b) {
      HarpPatch patch = plain;
      patch.string.tuning_hz = b == 1 ? 415.0 : 440.0;
      harp_reset(harp);
      harp_set_patch(harp, &patch, 0);
      set_steps(harp, steps[s]);
      harp_bend(harp, 0, bends[b]);
      for (uint32_t key = 0; key < HARP_KEYS; ++key) {
        const double octaves = ((double)key - 69.0) / 12.0;
        const double hz = patch.string.tuning_hz * exp2(steps[s] * octaves + bends[b] / 12.0);
        harp_note_on(harp, 0, key, 100);
        assert_true(hz >= 0.49 * RATE || harp->strings[key].voice.is_awake);
        assert_true(hz < 0.5 * RATE || !harp->strings[key].voice.is_awake);
        if (harp->strings[key].voice.is_awake) {
          const double tau_s =
              1.0 / (plain.string.damping_per_s * exp2(plain.string.tracking * octaves));
          worst = fmax(worst, cents_off(harp, key, hz));
          worst_decay = fmax(worst_decay, fabs(tone_of(harp, key).tau_s / tau_s - 1.0));
        }
      }
    }
  }
  harp_free(harp);
  /* A closed form there and its inverse back: nothing but roundings. */
  assert_within("cents", worst, 1e-9);
  assert_within("decay", worst_decay, 1e-12);
}

static void equal_temperament_is_where_it_begins(void** state) {
  (void)state;
  static Sound never;
  static Sound told;
  for (int i = 0; i < 2; ++i) {
    Sound* const sound = i ? &told : &never;
    Harp* const harp = new_harp();
    if (i) {
      set_steps(harp, 1.0);
    }
    harp_bend(harp, 0, 0.37);
    for (uint32_t key = 0; key < HARP_KEYS; key += 5) {
      harp_note_on(harp, 0, key, 90);
    }
    run(harp, sound, 0, 3000);
    if (i) {
      set_steps(harp, 1.0);
    }
    run(harp, sound, 3000, FRAMES);
    harp_free(harp);
  }
  assert_memory_equal(&never, &told, sizeof(never));
}

/* A key tuned as another has as many masses as that one, if they are damped alike. */
static void a_low_pitch_has_its_masses_on_every_key(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  HarpPatch patch = plain;
  patch.string.tracking = 0.0;
  harp_set_patch(harp, &patch, 0);
  for (int pitch = 0; pitch < 128; pitch += 9) {
    harp_reset(harp);
    set_steps(harp, 1.0);
    harp_note_on(harp, 0, (uint32_t)pitch, 100);
    const uint32_t n_masses = harp->strings[pitch].voice.chain.n_masses;
    for (int key = 0; key < 128; key += 7) {
      harp_reset(harp);
      set_key(harp, key, pitch - 69);
      harp_note_on(harp, 0, (uint32_t)key, 100);
      assert_int_equal(harp->strings[key].voice.chain.n_masses, n_masses);
    }
  }
  set_key(harp, 127, -69.0);
  harp_note_on(harp, 0, 127, 100);
  assert_int_equal(harp->strings[127].voice.chain.n_masses, CHAIN_MAX_MASSES);
  harp_free(harp);
}

static void a_key_without_a_pitch_is_silent(void** state) {
  (void)state;
  static Sound sound;
  Harp* const harp = new_harp();
  set_key(harp, 60, (double)NAN);
  harp_note_on(harp, 0, 60, 127);
  run(harp, &sound, 0, FRAMES);
  assert_int_equal(harp_report(harp).n_strings, 0);
  harp_note_off(harp, 0, 60);
  set_steps(harp, 1.0);
  harp_note_on(harp, 0, 60, 127);
  assert_int_equal(harp_report(harp).n_strings, 1);
  assert_true(cents_off(harp, 60, 440.0 * exp2(-0.75)) < 1e-5);
  harp_free(harp);
}

/* A tenth of a second is what a hand takes that chokes; a glide takes the rest. */
static void what_loses_its_pitch_is_choked(void** state) {
  (void)state;
  static Sound sound;
  Harp* const harp = new_harp();
  harp_note_on(harp, 0, 60, 127);
  harp_note_on(harp, 0, 64, 127);
  run(harp, &sound, 0, 2000);
  set_key(harp, 60, (double)NAN);
  assert_true(harp->strings[60].voice.chain.n_gliding == harp->n_gesture);
  harp_note_on(harp, 0, 60, 127);
  run(harp, &sound, 2000, 2000 + RATE / 8);
  assert_false(harp->strings[60].voice.is_awake);
  assert_true(harp->strings[64].voice.is_awake);
  harp_free(harp);
}

static void what_rings_glides_in_a_gesture(void** state) {
  (void)state;
  static const double steps[] = {0.9, 1.0, 1.02, 0.5, -1.0, 1.0};
  static Sound sound;
  double worst = 0.0;
  Harp* const harp = new_harp();
  for (uint32_t key = 40; key < 90; key += 7) {
    harp_note_on(harp, 0, key, 100);
  }
  harp_note_off(harp, 0, 47);
  run(harp, &sound, 0, 500);
  for (size_t s = 0; s < 6; ++s) {
    set_steps(harp, steps[s]);
    for (uint32_t key = 40; key < 90; key += 7) {
      const Chain* const chain = &harp->strings[key].voice.chain;
      worst = fmax(worst, cents_off(harp, key, 440.0 * exp2(steps[s] * ((int)key - 69) / 12.0)));
      assert_int_equal(chain->n_gliding, harp->n_gesture);
      assert_true(harp->strings[key].lift == (key == 47 ? 0.0 : 1.0));
    }
    run(harp, &sound, 500, 500 + harp->n_gesture);
    for (uint32_t key = 40; key < 90; key += 7) {
      const Chain* const chain = &harp->strings[key].voice.chain;
      assert_int_equal(chain->n_gliding, 0);
      assert_memory_equal(&chain->now, &chain->goal, sizeof(StringCoefs));
    }
  }
  harp_free(harp);
  assert_within("cents", worst, 1e-9);
}

static void what_keeps_its_pitch_is_not_touched(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  static Sound sound;
  harp_note_on(harp, 0, 60, 100);
  harp_note_on(harp, 0, 62, 100);
  run(harp, &sound, 0, 1000);
  set_key(harp, 62, -6.5);
  assert_int_equal(harp->strings[60].voice.chain.n_gliding, 0);
  assert_int_equal(harp->strings[62].voice.chain.n_gliding, harp->n_gesture);
  harp_free(harp);
}

static void it_outlives_a_reset_and_a_patch(void** state) {
  (void)state;
  Harp* const harp = new_harp();
  set_key(harp, 60, 2.5);
  harp_reset(harp);
  harp_set_patch(harp, &plain, 0);
  harp_note_on(harp, 0, 60, 100);
  harp_silence(harp);
  assert_true(cents_off(harp, 60, 440.0 * exp2(2.5 / 12.0)) < 1e-5);
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_key_has_the_pitch_of_the_scale),
      cmocka_unit_test(equal_temperament_is_where_it_begins),
      cmocka_unit_test(a_low_pitch_has_its_masses_on_every_key),
      cmocka_unit_test(a_key_without_a_pitch_is_silent),
      cmocka_unit_test(what_loses_its_pitch_is_choked),
      cmocka_unit_test(what_rings_glides_in_a_gesture),
      cmocka_unit_test(what_keeps_its_pitch_is_not_touched),
      cmocka_unit_test(it_outlives_a_reset_and_a_patch),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
