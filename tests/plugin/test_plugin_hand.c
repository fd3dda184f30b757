/* What the hand makes of a note: a pull that is let go, brighter when it is harder, and alike when
 * it is repeated. */
#include "tests/support/guitar_host.h"
#include "tests/support/loudness.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/strings_host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 512, PLUCK = 0, STRIKE = 1, MOST_PARTIALS = 40 };

static const double PI = 3.14159265358979323846;

static double f0_of(uint32_t key) {
  return 440.0 * exp2((key - 69.0) / 12.0);
}

static Sound play(Host* host, uint32_t key, uint32_t velocity, size_t n_frames) {
  Sound sound = sound_new(n_frames);
  strings_restart(host);
  strings_note_on(host, 0, key, velocity);
  strings_run(host, &sound, 0, n_frames, BLOCK);
  return sound;
}

/* sin(kπp)/k² in displacement, /k in velocity and at the bridge; of velocity and displacement times
 * sin(kπq), q the pickup. */
static void a_pluck_is_that_of_a_string_pulled_aside(void** state) {
  (void)state;
  static const double p = 0.17, q = 0.23;
  Host* const host = strings_open(RATE, BLOCK);
  strings_set(host, "damping", 0.02);
  strings_set(host, "tracking", 0.0);
  strings_set(host, "loss", 1e-5);
  strings_set(host, "masses", 512.0);
  strings_set(host, "hardness", 1.0);
  strings_set(host, "pluck", p);
  strings_set(host, "pickup", q);
  strings_set(host, "spread", 0.0);
  strings_set(host, "limiter", 0.0);
  for (int sense = 0; sense < 3; ++sense) {
    double worst = 0.0;
    strings_set(host, "sense", sense);
    /* The narrowest pick is two masses wide to each side, which low strings have more of. */
    for (uint32_t key = 28; key <= 52; key += 12) {
      Sound s = play(host, key, 127, 2 * RATE);
      const float* const from = s.left + RATE / 10;
      const double first = measure_near(from, RATE, RATE, f0_of(key)) / sin(PI * p) /
                           (sense < 2 ? sin(PI * q) : 1.0);
      for (int k = 2; k <= 12; ++k) {
        const double told = fabs(sin(PI * k * p) * (sense < 2 ? sin(PI * k * q) : 1.0)) /
                            pow(k, sense == 0 ? 2.0 : 1.0);
        const double heard = measure_near(from, RATE, RATE, k * f0_of(key)) / first;
        /* Near a node a partial is as wrong as its neighbours are wide. */
        worst = told * pow(k, sense == 0 ? 2.0 : 1.0) > 0.2
                    ? fmax(worst, fabs(20.0 * log10(heard / told)))
                    : worst;
      }
      sound_free(&s);
    }
    print_message("sense %d\n", sense);
    assert_within("  partials [dB]", worst, 0.5);
  }
  host_free(host);
}

/* Energy above five fundamentals, against that below [dB]. */
static double brightness(Host* host, uint32_t key, uint32_t velocity) {
  Sound s = play(host, key, velocity, RATE * 3 / 10);
  double low = 0.0;
  double high = 0.0;
  for (int k = 1; k <= MOST_PARTIALS && k * f0_of(key) < 0.45 * RATE; ++k) {
    const double a = measure_near(s.left, s.n_frames, RATE, k * f0_of(key));
    *(k <= 5 ? &low : &high) += a * a;
  }
  sound_free(&s);
  return 10.0 * log10(high / low);
}

static double least_brighter(Host* host, double hardness) {
  double least = HUGE_VAL;
  strings_set(host, "hardness", hardness);
  for (uint32_t key = 33; key <= 81; key += getenv("HOOKE_TEST_LONG") ? 3 : 12) {
    const double soft = brightness(host, key, 20);
    const double middle = brightness(host, key, 70);
    const double hard = brightness(host, key, 127);
    assert_true(soft < middle && middle < hard + 0.3);
    least = fmin(least, hard - soft);
  }
  return least;
}

static void harder_is_brighter(void** state) {
  (void)state;
  for (int exciter = PLUCK; exciter <= STRIKE; ++exciter) {
    Host* const host = strings_open(RATE, BLOCK);
    double least = HUGE_VAL;
    strings_set(host, "exciter", exciter);
    strings_set(host, "sense", 2.0);
    strings_set(host, "loss", 0.003);
    strings_set(host, "limiter", 0.0);
    for (int h = 1; h <= 9; h += 4) {
      const double db = least_brighter(host, 0.1 * h);
      print_message("  %s, hardness 0.%d: %.1f dB\n", exciter ? "strike" : "pluck", h, db);
      least = fmin(least, db);
    }
    /* What differs from note to note is as soft. */
    strings_set(host, "hardness", 0.5);
    strings_set(host, "variation", 0.3);
    const double varied = brightness(host, 45, 127) - brightness(host, 45, 20);
    print_message("  varied: %.1f dB\n", varied);
    assert_true(fmin(least, varied) >= (exciter == STRIKE ? 10.0 : 6.0));
    host_free(host);
  }
}

static void harder_is_brighter_on_the_guitar(void** state) {
  (void)state;
  Host* const host = guitar_open(RATE, BLOCK);
  double least = HUGE_VAL;
  strings_set(host, "loss", 0.003);
  strings_set(host, "limiter", 0.0);
  for (int h = 2; h <= 8; h += 3) {
    strings_set(host, "hardness", 0.1 * h);
    for (uint32_t key = 40; key <= 76; key += 12) {
      const double db = brightness(host, key, 127) - brightness(host, key, 20);
      print_message("  hardness 0.%d, key %u: %.1f dB\n", h, key, db);
      least = fmin(least, db);
    }
  }
  assert_true(least >= 6.0);
  host_free(host);
}

/* Repeated on what rings, at any moment of its period: as loud as from rest, but for what the wood
 * still rings of the last. */
static double spread_of_repeats(Host* host, uint32_t key) {
  static const size_t gaps[] = {4800, 7213, 9001, 12345, 20011};
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  for (int g = 0; g < 5; ++g) {
    Sound s = sound_new(gaps[g] + RATE / 2);
    strings_restart(host);
    strings_note_on(host, 0, key, 100);
    strings_note_on(host, gaps[g], key, 100);
    strings_run(host, &s, 0, s.n_frames, BLOCK);
    const double lufs = loudness_lufs(s.left + gaps[g], s.right + gaps[g], RATE / 2);
    least = fmin(least, lufs);
    most = fmax(most, lufs);
    sound_free(&s);
  }
  return most - least;
}

static void repeats_are_alike(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  double worst[] = {0.0, 0.0};
  for (uint32_t p = 0; p < host_n_presets(host); ++p) {
    assert_true(host_preset(host, host_preset_label(host, p)));
    if (host_get(host, "exciter") == 0.0f && host_get(host, "resonance") == 0.0f) {
      double* const of_kind = &worst[host_get(host, "body") > 0.0f];
      for (uint32_t key = 45; key <= 81; key += 12) {
        *of_kind = fmax(*of_kind, spread_of_repeats(host, key));
      }
    }
  }
  assert_within("dB between repeats", worst[0], 1.0);
  assert_within("dB between repeats, with a body", worst[1], 2.0);
  host_free(host);
}

/* Nothing steps where a note begins, from rest or on what rings. */
static void a_pluck_begins_without_a_step(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  double worst = 0.0;
  strings_set(host, "limiter", 0.0);
  for (int sense = 0; sense < 3; ++sense) {
    strings_set(host, "sense", sense);
    for (uint32_t key = 28; key <= 88; key += 12) {
      enum { AGAIN = 9001, N = 24000 };
      Sound s = sound_new(N);
      strings_restart(host);
      strings_note_on(host, 100, key, 127);
      strings_note_on(host, AGAIN, key, 127);
      strings_run(host, &s, 0, N, BLOCK);
      double steps[2] = {0.0};
      for (size_t i = 1; i < N; ++i) {
        const bool is_start = (i >= 100 && i < 104) || (i >= AGAIN && i < AGAIN + 4);
        const double step = fabs((double)s.left[i] - (double)s.left[i - 1]);
        steps[is_start] = fmax(steps[is_start], step);
      }
      assert_true(s.left[99] == 0.0f && s.left[101] != 0.0f);
      worst = fmax(worst, steps[1] / steps[0]);
      sound_free(&s);
    }
  }
  assert_within("steps as a note begins, of the largest later", worst, 1.0);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_pluck_is_that_of_a_string_pulled_aside),
      cmocka_unit_test(harder_is_brighter),
      cmocka_unit_test(harder_is_brighter_on_the_guitar),
      cmocka_unit_test(repeats_are_alike),
      cmocka_unit_test(a_pluck_begins_without_a_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
