/* The promise of Hooke Guitar, measured on its sound: every string, at every fret, has exactly the
 * pitch and exactly the decay that were asked for. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { N_STRINGS = 6, N_FRETS = 23, BLOCK = 512 };

/* What the instrument promises, and Hooke Strings keeps. */
static const double MOST_CENTS = 0.005;
static const double MOST_DECAY_ERROR = 2e-4;

static const double rates_hz[] = {44100.0, 48000.0, 96000.0};

static const uint32_t open_notes[N_STRINGS] = {64, 59, 55, 50, 45, 40};

/* A note, as the manual has it. */
static Tone asked_of(const Host* host, uint32_t note) {
  const double octaves = ((double)note - 69.0) / 12.0;
  return (Tone){
      .f0_hz = (double)host_get(host, "tuning") * exp2(octaves),
      .tau_s = 1.0 / ((double)host_get(host, "damping") *
                      exp2((double)host_get(host, "tracking") * octaves)),
  };
}

/* A string by its channel, from rest. */
static ToneError play(Host* host, double rate_hz, uint32_t string, uint32_t fret) {
  const uint32_t note = open_notes[string] + fret;
  const Tone asked = asked_of(host, note);
  const size_t n_frames = (size_t)(fmin(4.0 * asked.tau_s, 4.0) * rate_hz);
  const size_t skip = (size_t)(2.0 * rate_hz / asked.f0_hz);
  Sound sound = sound_new(n_frames);
  strings_restart(host);
  strings_midi(host, 0, 0x90 + string, note, 127);
  strings_run(host, &sound, 0, n_frames, BLOCK);
  const ToneError error = strings_measure(&sound, rate_hz, skip, n_frames, asked);
  sound_free(&sound);
  return error;
}

static void every_string_is_in_tune_at_every_fret(void** state) {
  const double rate_hz = *(const double*)*state;
  Host* const host = guitar_open(rate_hz, BLOCK);
  ToneError worst = {0};
  guitar_set_plain(host);
  host_set(host, "mode", 1.0f);
  for (uint32_t string = 0; string < N_STRINGS; ++string) {
    for (uint32_t fret = 0; fret < N_FRETS; ++fret) {
      host_set(host, "partials", (float)((string + fret) % 3));
      const ToneError error = play(host, rate_hz, string, fret);
      if (!(error.cents <= MOST_CENTS) || !(error.decay <= MOST_DECAY_ERROR)) {
        print_message("string %u, fret %u: %.6f cents, decay off by %.5f %%\n", string + 1, fret,
                      error.cents, 100.0 * error.decay);
      }
      worst = strings_worse(worst, error);
    }
  }
  print_message("%g Hz: worst %.6f cents, worst decay %.6f %%\n", rate_hz, worst.cents,
                100.0 * worst.decay);
  assert_true(worst.cents <= MOST_CENTS);
  assert_true(worst.decay <= MOST_DECAY_ERROR);
  host_free(host);
}

int main(void) {
  struct CMUnitTest tests[sizeof(rates_hz) / sizeof(rates_hz[0])];
  double rates[sizeof(rates_hz) / sizeof(rates_hz[0])];
  for (size_t i = 0; i < sizeof(rates_hz) / sizeof(rates_hz[0]); ++i) {
    rates[i] = rates_hz[i];
    tests[i] = (struct CMUnitTest)cmocka_unit_test_prestate(every_string_is_in_tune_at_every_fret,
                                                            &rates[i]);
  }
  return cmocka_run_group_tests(tests, NULL, NULL);
}
