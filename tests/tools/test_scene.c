#include "tools/formats/scene.h"

#include "tests/support/scenes.h"
#include "tests/support/speed.h"
#include "tools/formats/bytes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#define HEAD "rate 6000\nmass a 2\nground g\nspring a g 5\n"
#define TAIL "pickup a 1\nend 2\n"

static void the_statements_are_all_there(void** state) {
  (void)state;
  Scene* const scene = scenes_read("rate 6000\n"
                                   "string s 5 mass 1.5 stiffness 28e6 damping 7.5 # s.1 to s.5\n"
                                   "mass a 0.002\n"
                                   "ground g\n"
                                   "spring a g 5000\n"
                                   "damper a g 0.01\n"
                                   "spring a s.3 200\n"
                                   "at 0.25 push a 3 for 0.005\n"
                                   "at 0.0 displace s.2 0.001\n"
                                   "at 1 strike s.5 -2e-3\n"
                                   "pickup s.4 1.0\n"
                                   "pickup a -0.5\n"
                                   "end 2.0\n");
  const Network* const network = scene->network;
  assert_true(scene->rate_hz == 6000.0 && scene->end_s == 2.0);
  assert_int_equal(network->n_points, 9);
  assert_int_equal(network->n_masses, 6);
  assert_true(network->mass_kg[0] == 1.5 && network->mass_kg[7] == 0.002);
  assert_true(network->is_ground[5] && network->is_ground[6] && network->is_ground[8]);
  assert_true(network->is_checked);
  assert_int_equal(network->springs.n, 8);
  assert_true(network->springs.link[0].value == 28e6 && network->springs.link[6].value == 5000.0);
  assert_int_equal(network->springs.link[7].from, 7);
  assert_int_equal(network->springs.link[7].to, 2);
  assert_int_equal(network->dampers.n, 7);
  assert_true(network->dampers.link[5].value == 7.5 && network->dampers.link[6].value == 0.01);
  assert_int_equal(scene->n_events, 3);
  const SceneEvent push = scene->events[0];
  assert_true(push.action == SCENE_PUSH && push.point == 7 && push.time_s == 0.25 &&
              push.value == 3.0 && push.duration_s == 0.005);
  assert_true(scene->events[1].action == SCENE_DISPLACE && scene->events[1].point == 1);
  assert_true(scene->events[2].action == SCENE_STRIKE && scene->events[2].value == -2e-3);
  assert_int_equal(scene->n_pickups, 2);
  assert_true(scene->pickups[0].point == 3 && scene->pickups[1].gain == -0.5);
  scene_free(scene);
}

static void a_long_comment_is_no_matter(void** state) {
  (void)state;
  static const char text[] = HEAD TAIL "#";
  enum { LENGTH = 1000000 };
  ScenesRead read;
  char* const longer = malloc(LENGTH);
  assert_non_null(longer);
  memset(longer, '#', LENGTH);
  memcpy(longer, text, sizeof(text) - 1);
  Scene* const scene = scenes_read_bytes(longer, LENGTH, SCENE_FOR_SOUND, &read);
  assert_non_null(scene);
  scene_free(scene);
  free(longer);
}

static void line_ends_tabs_and_marks_do_not_matter(void** state) {
  (void)state;
  static const char* const texts[] = {
      "rate 6000\r\nmass a 2\r\nground g\r\nspring a g 5\r\npickup a 1\r\nend 2\r\n",
      "\trate\t6000\n \tmass\ta 2\t\nground g\n\n\nspring a g 5\npickup a 1\nend 2",
      "\xef\xbb\xbfrate 6000\nmass a 2\nground g\nspring a g 5\npickup a 1\nend 2#",
      "rate +6000.\nmass a 2e0#kg\nground g\nspring a g .5E1\npickup a 1\nend 2\r",
      "# a\r\nend 2\nmass a 2\nground g\npickup a 1\nspring a g 5\nrate 6e3\n",
  };
  for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); ++i) {
    Scene* const scene = scenes_read(texts[i]);
    assert_true(scene->rate_hz == 6000.0 && scene->end_s == 2.0);
    assert_true(scene->network->mass_kg[0] == 2.0);
    assert_true(scene->network->springs.link[0].value == 5.0);
    scene_free(scene);
  }
}

static void names_have_letters_of_all_alphabets(void** state) {
  (void)state;
  Scene* const scene = scenes_read("rate 1\nstring cordes-à_vide2 2 mass 1 stiffness 1 damping 0\n"
                                   "mass rate 1\nspring rate cordes-à_vide2.2 1\n"
                                   "pickup cordes-à_vide2.1 1\nend 1\n");
  assert_int_equal(scene->network->n_masses, 3);
  scene_free(scene);
}

static void modes_need_neither_pickup_nor_end(void** state) {
  (void)state;
  ScenesRead read;
  Scene* const scene = scenes_read_bytes(HEAD, sizeof(HEAD) - 1, SCENE_FOR_MODES, &read);
  assert_non_null(scene);
  assert_true(scene->end_s == 0.0 && scene->n_pickups == 0);
  scene_free(scene);
}

__attribute__((format(printf, 2, 3))) static void add_line(Bytes* bytes, const char* format, ...) {
  char line[128];
  va_list args;
  va_start(args, format);
  const int n = vsnprintf(line, sizeof(line), format, args);
  va_end(args);
  assert_true(bytes_append(bytes, line, (size_t)n));
}

/* Masses in a ring of springs, each with a damper to the ground, and each pushed once. */
static void a_hundred_thousand_lines_load_within_a_second(void** state) {
  (void)state;
  enum { N = 25000 };
  Bytes bytes = {0};
  ScenesRead read;
  add_line(&bytes, "rate 48000\nground ground\nmass number0 1\nspring number0 ground 5\n");
  for (int i = 1; i < N; ++i) {
    add_line(&bytes, "mass number%d 0.00125\nspring number%d number%d 123.456 # a link\n", i, i,
             i - 1);
    add_line(&bytes, "damper number%d ground 1e-3\nat %.5f push number%d 1e-3 for 0.01\n", i,
             1e-4 * (N - i), i);
  }
  add_line(&bytes, "pickup number7 1\nend 10\n");
  const clock_t start = clock();
  Scene* const scene = scenes_read_bytes(bytes.data, bytes.size, SCENE_FOR_SOUND, &read);
  const double cpu_s = (double)(clock() - start) / CLOCKS_PER_SEC;
  if (!scene) {
    fail_msg("%s", read.error);
  }
  printf("%d lines: %.3f s\n", 4 * N, cpu_s);
  assert_int_equal(scene->network->n_masses, N);
  assert_int_equal(scene->n_events, N - 1);
  assert_true(cpu_s < 1.0 * speed_slowdown());
  scene_free(scene);
  bytes_clear(&bytes);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_statements_are_all_there),
      cmocka_unit_test(a_long_comment_is_no_matter),
      cmocka_unit_test(line_ends_tabs_and_marks_do_not_matter),
      cmocka_unit_test(names_have_letters_of_all_alphabets),
      cmocka_unit_test(modes_need_neither_pickup_nor_end),
      cmocka_unit_test(a_hundred_thousand_lines_load_within_a_second),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
