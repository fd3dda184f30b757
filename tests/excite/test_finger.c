/* A finger on a string takes energy, gives none, and leaves what has a node under it. */
#include "core/excite/finger.h"

#include "tests/support/energy.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { MOST_MASSES = 256 };

/*
  The finger moves two masses, and floats round what it puts there by 2^−24 of itself.  In a string
  that is stiff near its limit that is at most what a few masses of largest displacement hold, over
  what all hold.
*/
static const double MOST_ROUNDING = 1e-6;

static _Alignas(CHAIN_ALIGNMENT) char memory[1 << 16];
static Chain chain;
static Motion before;
static Motion after;

/* A stable string of few masses or many: a mode shape, one mass that moves, or noise. */
static void draw_string(Random* random, uint32_t n_masses) {
  const double tau_s = random_log_between(random, 1e-3, 10.0);
  const double loss = random_below(random, 3) ? random_between(random, 0.0, 1.0) : 0.0;
  const double stiffness = random_below(random, 2) ? 0.0 : random_log_between(random, 1e-6, 0.1);
  TuningTarget target = {48e3, {0.0, tau_s}, loss, stiffness, (Partials)random_below(random, 3)};
  StringCoefs coefs = {0};
  do {
    target.tone.f0_hz = random_log_between(random, 20.0, 20e3);
  } while (tuning_fit(&target, n_masses, &coefs));
  assert_true(oracle_headroom(coefs, n_masses) > 0.0);
  chain_init(&chain, chain_kernel(0), memory, n_masses);
  chain_set(&chain, coefs);
  const uint32_t kind = random_below(random, 3);
  const uint32_t k = 1 + random_below(random, n_masses);
  for (uint32_t i = 0; i < n_masses; ++i) {
    const double shape = kind == 0   ? sin(PI * k * (i + 1.0) / (n_masses + 1.0))
                         : kind == 1 ? i + 1 == k
                                     : 1.0;
    chain_place(&chain, i, (float)(shape * random_between(random, -1.0, 1.0)),
                (float)(shape * random_between(random, -1.0, 1.0)));
  }
}

static double draw_place(Random* random, uint32_t n_masses) {
  const uint32_t choice = random_below(random, 8);
  const double mass = random_below(random, n_masses + 2);
  return choice == 0   ? 0.0
         : choice == 1 ? 1.0
         : choice < 4  ? mass / (n_masses + 1.0)
                       : random_between(random, 0.0, 1.0);
}

static void touch_never_adds_energy(void** state) {
  (void)state;
  const int n_touches = getenv("HOOKE_TEST_LONG") ? 1000000 : 100000;
  Random random = random_start();
  double worst = 0.0;
  int n_felt = 0;
  for (int i = 0; i < n_touches; ++i) {
    const uint32_t n_masses = (uint32_t)random_log_between(&random, 1.0, MOST_MASSES + 0.999);
    draw_string(&random, n_masses);
    const double place = draw_place(&random, n_masses);
    const double weight = random_below(&random, 3) ? random_between(&random, 0.0, 1.0) : 1.0;
    motion_read(&chain, &before);
    finger_act(&chain, place, weight);
    motion_read(&chain, &after);
    const double energy = motion_energy(&before, chain.now);
    assert_true(energy > 0.0);
    const double gain = motion_energy(&after, chain.now) / energy - 1.0;
    worst = fmax(worst, gain);
    n_felt += gain < -MOST_ROUNDING;
  }
  print_message("  %d of %d took some\n", n_felt, n_touches);
  assert_true(n_felt > n_touches / 3);
  assert_within("energy gained, of what there was", worst, MOST_ROUNDING);
}

static double distance(const Motion* a, const Motion* b) {
  double sum = 0.0;
  for (uint32_t i = 0; i < a->n; ++i) {
    sum += fabs(a->x[i] - b->x[i]) + fabs(a->u[i] - b->u[i]);
  }
  return sum;
}

static void no_weight_and_walls_do_nothing(void** state) {
  (void)state;
  Random random = random_start();
  for (int i = 0; i < 3000; ++i) {
    const uint32_t n_masses = 1 + random_below(&random, MOST_MASSES);
    draw_string(&random, n_masses);
    motion_read(&chain, &before);
    finger_act(&chain, draw_place(&random, n_masses), 0.0);
    finger_act(&chain, 0.0, 1.0);
    finger_act(&chain, 1.0, 1.0);
    motion_read(&chain, &after);
    assert_true(distance(&before, &after) == 0.0);
  }
}

/* What a full touch takes, a second way: of all that a push at e can take from H, found with y held
 * and u moved along e, the share 1 − (1 − θ)². */
static void touch_takes_the_share_that_it_should(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const uint32_t n_masses = 8 + random_below(&random, 200);
    const double weight = random_between(&random, 0.1, 1.0);
    draw_string(&random, n_masses);
    const uint32_t m = 1 + random_below(&random, n_masses);
    motion_read(&chain, &before);
    const double e0 = motion_energy(&before, chain.now);
    /* H along x += s/2, u += s is a parabola; its bottom from three points. */
    double at[2];
    for (int side = 0; side < 2; ++side) {
      const double s = side ? 1.0 : -1.0;
      after = before;
      after.x[m - 1] += 0.5 * s;
      after.u[m - 1] += s;
      at[side] = motion_energy(&after, chain.now);
    }
    const double inertia = at[0] + at[1] - 2.0 * e0; /* eᵀB e */
    const double slope = 0.5 * (at[1] - at[0]);
    const double damper = weight * 2.0 * sqrt(chain.now.k1);
    const double theta = damper / (inertia + 0.5 * damper);
    const double taken = 0.5 * slope * slope / inertia * (1.0 - (1.0 - theta) * (1.0 - theta));
    finger_act(&chain, m / (n_masses + 1.0), weight);
    motion_read(&chain, &after);
    const double here = e0 - motion_energy(&after, chain.now);
    worst = fmax(worst, fabs(here - taken) / e0);
  }
  assert_within("energy taken, against what should be, of all", worst, 2.0 * MOST_ROUNDING);
}

/* Half a mass from a wall: 9/16 on the mass there and −1/16 on the next, as between any two, and
 * the same upside down of those behind the wall, −1/16 of mass −1. */
static void finger_beside_a_wall_feels_the_string_go_on(void** state) {
  (void)state;
  const uint32_t n = 60;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < 500; ++i) {
    draw_string(&random, n);
    motion_read(&chain, &before);
    finger_act(&chain, (i % 2 ? 0.5 : n + 0.5) / (n + 1.0), 1.0);
    motion_read(&chain, &after);
    const uint32_t near = i % 2 ? 0 : n - 1;
    const uint32_t next = i % 2 ? 1 : n - 2;
    const double moved = after.u[near] - before.u[near];
    const double other = after.u[next] - before.u[next];
    const double room = 1e-6 * (fabs(before.u[near]) + fabs(before.u[next]) + fabs(moved));
    worst = fmax(worst, fabs(other + moved * 0.0625 / 0.625) / room);
  }
  assert_within("off what it should be, of rounding", worst, 1.0);
}

/* A mode with a node under the finger keeps all that it has; the next one loses. */
static void node_is_not_felt(void** state) {
  (void)state;
  static const uint32_t nodes[] = {2, 3, 4, 5};
  const TuningTarget target = {48e3, {110.0, 1.0}, 0.01, 1e-5, PARTIALS_TRUEST};
  for (int i = 0; i < 4; ++i) {
    for (uint32_t k = 1; k <= 20; ++k) {
      const uint32_t n_masses = 119; /* With masses at all these nodes */
      StringCoefs coefs = {0};
      assert_int_equal(tuning_solve(&target, n_masses, &coefs), STATUS_OK);
      chain_init(&chain, chain_kernel(0), memory, n_masses);
      chain_set(&chain, coefs);
      for (uint32_t m = 0; m < n_masses; ++m) {
        const double shape = sin(PI * k * (m + 1.0) / (n_masses + 1.0));
        chain_place(&chain, m, (float)(0.3 * shape), (float)(0.01 * shape));
      }
      motion_read(&chain, &before);
      finger_act(&chain, 1.0 / nodes[i], 1.0);
      motion_read(&chain, &after);
      const double lost = 1.0 - motion_energy(&after, coefs) / motion_energy(&before, coefs);
      assert_true(k % nodes[i] == 0 ? fabs(lost) < 1e-6 : lost > 1e-6);
    }
  }
}

/* Run under a finger, it dies far sooner than without. */
static double left_of(uint32_t n_steps, double weight) {
  static const ChainTap tap = {{0, 0}, {1.0f, 0.0f}, false};
  const TuningTarget target = {48e3, {110.0, 10.0}, 0.0, 0.0, PARTIALS_TRUEST};
  StringCoefs coefs = {0};
  float sample;
  float* const out[] = {&sample};
  assert_int_equal(tuning_solve(&target, 80, &coefs), STATUS_OK);
  chain_init(&chain, chain_kernel(0), memory, 80);
  chain_set(&chain, coefs);
  for (uint32_t m = 0; m < 80; ++m) {
    chain_place(&chain, m, (float)sin(PI * (m + 1.0) / 81.0), 0.0f);
  }
  motion_read(&chain, &before);
  for (uint32_t n = 0; n < n_steps; ++n) {
    chain_run(&chain, 1, &tap, 1, out);
    finger_act(&chain, 0.5, weight);
  }
  motion_read(&chain, &after);
  return motion_energy(&after, coefs) / motion_energy(&before, coefs);
}

/* Up to where it takes the most that a finger can, as far as floats tell. */
static void weight_is_graded(void** state) {
  (void)state;
  double last = left_of(2000, 0.0);
  assert_true(last > 0.98);
  for (double weight = 0.002; weight < 0.1; weight *= 2.0) {
    const double left = left_of(2000, weight);
    assert_true(left < 0.9 * last);
    last = left;
  }
  assert_true(last < 1e-2 && left_of(2000, 1.0) < 1e-3);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(touch_never_adds_energy),
      cmocka_unit_test(no_weight_and_walls_do_nothing),
      cmocka_unit_test(touch_takes_the_share_that_it_should),
      cmocka_unit_test(finger_beside_a_wall_feels_the_string_go_on),
      cmocka_unit_test(node_is_not_felt),
      cmocka_unit_test(weight_is_graded),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
