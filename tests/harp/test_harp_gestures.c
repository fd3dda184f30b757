#include "core/harp/harp.h"
#include "core/harp/harp_balance.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { FRAMES = 12000 };

/* Both sides of a run. */
typedef struct {
  float left[FRAMES];
  float right[FRAMES];
} Sound;

static const HarpPatch plain = {
    .level = 1.0,
    .string.damping_per_s = 1.0,
    .string.loss = 0.01,
    .pickup = 0.12,
    .spread = 0.1,
    .pluck = 0.2,
    .hardness = 0.5,
    .string.release_s = 0.05,
    .string.tuning_hz = 440.0,
    .string.max_masses = 300,
};

static HarpPatch random_patch(Random* random) {
  const bool is_mono = random_below(random, 3) == 0;
  return (HarpPatch){
      .level = random_between(random, 0.0, 2.0),
      .string.damping_per_s = random_log_between(random, 0.02, 200.0),
      .string.tracking = random_between(random, -1.0, 2.0),
      .string.loss =
          random_below(random, 4) ? random_between(random, 0.0, 1.0) : random_below(random, 2),
      .string.inharmonicity = random_below(random, 3) ? random_log_between(random, 1e-6, 0.1) : 0.0,
      .string.partials = (Partials)random_below(random, 3),
      .pickup = random_between(random, 0.0, 1.0),
      .spread = is_mono ? 0.0 : random_between(random, 0.0, 0.5),
      .pluck = random_between(random, 0.0, 1.0),
      .hardness = random_between(random, 0.0, 1.0),
      .string.release_s = random_log_between(random, 1e-3, 10.0),
      .string.tension = random_below(random, 2) ? random_between(random, 0.0, 100.0) : 0.0,
      .string.tuning_hz = random_between(random, 400.0, 480.0),
      .string.max_masses =
          1 + random_below(random, random_below(random, 2) ? 20 : CHAIN_MAX_MASSES),
  };
}

/* Do one thing that a player or a host can do; true if it was a pluck. */
static bool gesture(Harp* harp, Random* random) {
  const uint32_t key = 30 + random_below(random, 90);
  const HarpPatch patch = random_patch(random);
  const uint32_t n_glide = random_below(random, 4) ? 1 + random_below(random, 3000) : 0;
  const uint32_t choice = random_below(random, 20);
  const double bend = random_below(random, 4) ? random_between(random, -2.0, 2.0)
                                              : random_between(random, -24.0, 24.0);
  switch (choice) {
  case 0:
    harp_pedal(harp, 0, 1.0);
    break;
  case 1:
    harp_pedal(harp, 0, 0.0);
    break;
  case 2:
  case 3:
  case 4:
    harp_bend(harp, 0, bend);
    break;
  case 5:
  case 6:
  case 7:
    harp_set_patch(harp, &patch, n_glide);
    break;
  case 8:
    harp_all_notes_off(harp, 0);
    break;
  case 9:
    if (random_below(random, 4) == 0) {
      harp_silence(harp);
    }
    break;
  case 10:
  case 11:
  case 12:
  case 13:
    harp_note_off(harp, 0, key);
    break;
  default:
    harp_note_on(harp, 0, key, 1 + random_below(random, 127));
    return true;
  }
  return false;
}

/* The same gestures at the same frames, whatever the size of the calls; 0: at random. */
static void play(Sound* sound, Harp* harp, uint64_t seed, uint32_t cut) {
  Random random = {.state = seed};
  Random cuts = {.state = cut};
  const HarpPatch patch = random_patch(&random);
  harp_reset(harp);
  harp_set_patch(harp, &patch, 0);
  for (uint32_t done = 0; done < FRAMES;) {
    (void)gesture(harp, &random);
    uint32_t left = random_below(&random, 700);
    left = left < FRAMES - done ? left : FRAMES - done;
    while (left > 0) {
      const uint32_t wanted = cut > 0 ? cut : 1 + random_below(&cuts, 300);
      const uint32_t n = wanted < left ? wanted : left;
      harp_run(harp, n, sound->left + done, sound->right + done);
      done += n;
      left -= n;
    }
  }
}

static void cutting_into_calls_does_not_change_a_bit(void** state) {
  (void)state;
  static const uint32_t cuts[] = {1, 16, 17, 64, 1000, 0};
  static Sound whole;
  static Sound cut;
  Random random = random_start();
  Harp* const harp = harp_new(48000.0);
  assert_non_null(harp);
  for (int trial = 0; trial < 8; ++trial) {
    const uint64_t seed = random_below(&random, 1U << 31);
    play(&whole, harp, seed, FRAMES);
    for (size_t c = 0; c < sizeof(cuts) / sizeof(cuts[0]); ++c) {
      play(&cut, harp, seed, cuts[c]);
      assert_memory_equal(&whole, &cut, sizeof(whole));
    }
  }
  harp_free(harp);
}

/* Every string that sounds, by the coefficients it has at this very frame. */
static void check_strings(const Harp* harp) {
  uint32_t n_strings = 0;
  for (uint32_t i = 0; i < HARP_STRINGS; ++i) {
    const HarpString* const string = &harp->strings[i];
    if (string->voice.is_awake) {
      assert_true(oracle_headroom(string->voice.chain.now, string->voice.chain.n_masses) >= 0.0);
      assert_true(string->voice.chain.n_masses <= string->voice.capacity);
      ++n_strings;
    }
  }
  const VoiceReport report = harp_report(harp);
  assert_int_equal(report.n_strings, n_strings);
  assert_true(report.headroom >= TUNING_LAST_MARGIN - 16.0 * DBL_EPSILON);
}

/* The largest sample; infinite if there is one that is no number. */
static double peak_of(const float* out, uint32_t n_frames) {
  double peak = 0.0;
  for (uint32_t n = 0; n < n_frames; ++n) {
    peak = isfinite(out[n]) ? fmax(peak, fabs((double)out[n])) : HUGE_VAL;
  }
  return peak;
}

static void no_patch_and_no_gesture_explodes(void** state) {
  (void)state;
  enum { PATCHES = 2000, RUN = 200 };
  static const double rates_hz[] = {8000.0, 44100.0, 48000.0, 96000.0};
  float left[RUN];
  float right[RUN];
  double worst = 0.0;
  Random random = random_start();
  for (size_t r = 0; r < 4; ++r) {
    Harp* const harp = harp_new(rates_hz[r]);
    assert_non_null(harp);
    for (int trial = 0; trial < PATCHES / 4; ++trial) {
      const HarpPatch patch = random_patch(&random);
      int n_plucks = 0;
      harp_reset(harp);
      harp_set_patch(harp, &patch, 0);
      for (int turn = 0; turn < 20; ++turn) {
        n_plucks += gesture(harp, &random);
        const uint32_t n_frames = 1 + random_below(&random, RUN);
        harp_run(harp, n_frames, left, right);
        check_strings(harp);
        const double peak = fmax(peak_of(left, n_frames), peak_of(right, n_frames));
        worst = fmax(worst, peak / fmax(1.0, n_plucks));
      }
    }
    harp_free(harp);
  }
  /* Level 2 times 0.25 for each pluck, which where little of it is heard is made so much harder;
   * and a bend from +24 to −24 semitones, which keeps E/ω, makes of it the root of sixteen. */
  assert_within("largest sample per pluck", worst, 2.0 * 0.25 * HARP_BALANCE_MOST * 4.0);
}

static void masses_are_capped_by_the_patch(void** state) {
  (void)state;
  Harp* const harp = harp_new(48000.0);
  assert_non_null(harp);
  for (uint32_t most = 1; most <= 256; most *= 2) {
    HarpPatch patch = plain;
    patch.string.max_masses = most;
    harp_reset(harp);
    harp_set_patch(harp, &patch, 0);
    for (uint32_t key = 20; key < 40; ++key) {
      harp_note_on(harp, 0, key, 64);
    }
    assert_int_equal(harp_report(harp).n_masses, 20 * most);
  }
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cutting_into_calls_does_not_change_a_bit),
      cmocka_unit_test(no_patch_and_no_gesture_explodes),
      cmocka_unit_test(masses_are_capped_by_the_patch),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
