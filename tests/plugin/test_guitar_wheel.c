/* The wheel bends by what its range says, and that is what controllers say. */
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/orders.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { MOST_PAIRS = 8 };

/* Controllers of the second channel and their values, and the bend that a wheel at 3/4 then makes,
 * half its range. */
typedef struct {
  const char* what;
  uint8_t pairs[MOST_PAIRS][2];
  double semitones;
} BendRange;

#define CHOSEN                                                                                     \
  {CC_UPPER, 0}, {                                                                                 \
    CC_LOWER, 0                                                                                    \
  }

static const BendRange bend_ranges[] = {
    {"nothing", {{0, 0}}, 1.0},
    {"twelve", {CHOSEN, {CC_DATA_UPPER, 12}}, 6.0},
    {"with nought cents", {CHOSEN, {CC_DATA_UPPER, 12}, {CC_DATA_LOWER, 0}}, 6.0},
    {"and a half", {CHOSEN, {CC_DATA_UPPER, 12}, {CC_DATA_LOWER, 50}}, 6.25},
    {"cents alone", {CHOSEN, {CC_DATA_LOWER, 50}}, 1.25},
    {"semitones clear cents", {CHOSEN, {CC_DATA_LOWER, 50}, {CC_DATA_UPPER, 3}}, 1.5},
    {"chosen the other way round", {{CC_LOWER, 0}, {CC_UPPER, 0}, {CC_DATA_UPPER, 5}}, 2.5},
    {"the widest", {CHOSEN, {CC_DATA_UPPER, 24}}, 12.0},
    {"wider than the guitar bends", {CHOSEN, {CC_DATA_UPPER, 25}}, 12.5},
    {"and so far", {CHOSEN, {CC_DATA_UPPER, 127}, {CC_DATA_LOWER, 127}}, 24.0},
    {"a cent more", {CHOSEN, {CC_DATA_UPPER, 24}, {CC_DATA_LOWER, 2}}, 12.01},
    {"a cent less, in a step", {CHOSEN, {CC_DATA_UPPER, 24}, {CC_DECREMENT, 0}}, 11.995},
    {"none", {CHOSEN, {CC_DATA_UPPER, 0}}, 0.0},
    {"twice", {CHOSEN, {CC_DATA_UPPER, 12}, {CC_DATA_UPPER, 4}}, 2.0},
    {"null", {CHOSEN, {CC_UPPER, 127}, {CC_LOWER, 127}, {CC_DATA_UPPER, 12}}, 1.0},
    {"null after it", {CHOSEN, {CC_DATA_UPPER, 8}, {CC_UPPER, 127}, {CC_LOWER, 127}}, 4.0},
    {"no parameter", {{CC_DATA_UPPER, 12}, {CC_DATA_LOWER, 12}}, 1.0},
    {"half a parameter", {{CC_UPPER, 0}, {CC_DATA_UPPER, 12}}, 1.0},
    {"the other half", {{CC_LOWER, 0}, {CC_DATA_UPPER, 12}}, 1.0},
    {"another bank", {{CC_UPPER, 1}, {CC_LOWER, 0}, {CC_DATA_UPPER, 12}}, 1.0},
    {"a maker's own", {CHOSEN, {CC_OWN_UPPER, 0}, {CC_OWN_LOWER, 0}, {CC_DATA_UPPER, 12}}, 1.0},
    {"half its own", {CHOSEN, {CC_OWN_LOWER, 5}, {CC_DATA_UPPER, 12}}, 1.0},
    {"its other half", {CHOSEN, {CC_OWN_UPPER, 5}, {CC_DATA_UPPER, 12}}, 1.0},
    {"chosen again", {{CC_OWN_UPPER, 0}, {CC_OWN_LOWER, 0}, CHOSEN, {CC_DATA_UPPER, 12}}, 6.0},
};

static Sound play_range(Host* host, const BendRange* range, uint32_t wheel_channel) {
  Sound sound = sound_new(ORDERS_FRAMES);
  strings_restart(host);
  strings_midi(host, 0, 0x90 | wheel_channel, 62, 100);
  for (int i = 0; i < MOST_PAIRS && range->pairs[i][0]; ++i) {
    strings_midi(host, 3, 0xB1, range->pairs[i][0], range->pairs[i][1]);
  }
  strings_midi(host, 4000, 0xE0 | wheel_channel, 0, 96);
  strings_run(host, &sound, 0, ORDERS_FRAMES, ORDERS_BLOCK);
  return sound;
}

static void the_wheels_range_is_registered_parameter_nought(void** state) {
  (void)state;
  Host* const host = orders_open();
  for (size_t i = 0; i < sizeof(bend_ranges) / sizeof(bend_ranges[0]); ++i) {
    for (uint32_t channel = 1; channel <= 2; ++channel) {
      const double semitones = channel == 1 ? bend_ranges[i].semitones : 1.0;
      const Step steps[] = {{0, {0}, {ON, channel, 62, 100}},
                            {4000, {0}, {BEND, channel, semitones, 0}}};
      print_message("%s, channel %u\n", bend_ranges[i].what, channel);
      Sound heard = play_range(host, &bend_ranges[i], channel);
      Sound wanted = orders_play(host, steps, 2);
      assert_true(sound_is_same(&heard, &wanted));
      sound_free(&heard);
      sound_free(&wanted);
    }
  }
  host_free(host);
}

/* The wheel stays where it is, and what it bends by is the new range. */
static void a_new_range_holds_at_once(void** state) {
  static const Step steps[] = {
      {0, {0x91, 62, 100}, {ON, 1, 62, 100}},
      {100, {0xE1, 0, 96}, {BEND, 1, 1.0, 0}},
      {200, {0xB1, CC_UPPER, 0}, {END, 0, 0, 0}},
      {200, {0xB1, CC_LOWER, 0}, {END, 0, 0, 0}},
      {6000, {0xB1, CC_DATA_UPPER, 5}, {BEND, 1, 2.5, 0}},
      {9000, {0xB1, CC_DATA_LOWER, 50}, {BEND, 1, 2.75, 0}},
  };
  (void)state;
  Host* const host = orders_open();
  assert_true(orders_are_told(host, steps, 6));
  host_free(host);
}

/* As for Hooke Strings, and the sum goes as far as the guitar does. */
static void tunings_bend_as_the_wheel_does(void** state) {
  static const Step steps[] = {
      {0, {0x91, 62, 100}, {ON, 1, 62, 100}},
      {100, {0xE1, 0, 96}, {BEND, 1, 1.0, 0}},
      {200, {0xB1, CC_UPPER, 0}, {END, 0, 0, 0}},
      {200, {0xB1, CC_LOWER, 2}, {END, 0, 0, 0}},
      {3000, {0xB1, CC_DATA_UPPER, 61}, {BEND, 1, -2.0, 0}},
      {5000, {0xB1, CC_LOWER, 1}, {END, 0, 0, 0}},
      {6000, {0xB1, CC_DATA_UPPER, 96}, {BEND, 1, -1.5, 0}},
      {7000, {0xB1, CC_LOWER, 2}, {END, 0, 0, 0}},
      {8000, {0xB1, CC_DATA_UPPER, 127}, {BEND, 1, 24.0, 0}},
  };
  (void)state;
  Host* const host = orders_open();
  assert_true(orders_are_told(host, steps, sizeof(steps) / sizeof(steps[0])));
  host_free(host);
}

/* The lower half of a wheel counts, at the widest range a little of it. */
static void a_wide_range_limits_the_result_and_never_the_scale(void** state) {
  const double bend = 48.0 * 341 / 8192;
  const Step steps[] = {
      {0, {0xB6, CC_UPPER, 0}, {END, 0, 0, 0}},
      {0, {0xB6, CC_LOWER, 0}, {END, 0, 0, 0}},
      {0, {0xB6, CC_DATA_UPPER, 48}, {END, 0, 0, 0}},
      {0, {0x96, 62, 100}, {ON, 6, 62, 100}},
      {4000, {0xE6, 341 & 127, 64 + (341 >> 7)}, {BEND, 6, bend, 0}},
  };
  (void)state;
  assert_within("from +1.998", fabs(bend - 1.998), 1e-4);
  Host* const host = orders_open();
  assert_true(orders_are_told(host, steps, sizeof(steps) / sizeof(steps[0])));
  host_free(host);
}

/* A wheel is its channel's in either mode, and stays where it is between them. */
static void another_mode_leaves_the_wheels(void** state) {
  (void)state;
  Host* const host = orders_open();
  Sound sounds[2] = {sound_new(ORDERS_FRAMES), sound_new(ORDERS_FRAMES)};
  for (int i = 0; i < 2; ++i) {
    strings_set(host, "mode", i == 0);
    strings_restart(host);
    strings_midi(host, 0, 0xE1, 0, 96);
    strings_midi(host, 0, 0xE2, 0, 0);
    strings_run(host, &sounds[i], 0, ORDERS_BLOCK, ORDERS_BLOCK);
    strings_set(host, "mode", 0.0);
    strings_midi(host, 300, 0x91, 62, 100);
    strings_run(host, &sounds[i], ORDERS_BLOCK, ORDERS_FRAMES, ORDERS_BLOCK);
  }
  assert_true(measure_peak(sounds[0].left, ORDERS_FRAMES) > 0.01);
  assert_true(sound_is_same(&sounds[0], &sounds[1]));
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
  host_free(host);
}

static void activation_brings_the_usual_range_back(void** state) {
  (void)state;
  Host* const host = orders_open();
  Sound first = play_range(host, &bend_ranges[0], 1);
  Sound wide = play_range(host, &bend_ranges[1], 1);
  Sound again = play_range(host, &bend_ranges[0], 1);
  assert_false(sound_is_same(&first, &wide));
  assert_true(sound_is_same(&first, &again));
  sound_free(&first);
  sound_free(&wide);
  sound_free(&again);
  host_free(host);
}

/* Through the host and by the ear: with a range of an octave the wheel bends by one, but for the
 * step that its upper half lacks. */
static void the_wheel_bends_by_an_octave_exactly(void** state) {
  static const struct {
    unsigned value;
    double semitones;
  } wheels[] = {{16383, 12.0 * 8191 / 8192}, {0, -12.0}, {12288, 6.0}, {8192, 0.0}};
  (void)state;
  Host* const host = guitar_open(ORDERS_RATE, ORDERS_BLOCK);
  Sound sound = sound_new(2 * ORDERS_RATE);
  ToneError worst = {0};
  guitar_set_plain(host);
  for (int i = 0; i < 4; ++i) {
    strings_restart(host);
    strings_controller(host, 0, CC_UPPER, 0);
    strings_controller(host, 0, CC_LOWER, 0);
    strings_controller(host, 0, CC_DATA_UPPER, 12);
    strings_note_on(host, 0, 57, 100);
    strings_midi(host, ORDERS_RATE, 0xE0, wheels[i].value & 0x7F, wheels[i].value >> 7);
    strings_run(host, &sound, 0, sound.n_frames, ORDERS_BLOCK);
    const Tone straight = strings_tone(host, 57, 0.0);
    const Tone bent = {.f0_hz = strings_tone(host, 57, wheels[i].semitones).f0_hz,
                       .tau_s = straight.tau_s};
    worst.cents =
        fmax(worst.cents,
             strings_measure(&sound, ORDERS_RATE, ORDERS_RATE / 50, ORDERS_RATE, straight).cents);
    worst.cents =
        fmax(worst.cents, strings_measure(&sound, ORDERS_RATE, ORDERS_RATE + ORDERS_RATE / 20,
                                          2 * ORDERS_RATE, bent)
                              .cents);
  }
  assert_within("pitch [cents]", worst.cents, 0.005); /* What the instrument promises */
  sound_free(&sound);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_wheels_range_is_registered_parameter_nought),
      cmocka_unit_test(a_new_range_holds_at_once),
      cmocka_unit_test(tunings_bend_as_the_wheel_does),
      cmocka_unit_test(a_wide_range_limits_the_result_and_never_the_scale),
      cmocka_unit_test(another_mode_leaves_the_wheels),
      cmocka_unit_test(activation_brings_the_usual_range_back),
      cmocka_unit_test(the_wheel_bends_by_an_octave_exactly),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
