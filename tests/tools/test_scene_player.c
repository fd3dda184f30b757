#include "tools/formats/scene_player.h"

#include "tests/support/measure.h"
#include "tests/support/oracle.h"
#include "tests/support/scenes.h"

#include <complex.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

/* One mass: a = (ω0 h)² = 0.1, g = γ h = 0.02 at 1000 Hz. */
#define MASS "rate 1000\nmass a 0.5\nground g\nspring a g 50000\ndamper a g 10\n"

static const double RATE_HZ = 1000.0;
static const double MASS_KG = 0.5;
static const double A = 0.1;
static const double G = 0.02;

/* All frames, in blocks; to be freed. */
static double* play_blocks(const char* text, double rate_hz, uint32_t block, size_t* n) {
  Scene* const scene = scenes_read(text);
  ScenePlayer* const player = scene_player_new(scene, rate_hz > 0.0 ? rate_hz : scene->rate_hz);
  assert_non_null(player);
  *n = scene_player_length(player);
  double* const out = malloc(*n * sizeof(double));
  assert_non_null(out);
  for (size_t i = 0; i < *n; i += block) {
    scene_player_run(player, out + i, (uint32_t)(*n - i < block ? *n - i : block));
    assert_true(scene_player_settle(player));
  }
  scene_player_free(player);
  scene_free(scene);
  return out;
}

static double* play(const char* text, size_t* n) {
  return play_blocks(text, 0.0, 256, n);
}

/* The mass after x0 and x1: two poles, z² + (a + g − 2) z + 1 − g = 0. */
static double response(double x0, double x1, double n) {
  const double half = 0.5 * (2.0 - A - G);
  const double complex z = complex_of(half, sqrt(1.0 - G - half * half));
  const double complex weight = (x1 - x0 * conj(z)) / (z - conj(z));
  return n < 0.0 ? 0.0 : 2.0 * creal(weight * cpow(z, n));
}

static void a_displaced_mass_moves_as_its_poles_say(void** state) {
  (void)state;
  size_t n = 0;
  double worst = 0.0;
  double* const out = play(MASS "at 0.1 displace a 0.25\npickup a 2\nend 1\n", &n);
  assert_int_equal(n, 1000);
  for (size_t i = 0; i < n; ++i) {
    const double expected = 2.0 * response(0.25, 0.25 * (1.0 - A), (double)i - 100.0);
    worst = fmax(worst, fabs(out[i] - expected));
  }
  /* 900 turns of a pole, a rounding of 1e-16 each. */
  assert_within("displaced", worst, 1e-12);
  free(out);
}

static void a_struck_mass_moves_as_its_poles_say(void** state) {
  (void)state;
  size_t n = 0;
  double worst = 0.0;
  double* const out = play(MASS "at 0.1 strike a 3\npickup a 1\nend 1\n", &n);
  for (size_t i = 0; i < n; ++i) {
    const double expected = response(0.0, 3.0 / RATE_HZ * (1.0 - G), (double)i - 100.0);
    worst = fmax(worst, fabs(out[i] - expected));
  }
  assert_within("struck", worst, 1e-12);
  free(out);
}

/* Of every step of the push an impulse of h F. */
static double pushed(double force, int from, int to, size_t i) {
  double sum = 0.0;
  for (int step = from; step < to; ++step) {
    sum += response(0.0, force / MASS_KG / (RATE_HZ * RATE_HZ), (double)i - step);
  }
  return sum;
}

static void a_pushed_mass_moves_as_the_sum_of_impulses(void** state) {
  (void)state;
  size_t n = 0;
  double worst = 0.0;
  double* const out = play(MASS "at 0.1 push a 2000 for 0.05\nat 0.12 push a 500 for 0.1\n"
                                "at 0.3 push a 1e9 for 1e-7\npickup a 1\nend 1\n",
                           &n);
  for (size_t i = 0; i < n; ++i) {
    const double expected =
        pushed(2000.0, 100, 150, i) + pushed(500.0, 120, 220, i) + pushed(1e9, 300, 301, i);
    worst = fmax(worst, fabs(out[i] - expected));
  }
  /* Of a motion of up to 3000 m. */
  assert_within("pushed", worst, 1e-8);
  free(out);
}

static void events_come_by_time_and_not_by_line(void** state) {
  (void)state;
  static const char* const texts[] = {
      MASS "at 0.5 strike a 1e-3\nat 0.1 push a 1 for 0.2\nat 0.1 displace a 0.1\n"
           "at 0 displace a 0.3\npickup a 1\nend 1\n",
      "end 1\n" MASS "pickup a 1\nat 0 displace a 0.3\nat 0.1 displace a 0.1\n"
      "at 0.1 push a 1 for 0.2\nat 0.5 strike a 1e-3\n",
  };
  size_t n = 0;
  double* const out = play(texts[0], &n);
  double* const other = play(texts[1], &n);
  assert_memory_equal(out, other, n * sizeof(double));
  assert_true(out[0] == 0.3);
  free(out);
  free(other);
}

/* (1e16 + 1) − 1e16 is 0 in double, and (1e16 − 1e16) + 1 is 1. */
static void events_of_one_step_keep_the_order_of_the_file(void** state) {
  (void)state;
  size_t n = 0;
  double* const lost = play(MASS "at 0 displace a 1e16\nat 0 displace a 1\n"
                                 "at 1e-5 displace a -1e16\npickup a 1\nend 1e-3\n",
                            &n);
  double* const kept = play(MASS "at 1e-5 displace a 1e16\nat 0 displace a -1e16\n"
                                 "at 0 displace a 1\npickup a 1\nend 1e-3\n",
                            &n);
  assert_int_equal(n, 1);
  assert_true(lost[0] == 0.0);
  assert_true(kept[0] == 1.0);
  free(lost);
  free(kept);
}

static void a_push_that_is_over_leaves_no_force(void** state) {
  (void)state;
  Scene* const scene = scenes_read(MASS "at 0 push a 0.1 for 0.3\nat 0.1 push a 0.7 for 0.3\n"
                                        "at 0.2 push a 1e9 for 0.1\npickup a 1\nend 1\n");
  ScenePlayer* const player = scene_player_new(scene, RATE_HZ);
  double out[400];
  scene_player_run(player, out, 350);
  assert_true(scene->network->force[0] > 0.6 && scene->network->force[0] < 0.8);
  scene_player_run(player, out, 50);
  scene_player_run(player, out, 1);
  assert_true(scene->network->force[0] == 0.0);
  scene_player_free(player);
  scene_free(scene);
}

/* 1e17 + 1 − 1e17 is 0 in double. */
static void a_push_ends_before_the_next_begins(void** state) {
  (void)state;
  Scene* const scene = scenes_read(MASS "at 0.1 push a 1 for 0.3\nat 0 push a 1e17 for 0.1\n"
                                        "pickup a 1\nend 1\n");
  ScenePlayer* const player = scene_player_new(scene, RATE_HZ);
  double out[101];
  scene_player_run(player, out, 101);
  assert_true(scene->network->force[0] == 1.0);
  scene_player_free(player);
  scene_free(scene);
}

static void block_size_does_not_change_the_sound(void** state) {
  (void)state;
  static const char text[] =
      "rate 6000\nstring s 5 mass 1 stiffness 28e6 damping 7\nat 0 displace s.2 1e-3\n"
      "at 0.1 push s.4 3 for 0.0123\nat 0.2 strike s.1 0.1\npickup s.4 1\npickup s.1 -2\nend 0.5\n";
  size_t n = 0;
  double* const out = play_blocks(text, 0.0, 4096, &n);
  for (uint32_t block = 1; block < 100; block += 48) {
    double* const other = play_blocks(text, 0.0, block, &n);
    assert_memory_equal(out, other, n * sizeof(double));
    free(other);
  }
  free(out);
}

static void times_stay_where_they_are_at_another_rate(void** state) {
  (void)state;
  size_t n = 0;
  double* const out =
      play_blocks(MASS "at 0.5 displace a 1\npickup a 1\nend 1\n", 48000.0, 256, &n);
  assert_int_equal(n, 48000);
  assert_true(out[23999] == 0.0);
  assert_true(out[24000] == 1.0);
  free(out);
}

/* The paper's string: 440 Hz and 1 s. */
static void a_scene_has_the_pitch_it_is_made_for(void** state) {
  (void)state;
  size_t n = 0;
  double* const out =
      play("rate 6000\nstring s 5 mass 1 stiffness 28018382.290630583 damping 7.46285773641449\n"
           "at 0 displace s.2 1\nat 0 displace s.3 1\npickup s.4 1\nend 4\n",
           &n);
  float* const samples = malloc(n * sizeof(float));
  Tone tone = {0};
  assert_non_null(samples);
  for (size_t i = 0; i < n; ++i) {
    samples[i] = (float)out[i];
  }
  assert_true(measure_tone(samples, n, 6000.0, (Tone){440.0, 1.0}, &tone));
  assert_within("cents", fabs(measure_cents(tone.f0_hz, 440.0)), 0.001);
  assert_within("decay", fabs(tone.tau_s - 1.0), 1e-4);
  free(samples);
  free(out);
}

static void what_no_longer_moves_is_brought_to_rest(void** state) {
  (void)state;
  size_t n = 0;
  double* const out = play(MASS "at 0 displace a 1\nat 60 displace a 1\npickup a 1\nend 61\n", &n);
  assert_true(out[59000] == 0.0);
  assert_true(out[60000] == 1.0);
  free(out);
}

static void an_explosion_is_noticed(void** state) {
  (void)state;
  Scene* const scene =
      scenes_read("rate 1000\nmass a 1\nmass b 1\nground g\nspring a g 1e7\nspring b g 1\n"
                  "at 0 displace a 1\npickup b 1\nend 1\n");
  ScenePlayer* const player = scene_player_new(scene, RATE_HZ);
  double out[1000];
  scene_player_run(player, out, 10);
  assert_true(scene_player_settle(player));
  scene_player_run(player, out, 990);
  assert_false(scene_player_settle(player));
  scene_player_free(player);
  scene_free(scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_displaced_mass_moves_as_its_poles_say),
      cmocka_unit_test(a_struck_mass_moves_as_its_poles_say),
      cmocka_unit_test(a_pushed_mass_moves_as_the_sum_of_impulses),
      cmocka_unit_test(events_come_by_time_and_not_by_line),
      cmocka_unit_test(events_of_one_step_keep_the_order_of_the_file),
      cmocka_unit_test(a_push_that_is_over_leaves_no_force),
      cmocka_unit_test(a_push_ends_before_the_next_begins),
      cmocka_unit_test(block_size_does_not_change_the_sound),
      cmocka_unit_test(times_stay_where_they_are_at_another_rate),
      cmocka_unit_test(a_scene_has_the_pitch_it_is_made_for),
      cmocka_unit_test(what_no_longer_moves_is_brought_to_rest),
      cmocka_unit_test(an_explosion_is_noticed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
