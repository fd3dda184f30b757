/* What the ports do while a string rings: it goes to its new sound in a straight line, without a
 * click, and is exactly in tune when it is there. */
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 1024, CHANGED = 24 * BLOCK, N_FRAMES = 2 * CHANGED };

/* Of the peak: a block's steps of a ramp, each rounded by 3e-8 at the most. */
static const double ROUNDING = 3e-8 * BLOCK;

/* How far a splice stands out above what is allowed, at the least. */
static const double SPLICE = 50.0;

static HostRange range_of(Host* host, const char* symbol) {
  HostRange range = {0};
  assert_true(host_range(host, symbol, &range));
  return range;
}

/* Where a string is read says how hard it is played; so that is set once it has been, by BLOCK. */
static bool is_of_pickups(const char* symbol) {
  return strcmp(symbol, "pickup") == 0 || strcmp(symbol, "spread") == 0;
}

/* One note, and one port set to `to` in mid-note. */
static Sound play_change(Host* host, uint32_t block, const char* symbol, double from, double to) {
  Sound sound = sound_new(N_FRAMES);
  const bool is_late = is_of_pickups(symbol);
  const HostRange range = is_late ? range_of(host, symbol) : (HostRange){0};
  strings_set(host, symbol, is_late ? (double)range.initial : from);
  strings_restart(host);
  strings_set(host, "spread", 0.0);
  strings_note_on(host, 0, 45, 100);
  strings_run(host, &sound, 0, BLOCK, block);
  strings_set(host, symbol, from);
  strings_run(host, &sound, BLOCK, CHANGED, block);
  strings_set(host, symbol, to);
  strings_run(host, &sound, CHANGED, N_FRAMES, block);
  return sound;
}

/* What a change of level or of pickup makes of the sounds before and after, `length` frames long.
 */
static double line_between(const Sound* a, const Sound* b, size_t i, size_t length) {
  const double way = i < CHANGED ? 0.0 : fmin(1.0, (double)(i - CHANGED + 1) / (double)length);
  return (1.0 - way) * (double)a->left[i] + way * (double)b->left[i];
}

static void check_line(uint32_t block, size_t length, const char* symbol, double from, double to) {
  Host* const host = strings_open(RATE, BLOCK);
  Sound before = play_change(host, block, symbol, from, from);
  Sound after = play_change(host, block, symbol, to, to);
  Sound changed = play_change(host, block, symbol, from, to);
  double worst = 0.0;
  for (size_t i = 0; i < N_FRAMES; ++i) {
    const double wanted = line_between(&before, &after, i, length);
    worst = fmax(worst, fabs((double)changed.left[i] - wanted));
  }
  const double peak = fmax(measure_peak(before.left, N_FRAMES), measure_peak(after.left, N_FRAMES));
  assert_within(symbol, worst / peak, ROUNDING);
  sound_free(&before);
  sound_free(&after);
  sound_free(&changed);
  host_free(host);
}

/* A host's stairs become slopes, each as long as its block, from one sound to the other. */
static void level_and_pickup_change_in_a_line_over_the_block(void** state) {
  (void)state;
  check_line(BLOCK, BLOCK, "level", 0.0, -60.0);
  check_line(BLOCK, BLOCK, "level", -20.0, 12.0);
  check_line(BLOCK, BLOCK, "pickup", 0.2, 0.7);
  check_line(BLOCK, BLOCK, "pickup", 0.0, 1.0);
  check_line(BLOCK, BLOCK, "spread", 0.0, 0.5);
  check_line(BLOCK, BLOCK, "spread", 0.3, 0.1);
  check_line(512, 512, "level", 0.0, -60.0);
  check_line(512, 512, "pickup", 0.2, 0.7);
}

/* In small blocks it takes 5 ms, or it would be a step. */
static void a_change_takes_five_milliseconds_at_the_least(void** state) {
  (void)state;
  const size_t shortest = (size_t)(0.005 * RATE) + 1;
  check_line(64, shortest, "level", 0.0, -60.0);
  check_line(64, shortest, "pickup", 0.2, 0.7);
  check_line(1, shortest, "spread", 0.0, 0.5);
}

static void level_is_in_decibels(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound loud = play_change(host, BLOCK, "level", 0.0, 0.0);
  Sound soft = play_change(host, BLOCK, "level", -20.0, -20.0);
  for (size_t i = 0; i < N_FRAMES; ++i) {
    assert_true(fabs((double)soft.left[i] - 0.1 * (double)loud.left[i]) < 1e-7);
  }
  sound_free(&loud);
  sound_free(&soft);
  host_free(host);
}

/* Largest second difference, that is where a click would stand out. */
static double roughness(const float* samples, size_t from, size_t to) {
  double worst = 0.0;
  for (size_t i = from; i < to; ++i) {
    const double bend = (double)samples[i] - 2.0 * (double)samples[i - 1] + (double)samples[i - 2];
    worst = fmax(worst, fabs(bend));
  }
  return worst;
}

/* Where a slope starts, and the two sounds are far apart, there is a corner, and no more than this.
 */
static double corner(const Sound* a, const Sound* b, size_t from, size_t to) {
  double worst = 0.0;
  for (size_t i = from; i < to; ++i) {
    worst = fmax(worst, fabs((double)a->left[i] - (double)b->left[i]) / BLOCK);
  }
  return worst;
}

/* The roughness of `a` until a frame and of `b` from it on, for the worst frame. */
static double splice(const Sound* a, const Sound* b, size_t from, size_t to) {
  double worst = 0.0;
  for (size_t i = from; i < to; ++i) {
    const float spliced[3] = {a->left[i - 2], a->left[i - 1], b->left[i]};
    worst = fmax(worst, roughness(spliced, 2, 3));
  }
  return worst;
}

typedef struct {
  const char* symbol;
  double low, high;
  bool is_slope; /* What is heard goes from the one to the other; else the string's forces do */
} Swept;

/* The change against the rougher of the two sounds between which it is.  Returns what splicing them
 * would be, which has to stand out. */
static double check_click(const Swept* port, double from, double to) {
  Host* const host = strings_open(RATE, BLOCK);
  strings_set(host, "hardness", 0.0);
  strings_set(host, "pluck", 0.3);
  Sound before = play_change(host, BLOCK, port->symbol, from, from);
  Sound after = play_change(host, BLOCK, port->symbol, to, to);
  Sound changed = play_change(host, BLOCK, port->symbol, from, to);
  const size_t start = CHANGED - BLOCK;
  const size_t end = CHANGED + 2 * BLOCK;
  const double usual =
      fmax(roughness(before.left, start, end), roughness(after.left, start, end)) * 1.5 +
      (port->is_slope ? corner(&before, &after, start, end) : 0.0);
  const double control = splice(&before, &after, start, end) / usual;
  char what[64];
  (void)snprintf(what, sizeof(what), "%s from %g to %g, spliced %.1f", port->symbol, from, to,
                 control);
  assert_within(what, roughness(changed.left, start, end) / usual, 1.0);
  assert_true(isfinite(measure_peak(changed.left, N_FRAMES)));
  assert_true(host_get(host, "headroom") >= 0.0f);
  sound_free(&before);
  sound_free(&after);
  sound_free(&changed);
  host_free(host);
  return control;
}

static void a_port_set_from_end_to_end_does_not_click(void** state) {
  static const Swept ports[] = {
      {"level", -60.0, 12.0, true},    {"pickup", 0.05, 0.95, true},
      {"spread", 0.0, 0.5, true},      {"damping", 0.02, 200.0, false},
      {"tracking", 0.0, 1.0, false},   {"loss", 1e-5, 1.0, false},
      {"stiffness", 1e-6, 0.1, false}, {"tuning", 400.0, 480.0, false},
      {"damping", 0.02, 8.0, false},
  };
  (void)state;
  for (size_t i = 0; i < sizeof(ports) / sizeof(ports[0]); ++i) {
    assert_true(check_click(&ports[i], ports[i].low, ports[i].high) > SPLICE);
    assert_true(check_click(&ports[i], ports[i].high, ports[i].low) > SPLICE);
  }
}

/* Every block another value, as automation arrives; energy has nowhere to come from but tuning. */
static void check_sweep(const char* symbol, double low, double high) {
  Host* const host = strings_open(RATE, BLOCK);
  strings_set(host, "partials", 1.0);
  strings_set(host, "masses", 256.0);
  Sound still = play_change(host, BLOCK, symbol, low, low);
  Sound swept = sound_new(N_FRAMES);
  const double peak = measure_peak(still.left, N_FRAMES);
  strings_set(host, symbol, low);
  strings_restart(host);
  strings_note_on(host, 0, 45, 100);
  for (size_t at = 0; at < N_FRAMES; at += BLOCK) {
    const double way = 0.5 - 0.5 * cos((double)at / 5000.0);
    strings_set(host, symbol, low * pow(high / low, way));
    strings_run(host, &swept, at, at + BLOCK, BLOCK);
    assert_true(host_get(host, "headroom") >= 0.0f);
  }
  assert_within(symbol, measure_peak(swept.left, N_FRAMES) / peak, 1.1);
  sound_free(&still);
  sound_free(&swept);
  host_free(host);
}

static void sweeping_makes_nothing_louder(void** state) {
  (void)state;
  check_sweep("stiffness", 1e-6, 0.1);
  check_sweep("loss", 1e-5, 1.0);
  check_sweep("damping", 0.02, 200.0);
  check_sweep("damping", 200.0, 0.02);
}

static void check_tone_after(const char* symbol, double from, double to, ToneError* worst) {
  Host* const host = strings_open(RATE, BLOCK);
  strings_set_plain(host);
  Sound sound = play_change(host, BLOCK, symbol, from, to);
  const Tone asked = strings_tone(host, 45, 0.0);
  *worst =
      strings_worse(*worst, strings_measure(&sound, RATE, CHANGED + 2 * BLOCK, N_FRAMES, asked));
  sound_free(&sound);
  host_free(host);
}

static void what_rings_has_the_new_pitch_and_decay_exactly(void** state) {
  (void)state;
  ToneError worst = {0};
  check_tone_after("tuning", 440.0, 480.0, &worst);
  check_tone_after("tuning", 480.0, 400.0, &worst);
  check_tone_after("tuning", 415.0, 440.0, &worst);
  strings_assert_exact("tuning", worst);
  check_tone_after("damping", 0.6, 4.0, &worst);
  check_tone_after("damping", 4.0, 0.02, &worst);
  check_tone_after("tracking", 0.0, 1.0, &worst);
  strings_assert_exact("damping and tracking", worst);
  check_tone_after("stiffness", 1e-6, 0.1, &worst);
  check_tone_after("stiffness", 0.1, 1e-6, &worst);
  check_tone_after("loss", 1e-5, 1.0, &worst);
  check_tone_after("stiffness_tracking", 0.0, 4.0, &worst);
  check_tone_after("loss_tracking", 4.0, -2.0, &worst);
  strings_assert_exact("stiffness and loss, which leave both alone", worst);
}

/* Off, it is choked and keys do nothing; on again, it is as new. */
static void off_is_silent_and_on_is_as_before(void** state) {
  enum { TENTH = RATE / 10 };
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(TENTH);
  Sound again = sound_new(TENTH);
  strings_set(host, "release", 10.0);
  strings_note_on(host, 0, 45, 100);
  strings_run(host, &sound, 0, TENTH, BLOCK);
  strings_set(host, "enabled", 0.0);
  strings_run(host, &again, 0, TENTH, BLOCK);
  strings_note_on(host, 5, 50, 127);
  strings_run(host, &again, 0, TENTH, BLOCK);
  assert_true(measure_peak(again.left, TENTH) < 1e-5 * measure_peak(sound.left, TENTH));
  assert_true(host_get(host, "sounding") == 0.0f);
  strings_set(host, "enabled", 1.0);
  strings_run(host, &again, 0, TENTH, BLOCK);
  assert_true(measure_peak(again.left, TENTH) == 0.0);
  strings_note_on(host, 0, 45, 100);
  strings_run(host, &again, 0, TENTH, BLOCK);
  assert_true(sound_is_same(&sound, &again));
  sound_free(&sound);
  sound_free(&again);
  host_free(host);
}

static Sound play_at(double pickup, double spread) {
  Host* const host = strings_open(RATE, BLOCK);
  Sound sound = sound_new(N_FRAMES);
  strings_note_on(host, 0, 45, 100);
  strings_run(host, &sound, 0, BLOCK, BLOCK);
  strings_set(host, "pickup", pickup);
  strings_set(host, "spread", spread);
  strings_run(host, &sound, BLOCK, N_FRAMES, BLOCK);
  host_free(host);
  return sound;
}

/* Without spread both sides are one, and with it their mean is that, half a millisecond later. */
static void both_sides_are_one_pickup(void** state) {
  (void)state;
  enum { THERE = 2 * BLOCK, LATE = RATE / 2000 };
  const size_t size = (N_FRAMES - THERE) * sizeof(float);
  Sound one = play_at(0.25, 0.0);
  Sound both = play_at(0.25, 0.5);
  double worst = 0.0;
  double most_apart = 0.0;
  assert_memory_equal(one.left + THERE, one.right + THERE, size);
  for (size_t i = THERE; i < N_FRAMES; ++i) {
    const double mean = 0.5 * ((double)both.left[i] + (double)both.right[i]);
    worst = fmax(worst, fabs(mean - (double)one.left[i - LATE]));
    most_apart = fmax(most_apart, fabs((double)both.left[i] - (double)both.right[i]));
  }
  const double peak = measure_peak(one.left, N_FRAMES);
  assert_within("mean, from what one pickup hears", worst / peak, ROUNDING);
  assert_true(most_apart > 0.1 * peak);
  sound_free(&one);
  sound_free(&both);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(level_and_pickup_change_in_a_line_over_the_block),
      cmocka_unit_test(level_is_in_decibels),
      cmocka_unit_test(a_change_takes_five_milliseconds_at_the_least),
      cmocka_unit_test(a_port_set_from_end_to_end_does_not_click),
      cmocka_unit_test(sweeping_makes_nothing_louder),
      cmocka_unit_test(what_rings_has_the_new_pitch_and_decay_exactly),
      cmocka_unit_test(off_is_silent_and_on_is_as_before),
      cmocka_unit_test(both_sides_are_one_pickup),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
