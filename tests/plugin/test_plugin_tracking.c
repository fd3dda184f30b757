/* What follows the key, heard: one set of ports has the stiffness and the decay of a grand from its
 * lowest strings to its highest, all of them in tune, and its dampers too. */
#include "tests/support/guitar_host.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 512 };

/* Of a grand, by its key: B, and seconds that the fundamental takes to fall by 60 dB. */
typedef struct {
  uint32_t key;
  double value;
} OfKey;

static const OfKey stiffness[2] = {{45, 1.1e-4}, {87, 3e-3}};
static const OfKey t60_s[2] = {{33, 13.0}, {93, 0.6}};

/* B is a small difference of partials, and so high a string has few masses: its sixth partial is a
 * cent flat. */
static const double MOST_STIFFNESS_ERROR = 0.03;
static const double MOST_T60_ERROR = 0.02;

/* Octaves that a value goes up in an octave between two keys, and where it is at A4. */
static double tracking_of(const OfKey at[2]) {
  return log2(at[1].value / at[0].value) * 12.0 / ((double)at[1].key - (double)at[0].key);
}

static double at_a4(const OfKey at[2]) {
  return at[0].value * exp2(tracking_of(at) * (69.0 - (double)at[0].key) / 12.0);
}

static void set_grand(Host* host) {
  strings_set(host, "stiffness", at_a4(stiffness));
  strings_set(host, "stiffness_tracking", tracking_of(stiffness));
  strings_set(host, "damping", log(1000.0) / at_a4(t60_s));
  strings_set(host, "tracking", -tracking_of(t60_s));
  strings_set(host, "loss", 1e-4);
  strings_set(host, "limiter", 0.0);
}

static Host* open_strings(void) {
  Host* const host = strings_open(RATE, BLOCK);
  strings_set_plain(host);
  set_grand(host);
  return host;
}

static Host* open_guitar(void) {
  Host* const host = guitar_open(RATE, BLOCK);
  guitar_set_plain(host);
  set_grand(host);
  return host;
}

/* From rest. */
static Sound play(Host* host, uint32_t key, double seconds) {
  Sound sound = sound_new((size_t)(seconds * RATE));
  strings_restart(host);
  strings_note_on(host, 0, key, 127);
  strings_run(host, &sound, 0, sound.n_frames, BLOCK);
  return sound;
}

static Tone partial_of(const Sound* sound, Tone near, double f0_hz) {
  const size_t skip = (size_t)(0.05 * RATE);
  Tone heard = {0};
  assert_true(
      measure_partial(sound->left + skip, sound->n_frames - skip, RATE, near, 0.5 * f0_hz, &heard));
  return heard;
}

/* B by which partial `k` is heard above k times the fundamental: with r = f_k/(k f_1), r² (1 + B) =
 * 1 + B k². */
static double heard_stiffness(Host* host, uint32_t key, double wanted, uint32_t k) {
  const Tone tone = strings_tone(host, key, 0.0);
  const double near_hz = k * tone.f0_hz * sqrt((1.0 + wanted * k * k) / (1.0 + wanted));
  Sound sound = play(host, key, 3.0);
  const double first_hz = partial_of(&sound, tone, tone.f0_hz).f0_hz;
  const double heard_hz = partial_of(&sound, (Tone){near_hz, tone.tau_s}, tone.f0_hz).f0_hz;
  const double r = heard_hz / (k * first_hz);
  sound_free(&sound);
  return (r * r - 1.0) / (k * k - r * r);
}

static void one_set_of_ports_is_as_stiff_as_a_grand(void** state) {
  static const uint32_t partials[] = {3, 5, 6};
  (void)state;
  double worst = 0.0;
  Host* const host = open_strings();
  for (int end = 0; end < 2; ++end) {
    const double wanted = stiffness[end].value;
    for (size_t i = 0; i < sizeof(partials) / sizeof(partials[0]); ++i) {
      const double heard = heard_stiffness(host, stiffness[end].key, wanted, partials[i]);
      print_message("key %u: B %g\n", stiffness[end].key, heard);
      worst = fmax(worst, fabs(heard / wanted - 1.0));
    }
  }
  assert_within("B, relative", worst, MOST_STIFFNESS_ERROR);
  host_free(host);
}

static void and_dies_as_a_grand_does(void** state) {
  (void)state;
  double worst = 0.0;
  Host* const host = open_strings();
  for (int end = 0; end < 2; ++end) {
    const uint32_t key = t60_s[end].key;
    const Tone tone = strings_tone(host, key, 0.0);
    Sound sound = play(host, key, fmin(6.0, 0.6 * t60_s[end].value));
    const double heard_s = log(1000.0) * partial_of(&sound, tone, 2.0 * tone.f0_hz).tau_s;
    print_message("key %u: T60 %g s\n", key, heard_s);
    worst = fmax(worst, fabs(heard_s / t60_s[end].value - 1.0));
    sound_free(&sound);
  }
  assert_within("T60, relative", worst, MOST_T60_ERROR);
  host_free(host);
}

static double seconds_of(Tone tone) {
  return fmin(fmax(6.0 * tone.tau_s, 40.0 / tone.f0_hz), 5.0);
}

/* What each key is to be: the formulas of the manual, to the instrument's own bounds; the loss is
 * taken to either end of its range. */
static ToneError check_keys(Host* host, uint32_t lowest, uint32_t highest) {
  ToneError worst = {0};
  for (uint32_t key = lowest; key <= highest; key += 7) {
    const Tone asked = strings_tone(host, key, 0.0);
    strings_set(host, "loss", 0.05);
    strings_set(host, "loss_tracking", key % 2 ? 4.0 : -2.0);
    Sound sound = play(host, key, seconds_of(asked));
    const size_t skip = (size_t)(2.0 * RATE / asked.f0_hz);
    worst = strings_worse(worst, strings_measure(&sound, RATE, skip, sound.n_frames, asked));
    sound_free(&sound);
  }
  return worst;
}

static void every_key_has_its_pitch_and_its_decay(void** state) {
  (void)state;
  Host* const strings = open_strings();
  Host* const guitar = open_guitar();
  strings_assert_exact("strings", check_keys(strings, 24, 94));
  strings_assert_exact("guitar", check_keys(guitar, 40, 82));
  host_free(strings);
  host_free(guitar);
}

/* Let go after a fifth of a second. */
static ToneError check_release(Host* host, uint32_t lowest, uint32_t highest) {
  enum { OFF = RATE / 5, FROM = OFF + RATE / 50 };
  ToneError worst = {0};
  strings_set(host, "damping", 0.1);
  strings_set(host, "tracking", 0.0);
  strings_set(host, "release", 0.15);
  strings_set(host, "release_tracking", 0.8);
  for (uint32_t key = lowest; key <= highest; key += 6) {
    const Tone asked = strings_released_tone(host, key, 0.0);
    Sound sound = sound_new(FROM + (size_t)(6.0 * asked.tau_s * RATE));
    strings_restart(host);
    strings_note_on(host, 0, key, 127);
    strings_note_off(host, OFF, key);
    strings_run(host, &sound, 0, sound.n_frames, BLOCK);
    worst = strings_worse(worst, strings_measure(&sound, RATE, FROM, sound.n_frames, asked));
    sound_free(&sound);
  }
  return worst;
}

static void the_release_follows_the_key(void** state) {
  (void)state;
  Host* const strings = open_strings();
  Host* const guitar = open_guitar();
  strings_assert_exact("strings", check_release(strings, 33, 87));
  strings_assert_exact("guitar", check_release(guitar, 40, 82));
  host_free(strings);
  host_free(guitar);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_set_of_ports_is_as_stiff_as_a_grand),
      cmocka_unit_test(and_dies_as_a_grand_does),
      cmocka_unit_test(every_key_has_its_pitch_and_its_decay),
      cmocka_unit_test(the_release_follows_the_key),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
