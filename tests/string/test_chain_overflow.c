/* Whole numbers never grow past what they can hold, whatever the string is made to do. */
#include "core/string/chain.h"

#include "core/string/chain_fixed.h"
#include "tests/support/chains.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { MOST = 100, BACK = 200, AFTER = 100 };

/* Half of what a number can hold, so that a pull fits as well. */
static const double FULL = 1073741824.0;

static _Alignas(CHAIN_ALIGNMENT) char memory[CHAINS_MOST_BYTES];

typedef struct {
  double x[MOST];
  double u[MOST];
} Shape;

/* The largest of what a step computes of the numbers: x, u, and the differences that links take. */
static double largest(const Chain* chain) {
  double x[MOST + 6] = {0};
  double bow[MOST + 6] = {0};
  double flex[MOST + 6] = {0};
  double u[MOST];
  double most = 0.0;
  const uint32_t n = chain->n_masses;
  chains_read(chain, x + 3, u);
  for (uint32_t i = 3; i < n + 3; ++i) {
    bow[i] =
        chain->fixed.k2 != 0.0 || chain->fixed.k3 != 0.0 ? 2.0 * x[i] - x[i - 1] - x[i + 1] : 0.0;
  }
  for (uint32_t i = 3; i < n + 3; ++i) {
    flex[i] = chain->fixed.k3 != 0.0 ? 2.0 * bow[i] - bow[i - 1] - bow[i + 1] : 0.0;
    most = fmax(most, fmax(fabs(u[i - 3]), fmax(fabs(x[i]), fmax(fabs(bow[i]), fabs(flex[i])))));
  }
  for (uint32_t i = 3; i < n + 4; ++i) {
    const double slope = fmax(fabs(x[i] - x[i - 1]), fabs(bow[i] - bow[i - 1]));
    most = fmax(most, fmax(slope, fabs(flex[i] - flex[i - 1])));
  }
  return most;
}

/* From here on, over what is allowed. */
static double
worst_from(const ChainKernel* kernel, StringCoefs coefs, uint32_t n, const Shape* shape) {
  Chain chain;
  double worst = 0.0;
  chain_init(&chain, kernel, memory, n);
  chain_set(&chain, coefs);
  for (uint32_t i = 0; i < n; ++i) {
    chain_place(&chain, i, (float)shape->x[i], (float)shape->u[i]);
  }
  assert_true(chain_hold(&chain, CHAIN_FIXED));
  for (uint32_t step = 0; step < BACK + AFTER; ++step) {
    worst = fmax(worst, largest(&chain) / FULL);
    chains_run(&chain, 1);
  }
  return worst;
}

/* What the shape was BACK steps ago, had there been no dampers: x − u, and then the velocity that
 * became u. */
static void go_back(StringCoefs coefs, uint32_t n, Shape* shape) {
  coefs.z0 = 0.0;
  coefs.z1 = 0.0;
  for (int step = 0; step < BACK; ++step) {
    double x[MOST];
    double u[MOST] = {0};
    for (uint32_t i = 0; i < n; ++i) {
      shape->x[i] -= shape->u[i];
      x[i] = shape->x[i];
    }
    oracle_step(coefs, n, x, u);
    for (uint32_t i = 0; i < n; ++i) {
      shape->u[i] -= u[i];
    }
  }
}

typedef enum { NOISE, TOP_MODE, PLUCK, PULL_ONE, PUSH_ONE, PUSH_TWO, WAVE, N_KINDS } Kind;

/* `width` is where a pluck has its corner, or which mass it is. */
static void make_shape(Kind kind, uint32_t n, uint32_t width, Shape* shape) {
  Random random = {.state = n + width};
  memset(shape, 0, sizeof(*shape));
  for (uint32_t i = 0; i < n; ++i) {
    const double place = (i + 1.0) / (n + 1.0);
    const double corner = (width + 1.0) / (n + 1.0);
    const double top = sin(PI * n * place);
    const double wave = sin(PI * (width + 1.0) * place);
    const bool is_here = i == width;
    const bool is_next = i == width + 1;
    switch (kind) {
    case NOISE:
      shape->x[i] = random_between(&random, -1.0, 1.0);
      shape->u[i] = random_between(&random, -1.0, 1.0);
      break;
    case TOP_MODE:
      shape->u[i] = top;
      shape->x[i] = 0.5 * top;
      break;
    case PLUCK:
      shape->x[i] = fmin(place / corner, (1.0 - place) / (1.0 - corner));
      break;
    case PULL_ONE:
      shape->x[i] = is_here;
      break;
    case PUSH_ONE:
      shape->u[i] = is_here;
      shape->x[i] = 0.5 * shape->u[i];
      break;
    case PUSH_TWO:
      shape->u[i] = (double)is_here - (double)is_next;
      shape->x[i] = 0.5 * shape->u[i];
      break;
    default:
      shape->x[i] = wave;
    }
  }
}

static const StringCoefs strings[] = {
    {.k1 = 0.99, .z0 = 1e-7},
    {.k1 = 0.5, .z0 = 1e-7, .z1 = 1e-6},
    {.k1 = 0.02, .z0 = 1e-8},
    {.k1 = 0.2, .k2 = 0.19, .z0 = 1e-7},
    {.k1 = 0.1, .k2 = 1e-3, .z0 = 1e-7},
    {.k1 = 0.002, .k2 = 0.2, .z0 = 1e-7},
    {.k1 = 0.9, .k2 = -0.15, .z0 = 1e-7},
    {.k1 = 0.3, .k2 = 0.07, .k3 = 0.02, .z0 = 1e-7},
    {.k1 = 0.9, .k2 = -0.2, .k3 = 0.02, .z0 = 1e-7},
};

enum { N_STRINGS = sizeof(strings) / sizeof(strings[0]) };

/* As it is, or with all of it larger or smaller, so that this much headroom is left. */
static StringCoefs near_limit(StringCoefs coefs, uint32_t n, double headroom) {
  const double size = (1.0 - headroom) / (1.0 - tuning_headroom(coefs, n));
  return (StringCoefs){.k1 = size * coefs.k1,
                       .k2 = size * coefs.k2,
                       .k3 = size * coefs.k3,
                       .z0 = size * coefs.z0,
                       .z1 = size * coefs.z1};
}

/* Everything that the string may be made to do, forwards and back in time. */
static double worst_of_string(const ChainKernel* kernel, StringCoefs coefs, uint32_t n) {
  double worst = 0.0;
  for (int kind = 0; kind < N_KINDS; ++kind) {
    for (uint32_t width = 0; width < n; width += n / 3 + 1) {
      Shape shape;
      make_shape((Kind)kind, n, width, &shape);
      worst = fmax(worst, worst_from(kernel, coefs, n, &shape));
      go_back(coefs, n, &shape);
      worst = fmax(worst, worst_from(kernel, coefs, n, &shape));
    }
  }
  return worst;
}

/*
  Where all energy comes together, numbers are as large as was thought; and no string wastes two of
  its bits on what cannot be.
*/
static void numbers_are_full_and_never_overflow(void** state) {
  (void)state;
  static const uint32_t sizes[] = {1, 2, 3, 8, 17, 40, 100};
  double fullest = 0.0;
  for (size_t s = 0; s < N_STRINGS; ++s) {
    double worst = 0.0;
    for (size_t size = 0; size < sizeof(sizes) / sizeof(sizes[0]); ++size) {
      const ChainKernel* const kernel = chain_kernel(size % 2 && chain_kernel(1));
      const StringCoefs edge = near_limit(strings[s], sizes[size], 1e-4);
      worst = fmax(worst, worst_of_string(kernel, strings[s], sizes[size]));
      worst = fmax(worst, worst_of_string(kernel, edge, sizes[size]));
    }
    print_message("  k1 %g, k2 %g, k3 %g:\n", strings[s].k1, strings[s].k2, strings[s].k3);
    assert_within("largest number, over what is allowed", worst, 1.0);
    assert_true(worst > 0.3);
    fullest = fmax(fullest, worst);
  }
  assert_true(fullest > 0.9);
}

/* Near the limit the uppermost modes alone could move fast, and a fundamental has none of them. */
static void a_fundamental_fills_the_numbers_of_a_string_at_its_limit(void** state) {
  (void)state;
  Shape shape;
  make_shape(WAVE, MOST, 0, &shape);
  const StringCoefs edge = near_limit(strings[0], MOST, 1e-4);
  const double found = worst_from(chain_kernel(0), edge, MOST, &shape);
  print_message("  %g of what is allowed\n", found);
  assert_true(found > 0.4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(numbers_are_full_and_never_overflow),
      cmocka_unit_test(a_fundamental_fills_the_numbers_of_a_string_at_its_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
