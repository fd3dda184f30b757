/* Harmonics of the guitar are pure and in tune, and so is what has slid, bent or swung to where it
 * ends; all heard through the host. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256, N_STRINGS = 6, CC_VIBRATO = 1 };

static const double PI = 3.14159265358979323846;
static const double complex J = (double complex)I;

static const uint32_t open_notes[N_STRINGS] = {64, 59, 55, 50, 45, 40};

/* What the instrument promises of pitch, of a string's first partial. */
static const double MOST_CENTS = 0.005;

static const double TOUCH_PERIODS = 20.0;
/* Of a window of cos⁴, that is 130 dB down 16 bins away. */
static const double WINDOW_PERIODS = 16.0;
static const double HIGHEST_HZ = 5000.0;

static Tone asked_of(const Host* host, uint32_t string, double fret) {
  const double octaves = ((double)open_notes[string] + fret - 69.0) / 12.0;
  return (Tone){(double)host_get(host, "tuning") * exp2(octaves),
                1.0 / ((double)host_get(host, "damping") *
                       exp2((double)host_get(host, "tracking") * octaves))};
}

/* Level of a frequency [dB]. */
static double level_of(const Sound* sound, size_t start, size_t length, double f_hz) {
  double complex sum = 0.0;
  for (size_t i = 0; i < length; ++i) {
    const double bell = sin(PI * ((double)i + 0.5) / (double)length);
    sum += bell * bell * bell * bell * (double)sound->left[start + i] *
           cexp(-J * (2.0 * PI * f_hz * (double)i / RATE));
  }
  return 20.0 * log10(cabs(sum) / (0.1875 * (double)length) + 1e-12);
}

/* By how much the loudest partial with a node at 1/m is over the loudest without [dB]. */
static double purity_of(const Sound* sound, size_t start, double f0_hz, uint32_t m) {
  const size_t length = (size_t)(WINDOW_PERIODS * RATE / f0_hz);
  double with = -HUGE_VAL;
  double without = -HUGE_VAL;
  for (uint32_t k = 1; k * f0_hz < HIGHEST_HZ; ++k) {
    const double level = level_of(sound, start, length, k * f0_hz);
    *(k % m == 0 ? &with : &without) = fmax(k % m == 0 ? with : without, level);
  }
  return with - without;
}

/* How pure the worst harmonic is, and how far the worst is from its pitch. */
typedef struct {
  double db;
  double cents;
} Purity;

static void hear_harmonic(Host* host, uint32_t string, double fret, uint32_t m, Purity* worst) {
  const Tone asked = asked_of(host, string, fret);
  const size_t start = (size_t)((TOUCH_PERIODS / asked.f0_hz + 0.001) * RATE);
  Sound sound = sound_new(start + RATE);
  Tone heard = {0};
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  const double db = purity_of(&sound, start, asked.f0_hz, m);
  const Tone near = {m * asked.f0_hz, asked.tau_s};
  assert_true(measure_tone(sound.left + start, RATE, RATE, near, &heard));
  const double cents = fabs(measure_cents(heard.f0_hz, near.f0_hz));
  if (db < 40.0 || cents > 0.05) {
    print_message("string %u fret %g at 1/%u: %g dB, %g cents\n", string + 1, fret, m, db, cents);
  }
  worst->db = fmin(worst->db, db);
  worst->cents = fmax(worst->cents, cents);
  sound_free(&sound);
}

/* One pickup, and a place of the pluck, where no partial of use has a node. */
static Host* open_touched(void) {
  Host* const host = guitar_open(RATE, BLOCK);
  strings_set(host, "pickup", 0.1);
  strings_set(host, "blend", 0.0);
  strings_set(host, "hardness", 0.8);
  strings_set(host, "mode", 1.0);
  return host;
}

static void assert_pure(Purity worst) {
  assert_within("least that it is over the others [-dB]", -worst.db, -40.0);
  assert_within("off its pitch [cents]", worst.cents, 0.05);
}

static void touched_strings_ring_in_harmonics(void** state) {
  Purity worst = {HUGE_VAL, 0.0};
  (void)state;
  Host* const host = open_touched();
  for (uint32_t i = 0; i < 3 * N_STRINGS; ++i) {
    const uint32_t string = i % N_STRINGS;
    const uint32_t m = 2 + i / N_STRINGS;
    const double touch_s = TOUCH_PERIODS / asked_of(host, string, 0.0).f0_hz;
    strings_restart(host);
    guitar_send(host, 0, (GuitarEvent){GUITAR_TOUCH, string, {1.0f / (float)m, (float)touch_s}});
    guitar_send(host, 0, (GuitarEvent){GUITAR_PLUCK, string, {1.0f, NAN, NAN}});
    hear_harmonic(host, string, 0.0, m, &worst);
  }
  assert_pure(worst);
  host_free(host);
}

static void the_port_touches_every_note(void** state) {
  static const uint32_t frets[] = {0, 4};
  Purity worst = {HUGE_VAL, 0.0};
  (void)state;
  Host* const host = open_touched();
  for (uint32_t i = 0; i < 6 * N_STRINGS; ++i) {
    const uint32_t string = i % N_STRINGS;
    const uint32_t m = 2 + i / N_STRINGS % 3;
    const uint32_t fret = frets[i / (3 * N_STRINGS)];
    strings_set(host, "harmonic", m - 1.0);
    strings_restart(host);
    strings_midi(host, 0, 0x90 | string, open_notes[string] + fret, 110);
    hear_harmonic(host, string, fret, m, &worst);
  }
  assert_pure(worst);
  host_free(host);
}

/* Ways from one pitch to another. */
typedef enum { FINGER, SLIDE, BEND, WHEEL, VIBRATO, WHEEL_AND_SLIDE, N_WAYS } Way;

/* Set out from fret 3 on a string that rings, get there by frame RATE / 2; where to, in frets. */
static double go(Host* host, Way way, uint32_t string, uint32_t channel) {
  const int turn = string % 2 ? 1 : -1;
  const unsigned wheel = turn > 0 ? 12288 : 0; /* A semitone up, or two down */
  const double bent = turn > 0 ? 1.0 : -2.0;
  const float fret = 3.0f + 5.5f * (float)turn;
  if (way == SLIDE || way == WHEEL_AND_SLIDE) {
    guitar_send(host, 9600, (GuitarEvent){GUITAR_SLIDE, string, {fret, 0.23f}});
  }
  if (way == FINGER) {
    guitar_send(host, 9600, (GuitarEvent){GUITAR_FRET, string, {fret}});
  }
  if (way == BEND) {
    guitar_send(host, 9600, (GuitarEvent){GUITAR_BEND, string, {1.7f * (float)turn, 0.2f}});
  }
  if (way == WHEEL || way == WHEEL_AND_SLIDE) {
    for (unsigned i = 0; i <= 32; ++i) {
      const unsigned value = (8192 * (32 - i) + wheel * i) / 32;
      strings_midi(host, 9600 + 211 * i, 0xE0 | channel, value & 127, value >> 7);
    }
  }
  if (way == VIBRATO) {
    strings_midi(host, 9600, 0xB0 | channel, CC_VIBRATO, 127);
    strings_midi(host, 22000 + 77 * string, 0xB0 | channel, CC_VIBRATO, 0);
  }
  const double by_wheel = way == WHEEL || way == WHEEL_AND_SLIDE ? bent : 0.0;
  const bool has_slid = way == FINGER || way == SLIDE || way == WHEEL_AND_SLIDE;
  const double slid = has_slid ? (double)fret : 3.0;
  return slid + by_wheel + (way == BEND ? (double)(1.7f * (float)turn) : 0.0);
}

static void ways_end_in_tune(void** state) {
  static const char* const names[N_WAYS] = {"finger", "slide",   "bend",
                                            "wheel",  "vibrato", "wheel and slide"};
  ToneError worst = {0};
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  Sound sound = sound_new(2 * RATE);
  guitar_set_plain(host);
  for (uint32_t i = 0; i < 2 * N_STRINGS * N_WAYS; ++i) {
    const Way way = (Way)(i / 2 / N_STRINGS);
    const uint32_t string = i / 2 % N_STRINGS;
    const uint32_t channel = i % 2 ? string : 0;
    strings_set(host, "mode", i % 2);
    strings_restart(host);
    guitar_send(host, 0, (GuitarEvent){GUITAR_FRET, string, {3.0f}});
    guitar_send(host, 0, (GuitarEvent){GUITAR_PLUCK, string, {1.0f, NAN, NAN}});
    const double fret = go(host, way, string, channel);
    const Tone asked = asked_of(host, string, fret);
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    const ToneError error = strings_measure(&sound, RATE, RATE / 2 + 1200, 2 * RATE, asked);
    if (!(error.cents <= MOST_CENTS)) {
      print_message("%s, string %u: %g cents\n", names[way], string + 1, error.cents);
    }
    worst = strings_worse(worst, error);
  }
  assert_within("pitch where they end [cents]", worst.cents, MOST_CENTS);
  sound_free(&sound);
  host_free(host);
}

/* The coefficients move in pieces of 64 frames; in straight lines, for stairs would hum at 750 Hz
 * and as far from it as the pitch is.  Heard on a low string so dark that nothing else is there. */
static void slides_do_not_hum(void** state) {
  enum { START = RATE, LENGTH = 9600 };
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  Sound sound = sound_new(START + LENGTH);
  guitar_set_plain(host);
  strings_set(host, "loss", 1.0);
  strings_set(host, "damping", 2.0);
  strings_set(host, "hardness", 0.0);
  guitar_send(host, 0, (GuitarEvent){GUITAR_PLUCK, 5, {1.0f, NAN, NAN}});
  guitar_send(host, START, (GuitarEvent){GUITAR_SLIDE, 5, {12.0f, (float)LENGTH / RATE}});
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  double tone = -HUGE_VAL;
  double hum = -HUGE_VAL;
  for (double f_hz = 80.0; f_hz < 170.0; f_hz += 5.0) {
    tone = fmax(tone, level_of(&sound, START, LENGTH, f_hz));
    hum = fmax(hum, level_of(&sound, START, LENGTH, 750.0 - f_hz));
    hum = fmax(hum, level_of(&sound, START, LENGTH, 750.0 + f_hz));
  }
  assert_within("hum, of the tone [dB]", hum - tone, -110.0);
  sound_free(&sound);
  host_free(host);
}

/* A hand that bends by nothing on the way leaves the swing where it is. */
static void a_vibrato_swings_on(void** state) {
  (void)state;
  Sound sounds[2] = {sound_new(RATE / 2), sound_new(RATE / 2)};
  double off = 0.0;
  for (size_t i = 0; i < 2; ++i) {
    Host* const host = guitar_open(RATE, BLOCK);
    guitar_set_plain(host);
    guitar_send(host, 0, (GuitarEvent){GUITAR_PLUCK, 4, {1.0f, NAN, NAN}});
    guitar_send(host, 4800, (GuitarEvent){GUITAR_VIBRATO, 4, {0.5f, 5.0f}});
    for (size_t at = 6000; i > 0 && at < RATE / 2; at += 1999) {
      guitar_send(host, at, (GuitarEvent){GUITAR_BEND, 4, {0.0f, 0.0f}});
    }
    strings_run(host, &sounds[i], 0, RATE / 2, BLOCK);
    host_free(host);
  }
  for (size_t i = 0; i < RATE / 2; ++i) {
    off = fmax(off, fabs((double)sounds[0].left[i] - (double)sounds[1].left[i]));
  }
  /* Its sine is cut into straight lines elsewhere. */
  assert_within("difference, of the peak", off / measure_peak(sounds[0].left, RATE / 2), 0.001);
  sound_free(&sounds[0]);
  sound_free(&sounds[1]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(touched_strings_ring_in_harmonics),
      cmocka_unit_test(the_port_touches_every_note),
      cmocka_unit_test(ways_end_in_tune),
      cmocka_unit_test(slides_do_not_hum),
      cmocka_unit_test(a_vibrato_swings_on),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
