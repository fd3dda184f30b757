/* What the harp's balance does to one mass, by hand; and what it does not do. */
#include "core/harp/harp_balance.h"

#include "core/base/complex_of.h"
#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { MOST = 96000, N_PLACES = 4, BOWED = 6 };

static const double plucks[N_PLACES] = {0.05, 0.13, 0.25, 0.5};
static const double pickups[N_PLACES] = {0.05, 0.2, 0.35, 0.5};

static float left[MOST];
static float right[MOST];

static HarpBalance string_of(const HarpPatch* patch, double rate_hz, uint32_t key) {
  const TuningTarget target = {.rate_hz = rate_hz,
                               .tone = harps_tone(patch, key, 0.0),
                               .loss = patch->string.loss,
                               .inharmonicity = patch->string.inharmonicity,
                               .partials = patch->string.partials};
  return (HarpBalance){target, tuning_max_masses(&target, patch->string.max_masses), key, 0.25,
                       NULL};
}

/* |H|² of both filters as BS.1770 prints them, for 48 kHz. */
static double k_weight(double hz) {
  const double complex z = cexp(complex_of(0.0, -2.0 * PI * hz / 48000.0));
  const double complex head = (1.53512485958697 + z * (-2.69169618940638 + z * 1.19839281085285)) /
                              (1.0 + z * (-1.69065929318241 + z * 0.73248077421585));
  const double complex low =
      (1.0 + z * (-2.0 + z)) / (1.0 + z * (-1.99004745483398 + z * 0.99007225036621));
  const double gain = cabs(head * low);
  return gain * gain;
}

/* The mean of what is left of a power over 0.4 s. */
static double left_of(double damping_per_s) {
  const double y = 0.8 * damping_per_s;
  return -expm1(-y) / y;
}

/* Both sides' readings of the one mass, squared; a spread s adds s²/2 to each in the mean. */
static double square_of_readings(const HarpPatch* patch) {
  const double reading = patch->pickup_type == PICKUP_FORCE      ? 0.18 * 2.0 / PI
                         : patch->pickup_type == PICKUP_VELOCITY ? 0.24
                                                                 : 1.0;
  return (2.0 + patch->spread * patch->spread) * reading * reading;
}

/* A sine of 4/π, read, weighed, and decayed. */
static double gain_by_hand(const HarpPatch* patch, Tone tone) {
  const double usual =
      left_of(patch->string.damping_per_s * exp2(-patch->string.tracking * 9.0 / 12.0));
  const double plain = 0.5 * 16.0 / (PI * PI) * square_of_readings(patch);
  const double share = fmin(fmax(left_of(1.0 / tone.tau_s), 0.1 * usual), 10.0 * usual);
  const double gain = sqrt(0.5 * usual / (plain * k_weight(tone.f0_hz) * share));
  const double most = fmin(8.0, 2.0 / sqrt(2.0 * plain));
  return fmax(fmin(gain, most), 0.125);
}

/* Radians in τ from which on what is damped still swings as a sine does. */
static const double LEAST_SWING = 10.0;

static void gains_of_one_mass_are_those_by_hand(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 5000; ++trial) {
    HarpPatch patch = harps_patch(random_below(&random, HARPS_N_SENSES));
    patch.pickup = 0.5;
    patch.spread = random_below(&random, 2) ? 0.5 : 0.0;
    patch.string.damping_per_s = random_log_between(&random, 0.02, 200.0);
    patch.string.tracking = random_between(&random, 0.0, 1.0);
    patch.string.max_masses = 1;
    const HarpBalance string = string_of(&patch, 48000.0, 9 + random_below(&random, 88));
    const Pluck pluck = {random_between(&random, 0.0, 1.0), 0.5, 0.1, 0.0};
    if (2.0 * PI * string.target.tone.f0_hz * string.target.tone.tau_s < LEAST_SWING) {
      continue;
    }
    const double by_hand = gain_by_hand(&patch, string.target.tone);
    const double db = 20.0 * log10(harp_balance_gain(&patch, &string, pluck) / by_hand);
    worst = fmax(worst, fabs(db));
  }
  /* Both decays are told within 0.2 dB. */
  assert_within("dB off", worst, 0.4);
}

/* Walls and nodes are not asked for the impossible. */
static void gains_are_bounded(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 20000; ++trial) {
    HarpPatch patch = harps_patch(random_below(&random, HARPS_N_WAYS));
    patch.pluck = 0.25 * random_below(&random, 5);
    patch.pickup = random_below(&random, 2) ? 0.5 * random_below(&random, 3)
                                            : random_between(&random, 0.0, 1.0);
    patch.spread = random_below(&random, 2) ? 0.0 : 0.5;
    patch.hardness = 0.5 * random_below(&random, 3);
    patch.string.loss = random_log_between(&random, 1e-5, 1.0);
    patch.string.damping_per_s = random_log_between(&random, 0.02, 200.0);
    patch.string.max_masses = 1 + random_below(&random, random_below(&random, 2) ? 5 : 1024);
    patch.unisons = 1 + random_below(&random, HARP_UNISONS);
    patch.unison_detune = random_between(&random, 0.0, 20.0);
    patch.second = random_below(&random, 2) ? random_between(&random, 0.0, 1.0) : 0.0;
    patch.second_detune = random_between(&random, 0.0, 30.0);
    patch.second_decay = random_log_between(&random, 0.25, 4.0);
    HarpMember members[HARP_MEMBERS];
    HarpBalance string = string_of(&patch, 48000.0, random_below(&random, 128));
    harp_members_place(&patch, harp_members_group(&patch), members);
    string.members = members;
    const double others =
        harp_members_is_alone(harp_members_group(&patch)) ? 1.0 : HARP_BALANCE_OTHERS;
    const Pluck pluck = {patch.pluck, patch.hardness, random_log_between(&random, 1e-5, 0.25), 0.0};
    const double gain = harp_balance_gain(&patch, &string, pluck);
    assert_true(gain >= 1.0 / HARP_BALANCE_MOST / others && gain <= HARP_BALANCE_MOST * others);
  }
}

/* The lowest strings are not heard at all: none is played so hard that it would drive a limiter. */
static void what_is_too_low_is_not_played_harder(void** state) {
  (void)state;
  double worst = 0.0;
  for (uint32_t way = 0; way < BOWED; ++way) {
    HarpPatch patch = harps_patch(way);
    Harp* const harp = harps_new(48000.0, &patch);
    for (int p = 0; p < N_PLACES; ++p) {
      patch.pluck = plucks[p];
      patch.pickup = pickups[p];
      for (uint32_t key = 0; key <= 12; key += 4) {
        const size_t n = (size_t)(4.0 * 48000.0 / harps_tone(&patch, key, 0.0).f0_hz);
        harps_restart(harp, &patch);
        harp_note_on(harp, 0, key, 127);
        harps_run(harp, n, left, right);
        const double rms = hypot(measure_rms(left, n), measure_rms(right, n));
        worst = fmax(worst, sqrt(2.0) * rms / 0.25);
      }
    }
    harp_free(harp);
  }
  assert_within("amplitude, of the string's", worst, 3.0);
}

/* What is read has nothing to do with how hard it was played. */
static void a_wall_is_still_silent(void** state) {
  (void)state;
  for (uint32_t unisons = 1; unisons <= HARP_UNISONS; ++unisons) {
    HarpPatch patch = harps_patch(0);
    patch.pickup = 0.0;
    patch.spread = 0.0;
    patch.unisons = unisons;
    Harp* const harp = harps_new(48000.0, &patch);
    harp_note_on(harp, 0, 60, 127);
    harps_run(harp, 4800, left, right);
    assert_true(measure_peak(left, 4800) == 0.0);
    assert_int_equal(harp_report(harp).n_strings, unisons);
    harp_free(harp);
  }
}

/* Hammers keep off the middle and bows near the walls, on the side that is asked for. */
static void each_side_of_a_string_can_be_played(void** state) {
  (void)state;
  static const double asked[] = {0.1, 0.49, 0.51, 0.9};
  static const double struck[] = {0.1, 0.47, 0.53, 0.9};
  static const double bowed[] = {0.1, 0.2, 0.8, 0.9};
  double worst = 0.0;
  for (int p = 0; p < N_PLACES; ++p) {
    for (uint32_t way = HARPS_N_SENSES; way < HARPS_N_WAYS; ++way) {
      HarpPatch patch = harps_patch(way);
      patch.pluck = asked[p];
      Harp* const harp = harps_new(48000.0, &patch);
      harp_note_on(harp, 0, 60, 100);
      const HarpString* const string = &harp->strings[60];
      worst = fmax(worst, fabs(way < BOWED ? string->voice.hammer.make.place - struck[p]
                                           : string->voice.bow.place.value - bowed[p]));
      harp_free(harp);
    }
  }
  assert_within("place", worst, 1e-12);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gains_of_one_mass_are_those_by_hand),
      cmocka_unit_test(gains_are_bounded),
      cmocka_unit_test(what_is_too_low_is_not_played_harder),
      cmocka_unit_test(each_side_of_a_string_can_be_played),
      cmocka_unit_test(a_wall_is_still_silent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
