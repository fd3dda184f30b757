/* What is heard of strings in unison and of two directions: they beat as asked, die as asked, are
 * in tune one by one and on the mean, and are as loud as one. */
#include "core/harp/harp.h"

#include "core/base/complex_of.h"
#include "tests/support/harps.h"
#include "tests/support/loudness.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { RATE = 48000, KEY = 69, WINDOW = 960, HOP = 240, MOST = 8 * RATE };

static const double PITCH_HZ = 440.0;

/* τ of what is to be heard for long [s]. */
static const double LONG_S = 5.0;

static float left[MOST];
static float right[MOST];

/* It is heard in one place. */
static HarpPatch plain_patch(double tau_s) {
  HarpPatch patch = harps_patch(0);
  patch.spread = 0.0;
  patch.string.damping_per_s = 1.0 / tau_s;
  return patch;
}

static void play(const HarpPatch* patch, double seconds) {
  Harp* const harp = harps_new(RATE, patch);
  harp_note_on(harp, 0, KEY, 100);
  harps_run(harp, (size_t)(seconds * RATE), left, right);
  harp_free(harp);
}

static double heard_at(size_t from) {
  return measure_near(left + from, WINDOW, RATE, PITCH_HZ);
}

static double db_of(double ratio) {
  return 20.0 * log10(ratio);
}

/* What two directions with amplitudes 1 and m, `beat_hz` apart, are together. */
static double together(double t, double m, double beat_hz, double tau_s, double second_tau_s) {
  const double complex second = cexp(complex_of(-t / second_tau_s, 2.0 * PI * beat_hz * t));
  return cabs(exp(-t / tau_s) + m * second);
}

static double time_of(size_t from) {
  return ((double)from + 0.5 * WINDOW) / RATE;
}

static double cents_for(double beat_hz) {
  return 1200.0 * log2(1.0 + beat_hz / PITCH_HZ);
}

/* Off the closed form all along, as it is after the attack [dB]. */
static double worst_off(double m, double beat_hz, double tau_s, double ratio, double seconds) {
  const size_t begin = RATE / 20;
  double worst = 0.0;
  double first = 0.0;
  for (size_t from = begin; from + WINDOW < (size_t)(seconds * RATE); from += HOP) {
    const double asked = together(time_of(from), m, beat_hz, tau_s, ratio * tau_s);
    const double off = db_of(heard_at(from) / asked);
    first = from == begin ? off : first;
    worst = fmax(worst, fabs(off - first));
  }
  return worst;
}

/* What is heard between the loudest and the softest, but for the decay [dB], and how often. */
typedef struct {
  double depth_db;
  double rate_hz;
} Beats;

/* Between the middles of the first two stretches that are softer than halfway [dB]. */
static Beats beats_heard(double seconds) {
  static double heard[MOST / HOP];
  const size_t n = ((size_t)(seconds * RATE) - WINDOW) / HOP;
  double least = HUGE_VAL;
  double most = 0.0;
  for (size_t i = 0; i < n; ++i) {
    heard[i] = heard_at(i * HOP) * exp(time_of(i * HOP) / LONG_S);
    least = fmin(least, heard[i]);
    most = fmax(most, heard[i]);
  }
  double middles[2] = {0.0};
  uint32_t n_soft = 0;
  for (size_t i = 1, begun = 0; i < n && n_soft < 2; ++i) {
    const bool was_soft = heard[i - 1] < sqrt(least * most);
    const bool is_soft = heard[i] < sqrt(least * most);
    begun = is_soft && !was_soft ? i : begun;
    if (was_soft && !is_soft) {
      middles[n_soft++] = 0.5 * (time_of(begun * HOP) + time_of(i * HOP));
    }
  }
  return (Beats){db_of(most / least), 1.0 / (middles[1] - middles[0])};
}

static void two_directions_beat_as_asked(void** state) {
  (void)state;
  static const double rates_hz[] = {0.4, 1.0, 3.0};
  static const double depths_db[] = {4.0, 8.0, 13.0};
  double off_db = 0.0;
  double off_depth_db = 0.0;
  double off_rate = 0.0;
  for (int r = 0; r < 3; ++r) {
    for (int d = 0; d < 3; ++d) {
      const double ratio = pow(10.0, 0.05 * depths_db[d]);
      const double seconds = 0.2 + 2.0 / rates_hz[r];
      HarpPatch patch = plain_patch(LONG_S);
      patch.second = (ratio - 1.0) / (ratio + 1.0);
      patch.second_detune = cents_for(rates_hz[r]);
      play(&patch, seconds);
      const Beats heard = beats_heard(seconds);
      print_message("  asked %.1f Hz, %4.1f dB: %.3f Hz, %5.2f dB\n", rates_hz[r], depths_db[d],
                    heard.rate_hz, heard.depth_db);
      off_db = fmax(off_db, worst_off(patch.second, rates_hz[r], LONG_S, 1.0, seconds));
      off_depth_db = fmax(off_depth_db, fabs(heard.depth_db - depths_db[d]));
      off_rate = fmax(off_rate, fabs(heard.rate_hz / rates_hz[r] - 1.0));
    }
  }
  /* A window blurs the bottom of a beat of 3 Hz and 13 dB. */
  assert_within("off the closed form [dB]", off_db, 0.4);
  assert_within("depth [dB]", off_depth_db, 0.2);
  assert_within("rate", off_rate, 0.02);
}

/* T60 of what is heard between two times, by its ends. */
static double t60_of(double from_s, double to_s) {
  const double fallen_db =
      db_of(heard_at((size_t)(from_s * RATE)) / heard_at((size_t)(to_s * RATE)));
  return 60.0 * (to_s - from_s) / fallen_db;
}

static void what_is_late_dies_more_slowly_as_asked(void** state) {
  (void)state;
  static const double decays[] = {0.25, 2.0, 3.0, 4.0};
  double off_db = 0.0;
  double most_ratio = 0.0;
  for (int i = 0; i < 4; ++i) {
    HarpPatch patch = plain_patch(1.0);
    patch.second = 0.3;
    patch.second_detune = 0.0;
    patch.second_decay = decays[i];
    play(&patch, 7.9);
    const double ratio = t60_of(6.0, 7.5) / t60_of(0.05, 0.3);
    print_message("  second_decay %.2f: late T60 over early %.2f\n", decays[i], ratio);
    off_db = fmax(off_db, worst_off(0.3, 0.0, 1.0, decays[i], 7.9));
    most_ratio = fmax(most_ratio, ratio);
  }
  assert_within("off the closed form [dB]", off_db, 0.05);
  assert_true(most_ratio >= 2.0);
}

/* The pitch and decay of a member, while all others are silent. */
static Tone tone_alone(const HarpPatch* patch, uint32_t member, Tone near) {
  Harp* const harp = harps_new(RATE, patch);
  HarpString* const leader = &harp->strings[KEY];
  Tone tone = {0};
  harp_note_on(harp, 0, KEY, 100);
  for (uint32_t i = 0; i < HARP_MEMBERS; ++i) {
    if (i != member) {
      voice_sleep(i > 0 ? &leader->followers[i - 1].voice : &leader->voice);
    }
  }
  assert_int_equal(harp_report(harp).n_strings, 1);
  harps_run(harp, 2 * RATE, left, right);
  assert_true(measure_tone(left + RATE / 20, 2 * RATE - RATE / 20, RATE, near, &tone));
  harp_free(harp);
  return tone;
}

/* By hand, and not as core/harp/harp_members.c has it. */
static void each_is_in_tune_and_so_is_their_mean(void** state) {
  (void)state;
  Random random = random_start();
  double worst_cents = 0.0;
  double worst_mean = 0.0;
  double worst_decay = 0.0;
  for (int trial = 0; trial < 6; ++trial) {
    HarpPatch patch = plain_patch(LONG_S);
    patch.unisons = 1 + (uint32_t)trial % 3;
    patch.unison_detune = random_between(&random, 0.0, 20.0);
    patch.second = random_between(&random, 0.1, 1.0);
    patch.second_detune = random_between(&random, 0.0, 30.0);
    patch.second_decay = random_log_between(&random, 0.25, 4.0);
    const double square = patch.second * patch.second;
    const uint32_t n = patch.unisons;
    double sum = 0.0;
    for (uint32_t i = 0; i < 2 * n; ++i) {
      const bool is_second = i >= n;
      const double of_unison =
          n > 1 ? patch.unison_detune * ((double)(i % n) / (n - 1) - 0.5) : 0.0;
      const double of_direction =
          (is_second ? 1.0 : -square) / (1.0 + square) * patch.second_detune;
      const double cents = of_unison + of_direction;
      const Tone asked = {PITCH_HZ * exp2(cents / 1200.0),
                          is_second ? LONG_S * patch.second_decay : LONG_S};
      const Tone heard = tone_alone(&patch, i % n + (is_second ? HARP_UNISONS : 0), asked);
      sum += (is_second ? square : 1.0) * measure_cents(heard.f0_hz, PITCH_HZ);
      worst_cents = fmax(worst_cents, fabs(measure_cents(heard.f0_hz, asked.f0_hz)));
      worst_decay = fmax(worst_decay, fabs(heard.tau_s / asked.tau_s - 1.0));
    }
    worst_mean = fmax(worst_mean, fabs(sum / (n * (1.0 + square))));
  }
  assert_within("cents of one", worst_cents, 0.005);
  assert_within("cents of the mean", worst_mean, 0.005);
  assert_within("decay", worst_decay, 2e-4);
}

/* How much louder a group is than one string [dB]. */
static double louder(Harp* harp, HarpPatch patch, HarpPatch group, uint32_t key, double seconds) {
  double lufs[2];
  for (int i = 0; i < 2; ++i) {
    harps_restart(harp, i ? &group : &patch);
    harp_note_on(harp, 0, key, 100);
    harps_run(harp, (size_t)(seconds * RATE), left, right);
    lufs[i] = loudness_lufs_at(RATE, left, right, (size_t)(seconds * RATE));
  }
  return lufs[1] - lufs[0];
}

/* The narrowest, and the widest there is. */
static const HarpPatch groups[] = {
    {.unisons = 2, .unison_detune = 2.0, .second_decay = 1.0},
    {.unisons = 3, .unison_detune = 20.0, .second_decay = 1.0},
    {.unisons = 1, .second = 0.5, .second_detune = 5.0, .second_decay = 2.0},
    {.unisons = 1, .second = 1.0, .second_detune = 30.0, .second_decay = 0.25},
    {.unisons = 3,
     .unison_detune = 20.0,
     .second = 1.0,
     .second_detune = 30.0,
     .second_decay = 4.0},
};
enum { N_GROUPS = sizeof(groups) / sizeof(groups[0]), BOWED = 6 };

static HarpPatch grouped(HarpPatch patch, const HarpPatch* group) {
  patch.unisons = group->unisons;
  patch.unison_detune = group->unison_detune;
  patch.second = group->second;
  patch.second_detune = group->second_detune;
  patch.second_decay = group->second_decay;
  return patch;
}

static void groups_are_as_loud_as_one_string(void** state) {
  (void)state;
  const uint32_t step = getenv("HOOKE_TEST_LONG") ? 3 : 18;
  double worst = 0.0;
  for (uint32_t way = 0; way < BOWED; ++way) {
    const HarpPatch patch = harps_patch(way);
    Harp* const harp = harps_new(RATE, &patch);
    for (int g = 0; g < N_GROUPS; ++g) {
      for (uint32_t key = 33; key <= 96; key += step) {
        const double db = louder(harp, patch, grouped(patch, &groups[g]), key, 0.5);
        worst = fmax(worst, fabs(db));
      }
    }
    harp_free(harp);
  }
  assert_within("dB", worst, 1.0);
}

/* Bowed strings do not begin in step, so how loud the loudest moment is hangs on when they are. */
static void bowed_groups_are_about_as_loud(void** state) {
  (void)state;
  const HarpPatch patch = harps_patch(BOWED);
  Harp* const harp = harps_new(RATE, &patch);
  double worst = 0.0;
  for (uint32_t key = 33; key <= 80; key += 12) {
    worst = fmax(worst, fabs(louder(harp, patch, grouped(patch, &groups[0]), key, 3.0)));
    worst = fmax(worst, fabs(louder(harp, patch, grouped(patch, &groups[1]), key, 1.5)));
  }
  assert_within("dB", worst, 3.0);
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(two_directions_beat_as_asked),
      cmocka_unit_test(what_is_late_dies_more_slowly_as_asked),
      cmocka_unit_test(each_is_in_tune_and_so_is_their_mean),
      cmocka_unit_test(groups_are_as_loud_as_one_string),
      cmocka_unit_test(bowed_groups_are_about_as_loud),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
