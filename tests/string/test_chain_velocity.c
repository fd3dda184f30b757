/* What a tap for velocities reads, in whatever numbers a string is kept. */
#include "core/string/chain.h"

#include "core/excite/pluck.h"
#include "core/string/chain_numbers.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { N = 80, FRAMES = 2000 };

static const double RATE_HZ = 48e3;
static const double F0_HZ = 82.4;

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];

/* Plucked, on one kernel, in one kind of numbers, and as strongly damped as fixed point bears. */
static void string_up(Chain* chain, uint32_t kernel, ChainNumbers numbers) {
  const TuningTarget target = {.rate_hz = RATE_HZ, .tone = {F0_HZ, 1.0}};
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(&target, N, &coefs), STATUS_OK);
  chain_init(chain, chain_kernel(kernel), memory, N);
  chain_set(chain, coefs);
  (void)pluck_pull(chain, (Pluck){0.13, 0.5, 0.25, 0.0});
  assert_true(chain_hold(chain, numbers));
  assert_true(chain->numbers == numbers);
}

/* How far a tap for the velocity is from what the same for the position came by, at the most, of
 * the largest. */
static double largest_error(uint32_t kernel, ChainNumbers numbers) {
  static float x[FRAMES];
  static float u[FRAMES];
  const ChainTap at = {{20, 21}, {0.25f, 0.75f}, false};
  ChainTap taps[2] = {at, at};
  Chain chain;
  taps[1].is_velocity = true;
  for (int n = 0; n < FRAMES; ++n) {
    x[n] = u[n] = 0.0f;
  }
  string_up(&chain, kernel, numbers);
  chain_run(&chain, FRAMES, taps, 2, (float* const[]){x, u});
  double worst = 0.0;
  double most = 0.0;
  for (int n = 1; n < FRAMES; ++n) {
    worst = fmax(worst, fabs((double)u[n] - ((double)x[n] - (double)x[n - 1])));
    most = fmax(most, fabs((double)u[n]));
  }
  return worst / most;
}

/* Of fixed point the gain fades, too: without that it would be a part in a thousand off. */
static void velocity_is_how_far_it_came_in_a_step(void** state) {
  (void)state;
  double worst = 0.0;
  for (uint32_t kernel = 0; chain_kernel(kernel); ++kernel) {
    for (int numbers = 0; numbers < N_CHAIN_NUMBERS; ++numbers) {
      worst = fmax(worst, largest_error(kernel, (ChainNumbers)numbers));
    }
  }
  /* Positions of 0.25 are told to 24 bits, and a step is a hundredth of that. */
  assert_within("off, of the largest", worst, 2e-5);
}

/* In the next frame after a pull its velocity is that of what pulls it back alone: it does not
 * jump. */
static void a_pull_makes_no_step(void** state) {
  (void)state;
  float u[1] = {0.0f};
  Chain chain;
  string_up(&chain, 0, CHAIN_FLOAT);
  const ChainTap tap = {{60, 61}, {0.5f, 0.5f}, true};
  chain_run(&chain, 1, &tap, 1, (float* const[]){u});
  assert_within("velocity away from the finger", fabs((double)u[0]), 1e-7);
  assert_true(fabs((double)chain_position(&chain, 60)) > 0.01);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(velocity_is_how_far_it_came_in_a_step),
      cmocka_unit_test(a_pull_makes_no_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
