/* The amplitude does not change with a bend: a string that is bent slowly, by octaves, moves as far
 * as one that is left alone. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/plugins.h"
#include "tests/support/swings.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { RATE = 48000, STEP = 64, N_BEFORE = RATE, N_BEND = 2 * RATE, N_AFTER = RATE };
enum { KEY = 57, RANGE = 48, N_ALL = N_BEFORE + N_BEND + N_AFTER };

typedef struct {
  const char* what;
  int plugin;
  int exciter;
  double masses;
  double most_octaves; /* That it bends by */
  double most_db;
} Instrument;

/* Of one mass the peak is all there is to it; of many the partials come to lie otherwise on the
 * way, and may for a moment all be at their peak, so it is their root of the mean square that
 * stays. A bow goes on playing, at every pitch a little differently. */
static const Instrument instruments[] = {
    {"plucked", 0, 0, 1.0, 4.0, 0.05},        {"struck", 0, 1, 1.0, 4.0, 0.05},
    {"guitar", 1, 0, 1.0, 2.0, 0.05},         {"plucked, whole", 0, 0, 128.0, 4.0, 0.5},
    {"struck, whole", 0, 1, 128.0, 4.0, 0.5}, {"bowed, whole", 0, 2, 128.0, 4.0, 1.5},
    {"guitar, whole", 1, 0, 80.0, 2.0, 0.05},
};

static Host* open_held(const Instrument* instrument) {
  Host* const host = instrument->plugin ? guitar_open(RATE, STEP) : strings_open(RATE, STEP);
  if (instrument->plugin) {
    guitar_set_plain(host);
  } else {
    strings_set_plain(host);
    strings_set(host, "exciter", instrument->exciter);
  }
  strings_set(host, "masses", instrument->masses);
  strings_set(host, "limiter", 0.0);
  strings_set(host, "damping", 0.02);
  strings_set(host, "tracking", 0.0);
  strings_set(host, "loss", 1e-5);
  swings_set_range(host, RANGE);
  return host;
}

static void wheel_to(Host* host, double semitones) {
  const unsigned value = (unsigned)fmin(16383.0, round(8192.0 + 8192.0 * semitones / RANGE));
  strings_midi(host, 0, 0xE0, value & 0x7F, value >> 7);
}

/* How far it moves after it has been bent in a straight line [full scale]. */
static double swing_after(const Instrument* instrument, double octaves) {
  Sound sound = sound_new(N_ALL);
  Host* const host = open_held(instrument);
  strings_note_on(host, 0, KEY, 100);
  for (size_t at = 0; at < N_ALL; at += STEP) {
    const double way = fmin(1.0, fmax(0.0, ((double)at - N_BEFORE) / N_BEND));
    wheel_to(host, 12.0 * octaves * way);
    strings_run(host, &sound, at, at + STEP, STEP);
  }
  const float* const after = sound.left + N_BEFORE + N_BEND;
  const double swing =
      instrument->masses > 1.0 ? measure_rms(after, N_AFTER) : measure_peak(after, N_AFTER);
  host_free(host);
  sound_free(&sound);
  return swing;
}

static void amplitude_does_not_change_with_a_bend(void** state) {
  static const double octaves[] = {-4.0, -2.0, -1.0, 1.0, 2.0, 4.0};
  (void)state;
  for (size_t i = 0; i < sizeof(instruments) / sizeof(instruments[0]); ++i) {
    const Instrument* const instrument = &instruments[i];
    const double straight = swing_after(instrument, 0.0);
    double worst = 0.0;
    for (size_t o = 0; o < sizeof(octaves) / sizeof(octaves[0]); ++o) {
      if (fabs(octaves[o]) <= instrument->most_octaves) {
        const double db = 20.0 * log10(swing_after(instrument, octaves[o]) / straight);
        print_message("  %-14s %+2g octaves: %6.3f dB\n", instrument->what, octaves[o], db);
        worst = fmax(worst, fabs(db));
      }
    }
    assert_within(instrument->what, worst, instrument->most_db);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(amplitude_does_not_change_with_a_bend)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
