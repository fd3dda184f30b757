#include "core/string/chain_numbers.h"

#include "tests/support/chains.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <complex.h>
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { STEPS = 300 };

/*
  In fixed point a link errs by 0.41 of a number in the mean; a mode grows by that over √k1 a
  step, at random, so that a mass is 0.41 √(300/k1) = 18 off where k1 is 0.15, and six times that
  happens to none of a million.  Where numbers are large a link's own last place is more: 0.29 ε of
  it.
*/
static const double CHANCE = 6.0 * 18.0;
static const double LAST_PLACES = 6.0 * 0.29 * 45.0 * (double)FLT_EPSILON;

static const char* const names[] = {"in floats", "in doubles", "in fixed point"};

static _Alignas(CHAIN_ALIGNMENT) char memory[CHAINS_MOST_BYTES];

/* Those that there are loops for. */
enum { N_COUNTS = 4 };
static const uint32_t counts[N_COUNTS] = {1, 2, 4, CHAIN_MAX_TAPS};

/* At both ends, at a place, and somewhere between two; and a velocity. */
static void choose_taps(uint32_t n, ChainTap taps[CHAIN_MAX_TAPS]) {
  taps[0] = (ChainTap){{0, n - 1}, {0.25f, 0.5f}, false};
  taps[1] = (ChainTap){{n / 2, n / 2}, {1.0f, 0.0f}, false};
  taps[2] = (ChainTap){{n - 1, 0}, {-1.0f, 0.5f}, false};
  taps[3] = (ChainTap){{n / 3, n / 2}, {0.5f, -0.5f}, false};
  taps[4] = (ChainTap){{n / 4, n / 4}, {-0.5f, 1.0f}, false};
  taps[5] = (ChainTap){{n / 4, n - 1}, {0.5f, -1.0f}, true};
}

static double read_tap(const ChainTap* tap, const double* of) {
  return (double)tap->weight[0] * of[tap->mass[0]] + (double)tap->weight[1] * of[tap->mass[1]];
}

/* What was read, and where the masses are: of the chain, and of the oracle. */
typedef struct {
  double x[CHAIN_MAX_MASSES];
  double u[CHAIN_MAX_MASSES];
  float read[CHAIN_MAX_TAPS][STEPS];
} Motion;

/* The oracle knows no gain: what is read of it is multiplied by the one after each step. */
static void foretell(const Chain* chain, const ChainTap* taps, Motion* motion) {
  const StringCoefs coefs = chains_seen(chain);
  double gain = chain->numbers == CHAIN_FIXED ? chain->gain : 1.0;
  chains_read(chain, motion->x, motion->u);
  for (uint32_t n = 0; n < STEPS; ++n) {
    double before[CHAIN_MAX_TAPS];
    for (uint32_t t = 0; t < CHAIN_MAX_TAPS; ++t) {
      before[t] = taps[t].is_velocity ? gain * read_tap(&taps[t], motion->x) : 0.0;
    }
    oracle_step(coefs, chain->n_masses, motion->x, motion->u);
    gain *= chain->numbers == CHAIN_FIXED ? chain->fade : 1.0;
    for (uint32_t t = 0; t < CHAIN_MAX_TAPS; ++t) {
      motion->read[t][n] = (float)(gain * read_tap(&taps[t], motion->x) - before[t]);
    }
  }
}

/* Buffers for what is read. */
typedef struct {
  float* taps[CHAIN_MAX_TAPS];
} Outputs;

static Outputs outputs_of(float* first, size_t n_frames) {
  Outputs outputs;
  for (uint32_t t = 0; t < CHAIN_MAX_TAPS; ++t) {
    outputs.taps[t] = first + t * n_frames;
  }
  return outputs;
}

/* How far the chain goes from where it should be, over its motion; less what chance may do. */
typedef struct {
  double state;
  double read;
} Distance;

static Distance distance_from(const Motion* truth, Chain* chain, uint32_t n_taps) {
  static Motion found;
  const uint32_t n = chain->n_masses;
  const double start_gain = chain->numbers == CHAIN_FIXED ? chain->gain : 1.0;
  ChainTap taps[CHAIN_MAX_TAPS];
  double worst_read = 0.0;
  choose_taps(n, taps);
  memset(found.read, 0, sizeof(found.read));
  chain_run(chain, STEPS, taps, n_taps, outputs_of(found.read[0], STEPS).taps);
  chains_read(chain, found.x, found.u);
  for (uint32_t t = 0; t < n_taps; ++t) {
    for (uint32_t m = 0; m < STEPS; ++m) {
      worst_read = fmax(worst_read, fabs((double)found.read[t][m] - (double)truth->read[t][m]));
    }
  }
  const double size = fmax(chains_largest(truth->x, n), chains_largest(truth->u, n));
  const double off =
      fmax(chains_distance(truth->x, found.x, n), chains_distance(truth->u, found.u, n));
  const double excused = chain->numbers == CHAIN_FIXED ? CHANCE : 0.0;
  return (Distance){
      .state = fmax(off - excused, 0.0) / size,
      .read = fmax(worst_read / start_gain - 1.5 * excused, 0.0) / size,
  };
}

/* Over all scenes that stand still, and taps, of one size. */
static Distance distance_of_scenes(const ChainKernel* kernel, ChainNumbers numbers, uint32_t n) {
  static Motion truth;
  Distance worst = {0};
  ChainTap taps[CHAIN_MAX_TAPS];
  choose_taps(n, taps);
  for (int scene = 0; scene < N_CHAIN_DAMPINGS * N_CHAIN_ELASTICITIES; ++scene) {
    for (int count = 0; count < N_COUNTS; ++count) {
      const uint32_t n_taps = counts[count];
      Chain chain;
      chains_start(&chain, kernel, memory, numbers, (ChainDamping)(scene % 3),
                   (ChainElasticity)(scene / 3), n);
      if (n_taps == 1) {
        foretell(&chain, taps, &truth);
      }
      const Distance distance = distance_from(&truth, &chain, n_taps);
      worst.state = fmax(worst.state, distance.state);
      worst.read = fmax(worst.read, distance.read);
    }
  }
  return worst;
}

/* In floats and doubles 300 steps that each round at a few places, all to the worse.  What is read
 * is a float. */
static void every_layout_is_the_same_string(void** state) {
  (void)state;
  static const double most[] = {STEPS * 4.0 * 0.5 * (double)FLT_EPSILON,
                                STEPS * 4.0 * 0.5 * DBL_EPSILON, LAST_PLACES};
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (int numbers = 0; numbers < N_CHAIN_NUMBERS; ++numbers) {
      Distance worst = {0};
      for (uint32_t size = 0; size < CHAINS_N_SIZES; ++size) {
        const Distance distance =
            distance_of_scenes(chain_kernel(kernel), (ChainNumbers)numbers, chains_size(size));
        worst.state = fmax(worst.state, distance.state);
        worst.read = fmax(worst.read, distance.read);
      }
      print_message("  %s, %s:\n", chain_kernel(kernel)->name, names[numbers]);
      assert_within("masses", worst.state, most[numbers]);
      assert_within("what is read", worst.read, fmax(most[numbers], (double)FLT_EPSILON));
    }
  }
}

/* "such that the pitch moves by about the same interval in each step": k1 by the same factor, and
 * the others along the straight line that it is on; the last step's are the goal's. */
static StringCoefs on_the_way(StringCoefs from, StringCoefs to, double way) {
  const double factor = to.k1 / from.k1;
  const double share = fabs(factor - 1.0) < 1e-9 ? way : (pow(factor, way) - 1.0) / (factor - 1.0);
  return (StringCoefs){
      .k1 = from.k1 + share * (to.k1 - from.k1),
      .k2 = from.k2 + share * (to.k2 - from.k2),
      .k3 = from.k3 + share * (to.k3 - from.k3),
      .z0 = from.z0 + share * (to.z0 - from.z0),
      .z1 = from.z1 + share * (to.z1 - from.z1),
  };
}

/* How fast the fundamental turns in a step, √(1 − g) sin ω: what is imaginary of its pole. */
static double turn_of(StringCoefs coefs, uint32_t n) {
  const double lambda = pow(2.0 * sin(0.5 * PI / (n + 1.0)), 2.0);
  double complex poles[2];
  oracle_mass_poles(coefs.k1 * lambda + coefs.k2 * lambda * lambda + coefs.k3 * pow(lambda, 3.0),
                    coefs.z0 + coefs.z1 * lambda, poles);
  return fabs(cimag(poles[0]));
}

/* A step with a bent clock: half of the pull is the springs' from before, for u − ½ K x goes on
 * faster by the ratio of turns. */
static void glide_step(StringCoefs from, StringCoefs to, uint32_t n, double* x, double* u) {
  const double ratio = turn_of(to, n) / turn_of(from, n);
  const StringCoefs half = {
      .k1 = 0.5 * (ratio * from.k1 + to.k1),
      .k2 = 0.5 * (ratio * from.k2 + to.k2),
      .k3 = 0.5 * (ratio * from.k3 + to.k3),
      .z0 = to.z0,
      .z1 = to.z1,
  };
  for (uint32_t i = 0; i < n; ++i) {
    u[i] *= ratio;
  }
  oracle_step(half, n, x, u);
}

enum { TURNS = 18, TURN_STEPS = 20 };

/* Six turns whose fuller end is each elasticity, in both numbers, with 1, 2 and 4 taps. */
static StringCoefs goal_of(int turn) {
  const int elasticity = turn / 6;
  const int lesser = turn / 2 % (elasticity + 1);
  return chains_coefs((ChainDamping)(turn % N_CHAIN_DAMPINGS),
                      (ChainElasticity)(turn % 2 ? lesser : elasticity));
}

/* The worst of masses and of what is read. */
static double distance_of_glides(Chain* chain) {
  static Motion truth;
  const uint32_t n = chain->n_masses;
  double worst = 0.0;
  ChainTap taps[CHAIN_MAX_TAPS];
  StringCoefs from = chain->now;
  choose_taps(n, taps);
  chains_read(chain, truth.x, truth.u);
  for (int turn = 0; turn < TURNS; ++turn) {
    static float read[CHAIN_MAX_TAPS][TURN_STEPS];
    const uint32_t n_taps = counts[turn % N_COUNTS];
    const StringCoefs to = goal_of(turn);
    memset(read, 0, sizeof(read));
    assert_true(chain_hold(chain, turn / 3 % 2 ? CHAIN_DOUBLE : CHAIN_FLOAT));
    chain_glide(chain, to, TURN_STEPS);
    chain_run(chain, TURN_STEPS, taps, n_taps, outputs_of(read[0], TURN_STEPS).taps);
    for (int m = 0; m < TURN_STEPS; ++m) {
      glide_step(on_the_way(from, to, (double)m / TURN_STEPS),
                 on_the_way(from, to, (m + 1.0) / TURN_STEPS), n, truth.x, truth.u);
      for (uint32_t t = 0; t < n_taps; ++t) {
        const double wanted = read_tap(&taps[t], taps[t].is_velocity ? truth.u : truth.x);
        worst = fmax(worst, fabs((double)read[t][m] - wanted));
      }
    }
    from = to;
  }
  for (uint32_t i = 0; i < n; ++i) {
    worst = fmax(worst, fabs(truth.x[i] - (double)chain_position(chain, i)));
  }
  return worst;
}

/* From floats to doubles and back, from every elasticity to every other, the motion kept. */
static void every_glide_is_the_same_string(void** state) {
  (void)state;
  double worst = 0.0;
  Random random = random_start();
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (uint32_t size = 0; size < CHAINS_N_SIZES; ++size) {
      Chain chain;
      chain_init(&chain, chain_kernel(kernel), memory, chains_size(size));
      chain_set(&chain, chains_coefs(CHAIN_GROUND, CHAIN_BENDING));
      chains_place_noise(&chain, &random);
      worst = fmax(worst, distance_of_glides(&chain));
    }
  }
  /* Half of the steps at most are in floats, whose coefficients round as well. */
  assert_within("positions up to 4", worst, 4.0 * 150.0 * 6.0 * 0.5 * (double)FLT_EPSILON);
}

/* Over the motion; in the one's fixed point, for they may differ a little in their size. */
static double difference_of_kernels(ChainNumbers numbers, int scene, uint32_t n) {
  static Motion one;
  static Motion other;
  Chain chains[2];
  for (uint32_t k = 0; k < 2; ++k) {
    Motion* const motion = k == 0 ? &one : &other;
    chains_start(&chains[k], chain_kernel(k), memory, numbers, (ChainDamping)(scene % 3),
                 (ChainElasticity)(scene / 3), n);
    chains_run(&chains[k], STEPS);
    chains_read(&chains[k], motion->x, motion->u);
  }
  for (uint32_t i = 0; i < n && numbers == CHAIN_FIXED; ++i) {
    other.x[i] *= chains[1].gain / chains[0].gain;
    other.u[i] *= chains[1].gain / chains[0].gain;
  }
  const double off = fmax(chains_distance(one.x, other.x, n), chains_distance(one.u, other.u, n));
  const double size = fmax(chains_largest(one.x, n), chains_largest(one.u, n));
  return fmax(off - (numbers == CHAIN_FIXED ? 2.0 * CHANCE : 0.0), 0.0) / size;
}

static void kernels_agree(void** state) {
  (void)state;
  static const double most[] = {STEPS * 4.0 * (double)FLT_EPSILON, STEPS * 4.0 * DBL_EPSILON,
                                2.0 * LAST_PLACES};
  for (int numbers = 0; numbers < N_CHAIN_NUMBERS && chain_kernel(1); ++numbers) {
    double worst = 0.0;
    for (uint32_t size = 0; size < CHAINS_N_SIZES; ++size) {
      for (int scene = 0; scene < N_CHAIN_DAMPINGS * N_CHAIN_ELASTICITIES; ++scene) {
        worst = fmax(worst, difference_of_kernels((ChainNumbers)numbers, scene, chains_size(size)));
      }
    }
    assert_within(names[numbers], worst, most[numbers]);
  }
}

/* Numbers that are no mass's, and not nought. */
static size_t n_stirred(const Chain* chain) {
  static bool is_mass[4 * CHAIN_MAX_MASSES];
  size_t n = 0;
  memset(is_mass, 0, sizeof(is_mass));
  for (uint32_t i = 0; i < chain->n_masses; ++i) {
    const size_t at = chain_numbers_offset(chain, i);
    is_mass[at] = is_mass[at + chain->loops->n_lanes] = true;
  }
  for (size_t m = 0; m < chains_n_numbers(chain); ++m) {
    n += !is_mass[m] && chains_number(chain, m) != 0.0;
  }
  return n;
}

/* What lay there would count in the energy, and could overflow. */
static void nothing_stirs_beyond_the_wall(void** state) {
  (void)state;
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (int scene = 0; scene < N_CHAIN_DAMPINGS * N_CHAIN_ELASTICITIES; ++scene) {
      for (uint32_t n = 1; n <= 70; ++n) {
        for (int numbers = 0; numbers < N_CHAIN_NUMBERS; ++numbers) {
          Chain chain;
          chains_start(&chain, chain_kernel(kernel), memory, (ChainNumbers)numbers,
                       (ChainDamping)(scene % 3), (ChainElasticity)(scene / 3), n);
          chains_run(&chain, 3);
          assert_int_equal(n_stirred(&chain), 0);
        }
      }
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_layout_is_the_same_string),
      cmocka_unit_test(every_glide_is_the_same_string),
      cmocka_unit_test(kernels_agree),
      cmocka_unit_test(nothing_stirs_beyond_the_wall),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
