/* Bodies through a host: what a knock on each comes out as is what its modes make of it, and the
 * strings keep their pitch and decay. */
#include "core/bank/bodies.h"
#include "core/base/complex_of.h"

#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_RATE = 96000, BLOCK = 256 };

/* A hard knock, and a softer one, whose spectrum is nought elsewhere. */
static const double HARDNESS[] = {1.0, 0.2};

/* From 6 ms to 1.5 ms, by what velocity 127 makes of the hardness. */
static double knock_s(double hardness) {
  const double softness = 1.0 - pow(1.0 / 0.75, 0.75);
  const double played = fmin(1.0, hardness + softness * (-0.2 - hardness));
  return 0.006 * pow(0.25, played);
}

static Host* open_body(double rate_hz, BodiesChoice body) {
  Host* const host = strings_open(rate_hz, BLOCK);
  strings_set(host, "limiter", 0.0);
  strings_set(host, "body", body);
  strings_set(host, "body_mix", 1.0);
  return host;
}

static Sound
note_of(double rate_hz, BodiesChoice body, double hardness, double knock, size_t n_frames) {
  Host* const host = open_body(rate_hz, body);
  Sound sound = sound_new(n_frames);
  strings_set(host, "hardness", hardness);
  strings_set(host, "damping", 200.0); /* What the string leaves of floats is in the way. */
  strings_set(host, "loss", 1.0);
  strings_set(host, "knock", knock);
  strings_note_on(host, 0, 60, 127);
  strings_run(host, &sound, 0, n_frames, BLOCK);
  host_free(host);
  return sound;
}

/* What the knock alone is heard as. */
static Sound knock_of(double rate_hz, BodiesChoice body, double hardness, size_t n_frames) {
  Sound without = note_of(rate_hz, body, hardness, 0.0, n_frames);
  Sound with = note_of(rate_hz, body, hardness, 1.0, n_frames);
  for (size_t n = 0; n < n_frames; ++n) {
    with.left[n] -= without.left[n];
    with.right[n] -= without.right[n];
  }
  sound_free(&without);
  return with;
}

static double complex turn(double angle) {
  return complex_of(cos(angle), sin(angle));
}

static double complex spectrum_at(const float* samples, size_t n, double angle) {
  double complex sum = 0.0;
  double complex phase = 1.0;
  const double complex back = turn(-angle);
  for (size_t i = 0; i < n; ++i) {
    sum += (double)samples[i] * phase;
    phase *= back;
  }
  return sum;
}

/* Of a raised cosine of time with a height of 1. */
static double complex knock_at(double rate_hz, double time_s, double angle) {
  const uint32_t n = (uint32_t)(time_s * rate_hz);
  double complex sum = 0.0;
  for (uint32_t i = 1; i <= n; ++i) {
    sum += 0.5 * (1.0 - cos(2.0 * acos(-1.0) * i / (n + 1.0))) * turn(-angle * (i - 1.0));
  }
  return sum;
}

/* A mass that is stepped, by what it speeds up by, in the z-plane. */
static double complex mass_at(Pole pole, double angle) {
  const double complex back = turn(-angle);
  const double complex d = 1.0 - back;
  return 1.0 / (1.0 + pole.a * back / (d * d) + pole.g * back / d);
}

/* The sum of its modes, of which less is heard by how much higher than its Q a mass peaks that is
 * stepped. */
static double complex modes_at(const Body* body, double rate_hz, int side, double angle) {
  double complex sum = 0.0;
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    Pole pole;
    if (mode->f0_hz < BODY_HIGHEST * rate_hz) {
      const double tau_s = mode->q / (acos(-1.0) * mode->f0_hz);
      assert_int_equal(pole_solve(rate_hz, (Tone){mode->f0_hz, tau_s}, &pole), STATUS_OK);
      const double half = acos(-1.0) * mode->f0_hz / rate_hz;
      const double peak = tan(half) / (half * sqrt(1.0 - pole.g));
      sum += mode->radiation[side] / (mode->mass_kg * peak) * mass_at(pole, angle);
    }
  }
  return sum;
}

/* Around each mode: on its peak, and where it has half its power.  A tenth of a cent of a mode that
 * is off, or a tenth of a decibel, is seen there. */
static double worst_over_modes(
    const Body* body, double rate_hz, Sound knocks[2], double gain, bool* is_measured) {
  double worst = 0.0;
  for (uint32_t k = 0; k < body->n_modes; ++k) {
    const BodyMode* const mode = &body->modes[k];
    for (int at = -1; at <= 1 && mode->f0_hz < 0.4 * rate_hz; ++at) {
      const double hz = mode->f0_hz * (1.0 + 0.5 * at / mode->q);
      const double angle = 2.0 * acos(-1.0) * hz / rate_hz;
      const double complex in[] = {knock_at(rate_hz, knock_s(HARDNESS[0]), angle),
                                   knock_at(rate_hz, knock_s(HARDNESS[1]), angle)};
      const int best = cabs(in[1]) > cabs(in[0]);
      for (int side = 0; side < 2; ++side) {
        const float* const samples = side ? knocks[best].right : knocks[best].left;
        const double complex heard = spectrum_at(samples, knocks[best].n_frames, angle);
        const double complex asked = gain * in[best] * modes_at(body, rate_hz, side, angle);
        /* What rounding to floats leaves of a knock's upper end is not measured. */
        if (cabs(asked) > 2e-4) {
          worst = fmax(worst, cabs(heard - asked) / cabs(asked));
          is_measured[k] = true;
        }
      }
    }
  }
  return worst;
}

static double gain_of(const Body* body, double rate_hz, const Sound* knock) {
  const double angle = 2.0 * acos(-1.0) * body->modes[0].f0_hz / rate_hz;
  const double complex asked =
      knock_at(rate_hz, knock_s(HARDNESS[0]), angle) * modes_at(body, rate_hz, 0, angle);
  return creal(spectrum_at(knock->left, knock->n_frames, angle) / asked);
}

/* 0.1 dB is 0.0116 of the amplitude; a mode of Q 50 that is 0.1 cent off is so by 0.006. */
static void a_knock_is_heard_through_the_modes_of_the_body(void** state) {
  static const double rates[] = {44100.0, 48000.0, 96000.0};
  const bool is_long = getenv("HOOKE_TEST_LONG");
  (void)state;
  for (BodiesChoice choice = BODIES_NONE + 1; choice < BODIES_FILE; ++choice) {
    const Body* const body = bodies_shipped(choice);
    for (int r = is_long ? 0 : (int)choice % 3; r < (is_long ? 3 : (int)choice % 3 + 1); ++r) {
      bool is_measured[BODY_MAX_MODES] = {false};
      const size_t n_frames = (size_t)(2.0 * rates[r]);
      Sound knocks[] = {knock_of(rates[r], choice, HARDNESS[0], n_frames),
                        knock_of(rates[r], choice, HARDNESS[1], n_frames)};
      const double gain = gain_of(body, rates[r], &knocks[0]);
      const double worst = worst_over_modes(body, rates[r], knocks, gain, is_measured);
      uint32_t n_measured = 0;
      for (uint32_t k = 0; k < body->n_modes; ++k) {
        n_measured += is_measured[k];
      }
      print_message("  body %d at %g Hz: %u of %u modes\n", (int)choice, rates[r], n_measured,
                    body->n_modes);
      assert_within("of the response", worst, 0.006);
      assert_true(n_measured > body->n_modes / 2);
      sound_free(&knocks[0]);
      sound_free(&knocks[1]);
    }
  }
}

static void pitch_and_decay_are_the_strings_own(void** state) {
  (void)state;
  ToneError worst = {0.0, 0.0};
  for (BodiesChoice choice = BODIES_NONE + 1; choice < BODIES_FILE; ++choice) {
    for (uint32_t key = 36; key <= 84; key += 12) {
      Host* const host = open_body(48000.0, choice);
      Sound sound = sound_new(48000 * 4);
      strings_note_on(host, 0, key, 100);
      strings_run(host, &sound, 0, sound.n_frames, BLOCK);
      const ToneError error =
          strings_measure(&sound, 48000.0, 96000, sound.n_frames, strings_tone(host, key, 0.0));
      worst.cents = fmax(worst.cents, error.cents);
      worst.decay = fmax(worst.decay, error.decay);
      sound_free(&sound);
      host_free(host);
    }
  }
  assert_within("cents", worst.cents, 0.0002);
  assert_within("decay", worst.decay, 2e-4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_knock_is_heard_through_the_modes_of_the_body),
      cmocka_unit_test(pitch_and_decay_are_the_strings_own),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
