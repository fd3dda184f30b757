#include "core/guitar/guitar_reading.h"

#include "core/string/pickup.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { MASSES = 40, FRAMES = GUITAR_MIX_FRAMES };

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

static GuitarGains gains_of(double first, double second) {
  GuitarGains gains = {.is_read = {first != 0.0, second != 0.0}};
  for (int n = 0; n < FRAMES; ++n) {
    gains.gain[0][n] = (float)first;
    gains.gain[1][n] = (float)second;
  }
  return gains;
}

static double read_at(const Chain* chain, double place) {
  const ChainTap tap = pickup_tap(chain->n_masses, place);
  return (double)tap.weight[0] * (double)chain_position(chain, tap.mass[0]) +
         (double)tap.weight[1] * (double)chain_position(chain, tap.mass[1]);
}

/* What is read in FRAMES frames, against what is there, place by place and in a straight line. */
static double worst_of(GuitarReading* reading,
                       const GuitarGains* gains,
                       uint32_t n_fade,
                       const double* from,
                       const double* to) {
  Chain chain;
  Chain twin;
  float out[FRAMES] = {0};
  float none;
  float* const nowhere[] = {&none};
  const ChainTap tap = {{0, 0}, {1.0f, 0.0f}};
  double worst = 0.0;
  ring(&chain, memory);
  ring(&twin, other_memory);
  for (uint32_t done = 0; done < FRAMES;) {
    const uint32_t stretch = guitar_reading_stretch(reading);
    const uint32_t n = stretch < FRAMES - done ? stretch : FRAMES - done;
    guitar_reading_run(reading, &chain, gains, done, n, out + done);
    done += n;
  }
  for (uint32_t n = 0; n < FRAMES; ++n) {
    double wanted = 0.0;
    const double way = n_fade == 0 ? 1.0 : fmin(1.0, (n + 1.0) / n_fade);
    chain_run(&twin, 1, &tap, 1, nowhere);
    for (int p = 0; p < GUITAR_PICKUPS; ++p) {
      wanted += (double)gains->gain[p][n] *
                ((1.0 - way) * read_at(&twin, from[p]) + way * read_at(&twin, to[p]));
    }
    worst = fmax(worst, fabs((double)out[n] - wanted));
  }
  return worst;
}

static void both_pickups_are_read_where_they_are(void** state) {
  (void)state;
  static const double gains[][2] = {{1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {0.5, -0.7}, {0.0, 0.0}};
  const double places[] = {0.13, 0.4};
  double worst = 0.0;
  for (int i = 0; i < 5; ++i) {
    GuitarReading reading = {0};
    const GuitarGains some = gains_of(gains[i][0], gains[i][1]);
    guitar_reading_set(&reading, places);
    assert_int_equal(guitar_reading_stretch(&reading), UINT32_MAX);
    worst = fmax(worst, worst_of(&reading, &some, 0, places, places));
  }
  assert_within("off what is there", worst, ROUNDING);
}

static void gain_is_that_of_its_frame(void** state) {
  (void)state;
  const double places[] = {0.13, 0.4};
  GuitarReading reading = {0};
  GuitarGains gains = gains_of(1.0, 1.0);
  for (int n = 0; n < FRAMES; ++n) {
    gains.gain[0][n] = (float)sin(0.1 * n);
    gains.gain[1][n] = (float)n / FRAMES;
  }
  guitar_reading_set(&reading, places);
  assert_within("off what is there", worst_of(&reading, &gains, 0, places, places), ROUNDING);
}

/* The fade is a straight line, with either pickup or both. */
static void move_fades_in_a_straight_line(void** state) {
  (void)state;
  static const double gains[][2] = {{1.0, 0.0}, {0.0, 1.0}, {0.6, 1.0}};
  const double from[] = {0.13, 0.4};
  const double to[] = {0.7, 0.22};
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    GuitarReading reading = {0};
    const GuitarGains some = gains_of(gains[i][0], gains[i][1]);
    guitar_reading_set(&reading, from);
    guitar_reading_move(&reading, to, 192);
    assert_int_equal(guitar_reading_stretch(&reading), 192);
    worst = fmax(worst, worst_of(&reading, &some, 192, from, to));
    assert_int_equal(guitar_reading_stretch(&reading), UINT32_MAX);
  }
  /* A ramp adds up 192 roundings of its step. */
  assert_within("off the straight line", worst, 192.0 * 1e-7);
}

static void move_under_way_is_not_disturbed(void** state) {
  (void)state;
  const double from[] = {0.13, 0.4};
  const double to[] = {0.7, 0.22};
  const double elsewhere[] = {0.5, 0.5};
  GuitarReading reading = {0};
  const GuitarGains some = gains_of(1.0, 1.0);
  guitar_reading_set(&reading, from);
  guitar_reading_move(&reading, from, 192);
  assert_int_equal(guitar_reading_stretch(&reading), UINT32_MAX);
  guitar_reading_move(&reading, to, 192);
  guitar_reading_move(&reading, elsewhere, 100);
  assert_within("off the straight line", worst_of(&reading, &some, 192, from, to), 192.0 * 1e-7);
  guitar_reading_move(&reading, elsewhere, 100);
  assert_int_equal(guitar_reading_stretch(&reading), 100);
  guitar_reading_set(&reading, from);
  assert_int_equal(guitar_reading_stretch(&reading), UINT32_MAX);
}

/* What is read is added to what is there, and not reading at all leaves it and steps the string. */
static void reading_adds(void** state) {
  (void)state;
  const double places[] = {0.13, 0.4};
  GuitarReading reading = {0};
  GuitarGains gains = gains_of(1.0, 0.0);
  Chain chain;
  float first[FRAMES] = {0};
  float second[FRAMES];
  guitar_reading_set(&reading, places);
  ring(&chain, memory);
  guitar_reading_run(&reading, &chain, &gains, 0, FRAMES, first);
  const float end = chain_position(&chain, 20);
  ring(&chain, memory);
  for (int n = 0; n < FRAMES; ++n) {
    second[n] = 0.5f;
  }
  guitar_reading_run(&reading, &chain, &gains, 0, FRAMES, second);
  for (int n = 0; n < FRAMES; ++n) {
    assert_true(second[n] == 0.5f + first[n]);
  }
  gains = gains_of(0.0, 0.0);
  ring(&chain, memory);
  memset(first, 0, sizeof(first));
  guitar_reading_run(&reading, &chain, &gains, 0, FRAMES, first);
  assert_true(chain_position(&chain, 20) == end);
  for (int n = 0; n < FRAMES; ++n) {
    assert_true(first[n] == 0.0f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(both_pickups_are_read_where_they_are),
      cmocka_unit_test(gain_is_that_of_its_frame),
      cmocka_unit_test(move_fades_in_a_straight_line),
      cmocka_unit_test(move_under_way_is_not_disturbed),
      cmocka_unit_test(reading_adds),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
