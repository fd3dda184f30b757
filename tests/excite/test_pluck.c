#include "core/excite/pluck.h"

#include "tests/support/oracle.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* Half the width of a finger, soft or hard, as a fraction of the length; never under two masses. */
static const double SOFTEST = 0.3;
static const double HARDEST = 0.005;
static const double NARROWEST = 2.0;

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];
static float sink[1];

static void step(Chain* chain) {
  static const ChainTap tap = {{0, 0}, {0.0f, 0.0f}};
  float* const out[] = {sink};
  chain_run(chain, 1, &tap, 1, out);
}

/* An undamped string with as many masses as it can have, up to `limit`; the angle per step. */
static double string_up(Chain* chain, double rate_hz, double f0_hz, uint32_t limit) {
  const TuningTarget target = {.rate_hz = rate_hz, .tone = {f0_hz, HUGE_VAL}};
  StringCoefs coefs = {0};
  const uint32_t n_masses = tuning_max_masses(&target, limit);
  assert_int_equal(tuning_solve(&target, n_masses, &coefs), STATUS_OK);
  chain_init(chain, chain_kernel(0), memory, n_masses);
  chain_set(chain, coefs);
  return 2.0 * PI * f0_hz / rate_hz;
}

/* The fundamental's coordinate: the projection of all positions on its sine. */
static double fundamental(const Chain* chain) {
  const double length = chain->n_masses + 1.0;
  double sum = 0.0;
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    sum += 2.0 / length * sin(PI * (i + 1.0) / length) * (double)chain_position(chain, i);
  }
  return sum;
}

/* The amplitude with which the fundamental rings, fitted to `n` steps of known angle. */
static double ringing_amplitude(Chain* chain, double angle, int n) {
  double cc = 0.0;
  double ss = 0.0;
  double cs = 0.0;
  double qc = 0.0;
  double qs = 0.0;
  for (int i = 0; i < n; ++i) {
    const double q = fundamental(chain);
    const double c = cos(angle * i);
    const double s = sin(angle * i);
    cc += c * c;
    ss += s * s;
    cs += c * s;
    qc += q * c;
    qs += q * s;
    step(chain);
  }
  const double determinant = cc * ss - cs * cs;
  return hypot((qc * ss - qs * cs) / determinant, (qs * cc - qc * cs) / determinant);
}

/* What a finger of half-width w leaves of a sine that it is laid on: the transform of a raised
 * cosine. */
static double finger(double w) {
  return sin(PI * w) / (PI * w * (1.0 - w * w));
}

static double width_of(uint32_t n_masses, double softness) {
  return fmax(NARROWEST / (n_masses + 1.0), softness);
}

static void fundamental_is_that_of_the_ideal_string(void** state) {
  (void)state;
  static const uint32_t limits[] = {1, 2, 3, 7, 20, 80, 300, 1024};
  static const double rates_hz[] = {8000.0, 48000.0, 192000.0};
  double worst = 0.0;
  for (size_t l = 0; l < 8; ++l) {
    for (size_t r = 0; r < 3; ++r) {
      for (int is_hard = 0; is_hard < 2; ++is_hard) {
        for (int fifth = 0; fifth < 5; ++fifth) {
          const double place = 0.1 + 0.2 * fifth;
          Chain chain;
          const double f0_hz = limits[l] <= 20 ? 110.0 : 20.0;
          const double angle = string_up(&chain, rates_hz[r], f0_hz, limits[l]);
          const double w = width_of(chain.n_masses, is_hard ? HARDEST : SOFTEST);
          pluck_add(&chain, (Pluck){place, is_hard, 0.25}, angle);
          const double amplitude = ringing_amplitude(&chain, angle, (int)(2.0 * PI / angle));
          if (place > w && place < 1.0 - w) {
            const double ideal = 4.0 / PI * 0.25 * sin(PI * place) * finger(w);
            worst = fmax(worst, fabs(amplitude / ideal - 1.0));
          } else {
            /* A finger that a wall cuts short: still never more than the most there is. */
            assert_true(amplitude > 0.0 && amplitude <= 4.0 / PI * 0.25 * (1.0 + 1e-5));
          }
        }
      }
    }
  }
  /* Off the masses a finger two of them wide has its centre a little elsewhere. */
  assert_within("amplitude, relative", worst, 0.01);
}

static void softest_finger_costs_half_a_decibel(void** state) {
  (void)state;
  /* So "in its middle" holds to half a dB for all fingers that the walls leave whole. */
  assert_within("dB from 0.5", fabs(20.0 * log10(finger(SOFTEST)) + 0.5), 0.01);
  assert_within("dB of the hardest", -20.0 * log10(finger(HARDEST)), 0.001);
}

static void one_mass_is_plucked_wherever_one_plucks(void** state) {
  (void)state;
  for (int quarter = 0; quarter <= 4; ++quarter) {
    const double place = 0.25 * quarter;
    Chain chain;
    const double angle = string_up(&chain, 48000.0, 1000.0, 1);
    pluck_add(&chain, (Pluck){place, 0.5, 0.25}, angle);
    assert_within("amplitude, relative",
                  fabs(ringing_amplitude(&chain, angle, 480) / (4.0 / PI * 0.25) - 1.0), 1e-5);
  }
}

/* The highest partial that is within 20 dB of the strongest: what a wide finger takes away. */
static uint32_t brightness(double hardness) {
  enum { N = 200 };
  Chain chain;
  uint32_t highest = 0;
  double most = 0.0;
  double partials[N + 1];
  chain_init(&chain, chain_kernel(0), memory, N);
  pluck_add(&chain, (Pluck){0.37, hardness, 0.25}, 0.01);
  for (uint32_t k = 1; k <= N; ++k) {
    double sum = 0.0;
    for (uint32_t i = 0; i < N; ++i) {
      sum += sin(PI * k * (i + 1.0) / (N + 1.0)) * (double)chain_velocity(&chain, i);
    }
    partials[k] = fabs(sum);
    most = fmax(most, partials[k]);
  }
  for (uint32_t k = 1; k <= N; ++k) {
    highest = partials[k] > 0.1 * most ? k : highest;
  }
  return highest;
}

static void harder_is_brighter(void** state) {
  (void)state;
  uint32_t before = 0;
  for (int eighth = 0; eighth <= 8; ++eighth) {
    const uint32_t highest = brightness(0.125 * eighth);
    assert_true(highest >= before);
    before = highest;
  }
  /* A raised cosine of half-width w has its first zero at the partial 2/w. */
  assert_in_range(brightness(0.0), 2, (uintmax_t)(2.0 / SOFTEST));
  assert_in_range(brightness(1.0), 50, 200);
}

/* The pluck is a push that the masses can carry: next to nothing of the mode that only flips. */
static void flipping_mode_is_left_alone(void** state) {
  (void)state;
  for (uint32_t n = 20; n <= 1000; n *= 2) {
    for (int step = 0; step < 57; ++step) {
      const double place = 0.11 + 0.0137 * step;
      Chain chain;
      double sum = 0.0;
      double most = 0.0;
      chain_init(&chain, chain_kernel(0), memory, n);
      pluck_add(&chain, (Pluck){place, 1.0, 0.25}, 0.01);
      for (uint32_t i = 0; i < n; ++i) {
        sum += (i % 2 ? -1.0 : 1.0) * (double)chain_velocity(&chain, i);
        most += (double)chain_velocity(&chain, i);
      }
      if (0.005 * (n + 1.0) < NARROWEST) {
        assert_true(fabs(sum) < 1e-5 * most);
      }
    }
  }
}

static void ideal_string_peaks_at_the_amplitude(void** state) {
  (void)state;
  static const double hardnesses[] = {0.0, 0.5, 1.0};
  double highest = 0.0;
  double lowest = HUGE_VAL;
  for (size_t h = 0; h < 3; ++h) {
    for (int tenth = 1; tenth <= 9; ++tenth) {
      const double place = 0.1 * tenth;
      Chain chain;
      /* 48000/2/F is 100.04: all but a Courant number of 1, where the scheme is exact. */
      const TuningTarget target = {.rate_hz = 48000.0, .tone = {239.9, HUGE_VAL}};
      const double angle = 2.0 * PI * 239.9 / 48000.0;
      StringCoefs coefs = {0};
      double peak = 0.0;
      assert_int_equal(tuning_solve(&target, 99, &coefs), STATUS_OK);
      chain_init(&chain, chain_kernel(0), memory, 99);
      chain_set(&chain, coefs);
      pluck_add(&chain, (Pluck){place, hardnesses[h], 0.25}, angle);
      for (int n = 0; n < 400; ++n) {
        step(&chain);
        for (uint32_t i = 0; i < 99; ++i) {
          peak = fmax(peak, fabs((double)chain_position(&chain, i)));
        }
      }
      highest = fmax(highest, peak / 0.25);
      lowest = fmin(lowest, peak / 0.25);
    }
  }
  /* The last hundredth of a mass still bends the hardest pick's corners. */
  assert_within("peak, relative", highest, 1.05);
  assert_within("peak falls short by", 1.0 - lowest, 0.05);
}

static void pluck_adds_to_what_rings(void** state) {
  (void)state;
  enum { N = 60 };
  float before[N];
  Chain chain;
  const double angle = string_up(&chain, 48000.0, 200.0, N);
  pluck_add(&chain, (Pluck){0.2, 0.4, 0.25}, angle);
  for (int n = 0; n < 500; ++n) {
    step(&chain);
  }
  for (uint32_t i = 0; i < N; ++i) {
    before[i] = chain_velocity(&chain, i);
  }
  float positions[N];
  for (uint32_t i = 0; i < N; ++i) {
    positions[i] = chain_position(&chain, i);
  }
  pluck_add(&chain, (Pluck){0.6, 0.8, 0.1}, angle);
  Chain alone;
  static _Alignas(CHAIN_ALIGNMENT) char other_memory[32 * CHAIN_MAX_MASSES];
  chain_init(&alone, chain_kernel(0), other_memory, N);
  pluck_add(&alone, (Pluck){0.6, 0.8, 0.1}, angle);
  for (uint32_t i = 0; i < N; ++i) {
    assert_true(chain_position(&chain, i) == positions[i]);
    const float sum = before[i] + chain_velocity(&alone, i);
    assert_true(fabs((double)(chain_velocity(&chain, i) - sum)) <= (double)FLT_EPSILON);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fundamental_is_that_of_the_ideal_string),
      cmocka_unit_test(softest_finger_costs_half_a_decibel),
      cmocka_unit_test(one_mass_is_plucked_wherever_one_plucks),
      cmocka_unit_test(harder_is_brighter),
      cmocka_unit_test(flipping_mode_is_left_alone),
      cmocka_unit_test(ideal_string_peaks_at_the_amplitude),
      cmocka_unit_test(pluck_adds_to_what_rings),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
