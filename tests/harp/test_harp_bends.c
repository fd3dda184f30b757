/* A string that has all the masses that it can hold is bent past what they can hold, and back. */
#include "core/harp/harp.h"

#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/settings.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { MOST_FRAMES = 200000, N_LEGS = 4, REACH = 96 };

/* How much more of it a move may have than there is without it: √2 for what beats, √2 for chance,
 * and 2 for how little a string that was pulled aside has there, a sixteenth of what a push leaves.
 */
static const double MOST_BURST = 4.5;

/* Bends one after another [semitones]; the last is back. */
typedef struct {
  double semitones[N_LEGS];
} Way;

static const Way ways[] = {
    {{2.0, -2.0, 1.0, 0.0}},    {{12.0, 0.0, -12.0, 0.0}}, {{24.0, 0.0, 24.0, 0.0}},
    {{-24.0, 0.0, -24.0, 0.0}}, {{7.0, 24.0, -24.0, 0.0}},
};

typedef struct {
  double rate_hz;
  uint32_t key;
  double stiffness;
  double loss;
  Partials partials;
} String;

static const String strings[] = {
    {48e3, 28, 0.0, 1e-3, PARTIALS_TRUE},   {48e3, 40, 1e-4, 1e-2, PARTIALS_TRUE},
    {48e3, 45, 0.0, 1e-5, PARTIALS_LUMPED}, {96e3, 52, 0.0, 1e-2, PARTIALS_TRUEST},
    {192e3, 57, 1e-5, 0.1, PARTIALS_TRUE},  {44.1e3, 33, 1e-3, 1e-3, PARTIALS_TRUEST},
    {96e3, 45, 0.0, 1e-3, PARTIALS_TRUE},   {192e3, 64, 0.0, 1e-3, PARTIALS_LUMPED},
};

enum { N_STRINGS = sizeof(strings) / sizeof(strings[0]), N_WAYS = sizeof(ways) / sizeof(ways[0]) };

static float sound[MOST_FRAMES];
static float other[MOST_FRAMES];
static double high[MOST_FRAMES];

/* What a bend leaves alone. */
static double amplitude_of(const HarpString* string) {
  const double a1 = tuning_mode(string->voice.chain.now, string->voice.chain.n_masses, 1).a;
  return chain_amplitude(&string->voice.chain, a1);
}

static HarpPatch patch_of(const String* s) {
  Setting setting = settings_default();
  setting.value[SETTING_DAMPING] = 0.3;
  setting.value[SETTING_LOSS] = s->loss;
  setting.value[SETTING_PARTIALS] = s->partials;
  setting.value[SETTING_MASSES] = CHAIN_MAX_MASSES;
  setting.value[SETTING_PLUCK] = 0.4;
  setting.value[SETTING_HARDNESS] = 0.0;
  HarpPatch patch = settings_patch(&setting);
  patch.string.inharmonicity = s->stiffness;
  patch.pickup = 0.45;
  patch.spread = 0.0;
  return patch;
}

/* What a sound has above `f_hz`, by a windowed sinc; nothing within its reach of the ends. */
static void sieve(uint32_t n, double rate_hz, double f_hz) {
  double weight[2 * REACH + 1];
  const double cut = 2.0 * f_hz / rate_hz;
  for (int k = -REACH; k <= REACH; ++k) {
    const double window = 0.5 + 0.5 * cos(PI * k / (REACH + 1.0));
    const double low = k == 0 ? cut : sin(PI * cut * k) / (PI * k);
    weight[k + REACH] = (k == 0) - window * window * low;
  }
  for (uint32_t i = REACH; i + REACH < n; ++i) {
    high[i] = 0.0;
    for (uint32_t k = 0; k <= 2 * REACH; ++k) {
      high[i] += weight[k] * (double)sound[i + k - REACH];
    }
  }
}

static double largest(uint32_t from, uint32_t to) {
  double most = 0.0;
  for (uint32_t i = from; i < to; ++i) {
    most = fmax(most, fabs(high[i]));
  }
  return most;
}

typedef struct {
  double cents;
  double click; /* What the move has above the strong partials, over what there is without it */
  double gain;  /* Amplitude after, over before */
} Worst;

/* A move of `n_move` frames at frame `at` of `n`; a soft finger leaves next to nothing past the
 * 16th partial, and what is below −80 dB is no click. */
static double click(const String* s, double f0_hz, uint32_t at, uint32_t n_move) {
  const uint32_t n = at + 3 * n_move;
  sieve(n, s->rate_hz, 16.0 * f0_hz);
  const double before = largest(REACH, at - REACH);
  const double after = largest(at + n_move + REACH, n - REACH);
  const double own = fmax(fmax(before, after), 1e-4 * measure_peak(sound, at));
  return largest(at - REACH, at + n_move + REACH) / own;
}

static double pitch_hz(const String* s, double semitones) {
  return 440.0 * exp2((s->key - 69.0 + semitones) / 12.0);
}

/* Sound up to the bend, and after it for as long as it takes to measure it. */
static void bend(Harp* harp, const String* s, double from, double to, Worst* worst) {
  const HarpString* const string = &harp->strings[s->key];
  const Tone asked = {pitch_hz(s, to), 3.0};
  const uint32_t at = (uint32_t)(0.1 * s->rate_hz);
  const uint32_t n_move = (uint32_t)(0.02 * s->rate_hz);
  const uint32_t n_after = (uint32_t)(s->rate_hz * fmax(0.4, 24.0 / asked.f0_hz));
  Tone heard = {0};
  assert_true(at + n_after <= MOST_FRAMES);
  harp_run(harp, at, sound, other);
  const double before = amplitude_of(string);
  harp_bend(harp, 0, to);
  harp_run(harp, n_after, sound + at, other);
  assert_true(string->voice.is_awake && !string->voice.is_choked && string->lift == 1.0);
  assert_true(string->voice.headroom >= 1e-4 * (1.0 - 1e-9));
  const bool is_heard =
      measure_tone(sound + at + n_move, n_after - n_move, s->rate_hz, asked, &heard);
  const double cents = is_heard ? fabs(measure_cents(heard.f0_hz, asked.f0_hz)) : HUGE_VAL;
  const double gain = amplitude_of(string) / before;
  worst->cents = fmax(worst->cents, cents);
  worst->gain = fmax(worst->gain, gain);
  worst->click = fmax(worst->click, click(s, fmax(asked.f0_hz, pitch_hz(s, from)), at, n_move));
}

static void bends_are_in_tune_and_do_not_click(void** state) {
  (void)state;
  Worst worst = {0};
  for (int s = 0; s < N_STRINGS; ++s) {
    Harp* const harp = harp_new(strings[s].rate_hz);
    assert_non_null(harp);
    const HarpPatch patch = patch_of(&strings[s]);
    harp_set_patch(harp, &patch, 0);
    for (int w = 0; w < N_WAYS; ++w) {
      harp_reset(harp);
      harp_note_on(harp, 0, strings[s].key, 127);
      double at = 0.0;
      for (int leg = 0; leg < N_LEGS; ++leg) {
        bend(harp, &strings[s], at, ways[w].semitones[leg], &worst);
        at = ways[w].semitones[leg];
      }
    }
    harp_free(harp);
  }
  assert_within("cents", worst.cents, 0.05);
  assert_within("burst, over the string's own", worst.click, MOST_BURST);
  /* The measure is that of the fundamental: what the partials do in it comes and goes. */
  assert_within("amplitude, over what it was", worst.gain, 1.25);
}

/* The measure finds a step of a hundredth of the loudest sample. */
static void a_click_is_found(void** state) {
  (void)state;
  const String* const s = &strings[2];
  const HarpPatch patch = patch_of(s);
  const uint32_t at = (uint32_t)(0.1 * s->rate_hz);
  const uint32_t n_move = (uint32_t)(0.02 * s->rate_hz);
  Harp* const harp = harp_new(s->rate_hz);
  assert_non_null(harp);
  harp_set_patch(harp, &patch, 0);
  harp_note_on(harp, 0, s->key, 127);
  harp_run(harp, at + 3 * n_move, sound, other);
  harp_free(harp);
  const double without = click(s, pitch_hz(s, 0.0), at, n_move);
  const float step = (float)(0.01 * measure_peak(sound, at));
  for (uint32_t i = at + n_move / 2; i < at + 3 * n_move; ++i) {
    sound[i] += step;
  }
  const double with = click(s, pitch_hz(s, 0.0), at, n_move);
  print_message("  burst of none %g, of a step %g\n", without, with);
  assert_true(without < MOST_BURST && with > 2.0 * MOST_BURST);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_click_is_found),
      cmocka_unit_test(bends_are_in_tune_and_do_not_click),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
