#include "core/guitar/guitar.h"

#include "core/guitar/guitar_string.h"

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

enum { FRAMES = 48000 };

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

static void is_made_only_at_a_rate(void** state) {
  (void)state;
  static const double bad[] = {0.0, -48e3, (double)NAN, HUGE_VAL};
  for (int i = 0; i < 4; ++i) {
    assert_null(guitar_new(bad[i]));
  }
  guitar_free(NULL);
  Guitar* const guitar = guitar_new(44.1e3);
  assert_true(guitar_rate_hz(guitar) == 44.1e3);
  assert_int_equal(guitar_report(guitar).n_strings, 0);
  assert_true(guitar_report(guitar).headroom == 1.0);
  guitar_free(guitar);
}

/* Until it is given a patch there is nothing to pluck. */
static void has_no_strings_as_it_is_made(void** state) {
  (void)state;
  const GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitar_new(RATE_HZ);
  assert_non_null(guitar);
  for (int is_set = 0; is_set < 2; ++is_set) {
    for (uint32_t string = 0; string < 6; ++string) {
      guitars_pluck(guitar, string, 1.0);
    }
    assert_int_equal(guitar_report(guitar).n_strings, is_set ? 6 : 0);
    run(guitar, 2000, &first);
    assert_true(is_set ? measure_peak(first.left, 2000) > 0.05
                       : measure_peak(first.left, 2000) == 0.0);
    guitar_set_patch(guitar, &patch, 0);
  }
  guitar_free(guitar);
}

static void strings_that_are_not_there_are_ignored(void** state) {
  (void)state;
  static const uint32_t none[] = {6, 7, 8, UINT32_MAX};
  const GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitars_new(RATE_HZ, &patch);
  for (int i = 0; i < 4; ++i) {
    guitars_pluck(guitar, none[i], 1.0);
    guitar_fret(guitar, none[i], 3.0);
    guitar_hammer(guitar, none[i], 3.0, 1.0);
    guitar_bend(guitar, none[i], 1.0, 0.0);
    guitar_vibrato(guitar, none[i], 1.0, 5.0);
    guitar_damp(guitar, none[i], 1.0);
    guitar_let_ring(guitar, none[i]);
    guitar_touch(guitar, none[i], 0.5, 1.0);
    assert_false(guitar_is_awake(guitar, none[i]));
    assert_true(guitar_fretted(guitar, none[i]) == 0.0);
  }
  run(guitar, 1000, &first);
  assert_true(measure_peak(first.left, 1000) == 0.0);
  guitar_free(guitar);
}

/* One that the patch takes away while it rings is choked. */
static void string_taken_away_falls_silent(void** state) {
  (void)state;
  GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitars_new(RATE_HZ, &patch);
  guitars_pluck(guitar, 5, 1.0);
  guitars_pluck(guitar, 0, 1.0);
  run(guitar, 1000, &first);
  patch.n_strings = 5;
  guitar_set_patch(guitar, &patch, 480);
  guitars_run(guitar, (uint32_t)(0.15 * RATE_HZ), NULL);
  assert_false(guitar_is_awake(guitar, 5));
  assert_true(guitar_is_awake(guitar, 0));
  assert_int_equal(guitar_report(guitar).n_strings, 1);
  guitar_free(guitar);
}

/* Everything that was done is undone. */
static void reset_is_as_new(void** state) {
  (void)state;
  GuitarPatch patch = guitars_patch();
  patch.course = 0.5;
  for (int i = 0; i < 20; ++i) {
    Random random = {(uint64_t)i};
    Guitar* const used = guitars_new(RATE_HZ, &patch);
    Guitar* const new = guitars_new(RATE_HZ, &patch);
    for (int n = 0; n < 60; ++n) {
      guitars_storm(used, &random);
      guitars_run(used, random_below(&random, 300), NULL);
    }
    guitar_set_patch(used, &patch, 0);
    guitar_reset(used);
    run(used, 500, &first);
    assert_true(measure_peak(first.left, 500) == 0.0 && guitar_report(used).n_strings == 0);
    run(new, 500, &first);
    for (uint32_t s = 0; s < 6; ++s) {
      assert_true(guitar_fretted(used, s) == 0.0);
      guitars_pluck(used, s, 1.0);
      guitar_touch(used, s, 0.3, 0.01);
      guitars_pluck(new, s, 1.0);
      guitar_touch(new, s, 0.3, 0.01);
    }
    run(used, 5000, &first);
    run(new, 5000, &second);
    assert_memory_equal(&first, &second, sizeof(first));
    guitar_free(used);
    guitar_free(new);
  }
}

/* By itself, so that its masses can be seen. */
static void dead_string_sleeps_in_exact_zeros(void** state) {
  (void)state;
  static _Alignas(CHAIN_ALIGNMENT) char memory[1 << 16];
  GuitarPatch patch = guitars_patch();
  const GuitarGains gains = {.is_read = {false, false}};
  GuitarString string;
  float none[GUITAR_MIX_FRAMES] = {0};
  uint32_t n_frames = 0;
  patch.string.damping_per_s = 20.0;
  patch.string.tracking = 0.0;
  assert_true(chain_size(GUITAR_MAX_MASSES) <= sizeof(memory));
  guitar_string_init(&string, &patch, RATE_HZ, 0, memory);
  string.open = 45.0;
  guitar_string_pluck(&string, (Pluck){0.3, 0.5, 0.25, 0.0});
  assert_true(string.voice.is_awake);
  while (string.voice.is_awake && n_frames < 100000) {
    guitar_string_run(&string, &gains, 16, none, NULL);
    n_frames += 16;
  }
  assert_within("seconds from ln(10⁶) τ", fabs(n_frames / RATE_HZ - log(1e6) / 20.0), 0.05);
  for (uint32_t i = 0; i < string.voice.chain.n_masses; ++i) {
    assert_true(chain_position(&string.voice.chain, i) == 0.0f);
    assert_true(chain_velocity(&string.voice.chain, i) == 0.0f);
  }
}

/* A finger that falls is a pluck of four tenths at the fret, as far out as there is string. */
static void hammer_is_a_weak_pluck_where_the_finger_falls(void** state) {
  (void)state;
  const GuitarPatch patch = guitars_patch();
  const double place = GUITAR_FARTHEST * exp2(-5.0 / 12.0);
  double worst = 0.0;
  Guitar* const guitar = guitars_new(RATE_HZ, &patch);
  guitar_hammer(guitar, 1, 5.0, 0.7);
  run(guitar, 5000, &first);
  guitar_reset(guitar);
  guitar_fret(guitar, 1, 5.0);
  guitar_pluck(guitar, 1, (GuitarPluck){0.7 * 0.4, place, 0.4});
  run(guitar, 5000, &second);
  for (uint32_t n = 0; n < 5000; ++n) {
    worst = fmax(worst, fabs((double)first.left[n] - (double)second.left[n]));
  }
  assert_true(measure_peak(first.left, 5000) > 0.01);
  assert_within("off the pluck", worst, 1e-5 * GUITAR_NOTE_PEAK);
  guitar_free(guitar);
}

/* The two upper strings have their like, a little sharp; the others the octave. */
static void course_has_a_string_beside_each(void** state) {
  (void)state;
  for (uint32_t s = 0; s < 6; ++s) {
    const double up = s < 2 ? 0.03 : 12.03;
    GuitarPatch patch = guitars_patch();
    Guitar* const guitar = guitars_new(RATE_HZ, &patch);
    guitars_pluck(guitar, s, 1.0);
    assert_int_equal(guitar_report(guitar).n_strings, 1);
    run(guitar, FRAMES, &first);
    guitar_reset(guitar);
    patch.course = 0.6;
    guitar_set_patch(guitar, &patch, 0);
    guitars_pluck(guitar, s, 1.0);
    assert_int_equal(guitar_report(guitar).n_strings, 2);
    run(guitar, FRAMES, &second);
    for (uint32_t n = 0; n < FRAMES; ++n) {
      second.left[n] -= first.left[n];
    }
    const Tone asked = guitars_tone(&patch, s, up);
    Tone heard = {0};
    assert_true(measure_tone(second.left, FRAMES, RATE_HZ, asked, &heard));
    assert_within("cents", fabs(measure_cents(heard.f0_hz, asked.f0_hz)), 0.005);
    guitar_free(guitar);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(is_made_only_at_a_rate),
      cmocka_unit_test(has_no_strings_as_it_is_made),
      cmocka_unit_test(strings_that_are_not_there_are_ignored),
      cmocka_unit_test(string_taken_away_falls_silent),
      cmocka_unit_test(reset_is_as_new),
      cmocka_unit_test(dead_string_sleeps_in_exact_zeros),
      cmocka_unit_test(hammer_is_a_weak_pluck_where_the_finger_falls),
      cmocka_unit_test(course_has_a_string_beside_each),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
