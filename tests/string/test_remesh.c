/* Moved onto other masses, a string has the shape that its header says, in doubles and term by
 * term. */
#include "core/string/remesh.h"

#include "tests/support/chains.h"
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

/* A place is told by the masses to this many zero crossings on either side. */
static const double REACH = 8.0;

static _Alignas(CHAIN_ALIGNMENT) char memory[CHAINS_MOST_BYTES];
static double x[CHAIN_MAX_MASSES];
static double u[CHAIN_MAX_MASSES];

/* The string beyond its walls: mirrored in both, upside down. */
static double shape_at(const double* shape, int n, int place) {
  const int length = n + 1;
  int at = place;
  double sign = 1.0;
  while (at < 0 || at > length) {
    at = at < 0 ? -at : 2 * length - at;
    sign = -sign;
  }
  return at == 0 || at == length ? 0.0 : sign * shape[at - 1];
}

/* sin(πt)/(πt) under half a cosine squared, as wide as the wider of both spacings. */
static double read_at(const double* shape, int n, double place, double pace) {
  double sum = 0.0;
  double weights = 0.0;
  for (int i = -20 * n - 20; i <= 21 * n + 20; ++i) {
    const double t = (i - place) / pace;
    if (fabs(t) <= REACH) {
      const double sinc = t == 0.0 ? 1.0 : sin(PI * t) / (PI * t);
      const double weight = sinc * pow(cos(PI * t / (2.0 * REACH)), 2.0);
      sum += weight * shape_at(shape, n, i);
      weights += weight;
    }
  }
  return sum / weights;
}

static void start(Chain* chain, uint32_t n) {
  chain_init(chain, chain_kernel(0), memory, n);
}

static void every_place_is_read_with_a_windowed_sinc(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const uint32_t n = (uint32_t)random_log_between(&random, 1.0, 120.0);
    const uint32_t n_then = (uint32_t)random_log_between(&random, fmax(1.0, n / 8.0), 120.0);
    const double ratio = (n + 1.0) / (n_then + 1.0);
    Chain chain;
    start(&chain, n);
    chains_place_noise(&chain, &random);
    chains_read(&chain, x, u);
    remesh(&chain, n_then);
    assert_int_equal(chain.n_masses, n_then);
    for (uint32_t i = 0; i < n_then; ++i) {
      const double place = (i + 1.0) * ratio;
      const double pace = fmax(1.0, ratio);
      worst =
          fmax(worst, fabs((double)chain_position(&chain, i) - read_at(x, (int)n, place, pace)));
      worst =
          fmax(worst, fabs((double)chain_velocity(&chain, i) - read_at(u, (int)n, place, pace)));
    }
  }
  /* What is kept is rounded to floats. */
  assert_within("off the sum, of masses up to 1", worst, 4.0 * (double)FLT_EPSILON);
}

/* Largest difference from mode `k`, of `share` of it, once it is on other masses. */
static double distance_of_mode(uint32_t k, uint32_t n, uint32_t n_then, double share) {
  Chain chain;
  double worst = 0.0;
  start(&chain, n);
  for (uint32_t i = 0; i < n; ++i) {
    const double sine = sin(PI * k * (i + 1.0) / (n + 1.0));
    chain_place(&chain, i, (float)sine, (float)(0.5 * sine));
  }
  remesh(&chain, n_then);
  for (uint32_t i = 0; i < n_then; ++i) {
    const double sine = share * sin(PI * k * (i + 1.0) / (n_then + 1.0));
    worst = fmax(worst, fabs((double)chain_position(&chain, i) - sine));
    worst = fmax(worst, fabs((double)chain_velocity(&chain, i) - 0.5 * sine));
  }
  return worst;
}

/* "its shape and velocity kept, but for what the fewer masses cannot carry": so wide a
 * window blurs a quarter of the fewer masses on either side of their number, and leaves ripples of
 * a hundredth. */
static void modes_are_kept_or_gone(void** state) {
  (void)state;
  static const uint32_t sizes[][2] = {{80, 40}, {40, 80}, {100, 97}, {60, 21}, {31, 300}};
  double worst_kept = 0.0;
  double worst_gone = 0.0;
  for (size_t s = 0; s < sizeof(sizes) / sizeof(sizes[0]); ++s) {
    const uint32_t n = sizes[s][0];
    const uint32_t n_then = sizes[s][1];
    const uint32_t fewer = n < n_then ? n : n_then;
    for (uint32_t k = 1; k <= n; ++k) {
      if (4 * k <= 3 * fewer) {
        worst_kept = fmax(worst_kept, distance_of_mode(k, n, n_then, 1.0));
      } else if (4 * k >= 5 * (fewer + 1)) {
        worst_gone = fmax(worst_gone, distance_of_mode(k, n, n_then, 0.0));
      }
    }
  }
  assert_within("kept modes, off", worst_kept, 0.015);
  assert_within("what is left of the others", worst_gone, 0.015);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_place_is_read_with_a_windowed_sinc),
      cmocka_unit_test(modes_are_kept_or_gone),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
