/* All nine ways to play and to hear the harp: what holds for every one of them. */
#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, SECONDS = 4, MOST = SECONDS * RATE, LAST_WAY = HARPS_N_WAYS - 1 };

static float left[MOST];
static float right[MOST];
static float other[2][MOST];

/* Strings that are quick to fall asleep, so that this happens often and anywhere. */
static HarpPatch quick_patch(Random* random) {
  HarpPatch patch = harps_patch(random_below(random, HARPS_N_WAYS));
  patch.level = random_log_between(random, 1e-3, 1.0);
  patch.string.damping_per_s = random_log_between(random, 1.0, 200.0);
  patch.string.release_s = random_log_between(random, 0.005, 0.1);
  patch.string.inharmonicity =
      random_below(random, 3) ? 0.0 : random_log_between(random, 1e-6, 1e-2);
  patch.hardness = random_between(random, 0.0, 1.0);
  patch.pluck = random_between(random, 0.0, 1.0);
  patch.pickup = random_between(random, 0.0, 1.0);
  patch.spread = random_below(random, 2) ? 0.0 : 0.2;
  patch.string.max_masses = 1 + random_below(random, 100);
  return patch;
}

static void gesture(Harp* harp, Random* random) {
  const uint32_t key = 40 + random_below(random, 50);
  const HarpPatch patch = quick_patch(random);
  const uint32_t n_glide = random_below(random, 4) ? 1 + random_below(random, 3000) : 0;
  const double bend = random_between(random, -2.0, 2.0);
  const uint32_t choice = random_below(random, 16);
  if (choice < 7) {
    harp_note_on(harp, 0, key, 1 + random_below(random, random_below(random, 2) ? 127 : 3));
  } else if (choice < 11) {
    harp_all_notes_off(harp, 0);
  } else if (choice == 11) {
    harp_bend(harp, 0, bend);
  } else if (choice == 12) {
    harp_set_patch(harp, &patch, n_glide);
  } else if (choice == 13) {
    harp_pedal(harp, 0, bend > 1.0 ? 1.0 : 0.0);
  } else if (choice == 14) {
    harp_silence(harp);
  } else {
    harp_note_off(harp, 0, key);
  }
}

/* The same gestures at the same frames, whatever the size of the calls; 0: at random. */
static void play_cut(Harp* harp, uint32_t way, uint64_t seed, uint32_t cut, float* l, float* r) {
  enum { FRAMES = RATE };
  Random random = {.state = seed};
  Random cuts = {.state = cut};
  HarpPatch patch = harps_patch(way);
  patch.level = 1e-3;
  harps_restart(harp, &patch);
  for (uint32_t done = 0; done < FRAMES;) {
    gesture(harp, &random);
    uint32_t rest = random_below(&random, random_below(&random, 5) ? 500 : 10000);
    rest = rest < FRAMES - done ? rest : FRAMES - done;
    while (rest > 0) {
      const uint32_t wanted = cut > 0 ? cut : 1 + random_below(&cuts, 300);
      const uint32_t n = wanted < rest ? wanted : rest;
      harp_run(harp, n, l + done, r + done);
      done += n;
      rest -= n;
    }
  }
}

static void cutting_into_calls_does_not_change_a_bit(void** state) {
  (void)state;
  static const uint32_t cuts[] = {1, 17, 64, 0};
  Random random = random_start();
  Harp* const harp = harp_new(RATE);
  assert_non_null(harp);
  for (uint32_t way = 0; way < HARPS_N_WAYS; ++way) {
    const uint64_t seed = random_below(&random, 1U << 31);
    play_cut(harp, way, seed, MOST, left, right);
    for (size_t c = 0; c < sizeof(cuts) / sizeof(cuts[0]); ++c) {
      play_cut(harp, way, seed, cuts[c], other[0], other[1]);
      assert_memory_equal(left, other[0], RATE * sizeof(float));
      assert_memory_equal(right, other[1], RATE * sizeof(float));
    }
  }
  harp_free(harp);
}

/* One note and its end, after `n_before` frames. */
static void play_late(Harp* harp, size_t n_before, float* l, float* r) {
  harps_run(harp, n_before, l, r);
  harp_note_on(harp, 0, 50, 100);
  harps_run(harp, RATE / 2, l, r);
  harp_note_off(harp, 0, 50);
  harps_run(harp, RATE / 2, l + RATE / 2, r + RATE / 2);
}

static void a_keys_sound_does_not_depend_on_when_it_is_played(void** state) {
  (void)state;
  for (uint32_t way = 0; way < HARPS_N_WAYS; ++way) {
    const HarpPatch patch = harps_patch(way);
    const HarpPatch bow = harps_patch(LAST_WAY);
    Harp* const harp = harps_new(RATE, &patch);
    play_late(harp, 0, left, right);
    harps_restart(harp, &patch);
    play_late(harp, 12345, other[0], other[1]);
    assert_memory_equal(left, other[0], RATE * sizeof(float));
    assert_memory_equal(right, other[1], RATE * sizeof(float));
    /* Nor on what was bowed, and has died away. */
    harps_restart(harp, &bow);
    harp_note_on(harp, 0, 60, 127);
    harps_run(harp, 10000, NULL, NULL);
    harp_silence(harp);
    harps_run(harp, RATE, NULL, NULL);
    harp_set_patch(harp, &patch, 0);
    play_late(harp, 777, other[0], other[1]);
    assert_memory_equal(left, other[0], RATE * sizeof(float));
    assert_memory_equal(right, other[1], RATE * sizeof(float));
    harp_free(harp);
  }
}

/* Over a whole chord, that is bowed or rings. */
static void nothing_stands_still_in_what_is_heard(void** state) {
  (void)state;
  static const uint32_t chord[] = {36, 48, 52, 55, 60, 67};
  for (uint32_t way = 0; way < HARPS_N_WAYS; ++way) {
    const HarpPatch patch = harps_patch(way);
    Harp* const harp = harps_new(RATE, &patch);
    double sums[2] = {0.0};
    for (size_t k = 0; k < sizeof(chord) / sizeof(chord[0]); ++k) {
      harp_note_on(harp, 0, chord[k], 127);
    }
    harps_run(harp, MOST, left, right);
    assert_true(measure_rms(left, MOST) > 0.01);
    for (size_t i = RATE; i < MOST; ++i) {
      sums[0] += (double)left[i];
      sums[1] += (double)right[i];
    }
    const double mean = fmax(fabs(sums[0]), fabs(sums[1])) / (MOST - RATE);
    print_message("  %s, %s:", harps_exciter(patch.exciter), harps_pickup_type(patch.pickup_type));
    assert_within("what stands still", mean, 1e-3);
    harp_free(harp);
  }
}

static void silence_is_exact_silence(void** state) {
  (void)state;
  for (uint32_t way = 0; way < HARPS_N_WAYS; ++way) {
    const HarpPatch patch = harps_patch(way);
    HarpPatch next = harps_patch((way + 1) % HARPS_N_WAYS);
    Harp* const harp = harps_new(RATE, &patch);
    harps_run(harp, 1000, left, right);
    harp_set_patch(harp, &next, 500);
    harps_run(harp, 1000, left + 1000, right + 1000);
    assert_true(measure_peak(left, 2000) == 0.0 && measure_peak(right, 2000) == 0.0);
    harp_free(harp);
  }
}

static void a_storm_of_ten_thousand_gestures_is_survived(void** state) {
  (void)state;
  enum { EVENTS = 10000 };
  static const double rates_hz[] = {8000.0, 48000.0, 96000.0};
  Random random = random_start();
  double worst = 0.0;
  for (size_t r = 0; r < 3; ++r) {
    Harp* const harp = harp_new(rates_hz[r]);
    assert_non_null(harp);
    for (int event = 0; event < EVENTS / 3 + 1; ++event) {
      const uint32_t n = 1 + random_below(&random, 400);
      gesture(harp, &random);
      harps_run(harp, n, left, right);
      worst = fmax(worst, fmax(measure_peak(left, n), measure_peak(right, n)));
      assert_true(isfinite(measure_peak(left, n)) && isfinite(measure_peak(right, n)));
      assert_true(harp_report(harp).headroom > 0.0);
    }
    harp_silence(harp);
    const size_t n = (size_t)(0.4 * rates_hz[r]);
    harps_run(harp, n, left, right);
    harps_run(harp, n, left, right);
    assert_int_equal(harp_report(harp).n_strings, 0);
    assert_true(measure_peak(left, n) == 0.0 && measure_peak(right, n) == 0.0);
    harp_free(harp);
  }
  assert_within("largest sample", worst, 50 * 0.25 * 4.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cutting_into_calls_does_not_change_a_bit),
      cmocka_unit_test(a_keys_sound_does_not_depend_on_when_it_is_played),
      cmocka_unit_test(nothing_stands_still_in_what_is_heard),
      cmocka_unit_test(silence_is_exact_silence),
      cmocka_unit_test(a_storm_of_ten_thousand_gestures_is_survived),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
