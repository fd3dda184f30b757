/* What a bowed string sounds like: Helmholtz's motion in tune, and its own once it is lifted. */
#include "core/excite/bow.h"

#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strung.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { MOST = 192000 * 7 };

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];
static float heard[MOST];

typedef struct {
  double slips;    /* A period, of those that it has */
  double cents;    /* Off: it is flat, as bowed strings are, which an ear makes good */
  double decibels; /* Of the fundamental, against Helmholtz's of the amplitude asked for */
} Bowed;

/* Where it is read, each fourth of its length has the fundamental by sin(π/4). */
static Bowed
bow_string(Strung* strung, Bow* bow, Stroke stroke, double from_s, double to_s, double* sines) {
  const size_t first = (size_t)(from_s * strung->rate_hz);
  const size_t last = (size_t)(to_s * strung->rate_hz);
  const uint32_t mass = strung->chain.n_masses / 4;
  double in_phase = 0.0;
  double across = 0.0;
  uint32_t n_slips = 0;
  BowState state = BOW_STICKS;
  bow_start(bow, &strung->chain, stroke, strung->angle1, strung->rate_hz);
  for (size_t i = 0; i < last; ++i) {
    heard[i] = strung_step(strung, mass);
    bow_act(bow, &strung->chain);
    n_slips += i >= first && state == BOW_STICKS && bow->state != BOW_STICKS;
    state = bow->state;
  }
  Tone tone = {0};
  const Tone near = {strung->f0_hz, 1e3};
  measure_tone(heard + first, last - first, strung->rate_hz, near, &tone);
  for (size_t i = first; i < last; ++i) {
    /* A Hann window, so that other partials do not count. */
    const double way = (double)(i - first) / (double)(last - first);
    const double weight = 1.0 - cos(2.0 * PI * way);
    const double angle = 2.0 * PI * tone.f0_hz / strung->rate_hz * (double)i;
    in_phase += weight * cos(angle) * (double)heard[i];
    across += weight * sin(angle) * (double)heard[i];
  }
  const double read = sin(PI * (mass + 1.0) / (strung->chain.n_masses + 1.0));
  *sines = 2.0 * hypot(in_phase, across) / (double)(last - first) / read;
  return (Bowed){
      .slips = n_slips / (tone.f0_hz * (to_s - from_s)),
      .cents = measure_cents(tone.f0_hz, strung->f0_hz),
      .decibels = 20.0 * log10(*sines / (8.0 / (PI * PI) * stroke.amplitude)),
  };
}

static void bowed_strings_move_as_helmholtz_said(void** state) {
  (void)state;
  static const double amplitudes[] = {0.25, 0.01};
  double worst_slips = 0.0;
  double worst_cents = 0.0;
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  for (uint32_t key = 33; key <= 84; key += 3) {
    for (uint32_t r = 0; r < STRUNG_N_RATES; ++r) {
      Strung strung;
      Bow bow = {0};
      double sines = 0.0;
      const double rate_hz = strung_rate_hz(r);
      strung_key(&strung, memory, key, rate_hz, 128, 2.0);
      const Stroke stroke = {0.13, 0.5, amplitudes[key % 2], 0.05, 0.05};
      const Bowed bowed = bow_string(&strung, &bow, stroke, 2.4, 3.0, &sines);
      print_message("%s%u %5.3f %+5.2fc %+4.1fdB", r == 0 ? "  " : " | ", key, bowed.slips,
                    bowed.cents, bowed.decibels);
      const double period = rate_hz / strung.f0_hz;
      if (period >= 30.0) {
        least = fmin(least, bowed.decibels);
        most = fmax(most, bowed.decibels);
      }
      if (period >= 75.0) {
        /* Counted in 0.6 s, of which one slip more or less is by chance in or out. */
        const double chance = 1.0 / (0.6 * strung.f0_hz);
        worst_slips = fmax(worst_slips, fabs(bowed.slips - 1.0) - chance);
        worst_cents = fmax(worst_cents, fabs(bowed.cents));
      }
    }
    print_message("\n");
  }
  assert_within("slips a period, off one", worst_slips, 1e-3);
  assert_within("cents", worst_cents, 10.0);
  assert_within("dB too soft", -least, 1.0);
  assert_within("dB too loud", most, 1.0);
}

/* What the string does in its last quarter of a second, of one that is bowed for a second. */
typedef struct {
  double share;    /* Of the time, that it slips, of β */
  double aside;    /* How far the bow holds it aside at its place, of the amplitude asked for */
  double partials; /* k² X_k/X_1 of Helmholtz's, the worst off to 12, but for
                      those that have a node at the bow, or less than eight frames a period [dB] */
} Motions;

enum { PARTIALS = 12 };

static double sine_at(const Strung* strung, uint32_t k, uint32_t i) {
  return sin(PI * k * (i + 1.0) / (strung->chain.n_masses + 1.0));
}

static Motions motions_of(Strung* strung, double beta) {
  const size_t n_all = (size_t)strung->rate_hz;
  const size_t first = n_all - n_all / 4;
  const uint32_t n = strung->chain.n_masses;
  const uint32_t at = (uint32_t)(beta * (n + 1.0)) - 1;
  double sums[PARTIALS] = {0.0};
  double squares[PARTIALS] = {0.0};
  double aside = 0.0;
  double slips = 0.0;
  Bow bow = {0};
  bow_start(&bow, &strung->chain, (Stroke){beta, 0.5, 0.25, 0.04, 0.03}, strung->angle1,
            strung->rate_hz);
  for (size_t frame = 0; frame < n_all; ++frame) {
    strung_step(strung, 0);
    bow_act(&bow, &strung->chain);
    if (frame >= first) {
      slips += bow.state == BOW_STICKS ? 0.0 : 1.0;
      aside += (double)chain_position(&strung->chain, at);
      for (uint32_t k = 1; k <= PARTIALS; ++k) {
        double x = 0.0;
        for (uint32_t i = 0; i < n; ++i) {
          x += sine_at(strung, k, i) * (double)chain_position(&strung->chain, i);
        }
        sums[k - 1] += x;
        squares[k - 1] += x * x;
      }
    }
  }
  const double n_heard = (double)(n_all - first);
  Motions motions = {slips / n_heard / beta, aside / n_heard / 0.25, 0.0};
  double powers[PARTIALS];
  for (uint32_t k = 1; k <= PARTIALS; ++k) {
    powers[k - 1] = squares[k - 1] / n_heard - pow(sums[k - 1] / n_heard, 2.0);
    const double off = 10.0 * log10(powers[k - 1] / powers[0]) + 40.0 * log10(k);
    const bool is_node = fabs(sin(PI * k * beta)) < 0.5;
    const bool is_high = k * strung->angle1 > 0.8;
    motions.partials = fmax(motions.partials, is_node || is_high ? 0.0 : fabs(off));
  }
  return motions;
}

static void slips_and_partials_are_helmholtzs(void** state) {
  (void)state;
  static const double betas[] = {0.08, 0.13, 0.17};
  double worst_share = 0.0;
  double worst_partial = 0.0;
  double most_aside = 0.0;
  for (uint32_t key = 33; key <= 81; key += 6) {
    for (uint32_t r = 1; r < 4; ++r) {
      Strung strung;
      const double beta = betas[(key / 6 + r) % 3];
      strung_key(&strung, memory, key, strung_rate_hz(r), 128, 2.0);
      const Motions motions = motions_of(&strung, beta);
      worst_share = fmax(worst_share, fabs(motions.share - 1.0));
      worst_partial = fmax(worst_partial, motions.partials);
      most_aside = fmax(most_aside, fabs(motions.aside));
    }
  }
  assert_within("time that it slips, off", worst_share, 0.2);
  assert_within("dB of partials to the twelfth", worst_partial, 3.0);
  assert_within("held aside, of the amplitude", most_aside, 0.4);
}

static double largest_bend(const float* samples, size_t n) {
  double most = 0.0;
  for (size_t i = 2; i < n; ++i) {
    most = fmax(most, fabs((double)(samples[i] - 2.0f * samples[i - 1] + samples[i - 2])));
  }
  return most;
}

static void lifted_strings_ring_on_as_they_are(void** state) {
  (void)state;
  static const uint32_t keys[] = {33, 48, 60, 72};
  double worst_cents = 0.0;
  double worst_decay = 0.0;
  double worst_click = 0.0;
  double worst_swell = 0.0;
  for (size_t k = 0; k < 4; ++k) {
    Strung strung;
    Bow bow = {0};
    Tone tone;
    double early = 0.0;
    const size_t n = (size_t)(5.0 * 48000.0);
    const size_t rest = (size_t)(2.0 * 48000.0);
    strung_key(&strung, memory, keys[k], 48000.0, 128, 0.8);
    const Stroke stroke = {0.13, 0.5, 0.25, 0.05, 0.05};
    bow_string(&strung, &bow, stroke, 4.0, 5.0, &early);
    worst_swell = fmax(worst_swell, fabs(20.0 * log10(measure_rms(heard + n - 24000, 24000) /
                                                      measure_rms(heard + 48000, 24000))));
    const double bowed = largest_bend(heard + n / 2, n / 2);
    bow_lift(&bow);
    size_t lifted = 0;
    for (size_t i = n; i < n + rest; ++i) {
      heard[i] = strung_step(&strung, strung.chain.n_masses / 4);
      lifted = bow_act(&bow, &strung.chain) ? i + 1 : lifted;
    }
    assert_in_range(lifted - n, 2300, 2500);
    assert_true(bow.friction == 0.0 || !bow.is_active);
    worst_click = fmax(worst_click, largest_bend(heard + n - 2, rest) / bowed);
    const Tone near = {strung.f0_hz, 0.8};
    assert_true(measure_tone(heard + lifted, n + rest - lifted, 48000.0, near, &tone));
    worst_cents = fmax(worst_cents, fabs(measure_cents(tone.f0_hz, strung.f0_hz)));
    worst_decay = fmax(worst_decay, fabs(tone.tau_s / 0.8 - 1.0));
  }
  assert_within("cents after the lift", worst_cents, 0.005);
  assert_within("decay after the lift, relative", worst_decay, 2e-4);
  assert_within("corner of the lift, of the bowed string's", worst_click, 1.2);
  assert_within("dB from the first second to the fifth", worst_swell, 0.5);
}

static void attack_makes_no_click(void** state) {
  (void)state;
  Strung strung;
  Bow bow = {0};
  double sines = 0.0;
  strung_key(&strung, memory, 57, 48000.0, 128, 2.0);
  bow_string(&strung, &bow, (Stroke){0.13, 0.5, 0.25, 0.05, 0.05}, 0.6, 1.2, &sines);
  assert_within("corner of the first 10 ms, of the bowed string's",
                largest_bend(heard, 480) / largest_bend(heard + 28800, 28800), 0.3);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bowed_strings_move_as_helmholtz_said),
      cmocka_unit_test(slips_and_partials_are_helmholtzs),
      cmocka_unit_test(lifted_strings_ring_on_as_they_are),
      cmocka_unit_test(attack_makes_no_click),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
