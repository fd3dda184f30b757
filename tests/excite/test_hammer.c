#include "core/excite/hammer.h"

#include "core/excite/rehearsal.h"
#include "tests/support/hammers.h"
#include "tests/support/oracle.h"
#include "tools/bench/bench_clock.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];

static bool is_long(void) {
  return getenv("HOOKE_TEST_LONG");
}

static void hammers_leave_for_good(void** state) {
  (void)state;
  Random random = random_start();
  const double most_s = HAMMER_MOST_S + HAMMER_LEAVING_S;
  double longest_s = 0.0;
  uint32_t n_early = 0;
  for (int k = 0; k < 1500; ++k) {
    Strung strung;
    Hammer hammer;
    strung_up_anywhere(&strung, memory, &random, CHAIN_FLOAT);
    const bool is_wanted = random_below(&random, 2);
    const double size = random_below(&random, 2) ? 0.3 : 0.0;
    hammers_shake(&strung, &random, size);
    if (is_wanted) {
      const Strike wanted = {random_between(&random, 0.0, 1.0), random_between(&random, 0.0, 1.0),
                             random_log_between(&random, 0.02, 1.0),
                             random_log_between(&random, 1e-5, 1.0)};
      hammer_throw(&hammer, &strung.chain, wanted, strung.angle1, strung.rate_hz);
    } else {
      hammer_start(&hammer, &strung.chain, hammers_anyhow(&random, 1.0), strung.rate_hz);
    }
    /* None comes with its felt pressed, not even before a string that runs from it. */
    const double rounding = 1e-12 * (1.0 + fabs(hammer.position) + hammer.velocity);
    assert_true(hammer.now <= rounding && hammer.before <= rounding);
    uint32_t n = 0;
    do {
      strung_step(&strung, 0);
      ++n;
    } while (hammer_act(&hammer, &strung.chain));
    longest_s = fmax(longest_s, (n - 4.0) / strung.rate_hz);
    if (n < HAMMER_MOST_S * strung.rate_hz) {
      /* It said that the string cannot reach it: look whether it could. */
      ++n_early;
      hammer.is_active = true;
      hammer.far = HUGE_VAL;
      for (int i = 0; i < 2000; ++i) {
        strung_step(&strung, 0);
        hammer_act(&hammer, &strung.chain);
        assert_true(hammer.force == 0.0);
      }
    }
    hammer.is_active = false;
    const float x = chain_position(&strung.chain, 0);
    assert_false(hammer_act(&hammer, &strung.chain));
    assert_true(chain_position(&strung.chain, 0) == x);
  }
  assert_within("longest [s]", longest_s, most_s);
  assert_true(n_early > 500);
}

/* In floats, again and again on a string that rings: all that it ever has is what was thrown. */
static void storms_of_strikes_stay_bounded(void** state) {
  (void)state;
  static Motion motion;
  Random random = random_start();
  for (int k = 0; k < (is_long() ? 2000 : 200); ++k) {
    Strung strung;
    Hammer hammers[2] = {0};
    double thrown = 0.0;
    strung_up_anywhere(&strung, memory, &random, CHAIN_FLOAT);
    for (int n = 0; n < 3000; ++n) {
      for (int h = 0; h < 2; ++h) {
        if (!hammers[h].is_active && random_below(&random, 100) == 0) {
          HammerMake make = hammers_anyhow(&random, 1.0);
          make.velocity = fmin(make.velocity, 1.0);
          make.place = h == 0 ? 0.2 : 0.8;
          hammer_start(&hammers[h], &strung.chain, make, strung.rate_hz);
          thrown += 0.5 * make.mass * (strung.chain.n_masses + 1.0) * make.velocity * make.velocity;
        }
      }
      strung_step(&strung, 0);
      hammer_act(&hammers[0], &strung.chain);
      hammer_act(&hammers[1], &strung.chain);
    }
    strung_read(&strung, &motion);
    const double energy = motion_energy(&motion, strung.chain.now);
    /* Two hammers on the same few masses are not exactly solved for together. */
    const double most = strung.chain.n_masses > 10 ? 1.001 : 4.0;
    assert_true(isfinite(energy) && energy <= most * thrown);
  }
}

static void a_strike_adds_to_what_rings(void** state) {
  (void)state;
  double before = 0.0;
  Strung strung;
  uint32_t n_pressed = 0;
  strung_key(&strung, memory, 52, 48000.0, 128, 1e9);
  for (int k = 0; k < 50; ++k) {
    hammers_strike(&strung, (Strike){0.12, 0.5, 0.1, 0.1}, &n_pressed);
    assert_true(n_pressed > 3);
    for (int i = 0; i < 97 * k; ++i) {
      strung_step(&strung, 0);
    }
  }
  before = strung_fundamental(&strung);
  /* Fifty at random phases: about seven times one, and at most fifty times. */
  assert_true(before > 0.1 && before < 50.0 * 0.1 * 4.0 / PI);
}

static void frames_may_be_cut_anyhow(void** state) {
  (void)state;
  float heard[2][4000];
  for (int way = 0; way < 2; ++way) {
    Strung strung;
    Hammer hammer;
    strung_key(&strung, memory, 60, 48000.0, 128, 1.0);
    hammer_throw(&hammer, &strung.chain, (Strike){0.12, 0.5, 0.1, 0.1}, strung.angle1, 48000.0);
    memset(heard[way], 0, sizeof heard[way]);
    for (uint32_t n = 0; n < 4000;) {
      const uint32_t most = way == 0 ? 1 : 257;
      const uint32_t stretch = hammer.is_active ? 1 : most < 4000 - n ? most : 4000 - n;
      float* const out[] = {heard[way] + n};
      chain_run(&strung.chain, stretch, &(ChainTap){{3, 4}, {0.5f, 0.5f}, false}, 1, out);
      hammer_act(&hammer, &strung.chain);
      n += stretch;
    }
    assert_false(hammer.is_active);
  }
  assert_memory_equal(heard[0], heard[1], sizeof heard[0]);
}

static void a_hammer_costs_next_to_nothing(void** state) {
  (void)state;
  enum { N = 20000 };
  Strung strung;
  Hammer pressed;
  Hammer flying;
  Hammer gone = {0};
  strung_key(&strung, memory, 33, 48000.0, 128, 1.0);
  /* A heavy, slow one that never lets go, and one that never comes. */
  hammer_start(&pressed, &strung.chain, (HammerMake){0.3, 100.0, {1e-4, 2.5, 0.0}, 1e-6}, 1e9);
  hammer_start(&flying, &strung.chain, (HammerMake){0.3, 0.1, {1e-4, 2.5, 0.0}, -1e-9}, 1e9);
  flying.position = -10.0;
  flying.far = HUGE_VAL;
  Hammer* const hammers[] = {&pressed, &flying, &gone};
  static const char* const names[] = {"pressed", "flying", "gone"};
  for (int h = 0; h < 3; ++h) {
    const double start_s = bench_clock_now_s();
    for (int i = 0; i < N; ++i) {
      hammer_act(hammers[h], &strung.chain);
    }
    print_message("  %-8s %6.1f ns a frame\n", names[h], 1e9 * (bench_clock_now_s() - start_s) / N);
  }
  double start_s = bench_clock_now_s();
  double longest_s = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double then_s = bench_clock_now_s();
    rehearsal_make(128, (Strike){0.12, i / 500.0, i % 2 ? 0.1 : 1.0, 0.1}, 0.01);
    longest_s = fmax(longest_s, bench_clock_now_s() - then_s);
  }
  print_message("  a rehearsal %.1f us, at most %.1f us\n",
                1e6 * (bench_clock_now_s() - start_s) / 500, 1e6 * longest_s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hammers_leave_for_good),
      cmocka_unit_test(storms_of_strikes_stay_bounded),
      cmocka_unit_test(a_strike_adds_to_what_rings),
      cmocka_unit_test(frames_may_be_cut_anyhow),
      cmocka_unit_test(a_hammer_costs_next_to_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
