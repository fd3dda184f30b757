#include "core/voice/pickups.h"

#include "core/string/chain.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { MASSES = 40, FRAMES = 256 };

/* A few roundings of a float near 1. */
static const double ROUNDING = 5e-7;

static _Alignas(CHAIN_ALIGNMENT) char memory[1 << 14];
static _Alignas(CHAIN_ALIGNMENT) char other_memory[1 << 14];

/* A string that rings in many modes. */
static void ring(Chain* chain, void* cells) {
  const TuningTarget target = {48e3, {220.0, 0.5}, 0.1, 0.0, PARTIALS_TRUE};
  StringCoefs coefs = {0};
  assert_int_equal(tuning_solve(&target, MASSES, &coefs), STATUS_OK);
  chain_init(chain, chain_kernel(0), cells, MASSES);
  chain_set(chain, coefs);
  for (uint32_t i = 0; i < MASSES; ++i) {
    chain_place(chain, i, i < 12 ? (float)i / 12.0f : (float)(MASSES - i) / 28.0f, 0.0f);
  }
}

static double read_at(const Chain* chain, double place) {
  const ChainTap tap = pickup_tap(chain->n_masses, place);
  return (double)tap.weight[0] * (double)chain_position(chain, tap.mass[0]) +
         (double)tap.weight[1] * (double)chain_position(chain, tap.mass[1]);
}

static const bool both[PICKUPS] = {true, true};

static void place(Pickup at[PICKUPS], const double places[PICKUPS]) {
  for (int p = 0; p < PICKUPS; ++p) {
    at[p] = (Pickup){PICKUP_DISPLACEMENT, places[p]};
  }
}

static void set(Pickups* pickups, const double places[PICKUPS]) {
  Pickup at[PICKUPS];
  place(at, places);
  pickups_set(pickups, at);
}

static void move(Pickups* pickups, const double places[PICKUPS], uint32_t n_frames) {
  Pickup at[PICKUPS];
  place(at, places);
  pickups_move(pickups, at, n_frames);
}

/* Read `n_frames` of a chain, in which the fade does not end, into two buffers. */
static void read_both(Pickups* pickups, Chain* chain, uint32_t n_frames, float* out[PICKUPS]) {
  const Reading reading = pickups_reading(pickups, both);
  static float left_behind[PICKUPS][FRAMES];
  float* taps[CHAIN_MAX_TAPS] = {out[0], out[1], left_behind[0], left_behind[1]};
  ChainTap at[CHAIN_MAX_TAPS];
  for (uint32_t t = 0; t < reading.n_taps; ++t) {
    at[t] = pickup_tap(MASSES, reading.at[t].place);
    memset(taps[t], 0, n_frames * sizeof(float));
  }
  chain_run(chain, n_frames, at, reading.n_taps, taps);
  pickups_cross(pickups, &reading, n_frames, taps);
}

/* What is read in FRAMES frames, against what is there, place by place and in a straight line. */
static double worst_of(Pickups* pickups, uint32_t n_fade, const double* from, const double* to) {
  Chain chain;
  Chain twin;
  static float heard[PICKUPS][FRAMES];
  float none;
  float* const nowhere[] = {&none};
  const ChainTap tap = {{0, 0}, {1.0f, 0.0f}, false};
  double worst = 0.0;
  ring(&chain, memory);
  ring(&twin, other_memory);
  for (uint32_t done = 0; done < FRAMES;) {
    const uint32_t stretch = pickups_stretch(pickups);
    const uint32_t n = stretch < FRAMES - done ? stretch : FRAMES - done;
    read_both(pickups, &chain, n, (float*[]){heard[0] + done, heard[1] + done});
    done += n;
  }
  for (uint32_t n = 0; n < FRAMES; ++n) {
    const double way = n_fade == 0 ? 1.0 : fmin(1.0, (n + 1.0) / n_fade);
    chain_run(&twin, 1, &tap, 1, nowhere);
    for (int p = 0; p < PICKUPS; ++p) {
      const double wanted = (1.0 - way) * read_at(&twin, from[p]) + way * read_at(&twin, to[p]);
      worst = fmax(worst, fabs((double)heard[p][n] - wanted));
    }
  }
  return worst;
}

static void strings_are_read_where_the_pickups_are(void** state) {
  (void)state;
  const double places[] = {0.13, 0.4};
  Pickups pickups = {0};
  set(&pickups, places);
  assert_int_equal(pickups_stretch(&pickups), UINT32_MAX);
  assert_within("off what is there", worst_of(&pickups, 0, places, places), ROUNDING);
}

static void move_fades_in_a_straight_line(void** state) {
  (void)state;
  const double from[] = {0.13, 0.4};
  const double to[] = {0.7, 0.22};
  Pickups pickups = {0};
  set(&pickups, from);
  move(&pickups, to, 192);
  assert_int_equal(pickups_stretch(&pickups), 192);
  assert_within("off the straight line", worst_of(&pickups, 192, from, to), 2.0 * ROUNDING);
  assert_int_equal(pickups_stretch(&pickups), UINT32_MAX);
}

static void move_under_way_is_not_disturbed(void** state) {
  (void)state;
  const double from[] = {0.13, 0.4};
  const double to[] = {0.7, 0.22};
  const double elsewhere[] = {0.5, 0.5};
  Pickups pickups = {0};
  set(&pickups, from);
  move(&pickups, from, 192);
  assert_int_equal(pickups_stretch(&pickups), UINT32_MAX);
  move(&pickups, to, 192);
  move(&pickups, elsewhere, 100);
  assert_within("off the straight line", worst_of(&pickups, 192, from, to), 2.0 * ROUNDING);
  move(&pickups, elsewhere, 100);
  assert_int_equal(pickups_stretch(&pickups), 100);
  set(&pickups, from);
  assert_int_equal(pickups_stretch(&pickups), UINT32_MAX);
}

/* Another type, or the other end, is another place. */
static void what_is_heard_is_a_part_of_the_place(void** state) {
  (void)state;
  const Pickup pickup = {PICKUP_FORCE, 0.3};
  assert_true(pickups_are_same(&pickup, &(Pickup){PICKUP_FORCE, 0.3}));
  assert_false(pickups_are_same(&pickup, &(Pickup){PICKUP_FORCE, 0.31}));
  assert_false(pickups_are_same(&pickup, &(Pickup){PICKUP_VELOCITY, 0.3}));
}

/* Those that nobody wants cost no tap, and those that fade come after those that stay. */
static void only_what_is_wanted_is_read(void** state) {
  (void)state;
  const double from[] = {0.13, 0.4};
  const double to[] = {0.7, 0.22};
  Pickups pickups = {0};
  set(&pickups, from);
  const Reading one = pickups_reading(&pickups, (const bool[PICKUPS]){false, true});
  assert_true(one.n_taps == 1 && one.n_heard == 1 && !one.is_fading && one.at[0].place == 0.4);
  move(&pickups, to, 10);
  const Reading two = pickups_reading(&pickups, (const bool[PICKUPS]){true, false});
  assert_true(two.n_taps == 2 && two.n_heard == 1 && two.is_fading);
  assert_true(two.at[0].place == 0.7 && two.at[1].place == 0.13);
  const Reading all = pickups_reading(&pickups, both);
  assert_true(all.n_taps == 4 && all.n_heard == 2 && all.at[1].place == 0.22);
  assert_true(all.at[2].place == 0.13 && all.at[3].place == 0.4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strings_are_read_where_the_pickups_are),
      cmocka_unit_test(move_fades_in_a_straight_line),
      cmocka_unit_test(move_under_way_is_not_disturbed),
      cmocka_unit_test(what_is_heard_is_a_part_of_the_place),
      cmocka_unit_test(only_what_is_wanted_is_read),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
