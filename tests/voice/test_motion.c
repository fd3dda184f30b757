#include "core/voice/motion.h"

#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* Rounding of a thousand pieces. */
static const double ROUNDING = 1e-12;

static void zero_is_still(void** state) {
  (void)state;
  VoiceMotion motion = {0};
  assert_true(motion_is_still(&motion));
  assert_true(motion_bend(&motion) == 0.0);
  assert_int_equal(motion_piece(&motion), MOTION_PIECE_FRAMES);
  motion_go(&motion, MOTION_PIECE_FRAMES);
  assert_true(motion_is_still(&motion) && motion_bend(&motion) == 0.0);
}

static void line_is_straight_and_ends_exactly(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double from = random_between(&random, -48.0, 48.0);
    const double to = random_between(&random, -48.0, 48.0);
    const uint32_t n = 1 + random_below(&random, 50000);
    VoiceMotion motion = {0};
    line_to(&motion.slide, from, 0);
    assert_true(motion.slide.value == from && motion_is_still(&motion));
    line_to(&motion.slide, to, n);
    for (uint32_t done = 0; done < n;) {
      assert_false(motion_is_still(&motion));
      const uint32_t most = motion_piece(&motion);
      assert_int_equal(most, n - done < MOTION_PIECE_FRAMES ? n - done : MOTION_PIECE_FRAMES);
      const uint32_t piece = 1 + random_below(&random, most);
      motion_go(&motion, piece);
      done += piece;
      worst = fmax(worst, fabs(motion.slide.value - (from + (to - from) * done / n)));
    }
    assert_true(motion.slide.value == to && motion_is_still(&motion));
  }
  assert_within("off the straight line", worst, 48.0 * ROUNDING);
}

/* A piece ends where any of the lines does. */
static void piece_ends_where_a_line_does(void** state) {
  (void)state;
  for (int which = 0; which < 3; ++which) {
    VoiceMotion motion = {0};
    Line* const lines[] = {&motion.slide, &motion.bend, &motion.depth};
    for (int l = 0; l < 3; ++l) {
      line_to(lines[l], 1.0, l == which ? 70 : 1000);
    }
    assert_int_equal(motion_piece(&motion), 64);
    motion_go(&motion, 64);
    assert_int_equal(motion_piece(&motion), 6);
    motion_go(&motion, 6);
    assert_true(lines[which]->value == 1.0 && lines[which]->n_left == 0);
    assert_int_equal(motion_piece(&motion), 64);
  }
}

static void new_goal_starts_from_where_it_is(void** state) {
  (void)state;
  VoiceMotion motion = {0};
  line_to(&motion.bend, 2.0, 128);
  motion_go(&motion, 64);
  assert_within("half way", fabs(motion_bend(&motion) - 1.0), ROUNDING);
  line_to(&motion.bend, -1.0, 64);
  motion_go(&motion, 32);
  assert_within("half way back", fabs(motion_bend(&motion)), ROUNDING);
  line_to(&motion.bend, 5.0, 0);
  assert_true(motion_bend(&motion) == 5.0 && motion_is_still(&motion));
}

/* The bend and the swing add; the swing is a sine of the frequency from its start, whose mean is
 * the pitch itself. */
static void vibrato_is_a_sine_of_the_frequency(void** state) {
  (void)state;
  VoiceMotion motion = {.rate = 1.0 / 1000.0};
  double worst = 0.0;
  double mean = 0.0;
  line_to(&motion.bend, 3.0, 0);
  line_to(&motion.depth, 0.5, 0);
  assert_false(motion_is_still(&motion));
  for (int n = 0; n < 5000; n += 50) {
    const double share = (exp2(0.5 / 12.0) - 1.0) * sin(2.0 * PI * n / 1000.0);
    const double wanted = 3.0 + 12.0 * log2(1.0 + share);
    mean += exp2((motion_bend(&motion) - 3.0) / 12.0) / 100.0;
    worst = fmax(worst, fabs(motion_bend(&motion) - wanted));
    assert_true(motion.phase >= 0.0 && motion.phase < 1.0);
    motion_go(&motion, 50);
  }
  assert_within("off the sine", worst, 100.0 * ROUNDING);
  assert_within("off the pitch in the mean", fabs(mean - 1.0), 100.0 * ROUNDING);
}

/* It stops where its depth has died away, and begins anew at the pitch itself. */
static void vibrato_stops_and_begins_at_no_bend(void** state) {
  (void)state;
  VoiceMotion motion = {.rate = 1.0 / 1000.0};
  line_to(&motion.depth, 1.0, 0);
  motion_go(&motion, 64);
  line_to(&motion.depth, 0.0, 64);
  assert_false(motion_is_still(&motion));
  motion_go(&motion, 64);
  assert_true(motion_is_still(&motion));
  assert_true(motion_bend(&motion) == 0.0);
  line_to(&motion.depth, 1.0, 0);
  assert_true(motion_bend(&motion) == 0.0);
}

/* As deep as the deepest there is, 12 semitones: the pitch is never nought. */
static void the_widest_vibrato_goes_down_by_an_octave(void** state) {
  (void)state;
  VoiceMotion motion = {.rate = 1.0 / 1024.0};
  double lowest = 0.0;
  line_to(&motion.depth, 12.0, 0);
  for (int n = 0; n < 1024; ++n) {
    lowest = fmin(lowest, motion_bend(&motion));
    motion_go(&motion, 1);
  }
  assert_within("off an octave down", fabs(lowest + 12.0), 1e-9);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(zero_is_still),
      cmocka_unit_test(line_is_straight_and_ends_exactly),
      cmocka_unit_test(piece_ends_where_a_line_does),
      cmocka_unit_test(new_goal_starts_from_where_it_is),
      cmocka_unit_test(vibrato_is_a_sine_of_the_frequency),
      cmocka_unit_test(the_widest_vibrato_goes_down_by_an_octave),
      cmocka_unit_test(vibrato_stops_and_begins_at_no_bend),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
