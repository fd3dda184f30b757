/* Whatever sixteen channels do to the harp at once: it sounds the same however it is called, and
 * nothing is left behind. */
#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RATE = 48000, MOST = 2 * RATE };

static float left[MOST];
static float other[MOST];

/* Any channel, and anything that it can do. */
static void gesture(Harp* harp, Random* random) {
  const uint32_t channel = random_below(random, HARP_CHANNELS);
  const uint32_t key = 40 + random_below(random, 8);
  const double share =
      random_below(random, 4) ? random_between(random, 0.0, 1.0) : (double)random_below(random, 2);
  HarpPatch patch = harps_touched_patch(random_below(random, HARPS_N_WAYS));
  switch (random_below(random, 16)) {
  case 0:
    harp_bend(harp, channel, 192.0 * (share - 0.5));
    break;
  case 1:
    harp_bend(harp, channel, 4.0 * (share - 0.5));
    break;
  case 2:
    harp_vibrato(harp, channel, share);
    break;
  case 3:
    harp_press(harp, channel, share);
    break;
  case 4:
    harp_press_key(harp, channel, key, share);
    break;
  case 5:
    harp_brighten(harp, channel, 2.0 * share - 1.0);
    break;
  case 6:
    harp_breathe(harp, channel, share);
    break;
  case 7:
    harp_set_gain(harp, channel, share);
    break;
  case 8:
    harp_pedal(harp, channel, share);
    break;
  case 9:
    harp_sostenuto(harp, channel, share > 0.5);
    break;
  case 10:
    harp_soften(harp, channel, share);
    break;
  case 11:
    harp_let_go(harp, channel);
    break;
  case 12:
    harp_note_off(harp, channel, key);
    break;
  case 13:
    patch.string.damping_per_s = random_log_between(random, 0.5, 100.0);
    harp_set_patch(harp, &patch, random_below(random, 3000));
    break;
  case 14:
    if (random_below(random, 8) == 0) {
      harp_silence(harp);
    } else {
      harp_all_notes_off(harp, channel);
    }
    break;
  default:
    harp_note_on(harp, channel, key, 1 + random_below(random, 127));
    break;
  }
}

/* The same storm, whatever the size of the calls; 0: at random. */
static void play_storm(Harp* harp, uint64_t seed, uint32_t cut, uint32_t n_frames, float* out) {
  Random random = {.state = seed};
  Random cuts = {.state = cut};
  const HarpPatch patch = harps_touched_patch(0);
  harps_restart(harp, &patch);
  for (uint32_t done = 0; done < n_frames;) {
    gesture(harp, &random);
    uint32_t rest = random_below(&random, random_below(&random, 5) ? 200 : 5000);
    rest = rest < n_frames - done ? rest : n_frames - done;
    while (rest > 0) {
      const uint32_t wanted = cut > 0 ? cut : 1 + random_below(&cuts, 300);
      const uint32_t n = wanted < rest ? wanted : rest;
      harps_run(harp, n, out + done, NULL);
      assert_true(harp_report(harp).headroom > 0.0);
      done += n;
      rest -= n;
    }
  }
}

/* Often enough for a bowed string to lose masses in the middle of a call. */
static void touches_are_the_same_however_calls_are_cut(void** state) {
  enum { ROUNDS = 60 };
  (void)state;
  Random random = random_start();
  const HarpPatch patch = harps_touched_patch(0);
  Harp* const harp = harps_new(RATE, &patch);
  for (int round = 0; round < ROUNDS; ++round) {
    const uint64_t seed = random_below(&random, 1U << 31);
    play_storm(harp, seed, MOST, 2 * RATE, left);
    assert_true(isfinite(measure_peak(left, 2 * RATE)) && measure_peak(left, 2 * RATE) > 1e-3);
    for (uint32_t cut = 1; cut <= (round < 3 ? 64 : 1); cut *= 8) {
      play_storm(harp, seed, cut == 8 ? 0 : cut, 2 * RATE, other);
      assert_memory_equal(left, other, 2 * RATE * sizeof(float));
    }
  }
  harp_free(harp);
}

static void nothing_sticks_after_a_storm_of_channels(void** state) {
  static const double rates_hz[] = {8000.0, 48000.0, 192000.0};
  (void)state;
  Random random = random_start();
  double peak = 0.0;
  for (size_t r = 0; r < 3; ++r) {
    const HarpPatch patch = harps_touched_patch(0);
    Harp* const harp = harps_new(rates_hz[r], &patch);
    for (int round = 0; round < 4; ++round) {
      play_storm(harp, random_below(&random, 1U << 31), MOST, 2 * RATE, left);
      peak = fmax(peak, measure_peak(left, 2 * RATE));
      harp_silence(harp);
      const size_t n = (size_t)(0.2 * rates_hz[r]);
      harps_run(harp, n, left, NULL);
      harps_run(harp, n, left, NULL);
      assert_int_equal(harp_report(harp).n_strings, 0);
      assert_true(measure_peak(left, n) == 0.0);
    }
    harp_free(harp);
  }
  /* Sixteen channels at eight keys, bows and bends at their worst. */
  assert_within("largest sample", peak, 40 * 0.25 * 4.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(touches_are_the_same_however_calls_are_cut),
      cmocka_unit_test(nothing_sticks_after_a_storm_of_channels),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
