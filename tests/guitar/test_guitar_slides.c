/* Slides, bends and vibrato are in tune all along, heard in the phase of a string so dark that only
 * its fundamental is left. */
#include "tests/support/guitars.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;
static const double complex J = (double complex)I;
static const double RATE_HZ = 48e3;

/* Before a move the upper partials die. */
enum { MOST_FRAMES = 240000, WAIT = 24000, MOST_LOOKS = 4000, HOP = 60 };

/* Periods in a window of cos⁴, in which what is 16 bins away, at the negative frequency, is 130 dB
 * down. */
static const double PERIODS = 8.0;

static float sound[MOST_FRAMES];
static double path_hz[MOST_FRAMES];

/* How far the sound is off the path, in cents, in the middle of each window. */
typedef struct {
  uint32_t n;
  double cents[MOST_LOOKS];
  uint32_t middle[MOST_LOOKS];
} Track;

static double complex look(const double* phase, uint32_t start, uint32_t length) {
  double complex sum = 0.0;
  for (uint32_t i = 0; i < length; ++i) {
    const double bell = sin(PI * (i + 0.5) / length);
    sum += bell * bell * bell * bell * (double)sound[start + i] * cexp(-J * phase[start + i]);
  }
  return sum;
}

static void follow(Track* track, uint32_t from, uint32_t to) {
  static double phase[MOST_FRAMES];
  double lowest_hz = HUGE_VAL;
  for (uint32_t i = from; i < to; ++i) {
    phase[i] = i > from ? phase[i - 1] + 2.0 * PI * path_hz[i] / RATE_HZ : 0.0;
    lowest_hz = fmin(lowest_hz, path_hz[i]);
  }
  const uint32_t length = (uint32_t)(PERIODS * RATE_HZ / lowest_hz);
  double complex before = 0.0;
  track->n = 0;
  for (uint32_t start = from; start + length <= to && track->n < MOST_LOOKS; start += HOP) {
    const double complex here = look(phase, start, length);
    const uint32_t middle = start + (length - HOP) / 2;
    if (start > from) {
      const double off_hz = carg(here * conj(before)) * RATE_HZ / (2.0 * PI * HOP);
      track->cents[track->n] = measure_cents(path_hz[middle] + off_hz, path_hz[middle]);
      track->middle[track->n++] = middle;
    }
    before = here;
  }
}

static double worst_of(const Track* track) {
  double worst = 0.0;
  for (uint32_t i = 0; i < track->n; ++i) {
    worst = fmax(worst, fabs(track->cents[i]));
  }
  return worst;
}

static GuitarPatch dark_patch(void) {
  GuitarPatch patch = guitars_patch();
  patch.string.loss = 1.0;
  patch.string.damping_per_s = 1.0;
  patch.string.tracking = 0.0;
  patch.hardness = 0.0;
  patch.pluck = 0.5;
  patch.pickups[0].place = 0.4;
  return patch;
}

static Guitar* ringing_guitar(const GuitarPatch* patch, uint32_t string, double fret) {
  Guitar* const guitar = guitars_new(RATE_HZ, patch);
  guitar_fret(guitar, string, fret);
  guitars_pluck(guitar, string, 1.0);
  guitars_run(guitar, WAIT, sound);
  return guitar;
}

/* Exact once it is there. */
static double cents_after(const GuitarPatch* patch, uint32_t string, double fret, uint32_t at) {
  const Tone asked = guitars_tone(patch, string, fret);
  Tone heard = {0};
  assert_true(measure_tone(sound + at, 48000, RATE_HZ, asked, &heard));
  return fabs(measure_cents(heard.f0_hz, asked.f0_hz));
}

/* A second from fret to fret, or bent as far; `nudge`: at every so many frames another gesture, of
 * a bend that is no bend, is begun on the way. */
static void move(uint32_t string,
                 double from,
                 double to,
                 bool is_bent,
                 uint32_t nudge,
                 double* worst,
                 double* worst_after) {
  static Track track;
  const GuitarPatch patch = dark_patch();
  Guitar* const guitar = ringing_guitar(&patch, string, from);
  const uint32_t n = 48000;
  if (is_bent) {
    guitar_bend(guitar, string, to - from, 1.0);
  } else {
    guitar_slide(guitar, string, to, 1.0);
  }
  const uint32_t piece = nudge > 0 ? nudge : n;
  for (uint32_t done = 0; done < n; done += piece) {
    guitars_run(guitar, n - done < piece ? n - done : piece, sound + WAIT + done);
    if (nudge > 0) {
      guitar_vibrato(guitar, string, 0.0, 0.0);
    }
  }
  guitars_run(guitar, 60000, sound + WAIT + n);
  for (uint32_t i = 0; i <= n; ++i) {
    path_hz[WAIT + i] = guitars_tone(&patch, string, from + (to - from) * i / n).f0_hz;
  }
  follow(&track, WAIT, WAIT + n);
  *worst = fmax(*worst, worst_of(&track));
  *worst_after = fmax(*worst_after, cents_after(&patch, string, to, WAIT + n + 1000));
  guitar_free(guitar);
}

static void slides_and_bends_are_in_tune_along_the_way(void** state) {
  (void)state;
  double worst = 0.0;
  double after = 0.0;
  for (uint32_t string = 0; string < 6; ++string) {
    move(string, 2.0, 7.0, false, 0, &worst, &after);
    move(string, 7.0, 2.0, false, 0, &worst, &after);
    move(string, 3.0, 5.0, true, 0, &worst, &after);
  }
  /* A window of 8 periods sees the pitch bend away from a straight line by less than that. */
  assert_within("cents off the straight line", worst, 0.5);
  assert_within("cents once it is there", after, 0.005);
}

/* What else is done on the way takes no time from it. */
static void other_gestures_do_not_hurry_a_slide(void** state) {
  (void)state;
  double worst = 0.0;
  double after = 0.0;
  move(3, 2.0, 7.0, false, 50, &worst, &after);
  move(3, 7.0, 2.0, false, 333, &worst, &after);
  assert_within("cents off the straight line", worst, 0.5);
  assert_within("cents once it is there", after, 0.005);
}

/* Two seconds of vibrato on the path that it should take: what is left is fitted by its sine. */
static void vibrato_has_its_depth_and_its_mean(void** state) {
  (void)state;
  static Track track;
  static const double vibratos[][2] = {{0.5, 5.0}, {0.1, 6.0}, {0.3, 3.0}};
  const GuitarPatch patch = dark_patch();
  double worst_depth = 0.0;
  double worst_mean = 0.0;
  for (int v = 0; v < 3; ++v) {
    for (uint32_t string = 0; string < 6; string += 2) {
      const uint32_t n = 96000;
      const double depth = vibratos[v][0];
      const double turn = 2.0 * PI * vibratos[v][1] / RATE_HZ;
      Guitar* const guitar = ringing_guitar(&patch, string, 3.0);
      guitar_vibrato(guitar, string, depth, vibratos[v][1]);
      guitars_run(guitar, n, sound + WAIT);
      for (uint32_t i = 0; i < n; ++i) {
        const double share = exp2(depth * fmin(1.0, i / 192.0) / 12.0) - 1.0;
        const double now = 12.0 * log2(1.0 + share * sin(turn * i));
        path_hz[WAIT + i] = guitars_tone(&patch, string, 3.0 + now).f0_hz;
      }
      follow(&track, WAIT, WAIT + n);
      const uint32_t cycle = (uint32_t)(RATE_HZ / vibratos[v][1]) / HOP;
      const uint32_t n_looks = track.n / cycle * cycle;
      double complex swing = 0.0;
      double mean = 0.0;
      for (uint32_t i = 0; i < n_looks; ++i) {
        swing += track.cents[i] * cexp(-J * turn * (track.middle[i] - (double)WAIT));
        mean += exp2(track.cents[i] / 1200.0) / n_looks;
      }
      worst_depth = fmax(worst_depth, cabs(swing) * 2.0 / n_looks / (100.0 * depth));
      worst_mean = fmax(worst_mean, fabs(1200.0 * log2(mean)));
      guitar_free(guitar);
    }
  }
  assert_within("depth, relative", worst_depth, 0.02);
  assert_within("cents of the mean frequency", worst_mean, 0.05);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(slides_and_bends_are_in_tune_along_the_way),
      cmocka_unit_test(other_gestures_do_not_hurry_a_slide),
      cmocka_unit_test(vibrato_has_its_depth_and_its_mean),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
