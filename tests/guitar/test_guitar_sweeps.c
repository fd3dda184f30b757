/* Storms of everything that can be done to a guitar, and wheels that swing. */
#include "core/guitar/guitar_event.h"

#include "tests/support/guitars.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { STORM_FRAMES = 24000, STORM_GAP = 60, MOST_BLOCK = 1024 };

/*
  How much louder than unswept.  Tension that swings in time with a string feeds it without bound;
  a string is let have four times what its plucks gave.  That is its amplitude times √ω, so at a
  lower pitch its amplitude may be the larger.
*/
static const double MOST_LOUDER = 4.0;

/* Both sides of a storm. */
typedef struct {
  float left[STORM_FRAMES];
  float right[STORM_FRAMES];
} Sound;

static Sound sound;

/* The same storm at the same frames, however they are cut. */
static void storm(double rate_hz, uint32_t block, uint64_t seed, Sound* out) {
  const GuitarPatch patch = guitars_patch();
  Random random = {seed};
  Guitar* const guitar = guitars_new(rate_hz, &patch);
  uint32_t next = 0;
  for (uint32_t done = 0; done < STORM_FRAMES;) {
    while (next == done) {
      guitars_storm(guitar, &random);
      next = done + random_below(&random, STORM_GAP);
    }
    const uint32_t until = next < STORM_FRAMES ? next : STORM_FRAMES;
    const uint32_t n = until - done < block ? until - done : block;
    guitar_run(guitar, n, out->left + done, out->right + done);
    done += n;
  }
  guitar_free(guitar);
}

static void blocks_do_not_change_the_sound(void** state) {
  (void)state;
  static const uint32_t blocks[] = {1, 3, 64, 100, 256};
  static Sound cut;
  for (uint64_t seed = 0; seed < (getenv("HOOKE_TEST_LONG") ? 20 : 2); ++seed) {
    storm(48e3, STORM_FRAMES, seed, &sound);
    assert_true(measure_peak(sound.left, STORM_FRAMES) > 0.01);
    for (int b = 0; b < 5; ++b) {
      storm(48e3, blocks[b], seed, &cut);
      assert_memory_equal(&sound, &cut, sizeof(sound));
    }
  }
}

/* Fewer events, so that blocks are longer than what is mixed at a time. */
static void long_blocks_do_not_change_the_sound(void** state) {
  (void)state;
  enum { FRAMES = 20000, EVERY = 2500 };
  static const uint32_t blocks[] = {1, 100, 256, 1000, 2500};
  static Sound cuts[2];
  for (int b = 0; b < 5; ++b) {
    const GuitarPatch patch = guitars_patch();
    Random random = {7};
    Guitar* const guitar = guitars_new(44.1e3, &patch);
    Sound* const out = &cuts[b > 0];
    for (uint32_t done = 0; done < FRAMES;) {
      for (int i = 0; done % EVERY == 0 && i < 12; ++i) {
        guitars_storm(guitar, &random);
      }
      const uint32_t left = EVERY - done % EVERY;
      const uint32_t n = left < blocks[b] ? left : blocks[b];
      guitar_run(guitar, n, out->left + done, out->right + done);
      done += n;
    }
    guitar_free(guitar);
    assert_memory_equal(&cuts[0], out, b > 0 ? sizeof(*out) : 0);
  }
}

/* All goes silent: a hand on all strings, and two tenths of a second.  At 8 kHz a mode near the
 * limit may only flip, but the hand lets none go on for longer.  A body rings on, and is taken
 * away. */
static void choke(Guitar* guitar) {
  static float out[2][MOST_BLOCK];
  const GuitarPatch patch = guitars_patch();
  const double rate_hz = guitar_rate_hz(guitar);
  guitar_choke(guitar);
  guitars_run(guitar, (uint32_t)(0.15 * rate_hz) + 2 * MOST_BLOCK, NULL);
  guitar_set_patch(guitar, &patch, 0);
  guitar_run(guitar, MOST_BLOCK, out[0], out[1]);
  assert_int_equal(guitar_report(guitar).n_strings, 0);
  assert_true(measure_peak(out[0], MOST_BLOCK) + measure_peak(out[1], MOST_BLOCK) == 0.0);
}

static void nothing_blows_up(void** state) {
  const double rate_hz = *(const double*)*state;
  const uint32_t n_events = getenv("HOOKE_TEST_LONG") ? 100000 : 10000;
  static float out[2][MOST_BLOCK];
  const GuitarPatch patch = guitars_patch();
  Random random = random_start();
  Guitar* const guitar = guitars_new(rate_hz, &patch);
  double peak = 0.0;
  double headroom = 1.0;
  for (uint32_t i = 1; i <= n_events; ++i) {
    guitars_storm(guitar, &random);
    if (random_below(&random, 3) == 0) {
      const uint32_t n = random_below(&random, 200);
      guitar_run(guitar, n, out[0], out[1]);
      for (int side = 0; side < 2; ++side) {
        const double here = measure_peak(out[side], n);
        assert_true(isfinite(here));
        peak = fmax(peak, here);
      }
      headroom = fmin(headroom, guitar_report(guitar).headroom);
      assert_true(headroom > 0.0);
    }
    if (i % 1000 == 0) {
      choke(guitar);
    }
  }
  guitar_free(guitar);
  print_message("  %g Hz: peak %g, least margin %g\n", rate_hz, peak, headroom);
}

/* A gesture in all its extremes, again at every frame or so; strings are plucked now and then. */
typedef struct {
  GuitarEvent events[2]; /* In turn */
  uint32_t every;
  double lowest; /* Pitch that it goes to [semitones] */
} Sweep;

static const Sweep sweeps[] = {
    {{{GUITAR_LET_RING, 0, {0.0f}}, {GUITAR_LET_RING, 0, {0.0f}}}, 64, 0.0}, /* Nothing: unswept */
    {{{GUITAR_FRET, 0, {-48.0f}}, {GUITAR_FRET, 0, {48.0f}}}, 1, -48.0},
    {{{GUITAR_FRET, 0, {-48.0f}}, {GUITAR_FRET, 0, {48.0f}}}, 300, -48.0},
    {{{GUITAR_FRET, 0, {0.0f}}, {GUITAR_FRET, 0, {12.0f}}}, 1000, 0.0},
    {{{GUITAR_BEND, 0, {-48.0f}}, {GUITAR_BEND, 0, {48.0f}}}, 1, -48.0},
    {{{GUITAR_BEND, 0, {-48.0f}}, {GUITAR_BEND, 0, {48.0f}}}, 193, -48.0},
    {{{GUITAR_BEND, 0, {-12.0f, 0.01f}}, {GUITAR_BEND, 0, {12.0f, 0.01f}}}, 480, -12.0},
    {{{GUITAR_SLIDE, 0, {0.0f, 0.02f}}, {GUITAR_SLIDE, 0, {24.0f, 0.02f}}}, 700, 0.0},
    {{{GUITAR_VIBRATO, 0, {12.0f, 50.0f}}, {GUITAR_VIBRATO, 0, {12.0f, 50.0f}}}, 20000, -12.0},
    {{{GUITAR_VIBRATO, 0, {12.0f, 50.0f}}, {GUITAR_VIBRATO, 0, {0.0f, 0.0f}}}, 1, -12.0},
    {{{GUITAR_DAMP, 0, {0.0f}}, {GUITAR_LET_RING, 0, {0.0f}}}, 1, 0.0},
    {{{GUITAR_TOUCH, 0, {0.5f, 0.0f}}, {GUITAR_TOUCH, 0, {0.01f, 0.01f}}}, 1, 0.0},
    {{{GUITAR_PALM, 0, {0.0f}}, {GUITAR_PALM, 0, {1.0f}}}, 7, 0.0},
    {{{GUITAR_BEND, 0, {-2.0f}}, {GUITAR_BEND, 0, {2.0f}}}, 1024, -2.0},
    {{{GUITAR_BEND, 0, {-2.0f}}, {GUITAR_BEND, 0, {2.0f}}},
     291,
     -2.0}, /* Twice a period of E: in time */
};

/* The loudest sample of six strings, swept for a while; the first is plucked again and again. */
static double swept_peak(const Sweep* sweep, double rate_hz, uint32_t n_frames) {
  static float out[2][MOST_BLOCK];
  const GuitarPatch patch = guitars_patch();
  Guitar* const guitar = guitars_new(rate_hz, &patch);
  const uint32_t per_pluck = (uint32_t)(0.3 * rate_hz);
  double peak = 0.0;
  uint32_t turn = 0;
  for (uint32_t done = 0; done < n_frames; ++turn) {
    if (done == 0 || done / per_pluck != (done - sweep->every) / per_pluck) {
      for (uint32_t s = 0; done == 0 && s < 6; ++s) {
        guitars_pluck(guitar, s, 1.0);
      }
      guitars_pluck(guitar, done / per_pluck % 6, 0.5);
    }
    GuitarEvent event = sweep->events[turn % 2];
    for (event.string = 0; event.string < 6; ++event.string) {
      assert_true(guitar_event_play(guitar, &event));
    }
    for (uint32_t left = sweep->every; left > 0;) {
      const uint32_t n = left < MOST_BLOCK ? left : MOST_BLOCK;
      guitar_run(guitar, n, out[0], out[1]);
      peak = fmax(peak, fmax(measure_peak(out[0], n), measure_peak(out[1], n)));
      left -= n;
    }
    assert_true(isfinite(peak));
    done += sweep->every;
  }
  choke(guitar);
  guitar_free(guitar);
  return peak;
}

static void sweeps_are_bounded(void** state) {
  (void)state;
  static const double rates_hz[] = {8e3, 48e3, 192e3};
  double worst = 0.0;
  for (int r = 0; r < (getenv("HOOKE_TEST_LONG") ? 3 : 2); ++r) {
    const double unswept = swept_peak(&sweeps[0], rates_hz[r], (uint32_t)(3.0 * rates_hz[r]));
    for (size_t i = 1; i < sizeof(sweeps) / sizeof(sweeps[0]); ++i) {
      const double seconds = sweeps[i].every < 10 ? 0.1 : 3.0;
      const uint32_t n = (uint32_t)(seconds * rates_hz[r]);
      const double deeper = exp2(-sweeps[i].lowest / 24.0);
      const double louder = swept_peak(&sweeps[i], rates_hz[r], n) / (deeper * unswept);
      if (!(louder <= 1.5)) {
        print_message("  sweep %zu at %g Hz: %.3g times\n", i, rates_hz[r], louder);
      }
      worst = fmax(worst, louder);
    }
  }
  assert_within("loudest, over unswept", worst, MOST_LOUDER);
}

/* The gains of two pickups in one place cancel; one that is not read does not matter. */
static void play(const GuitarPatch* patch, Sound* out) {
  Guitar* const guitar = guitars_new(48e3, patch);
  for (uint32_t s = 0; s < 6; ++s) {
    guitars_pluck(guitar, s, 1.0);
  }
  memset(out, 0, sizeof(*out));
  guitar_run(guitar, 4000, out->left, out->right);
  guitar_slide(guitar, 2, 9.0, 0.1);
  guitar_fret(guitar, 3, 4.0);
  guitar_run(guitar, 16000, out->left + 4000, out->right + 4000);
  guitar_free(guitar);
}

static void pickups_cancel_or_do_not_matter(void** state) {
  (void)state;
  static Sound other;
  GuitarPatch patch = guitars_patch();
  patch.width = 1.0;
  play(&patch, &sound);
  patch.pickups[1] = (GuitarPickup){0.77, 0.0};
  play(&patch, &other);
  assert_memory_equal(&sound, &other, sizeof(sound));
  patch.pickups[0] = (GuitarPickup){0.31, 0.7};
  patch.pickups[1] = (GuitarPickup){0.31, -0.7};
  play(&patch, &other);
  assert_true(measure_peak(other.left, 20000) == 0.0 && measure_peak(other.right, 20000) == 0.0);
  patch.pickups[1].place = 0.32;
  play(&patch, &other);
  assert_true(measure_peak(other.left, 20000) > 0.0);
}

int main(void) {
  static double rates_hz[] = {8e3, 44.1e3, 192e3};
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(blocks_do_not_change_the_sound),
      cmocka_unit_test(long_blocks_do_not_change_the_sound),
      cmocka_unit_test_prestate(nothing_blows_up, &rates_hz[0]),
      cmocka_unit_test_prestate(nothing_blows_up, &rates_hz[1]),
      cmocka_unit_test_prestate(nothing_blows_up, &rates_hz[2]),
      cmocka_unit_test(sweeps_are_bounded),
      cmocka_unit_test(pickups_cancel_or_do_not_matter),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
