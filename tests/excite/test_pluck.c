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
  static const ChainTap tap = {{0, 0}, {0.0f, 0.0f}, false};
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
          pluck_pull(&chain, (Pluck){place, is_hard, 0.25, 0.0});
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
    pluck_pull(&chain, (Pluck){place, 0.5, 0.25, 0.0});
    assert_within("amplitude, relative",
                  fabs(ringing_amplitude(&chain, angle, 480) / (4.0 / PI * 0.25) - 1.0), 1e-5);
  }
}

/* Positions of an undamped string of `n_masses`, as flexible as its partials let it be. */
static void string_of(Chain* chain, uint32_t n_masses, Partials partials, double inharmonicity) {
  const TuningTarget target = {.rate_hz = 48000.0,
                               .tone = {20.0, HUGE_VAL},
                               .inharmonicity = inharmonicity,
                               .partials = partials};
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(&target, n_masses, &coefs), STATUS_OK);
  chain_init(chain, chain_kernel(0), memory, n_masses);
  chain_set(chain, coefs);
}

/* The sine of partial `k` in the positions, or in what moves. */
static double partial(const Chain* chain, uint32_t k, float (*of)(const Chain*, uint32_t)) {
  const double length = chain->n_masses + 1.0;
  double sum = 0.0;
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    sum += 2.0 / length * sin(PI * k * (i + 1.0) / length) * (double)of(chain, i);
  }
  return sum;
}

/* sin(kπp)/k² in displacement, so /k in velocity and at the bridge. */
static void partials_are_those_of_a_string_pulled_aside(void** state) {
  (void)state;
  static const double places[] = {0.09, 0.13, 0.31, 0.47};
  for (size_t p = 0; p < 4; ++p) {
    Chain chain;
    double worst = 0.0;
    string_of(&chain, 1000, PARTIALS_LUMPED, 0.0);
    pluck_pull(&chain, (Pluck){places[p], 1.0, 0.25, 0.0});
    for (uint32_t k = 1; k <= 30; ++k) {
      const double ideal =
          4.0 / PI * 0.25 * sin(PI * k * places[p]) / (k * k) * finger(k * HARDEST);
      worst = fmax(worst, fabs(partial(&chain, k, chain_position) - ideal) * k * k / 0.25);
    }
    assert_within("partials, times k², of the amplitude", worst, 0.01);
  }
}

/* Whatever bends it: a_k X_k is the force, which is seen in what moves, half of it. */
static void string_gives_way_until_its_springs_hold_the_finger(void** state) {
  (void)state;
  static const double inharmonicities[] = {0.0, 1e-4, 1e-2};
  double worst = 0.0;
  for (uint32_t n = 1; n <= 400; n = 3 * n + 1) {
    for (int b = 0; b < 9; ++b) {
      Chain chain;
      string_of(&chain, n, (Partials)(b % 3), inharmonicities[b / 3]);
      pluck_pull(&chain, (Pluck){0.29, 0.7, 0.25, 0.0});
      const double first = partial(&chain, 1, chain_position);
      for (uint32_t k = 1; k <= n; ++k) {
        const double force = 2.0 * partial(&chain, k, chain_velocity);
        const double given = force / tuning_mode(chain.now, n, k).a;
        worst = fmax(worst, fabs(given - partial(&chain, k, chain_position)) / first);
      }
    }
  }
  /* Positions are floats. */
  assert_within("partials, of the first", worst, 1e-6);
}

/* So the first partial is a cosine from the frame on. */
static void string_is_let_go_from_rest(void** state) {
  (void)state;
  Chain chain;
  const double angle = string_up(&chain, 48000.0, 110.0, 100);
  pluck_pull(&chain, (Pluck){0.2, 0.5, 0.25, 0.0});
  const double amplitude = fundamental(&chain);
  double worst = 0.0;
  for (int n = 0; n < 1000; ++n) {
    worst = fmax(worst, fabs(fundamental(&chain) - amplitude * cos(angle * n)) / amplitude);
    step(&chain);
  }
  assert_within("off the cosine", worst, 2e-5);
}

/* The highest partial that is pulled at within 20 dB of the strongest: what a wide finger takes
 * away. */
static uint32_t brightness(double hardness) {
  enum { N = 200 };
  Chain chain;
  uint32_t highest = 0;
  double most = 0.0;
  double partials[N + 1];
  string_of(&chain, N, PARTIALS_LUMPED, 0.0);
  pluck_pull(&chain, (Pluck){0.37, hardness, 0.25, 0.0});
  for (uint32_t k = 1; k <= N; ++k) {
    partials[k] = fabs(partial(&chain, k, chain_velocity));
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

/* The pull is one that the masses can carry: next to nothing of the mode that only flips. */
static void flipping_mode_is_left_alone(void** state) {
  (void)state;
  for (uint32_t n = 20; n <= 1000; n *= 2) {
    for (int step = 0; step < 57; ++step) {
      const double place = 0.11 + 0.0137 * step;
      Chain chain;
      double sum = 0.0;
      double most = 0.0;
      string_of(&chain, n, PARTIALS_LUMPED, 0.0);
      pluck_pull(&chain, (Pluck){place, 1.0, 0.25, 0.0});
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

/* A corner of 2π p (1 − p) times the amplitude, and it never moves farther. */
static void string_is_pulled_to_a_corner_and_no_farther(void** state) {
  (void)state;
  double worst = 0.0;
  double farthest = 0.0;
  for (int tenth = 1; tenth <= 9; ++tenth) {
    const double place = 0.1 * tenth;
    const double corner = 2.0 * PI * place * (1.0 - place) * 0.25;
    Chain chain;
    double peak = 0.0;
    /* 48000/2/F is 100.04: all but a Courant number of 1, where the scheme is exact. */
    (void)string_up(&chain, 48000.0, 239.9, 99);
    pluck_pull(&chain, (Pluck){place, 1.0, 0.25, 0.0});
    worst = fmax(worst,
                 fabs((double)chain_position(&chain, (uint32_t)(10 * tenth - 1)) / corner - 1.0));
    for (int n = 0; n < 400; ++n) {
      step(&chain);
      for (uint32_t i = 0; i < 99; ++i) {
        peak = fmax(peak, fabs((double)chain_position(&chain, i)));
      }
    }
    farthest = fmax(farthest, peak / corner);
  }
  /* The hardest pick is two masses wide to each side. */
  assert_within("corner, relative", worst, 0.1);
  assert_within("farthest, of the corner", farthest, 1.01);
}

static void pull_adds_to_what_rings(void** state) {
  (void)state;
  enum { N = 60 };
  float positions[N];
  float velocities[N];
  Chain chain;
  (void)string_up(&chain, 48000.0, 200.0, N);
  pluck_pull(&chain, (Pluck){0.2, 0.4, 0.25, 0.0});
  for (int n = 0; n < 500; ++n) {
    step(&chain);
  }
  for (uint32_t i = 0; i < N; ++i) {
    positions[i] = chain_position(&chain, i);
    velocities[i] = chain_velocity(&chain, i);
  }
  const double before = chain_energy(&chain);
  const double given = pluck_pull(&chain, (Pluck){0.6, 0.8, -0.1, 0.0});
  assert_true(fabs(chain_energy(&chain) - before - given) < 1e-12 * before);
  Chain alone;
  static _Alignas(CHAIN_ALIGNMENT) char other_memory[32 * CHAIN_MAX_MASSES];
  chain_init(&alone, chain_kernel(0), other_memory, N);
  chain_set(&alone, chain.now);
  (void)pluck_pull(&alone, (Pluck){0.6, 0.8, -0.1, 0.0});
  for (uint32_t i = 0; i < N; ++i) {
    assert_true(fabsf(chain_position(&chain, i) - positions[i] - chain_position(&alone, i)) <=
                FLT_EPSILON);
    assert_true(fabsf(chain_velocity(&chain, i) - velocities[i] - chain_velocity(&alone, i)) <=
                FLT_EPSILON);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fundamental_is_that_of_the_ideal_string),
      cmocka_unit_test(softest_finger_costs_half_a_decibel),
      cmocka_unit_test(one_mass_is_plucked_wherever_one_plucks),
      cmocka_unit_test(partials_are_those_of_a_string_pulled_aside),
      cmocka_unit_test(string_gives_way_until_its_springs_hold_the_finger),
      cmocka_unit_test(string_is_let_go_from_rest),
      cmocka_unit_test(harder_is_brighter),
      cmocka_unit_test(flipping_mode_is_left_alone),
      cmocka_unit_test(string_is_pulled_to_a_corner_and_no_farther),
      cmocka_unit_test(pull_adds_to_what_rings),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
