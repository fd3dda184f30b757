/* No block costs much more than the others, whatever is played in it. */
#include "tools/bench/bench_block.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { MASSES = 256, N_TIMES = 60, PLAY_S = 60 };

/* Of the mean block when nothing happens. */
static const double MOST = 3.0;

/* Where each string is pulled, and its springs are solved for. */
static const double MOST_PULLED = 3.75;

/* After a minute of play nothing costs more, but for what a machine's clock does. */
static const double MOST_GROWTH = 1.25;

/* A sanitizer's checks are not what the instrument costs. */
static void skip_where_sanitized(void) {
#ifdef __SANITIZE_ADDRESS__
  print_message("built with a sanitizer: its cost is not measured\n");
  skip();
#endif
}

static void gesture_is_cheap(BenchGesture gesture, double most) {
  BenchBlocks blocks;
  skip_where_sanitized();
  assert_true(bench_block_gesture(gesture, MASSES, N_TIMES, &blocks));
  const double ratio = blocks.worst_s / blocks.steady_s;
  print_message("calm %.1f us, worst %.1f us (block %u): %.2f times\n", 1e6 * blocks.steady_s,
                1e6 * blocks.worst_s, blocks.worst_block, ratio);
  assert_true(ratio <= most);
}

static void ten_keys_fit_into_a_block(void** state) {
  (void)state;
  gesture_is_cheap(BENCH_TEN_KEYS, MOST_PULLED);
}

static void dampers_on_88_strings_fit_into_a_block(void** state) {
  (void)state;
  gesture_is_cheap(BENCH_PEDAL, MOST);
}

static void a_bend_of_88_strings_fits_into_a_block(void** state) {
  (void)state;
  gesture_is_cheap(BENCH_BEND, MOST);
}

static void the_wheel_may_move_in_every_block(void** state) {
  (void)state;
  gesture_is_cheap(BENCH_WHEEL, MOST);
}

static void a_jump_of_ports_fits_into_a_block(void** state) {
  (void)state;
  gesture_is_cheap(BENCH_JUMP, MOST);
}

static void a_minute_of_play_makes_nothing_dearer(void** state) {
  (void)state;
  double first_s;
  double last_s;
  skip_where_sanitized();
  assert_true(bench_block_growth(PLAY_S, &first_s, &last_s));
  print_message("mean block: %.1f us at first, %.1f us after %d s\n", 1e6 * first_s, 1e6 * last_s,
                PLAY_S);
  assert_true(last_s <= MOST_GROWTH * first_s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ten_keys_fit_into_a_block),
      cmocka_unit_test(dampers_on_88_strings_fit_into_a_block),
      cmocka_unit_test(a_bend_of_88_strings_fits_into_a_block),
      cmocka_unit_test(the_wheel_may_move_in_every_block),
      cmocka_unit_test(a_jump_of_ports_fits_into_a_block),
      cmocka_unit_test(a_minute_of_play_makes_nothing_dearer),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
