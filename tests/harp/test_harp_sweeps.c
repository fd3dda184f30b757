/* Twenty keys ring while what they are made of is swept from end to end, with a new value for every
 * block. */
#include "core/harp/harp.h"

#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"
#include "tests/support/settings.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { N_KEYS = 20, LOWEST_KEY = 28, KEY_STEP = 4, MOST_BLOCK = 1024 };

typedef enum { SHAPE_RAMP, SHAPE_SQUARE, SHAPE_WALK, N_SHAPES } Shape;

/* One port of the settings, or one of these. */
enum { SWEEP_NOTHING = N_SETTINGS, SWEEP_BEND, SWEEP_ALL };

static const int sweeps[] = {SETTING_DAMPING, SETTING_LOSS,     SETTING_STIFFNESS, SETTING_MASSES,
                             SETTING_TUNING,  SETTING_PARTIALS, SWEEP_BEND,        SWEEP_ALL};

typedef struct {
  uint32_t block;
  double seconds;
} Pace;

/* Short where the sweeps cost more than the strings, long where they can feed them. */
static const Pace paces[] = {{64, 0.7}, {1, 0.04}, {17, 0.3}, {1024, 2.0}};

/*
  How much louder than unswept.  Tension that swings in time with a string feeds it without bound;
  the harp lets it have four times what the plucks gave.
*/
static const double MOST_LOUDER = 4.0;

/*
  Frames in which everything must be asleep: 14 time constants of the damper are −120 dB.  Where
  loss is great the mode nearest the limit only flips, with a pole at −1 + (4 − a − 2g)/g: with a
  margin of 1e-4 and g < 2 it may take 5000 frames for each of them.
*/
static const double MOST_FRAMES = 14.0 * 5000.0;
static const double RELEASE_S = 0.02;

typedef struct {
  Harp* harp;
  Random* random;
  double rate_hz;
  double walk;
  double peak;
  double least_headroom;
} Sweep;

/* The way from one end to the other at block `b`. */
static double way_at(Sweep* sweep, Shape shape, uint32_t b, uint32_t block) {
  const double period = fmax(2.0, 0.25 * sweep->rate_hz / block);
  const double phase = fmod(b / period, 1.0);
  sweep->walk += random_between(sweep->random, -0.1, 0.1);
  sweep->walk = fmin(fmax(sweep->walk, 0.0), 1.0);
  switch (shape) {
  case SHAPE_RAMP:
    return fabs(2.0 * phase - 1.0);
  case SHAPE_SQUARE:
    return b % 2;
  default:
    return sweep->walk;
  }
}

static void turn(Sweep* sweep, int what, double way, uint32_t block) {
  Setting setting = settings_default();
  setting.value[SETTING_RELEASE] = RELEASE_S;
  for (SettingName name = 0; name < N_SETTINGS; ++name) {
    const bool is_swept = what == SWEEP_ALL && name <= SETTING_PARTIALS;
    if (what == (int)name || is_swept) {
      setting.value[name] = settings_on_way(name, name % 2 ? 1.0 - way : way);
    }
  }
  const HarpPatch patch = settings_patch(&setting);
  const uint32_t shortest = (uint32_t)(0.005 * sweep->rate_hz) + 1;
  if (what != SWEEP_BEND) {
    harp_set_patch(sweep->harp, &patch, block > shortest ? block : shortest);
  }
  if (what == SWEEP_BEND || what == SWEEP_ALL) {
    harp_bend(sweep->harp, 0, 4.0 * way - 2.0);
  }
}

static void run_block(Sweep* sweep, uint32_t n_frames) {
  static float out[2][MOST_BLOCK];
  harp_run(sweep->harp, n_frames, out[0], out[1]);
  for (int side = 0; side < 2; ++side) {
    const double peak = measure_peak(out[side], n_frames);
    assert_true(isfinite(peak));
    sweep->peak = fmax(sweep->peak, peak);
  }
  const VoiceReport report = harp_report(sweep->harp);
  assert_true(report.headroom > 0.0);
  sweep->least_headroom = fmin(sweep->least_headroom, report.headroom);
}

/* Everything falls asleep, and what sleeps is silent. */
static void release(Sweep* sweep) {
  double n_left = MOST_FRAMES + 14.0 * RELEASE_S * sweep->rate_hz;
  harp_all_notes_off(sweep->harp, 0);
  while (harp_report(sweep->harp).n_strings > 0) {
    run_block(sweep, MOST_BLOCK);
    n_left -= MOST_BLOCK;
    assert_true(n_left > 0.0);
  }
  sweep->peak = 0.0;
  run_block(sweep, MOST_BLOCK);
  assert_true(sweep->peak == 0.0);
}

/* The loudest sample of a sweep; the keys are struck again one by one while it lasts. */
static double play(Sweep* sweep, int what, Shape shape, const Pace* pace) {
  const uint32_t n_blocks = (uint32_t)(pace->seconds * sweep->rate_hz / pace->block);
  const uint32_t per_strike = (uint32_t)(0.05 * sweep->rate_hz / pace->block) + 1;
  const double before = sweep->peak;
  harp_reset(sweep->harp);
  turn(sweep, SWEEP_NOTHING, 0.0, pace->block);
  sweep->peak = 0.0;
  for (uint32_t i = 0; i < N_KEYS; ++i) {
    harp_note_on(sweep->harp, 0, LOWEST_KEY + KEY_STEP * i, 127);
  }
  for (uint32_t b = 0; b < n_blocks; ++b) {
    turn(sweep, what, way_at(sweep, shape, b, pace->block), pace->block);
    if (b % per_strike == per_strike - 1) {
      harp_note_on(sweep->harp, 0, LOWEST_KEY + KEY_STEP * (b / per_strike % N_KEYS), 60);
    }
    run_block(sweep, pace->block);
  }
  const double peak = sweep->peak;
  release(sweep);
  sweep->peak = before;
  return peak;
}

static void sweeps_are_bounded(void** state) {
  const double rate_hz = *(const double*)*state;
  Random random = random_start();
  Sweep sweep = {.harp = harp_new(rate_hz),
                 .random = &random,
                 .rate_hz = rate_hz,
                 .walk = 0.5,
                 .least_headroom = 1.0};
  double worst = 0.0;
  assert_non_null(sweep.harp);
  for (size_t p = 0; p < sizeof(paces) / sizeof(paces[0]); ++p) {
    const double unswept = play(&sweep, SWEEP_NOTHING, SHAPE_RAMP, &paces[p]);
    for (size_t s = 0; s < sizeof(sweeps) / sizeof(sweeps[0]); ++s) {
      for (Shape shape = 0; shape < N_SHAPES; ++shape) {
        const double louder = play(&sweep, sweeps[s], shape, &paces[p]) / unswept;
        if (!(louder <= MOST_LOUDER)) {
          print_message("  sweep %zu, shape %d, blocks of %u: %g times\n", s, (int)shape,
                        paces[p].block, louder);
        }
        worst = fmax(worst, louder);
      }
    }
  }
  harp_free(sweep.harp);
  print_message("  %g Hz, least margin %.6g\n", rate_hz, sweep.least_headroom);
  assert_within("loudest, over unswept", worst, MOST_LOUDER);
}

/* Fewer frames are cheaper. */
static void other_rates(void** state) {
  static double rates_hz[] = {8e3, 192e3};
  for (int r = 0; r < (getenv("HOOKE_TEST_LONG") ? 2 : 1); ++r) {
    *state = &rates_hz[r];
    sweeps_are_bounded(state);
  }
}

int main(void) {
  static double rate_hz = 48e3;
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_prestate(sweeps_are_bounded, &rate_hz),
      cmocka_unit_test(other_rates),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
