/* What hands do to strings that ring: bends, vibrato, pressure, brightness, breath and swells. */
#include "tests/harps.h"
#include "tests/measure.h"
#include "tests/oracle.h"
#include "tests/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, KEY = 57, MOST = 4 * RATE, SWING = RATE / 5, BOWED = 2 * HARPS_N_SENSES };

static const double PI = 3.14159265358979323846;

static float left[MOST];
static float other[MOST];

static Patch patch_of(uint32_t way) {
  Patch patch = harps_patch(way);
  patch.vibrato_hz = 5.0;
  patch.spread = 0.0;
  return patch;
}

static Tone tone_of(const HarpString* string) {
  assert_true(string->wire.is_awake && string->wire.chain.n_gliding == 0);
  return pole_tone(string->wire.rate_hz,
                   tuning_mode(string->wire.chain.now, string->wire.chain.n_masses, 1));
}

static void a_hand_bends_what_it_plays(void** state) {
  static const double bends[] = {0.01, 2.0, -12.0, 24.0, -48.0, 48.0, 0.0};
  (void)state;
  const Patch patch = patch_of(0);
  Harp* const harp = harps_new(RATE, &patch);
  const HarpString* const bent = &harp->strings[KEY];
  const HarpString* const still = &harp->strings[KEY + 1];
  double worst = 0.0;
  for (size_t b = 0; b < sizeof(bends) / sizeof(bends[0]); ++b) {
    harp_note_on(harp, 1, KEY, 100);
    harp_note_on(harp, 2, KEY + 1, 100);
    harp_bend(harp, 1, bends[b]);
    harps_run(harp, 1000, NULL, NULL);
    worst = fmax(worst,
                 fabs(measure_cents(tone_of(bent).f0_hz, harps_tone(&patch, KEY, bends[b]).f0_hz)));
    worst = fmax(worst,
                 fabs(measure_cents(tone_of(still).f0_hz, harps_tone(&patch, KEY + 1, 0.0).f0_hz)));
  }
  assert_within("cents", worst, 1e-4);
  harp_free(harp);
}

/* A string bent by up to eight octaves, in what is heard of it: its pitch, and no step of more than
 * a pluck's. */
static void far_bends_are_exact_and_do_not_click(void** state) {
  static const double bends[] = {-36.0, 48.0, -48.0, 12.0, 0.0};
  (void)state;
  const Patch patch = patch_of(0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, KEY, 127);
  harps_run(harp, RATE / 4, left, NULL);
  double worst = 0.0;
  for (size_t b = 0; b < sizeof(bends) / sizeof(bends[0]); ++b) {
    harps_restart(harp, &patch);
    harp_note_on(harp, 0, KEY, 127);
    harps_run(harp, RATE / 4, left, NULL);
    const double pluck = harps_largest_step(left, RATE / 4);
    harp_bend(harp, 0, bends[b]);
    harps_run(harp, 2 * RATE, left, NULL);
    const double step = harps_largest_step(left, 2 * RATE);
    const Tone asked = harps_tone(&patch, KEY, bends[b]);
    Tone heard = {0};
    assert_true(measure_tone(left + 2000, 2 * RATE - 2000, RATE, asked, &heard));
    worst = fmax(worst, fabs(measure_cents(heard.f0_hz, asked.f0_hz)));
    /* Steps grow with the pitch. */
    assert_within("step, of a pluck's", step / pluck / fmax(1.0, exp2(bends[b] / 12.0)), 1.05);
  }
  assert_within("cents", worst, 0.005);
  harp_free(harp);
}

/* The phase [cycles] of what is heard around `at`, against a steady tone of `f_hz`. */
static double phase_at(const float* samples, size_t at, size_t n_window, double f_hz) {
  double re = 0.0;
  double im = 0.0;
  for (size_t i = 0; i < n_window; ++i) {
    const double angle = 2.0 * PI * f_hz * (double)(at + i) / RATE;
    const double w = 1.0 - cos(2.0 * PI * ((double)i + 0.5) / (double)n_window);
    re += w * (double)samples[at + i] * cos(angle);
    im -= w * (double)samples[at + i] * sin(angle);
  }
  return atan2(im, re) / (2.0 * PI);
}

/* How far the mean of what is heard over `n` frames, so many whole swings, is above `f_hz`. */
static double mean_above_hz(const float* samples, size_t n, double f_hz) {
  enum { HOP = 300 };
  const size_t n_window = (size_t)(8.0 * RATE / f_hz);
  double last = phase_at(samples, 0, n_window, f_hz);
  double cycles = 0.0;
  for (size_t at = HOP; at <= n; at += HOP) {
    const double now = phase_at(samples, at, n_window, f_hz);
    cycles += (now - last) - round(now - last);
    last = now;
  }
  return cycles * RATE / (double)n;
}

/* Over nine whole swings. */
static void a_vibrato_is_exact_in_its_mean(void** state) {
  (void)state;
  Patch patch = patch_of(0);
  patch.damping_per_s = 0.05;
  Harp* const harp = harps_new(RATE, &patch);
  const double f0_hz = harps_tone(&patch, KEY, 0.0).f0_hz;
  harp_note_on(harp, 0, KEY, 127);
  harp_vibrato(harp, 0, 0.5);
  harps_run(harp, RATE, left, NULL);
  double lowest = 1.0;
  double highest = 0.0;
  for (uint32_t n = 0; n < 2 * RATE; n += 32) {
    const HarpString* const string = &harp->strings[KEY];
    harps_run(harp, 32, left + n, NULL);
    const double f_hz =
        pole_tone(RATE, tuning_mode(string->wire.chain.now, string->wire.chain.n_masses, 1)).f0_hz;
    lowest = fmin(lowest, measure_cents(f_hz, f0_hz));
    highest = fmax(highest, measure_cents(f_hz, f0_hz));
  }
  assert_within("sharp side, off half a semitone [cents]", fabs(highest - 50.0), 0.2);
  assert_within("flat side, off the same in Hz [cents]",
                fabs(lowest - 1200.0 * log2(2.0 - exp2(0.5 / 12.0))), 0.2);
  const double above_hz = mean_above_hz(left, 9 * SWING, f0_hz);
  assert_within("mean, off in cents", fabs(measure_cents(f0_hz + above_hz, f0_hz)), 0.01);
  harp_vibrato(harp, 0, 0.0);
  harps_run(harp, 2000, NULL, NULL);
  assert_within("cents once it is over",
                fabs(measure_cents(tone_of(&harp->strings[KEY]).f0_hz, f0_hz)), 1e-4);
  harp_free(harp);
}

/* Largest way from its place that a string's pitch is on within half a second [cents]. */
static double swing_of(Harp* harp, uint32_t key) {
  const HarpString* const string = &harp->strings[key];
  const double f0_hz = harp_string_pitch_hz(string, &harp->patch);
  double most = 0.0;
  for (uint32_t n = 0; n < RATE / 2; n += 64) {
    harps_run(harp, 64, NULL, NULL);
    const Pole pole = tuning_mode(string->wire.chain.now, string->wire.chain.n_masses, 1);
    most = fmax(most, fabs(measure_cents(pole_tone(RATE, pole).f0_hz, f0_hz)));
  }
  return most;
}

static void pressure_swings_the_keys_that_it_is_on(void** state) {
  (void)state;
  const Patch patch = patch_of(0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 1, KEY, 100);
  harp_note_on(harp, 1, KEY + 1, 100);
  harp_note_on(harp, 2, KEY + 2, 100);
  harp_press_key(harp, 1, KEY, 1.0);
  harp_press_key(harp, 2, KEY + 1, 1.0);
  assert_within("half a semitone [cents]", fabs(swing_of(harp, KEY) - 50.0), 2.0);
  assert_true(swing_of(harp, KEY + 1) < 1e-4);
  harp_press(harp, 1, 0.5);
  assert_within("the hardest counts [cents]", fabs(swing_of(harp, KEY) - 50.0), 2.0);
  assert_within("a quarter [cents]", fabs(swing_of(harp, KEY + 1) - 25.0), 1.0);
  assert_true(swing_of(harp, KEY + 2) < 1e-4);
  /* Until it is up. */
  harp_press(harp, 1, 0.0);
  harp_pedal(harp, 1, 1.0);
  harp_note_off(harp, 1, KEY);
  harps_run(harp, 1000, NULL, NULL);
  assert_true(swing_of(harp, KEY) < 1e-4);
  harp_note_on(harp, 1, KEY, 100);
  harp_press_key(harp, 1, KEY, 1.0);
  harp_all_sound_off(harp);
  harp_note_on(harp, 1, KEY, 100);
  harps_run(harp, 1000, NULL, NULL);
  assert_true(swing_of(harp, KEY) < 1e-4);
  harp_free(harp);
}

/* A note that is played under a vibrato has it, and so has one that follows another. */
static void a_vibrato_waits_for_notes(void** state) {
  (void)state;
  const Patch patch = patch_of(0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_vibrato(harp, 0, 0.3);
  for (int again = 0; again < 3; ++again) {
    harp_note_on(harp, 0, KEY, 100);
    assert_within("off 30 cents", fabs(swing_of(harp, KEY) - 30.0), 1.0);
  }
  harp_free(harp);
}

/* Nor does it begin in the middle of the last one's. */
static void a_vibrato_begins_with_its_note(void** state) {
  (void)state;
  Patch patch = patch_of(0);
  patch.damping_per_s = 50.0;
  Harp* const harp = harps_new(RATE, &patch);
  harp_vibrato(harp, 0, 0.3);
  for (int again = 0; again < 3; ++again) {
    harp_note_on(harp, 0, KEY, 100);
    harps_run(harp, RATE, again == 0 ? left : other, NULL);
    assert_int_equal(harp_report(harp).n_strings, 0);
    if (again > 0) {
      assert_memory_equal(left, other, RATE * sizeof(float));
    }
    harps_run(harp, 777, NULL, NULL);
  }
  harp_free(harp);
}

/* A host that automates something with large blocks. */
static void slow_changes_do_not_stretch_a_vibrato(void** state) {
  (void)state;
  Patch patch = patch_of(0);
  Harp* const harp = harps_new(RATE, &patch);
  harp_vibrato(harp, 0, 0.3);
  harp_note_on(harp, 0, KEY, 100);
  for (int block = 0; block < 4; ++block) {
    patch.damping_per_s *= 1.01;
    harp_set_patch(harp, &patch, RATE / 2);
    assert_within("off 30 cents", fabs(swing_of(harp, KEY) - 30.0), 1.0);
  }
  harp_free(harp);
}

/* Loudness of a bowed note from a second on, in dB. */
static double bowed_db(Harp* harp) {
  harps_run(harp, RATE, NULL, NULL);
  harps_run(harp, RATE, left, NULL);
  return 20.0 * log10(fmax(measure_rms(left, RATE), 1e-9));
}

static void breath_and_pressure_are_the_bows_strength(void** state) {
  (void)state;
  const Patch patch = patch_of(BOWED);
  Harp* const harp = harps_new(RATE, &patch);
  harp_note_on(harp, 0, KEY, 80);
  const double full = bowed_db(harp);
  harp_breathe(harp, 0, 0.5);
  assert_within("half a breath, dB off 6", fabs(bowed_db(harp) - full + 6.02), 1.0);
  harp_press(harp, 0, 1.0);
  assert_within("pressed as well, dB", fabs(bowed_db(harp) - full), 1.0);
  harp_breathe(harp, 0, 1.0);
  assert_within("pressed alone, dB off 6", fabs(bowed_db(harp) - full - 6.02), 1.0);
  assert_true(harp->strings[KEY].vibrato.depth == 0.0);
  harp_breathe(harp, 0, 0.0);
  /* Without any it leaves the string, which rings on. */
  harps_run(harp, RATE / 10, NULL, NULL);
  const Tone open = harps_tone(&patch, KEY, 0.0);
  Tone heard = {0};
  harps_run(harp, RATE, left, NULL);
  assert_true(measure_tone(left, RATE, RATE, open, &heard));
  assert_within("τ of what rings on", fabs(heard.tau_s / open.tau_s - 1.0), 1e-3);
  /* A note is as strong as the breath that it meets. */
  harps_restart(harp, &patch);
  harp_breathe(harp, 0, 0.25);
  harp_note_on(harp, 0, KEY, 80);
  assert_within("a quarter, dB off 12", fabs(bowed_db(harp) - full + 12.04), 1.5);
  harp_free(harp);
}

static double loss_of(const HarpString* string) {
  const StringCoefs c = string->wire.chain.goal;
  const double between = c.z1 * tuning_lambda(string->wire.chain.n_masses, 1);
  return between / (c.z0 + between);
}

static void brightness_moves_what_is_between_the_masses(void** state) {
  (void)state;
  const Patch patch = patch_of(0);
  const double tau_s = harps_tone(&patch, KEY, 0.0).tau_s;
  Harp* const harp = harps_new(RATE, &patch);
  double last = 1.0;
  harp_note_on(harp, 0, KEY, 100);
  for (int step = -4; step <= 4; ++step) {
    harp_brighten(harp, 0, 0.25 * step);
    harps_run(harp, 1000, NULL, NULL);
    const double loss = loss_of(&harp->strings[KEY]);
    assert_within("τ", fabs(tone_of(&harp->strings[KEY]).tau_s / tau_s - 1.0), 1e-9);
    assert_true(loss < 0.8 * last);
    if (step == 0) {
      assert_within("as the patch has it", fabs(loss / patch.loss - 1.0), 1e-9);
    }
    last = loss;
  }
  harp_free(harp);
}

/* How much of what is heard is above the first partials: mean square of the changes. */
static double sharpness(const float* samples, size_t n) {
  double sum = 0.0;
  for (size_t i = 1; i < n; ++i) {
    const double change = (double)(samples[i] - samples[i - 1]);
    sum += change * change;
  }
  const double rms = measure_rms(samples, n);
  return sqrt(sum / (double)n) / rms;
}

static void a_brighter_hand_plays_brighter_notes(void** state) {
  (void)state;
  for (uint32_t exciter = 0; exciter < 2; ++exciter) {
    const Patch patch = patch_of(HARPS_N_SENSES * exciter + SENSE_VELOCITY);
    Harp* const harp = harps_new(RATE, &patch);
    double last = 0.0;
    for (int step = -1; step <= 1; ++step) {
      harps_restart(harp, &patch);
      harp_brighten(harp, 0, step);
      harp_note_on(harp, 0, KEY, 100);
      harps_run(harp, RATE / 5, left, NULL);
      const double now = sharpness(left, RATE / 5);
      print_message("  %s, %+d: %.3g\n", harps_exciter(patch.exciter), step, now);
      assert_true(now > 1.1 * last);
      last = now;
    }
    harp_free(harp);
  }
}

/* Where it would click most. */
static void a_swell_is_a_gain_and_no_step(void** state) {
  (void)state;
  const Patch patch = patch_of(0);
  Harp* const harp = harps_new(RATE, &patch);
  uint32_t at = RATE / 2;
  harp_note_on(harp, 0, KEY, 100);
  harps_run(harp, RATE, left, NULL);
  for (uint32_t i = at; i < RATE / 2 + 500; ++i) {
    at = fabsf(left[i]) > fabsf(left[at]) ? i : at;
  }
  harps_restart(harp, &patch);
  harp_note_on(harp, 0, KEY, 100);
  harps_run(harp, at, other, NULL);
  harp_swell(harp, 0.25);
  harps_run(harp, RATE - at, other + at, NULL);
  assert_memory_equal(left, other, at * sizeof(float));
  assert_true(harps_largest_step(other + at, RATE - at) <=
              harps_largest_step(left + at - 500, RATE - at));
  for (uint32_t i = at + harp->n_gesture; i < RATE; ++i) {
    assert_true(other[i] == 0.25f * left[i]);
  }
  harp_free(harp);
}

/* Any hand, and anything that it can do. */
static void gesture(Harp* harp, Random* random) {
  const uint32_t hand = random_below(random, HARP_HANDS);
  const uint32_t key = 40 + random_below(random, 8);
  const double share =
      random_below(random, 4) ? random_between(random, 0.0, 1.0) : (double)random_below(random, 2);
  Patch patch = patch_of(random_below(random, HARPS_N_WAYS));
  switch (random_below(random, 16)) {
  case 0:
    harp_bend(harp, hand, 192.0 * (share - 0.5));
    break;
  case 1:
    harp_bend(harp, hand, 4.0 * (share - 0.5));
    break;
  case 2:
    harp_vibrato(harp, hand, share);
    break;
  case 3:
    harp_press(harp, hand, share);
    break;
  case 4:
    harp_press_key(harp, hand, key, share);
    break;
  case 5:
    harp_brighten(harp, hand, 2.0 * share - 1.0);
    break;
  case 6:
    harp_breathe(harp, hand, share);
    break;
  case 7:
    harp_swell(harp, share);
    break;
  case 8:
    harp_pedal(harp, hand, share);
    break;
  case 9:
    harp_sostenuto(harp, hand, share > 0.5);
    break;
  case 10:
    harp_soften(harp, hand, share);
    break;
  case 11:
    harp_let_go(harp, hand);
    break;
  case 12:
    harp_note_off(harp, hand, key);
    break;
  case 13:
    patch.damping_per_s = random_log_between(random, 0.5, 100.0);
    harp_set_patch(harp, &patch, random_below(random, 3000));
    break;
  case 14:
    if (random_below(random, 8) == 0) {
      harp_all_sound_off(harp);
    } else {
      harp_all_notes_off(harp, hand);
    }
    break;
  default:
    harp_note_on(harp, hand, key, 1 + random_below(random, 127));
    break;
  }
}

/* The same storm, whatever the size of the calls; 0: at random. */
static void play_storm(Harp* harp, uint64_t seed, uint32_t cut, uint32_t n_frames, float* out) {
  Random random = {.state = seed};
  Random cuts = {.state = cut};
  const Patch patch = patch_of(0);
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
  const Patch patch = patch_of(0);
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

static void nothing_sticks_after_a_storm_of_hands(void** state) {
  static const double rates_hz[] = {8000.0, 48000.0, 192000.0};
  (void)state;
  Random random = random_start();
  double peak = 0.0;
  for (size_t r = 0; r < 3; ++r) {
    const Patch patch = patch_of(0);
    Harp* const harp = harps_new(rates_hz[r], &patch);
    for (int round = 0; round < 4; ++round) {
      play_storm(harp, random_below(&random, 1U << 31), MOST, 2 * RATE, left);
      peak = fmax(peak, measure_peak(left, 2 * RATE));
      harp_all_sound_off(harp);
      const size_t n = (size_t)(0.2 * rates_hz[r]);
      harps_run(harp, n, left, NULL);
      harps_run(harp, n, left, NULL);
      assert_int_equal(harp_report(harp).n_strings, 0);
      assert_true(measure_peak(left, n) == 0.0);
    }
    harp_free(harp);
  }
  /* Sixteen hands at eight keys, bows and bends at their worst. */
  assert_within("largest sample", peak, 40 * 0.25 * 4.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_hand_bends_what_it_plays),
      cmocka_unit_test(far_bends_are_exact_and_do_not_click),
      cmocka_unit_test(a_vibrato_is_exact_in_its_mean),
      cmocka_unit_test(a_vibrato_waits_for_notes),
      cmocka_unit_test(a_vibrato_begins_with_its_note),
      cmocka_unit_test(slow_changes_do_not_stretch_a_vibrato),
      cmocka_unit_test(pressure_swings_the_keys_that_it_is_on),
      cmocka_unit_test(breath_and_pressure_are_the_bows_strength),
      cmocka_unit_test(brightness_moves_what_is_between_the_masses),
      cmocka_unit_test(a_brighter_hand_plays_brighter_notes),
      cmocka_unit_test(a_swell_is_a_gain_and_no_step),
      cmocka_unit_test(touches_are_the_same_however_calls_are_cut),
      cmocka_unit_test(nothing_sticks_after_a_storm_of_hands),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
