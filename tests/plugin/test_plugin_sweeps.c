/* Ports and the wheel swept from end to end by a host, with new values for every block. */
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/settings.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

static const double RATE_HZ = 48000.0;

enum { N_KEYS = 20, LOWEST_KEY = 28, KEY_STEP = 4, MOST_BLOCK = 1024, NOTHING = -1, WHEEL = -2 };

/* Swept in squares, which feed the most, and in a ramp; the wheel as well. */
static const int sweeps[] = {
    SETTING_STIFFNESS, SETTING_TUNING, SETTING_DAMPING, SETTING_LOSS, SETTING_MASSES,
    SETTING_PARTIALS,  WHEEL};
static const uint32_t blocks[] = {64, 1024, 17};

/* Four times what the plucks gave is what strings are let have. */
static const double MOST_LOUDER = 4.0;

static double run_block(Host* host, uint32_t n_frames) {
  if (!host_run(host, n_frames)) {
    fail_msg("%s", host_error(host));
  }
  const double left = measure_peak(host_output(host, 0), n_frames);
  const double right = measure_peak(host_output(host, 1), n_frames);
  const double headroom = (double)host_get(host, "headroom");
  assert_true(isfinite(left) && isfinite(right));
  assert_true(headroom > 0.0 && headroom <= 1.0);
  return fmax(left, right);
}

/* Everything falls asleep within a second and a half, and is silent then. */
static void release(Host* host) {
  strings_controller(host, 0, STRINGS_NOTES_OFF, 0);
  for (double at_s = 0.0; at_s < 1.5; at_s += MOST_BLOCK / RATE_HZ) {
    run_block(host, MOST_BLOCK);
  }
  assert_true(host_get(host, "sounding") == 0.0f);
  assert_true(run_block(host, MOST_BLOCK) == 0.0);
}

static double play(int what, bool is_square, uint32_t block) {
  Host* const host = strings_open(RATE_HZ, MOST_BLOCK);
  const uint32_t n_blocks = (uint32_t)((block == MOST_BLOCK ? 2.0 : 0.3) * RATE_HZ / block);
  const double period = fmax(2.0, 0.1 * RATE_HZ / block);
  double peak = 0.0;
  strings_set(host, "release", 0.02);
  for (uint32_t i = 0; i < N_KEYS; ++i) {
    strings_note_on(host, 0, LOWEST_KEY + KEY_STEP * i, 127);
  }
  for (uint32_t b = 0; b < n_blocks; ++b) {
    const double way = is_square ? b % 2 : fabs(2.0 * fmod(b / period, 1.0) - 1.0);
    if (what == WHEEL) {
      strings_bend(host, 0, 4.0 * way - 2.0);
    } else if (what != NOTHING) {
      const SettingName name = (SettingName)what;
      strings_set(host, settings_symbol(name), settings_on_way(name, way));
    }
    peak = fmax(peak, run_block(host, block));
  }
  release(host);
  host_free(host);
  return peak;
}

static void sweeps_are_bounded(void** state) {
  (void)state;
  double worst = 0.0;
  for (size_t b = 0; b < sizeof(blocks) / sizeof(blocks[0]); ++b) {
    const double unswept = play(NOTHING, false, blocks[b]);
    for (size_t s = 0; s < sizeof(sweeps) / sizeof(sweeps[0]); ++s) {
      for (int is_square = 0; is_square < 2; ++is_square) {
        worst = fmax(worst, play(sweeps[s], is_square, blocks[b]) / unswept);
      }
    }
  }
  assert_within("loudest, over unswept", worst, MOST_LOUDER);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(sweeps_are_bounded)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
