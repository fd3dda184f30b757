/* What moves is the string's clock, as core/string/chain.h says it: the same motion, read faster or
 * slower. */
#include "core/string/chain.h"

#include "tests/support/chains.h"
#include "tests/support/energy.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { N_MASSES = 24 };

static const double RATE_HZ = 48000.0;

static _Alignas(CHAIN_ALIGNMENT) char memory[CHAINS_MOST_BYTES];
static double stiffness[N_MASSES * N_MASSES];
static double damping[N_MASSES * N_MASSES];

/* Without dampers; stiff and true strings have no other clock than flexible ones. */
static StringCoefs coefs_of(double f0_hz, double inharmonicity, Partials partials) {
  const TuningTarget target = {.rate_hz = RATE_HZ,
                               .tone = {f0_hz, HUGE_VAL},
                               .inharmonicity = inharmonicity,
                               .partials = partials};
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(&target, N_MASSES, &coefs), STATUS_OK);
  assert_true(tuning_headroom(coefs, N_MASSES) >= TUNING_MARGIN);
  return coefs;
}

static void string_up(Chain* chain, StringCoefs coefs) {
  chain_init(chain, chain_kernel(0), memory, N_MASSES);
  assert_true(chain_hold(chain, CHAIN_DOUBLE));
  chain_set(chain, coefs);
}

/* v = u − ½ K x of a motion, by the dense matrix. */
static void read_speeds(const Motion* motion, StringCoefs coefs, double* speeds) {
  oracle_forces(coefs, N_MASSES, stiffness, damping);
  for (uint32_t i = 0; i < N_MASSES; ++i) {
    double pull = 0.0;
    for (uint32_t j = 0; j < N_MASSES; ++j) {
      pull += stiffness[i + N_MASSES * j] * motion->x[j];
    }
    speeds[i] = motion->u[i] - 0.5 * pull;
  }
}

/* "Position stays, and the velocity at the same instant, v = u − ½ K x, is scaled by the ratio of
 * the fundamental's frequencies": a step of a glide is that, and then a step as ever. */
static void velocities_of_an_instant_go_with_the_pitch(void** state) {
  (void)state;
  static Motion before;
  static Motion after;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const double hz[2] = {random_between(&random, 100.0, 400.0),
                          random_between(&random, 100.0, 400.0)};
    const double b = trial % 2 ? random_log_between(&random, 1e-5, 1e-3) : 0.0;
    const StringCoefs from = coefs_of(hz[0], b, (Partials)(trial % 3));
    const StringCoefs to = coefs_of(hz[1], b, (Partials)(trial % 3));
    double was[N_MASSES];
    double is[N_MASSES];
    Chain chain;
    string_up(&chain, from);
    chains_place_noise(&chain, &random);
    chains_read(&chain, before.x, before.u);
    chain_glide(&chain, to, 1);
    chains_run(&chain, 1);
    chains_read(&chain, after.x, after.u);
    /* The step's own velocity, over which it moves, less the half of the pull before it. */
    for (uint32_t i = 0; i < N_MASSES; ++i) {
      after.x[i] -= after.u[i];
    }
    read_speeds(&before, from, was);
    read_speeds(&after, to, is);
    const double ratio = sin(2.0 * PI * hz[1] / RATE_HZ) / sin(2.0 * PI * hz[0] / RATE_HZ);
    oracle_forces(to, N_MASSES, stiffness, damping);
    for (uint32_t i = 0; i < N_MASSES; ++i) {
      double pull = 0.0;
      for (uint32_t j = 0; j < N_MASSES; ++j) {
        pull += stiffness[i + N_MASSES * j] * before.x[j];
      }
      worst = fmax(worst, fabs(after.x[i] - before.x[i]));
      worst = fmax(worst, fabs(is[i] + pull - ratio * was[i]));
    }
  }
  assert_within("off, of masses up to 1", worst, 1e-12);
}

/* Amplitude of mode `k`. */
static double amplitude_of(const Chain* chain, uint32_t k) {
  static Motion motion;
  const double a = tuning_mode(chain->now, N_MASSES, k).a;
  double x = 0.0;
  double u = 0.0;
  chains_read(chain, motion.x, motion.u);
  for (uint32_t i = 0; i < N_MASSES; ++i) {
    const double sine = 2.0 / (N_MASSES + 1.0) * sin(PI * k * (i + 1.0) / (N_MASSES + 1.0));
    x += sine * motion.x[i];
    u += sine * motion.u[i];
  }
  return sqrt((x * x - x * u + u * u / a) / (1.0 - 0.25 * a));
}

/* Largest change of the amplitude of a mode that a glide makes, over many moments [dB]. */
static double change_of(uint32_t k, const double hz[2], uint32_t n_frames, Partials partials) {
  double worst = 0.0;
  for (uint32_t moment = 0; moment < 16; ++moment) {
    Chain chain;
    string_up(&chain, coefs_of(hz[0], 0.0, partials));
    for (uint32_t i = 0; i < N_MASSES; ++i) {
      chain_place(&chain, i, (float)sin(PI * k * (i + 1.0) / (N_MASSES + 1.0)), 0.0f);
    }
    chains_run(&chain, 1000 + 31 * moment);
    const double before = amplitude_of(&chain, k);
    chain_glide(&chain, coefs_of(hz[1], 0.0, partials), n_frames);
    chains_run(&chain, n_frames);
    worst = fmax(worst, fabs(20.0 * log10(amplitude_of(&chain, k) / before)));
  }
  return worst;
}

/* "So no glide of pitch feeds or starves it, whatever its time, and its amplitude is the same at
 * all pitches": of the fundamental to the last places, up and down an octave, in one frame or many;
 * a partial's clock goes as much faster as the fundamental's but for what sampling does to it. */
static void amplitudes_are_the_same_at_all_pitches(void** state) {
  (void)state;
  static const double ways[][2] = {{220.0, 440.0}, {440.0, 220.0}, {300.0, 336.7}, {300.0, 299.0}};
  double worst = 0.0;
  double worst_partial = 0.0;
  for (size_t w = 0; w < sizeof(ways) / sizeof(ways[0]); ++w) {
    for (uint32_t n_frames = 1; n_frames <= 20000; n_frames *= 3) {
      for (int partials = 0; partials < 3; ++partials) {
        worst = fmax(worst, change_of(1, ways[w], n_frames, (Partials)partials));
        for (uint32_t k = 2; k <= 5; ++k) {
          const double change = change_of(k, ways[w], n_frames, (Partials)partials);
          worst_partial = fmax(worst_partial, change);
        }
      }
    }
  }
  assert_within("fundamental [dB]", worst, 1e-9);
  assert_within("partials 2 to 5 [dB]", worst_partial, 0.1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(velocities_of_an_instant_go_with_the_pitch),
      cmocka_unit_test(amplitudes_are_the_same_at_all_pitches),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
