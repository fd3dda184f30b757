/* Every preset, key by key up a chromatic scale: how even it is, how clean, and how its notes begin
 * and end. */
#include "tests/support/loudness.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum {
  RATE = 48000,
  BLOCK = 256,
  LOWEST = 33,
  HIGHEST = 96,
  N_KEYS = HIGHEST - LOWEST + 1,
  N_UP = RATE / 10,      /* Frames between a key and the next */
  N_BEGIN = 8,           /* Frames in which a click would be heard as a note begins */
  N_BEFORE = RATE / 5,   /* Frames that the end of a note is measured by */
  N_STANDING = RATE / 5, /* Frames over which what stands still is measured */
};

static const double PI = 3.14159265358979323846;

/* What is promised: full scale with the limiter off, and −60 dB of it. */
static const double LOUDEST = 1.0;
static const double MOST_STANDING = 1e-3;

/* From a key to the next, and over all [dB].  Bars and short chains have so few partials that some
 * fall on the nodes of pickups. */
static const double MOST_UNEVEN_DB = 4.5;
static const double MOST_UNEVEN_BY_BODY_DB = 5.5;
static const double MOST_SPAN_DB = 8.0;

/* A note begins with no larger a step than its exciter's edge, as it comes by again rounded by a
 * period; and neither a damper nor a bow that is lifted makes one that the note did not have. */
static const double LARGEST_BEGIN = 2.0;
static const double LARGEST_END = 2.0;

typedef struct {
  double peak;
  double standing;          /* Largest mean */
  double begin;             /* First steps of a note, of the largest that come after */
  double end;               /* Steps after a key goes up, of those before */
  double uneven_db;         /* From a key to the next */
  double quietest, loudest; /* [LUFS] */
} Scale;

/* A bow takes its time. */
static size_t held_frames(const Host* host) {
  return host_get(host, "exciter") == 2.0f ? RATE * 6 / 5 : RATE * 45 / 100;
}

static Sound play(Host* host, size_t n_held) {
  const size_t n_note = n_held + N_UP;
  Sound sound = sound_new(N_KEYS * n_note);
  strings_restart(host);
  for (uint32_t k = 0; k < N_KEYS; ++k) {
    strings_note_on(host, k * n_note, LOWEST + k, 127);
    strings_note_off(host, k * n_note + n_held, LOWEST + k);
  }
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  return sound;
}

/* Under a window that hears nothing of the pitch. */
static double mean_of(const float* samples, size_t n) {
  double sum = 0.0;
  double weight = 0.0;
  for (size_t i = 0; i < n; ++i) {
    const double hann = 1.0 - cos(2.0 * PI * ((double)i + 0.5) / (double)n);
    sum += hann * hann * (double)samples[i];
    weight += hann * hann;
  }
  return sum / weight;
}

static double step_of(const float* samples, size_t n) {
  double most = 0.0;
  for (size_t i = 1; i < n; ++i) {
    most = fmax(most, fabs((double)samples[i] - (double)samples[i - 1]));
  }
  return most;
}

static void look_at_side(const float* note, size_t n_held, Scale* scale) {
  const float* const last = note + n_held - N_BEFORE;
  const double step = step_of(note, n_held);
  const double before = fmax(step_of(last, N_BEFORE), 0.05 * step);
  const double after_begin = step_of(note + N_BEGIN, n_held - N_BEGIN);
  scale->peak = fmax(scale->peak, measure_peak(note, n_held + N_UP));
  scale->standing = fmax(scale->standing, fabs(mean_of(note + n_held - N_STANDING, N_STANDING)));
  scale->begin = fmax(scale->begin, step_of(note, N_BEGIN) / after_begin);
  scale->end = fmax(scale->end, step_of(note + n_held - 1, N_UP) / before);
}

static void look(const Sound* sound, uint32_t k, size_t n_held, double* last_lufs, Scale* scale) {
  const size_t at = k * (n_held + N_UP);
  const double lufs = loudness_lufs(sound->left + at, sound->right + at, n_held);
  scale->quietest = fmin(scale->quietest, lufs);
  scale->loudest = fmax(scale->loudest, lufs);
  scale->uneven_db = fmax(scale->uneven_db, k > 0 ? fabs(lufs - *last_lufs) : 0.0);
  *last_lufs = lufs;
  look_at_side(sound->left + at, n_held, scale);
  look_at_side(sound->right + at, n_held, scale);
}

static Scale scale_of(Host* host) {
  Scale scale = {.quietest = HUGE_VAL, .loudest = -HUGE_VAL};
  const size_t n_held = held_frames(host);
  double last_lufs = 0.0;
  Sound sound = play(host, n_held);
  for (uint32_t k = 0; k < N_KEYS; ++k) {
    look(&sound, k, n_held, &last_lufs, &scale);
  }
  sound_free(&sound);
  return scale;
}

static void scales_are_even_and_clean(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  for (uint32_t i = 0; i < host_n_presets(host); ++i) {
    assert_true(host_preset(host, host_preset_uri(host, i)));
    strings_set(host, "limiter", 0.0);
    const Scale s = scale_of(host);
    print_message("%-18s %5.1f to %5.1f LUFS, uneven by %.1f dB, peak %.2f, mean %.0e, "
                  "begins %.2f, ends %.2f\n",
                  host_preset_label(host, i), s.quietest, s.loudest, s.uneven_db, s.peak,
                  s.standing, s.begin, s.end);
    assert_true(s.peak < LOUDEST && s.standing < MOST_STANDING);
    assert_true(s.begin < LARGEST_BEGIN && s.end < LARGEST_END);
    const bool has_body = host_get(host, "body") > 0.0f;
    assert_true(s.uneven_db < (has_body ? MOST_UNEVEN_BY_BODY_DB : MOST_UNEVEN_DB));
    assert_true(s.loudest - s.quietest < MOST_SPAN_DB);
  }
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(scales_are_even_and_clean),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
