#define _POSIX_C_SOURCE 200809L

#include "tools/scene.h"

#include "tests/random.h"
#include "tools/bytes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

/* Where a scene was, and what was said about it. */
typedef struct {
  char path[64];
  char error[SCENE_ERROR_SIZE];
} Read;

static Scene* read_bytes(const void* data, size_t size, ScenePurpose purpose, Read* read) {
  strcpy(read->path, "/tmp/hooke_scene_XXXXXX");
  read->error[0] = '\0';
  const int fd = mkstemp(read->path);
  assert_true(fd >= 0);
  assert_int_equal(write(fd, data, size), size);
  assert_int_equal(close(fd), 0);
  Scene* const scene = scene_new(read->path, purpose, read->error, sizeof(read->error));
  assert_int_equal(unlink(read->path), 0);
  return scene;
}

static Scene* read_text(const char* text, Read* read) {
  return read_bytes(text, strlen(text), SCENE_FOR_SOUND, read);
}

static Scene* read_sound(const char* text) {
  Read read;
  Scene* const scene = read_text(text, &read);
  if (!scene) {
    fail_msg("%s", read.error);
  }
  return scene;
}

static void assert_refused(const char* text, size_t size, unsigned line, const char* what) {
  Read read;
  char start[128];
  assert_null(read_bytes(text, size, SCENE_FOR_SOUND, &read));
  (void)snprintf(start, sizeof(start), "%s:%u: found ", read.path, line);
  if (strncmp(read.error, start, strlen(start)) != 0 || !strstr(read.error, what) ||
      !strstr(read.error, ", expected ") || strchr(read.error, '\n')) {
    fail_msg("'%s' does not say '%s…%s' in one line", read.error, start, what);
  }
}

#define HEAD                                                                                       \
  "rate 6000\nmass a 2\nground g\nspring a g 5\nstring s 3 mass 1 stiffness 2 damping 0\n"
#define TAIL "pickup a 1\nend 2\n"

static void the_statements_are_all_there(void** state) {
  (void)state;
  Scene* const scene = read_sound("rate 6000\n"
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

static const struct {
  const char* text;
  unsigned line;
  const char* what;
} refusals[] = {
    {"", 1, "found the end of the file, expected 'rate HZ'"},
    {"# nothing\n\n", 2, "found the end of the file, expected 'rate HZ'"},
    {"rate 1\n", 1, "expected a mass or a string"},
    {"rate 1\nground g\n", 2, "expected a mass or a string"},
    {HEAD "end 2\n", 6, "found the end of the file, expected 'pickup MASS GAIN'"},
    {HEAD "pickup a 1\n", 6, "found the end of the file, expected 'end T'"},
    {"mass a 1\nground g\nspring a g 1\n" TAIL, 5, "expected 'rate HZ'"},
    {HEAD "sprong a g 5\n" TAIL, 6, "found 'sprong', expected rate, string, mass"},
    {HEAD "Mass b 5\n" TAIL, 6, "found 'Mass', expected rate"},
    {HEAD "at 0 hit a 5\n" TAIL, 6, "found 'hit', expected displace, strike or push"},
    {HEAD "at 0\n" TAIL, 6, "found the end of the line, expected displace, strike or push"},
    {HEAD "at a displace a 5\n" TAIL, 6, "found 'a', expected a time from 0 to 1e6 s"},
    {HEAD "at -1 displace a 5\n" TAIL, 6, "found '-1', expected a time"},
    {HEAD "at 1 displace a far\n" TAIL, 6, "found 'far', expected a displacement"},
    {HEAD "at 1 strike a hard\n" TAIL, 6, "found 'hard', expected a velocity"},
    {HEAD "at 1 push a hard\n" TAIL, 6, "found 'hard', expected a force"},
    {HEAD "at 1 push a 3 during 1\n" TAIL, 6, "found 'during', expected 'for'"},
    {HEAD "at 1 push a 3 for 0\n" TAIL, 6, "found '0', expected a duration above 0"},
    {HEAD "at 1 push a 3\n" TAIL, 6, "found the end of the line, expected 'for'"},
    {HEAD "at 2 displace a 5\n" TAIL, 6, "found a time of 2 s, expected one before the end at 2 s"},
    {HEAD "spring a b 5\nmass b 1\n" TAIL, 6, "found 'b', expected a point declared above"},
    {HEAD "damper b a 5\nmass b 1\n" TAIL, 6, "found 'b', expected a point declared above"},
    {HEAD "at 0 displace b 5\n" TAIL, 6, "found 'b', expected a mass declared above"},
    {HEAD "pickup b 1\nmass b 1\n" TAIL, 6, "found 'b', expected a mass declared above"},
    {HEAD "pickup g 1\n" TAIL, 6, "found 'g', a ground, expected a mass"},
    {HEAD "at 0 push g 1 for 1\n" TAIL, 6, "found 'g', a ground, expected a mass"},
    {HEAD "spring a s 5\n" TAIL, 6, "found 's', expected one of the string's masses, 1 to 3"},
    {HEAD "spring a s.0 5\n" TAIL, 6, "found 's.0', expected one of the string's masses"},
    {HEAD "spring a s.4 5\n" TAIL, 6, "found 's.4', expected one of the string's masses"},
    {HEAD "spring a s.4294967297 5\n" TAIL, 6, "expected one of the string's masses"},
    {HEAD "spring a s.1x 5\n" TAIL, 6, "found 's.1x', expected one of the string's masses"},
    {HEAD "spring a s. 5\n" TAIL, 6, "found 's.', expected one of the string's masses"},
    {HEAD "spring a g.1 5\n" TAIL, 6, "found 'g.1', expected a point declared above"},
    {HEAD "mass a 5\n" TAIL, 6, "found 'a', declared in line 2 already, expected a new name"},
    {HEAD "ground s\n" TAIL, 6, "found 's', declared in line 5 already, expected a new name"},
    {HEAD "string a 3 mass 1 stiffness 1 damping 0\n" TAIL, 6, "found 'a', declared in line 2"},
    {HEAD "rate 5\n" TAIL, 6, "found a second 'rate', expected the one in line 1 only"},
    {HEAD TAIL "end 3\n", 8, "found a second 'end', expected the one in line 7 only"},
    {HEAD "mass 1b 5\n" TAIL, 6, "found '1b', expected a new name"},
    {HEAD "mass s.1 5\n" TAIL, 6, "found 's.1', expected a new name"},
    {HEAD "mass b 0\n" TAIL, 6, "found '0', expected a mass above 0 kg"},
    {HEAD "mass b -1\n" TAIL, 6, "found '-1', expected a mass above 0 kg"},
    {HEAD "mass b 1e-400\n" TAIL, 6, "found '1e-400', expected a mass above 0 kg"},
    {HEAD "mass b 1e400\n" TAIL, 6, "found '1e400', expected a mass above 0 kg"},
    {HEAD "mass b nan\n" TAIL, 6, "found 'nan', expected a mass above 0 kg"},
    {HEAD "mass b inf\n" TAIL, 6, "found 'inf', expected a mass above 0 kg"},
    {HEAD "mass b 0x10\n" TAIL, 6, "found '0x10', expected a mass above 0 kg"},
    {HEAD "mass b 1kg\n" TAIL, 6, "found '1kg', expected a mass above 0 kg"},
    {HEAD "mass b 1,5\n" TAIL, 6, "found '1,5', expected a mass above 0 kg"},
    {HEAD "mass b\n" TAIL, 6, "found the end of the line, expected a mass above 0 kg"},
    {HEAD "mass b # 5\n" TAIL, 6, "found the end of the line, expected a mass above 0 kg"},
    {HEAD "mass b 5 6\n" TAIL, 6, "found '6', expected the end of the line"},
    {HEAD "ground h 6\n" TAIL, 6, "found '6', expected the end of the line"},
    {HEAD "at 0 displace a 1 2\n" TAIL, 6, "found '2', expected the end of the line"},
    {HEAD "spring a g -5\n" TAIL, 6, "found '-5', expected a stiffness from 0 N/m up"},
    {HEAD "damper a g -5\n" TAIL, 6, "found '-5', expected a damping from 0 kg/s up"},
    {HEAD "spring a a 5\n" TAIL, 6, "found 'a' at both ends, expected two points"},
    {HEAD "damper s.2 s.2 5\n" TAIL, 6, "found 's.2' at both ends, expected two points"},
    {HEAD "spring s.2 s.02 5\n" TAIL, 6, "at both ends, expected two points"},
    {HEAD "string t 0 mass 1 stiffness 1 damping 0\n" TAIL, 6,
     "found '0', expected a whole number"},
    {HEAD "string t 2.5 mass 1 stiffness 1 damping 0\n" TAIL, 6, "found '2.5', expected a whole"},
    {HEAD "string t 1e9 mass 1 stiffness 1 damping 0\n" TAIL, 6, "found '1e9', expected a whole"},
    {HEAD "string t 5 stiffness 1\n" TAIL, 6, "found 'stiffness', expected 'mass'"},
    {HEAD "string t 5 mass 1 damping 1\n" TAIL, 6, "found 'damping', expected 'stiffness'"},
    {HEAD "string t 5 mass 1 stiffness 1\n" TAIL, 6,
     "found the end of the line, expected 'damping'"},
    {HEAD "string t 5 mass 0 stiffness 1 damping 0\n" TAIL, 6, "found '0', expected a mass above"},
    {HEAD "mass b 1\n" TAIL, 6, "found 'b' hanging on no ground, expected springs"},
    {HEAD "mass b 1\nspring b a 0\n" TAIL, 6, "found 'b' hanging on no ground, expected springs"},
    {HEAD "mass b 1\ndamper b g 1\n" TAIL, 6, "found 'b' hanging on no ground, expected springs"},
    {HEAD "string t 4 mass 1 stiffness 0 damping 0\n" TAIL, 6, "found 't' hanging on no ground"},
    {"rate 0\n", 1, "found '0', expected a rate above 0"},
    {"rate 2e9\n", 1, "found '2e9', expected a rate above 0"},
    {"rate\n", 1, "found the end of the line, expected a rate"},
    {HEAD "end 0\n", 6, "found '0', expected a duration above 0"},
    {HEAD "pickup a loud\n", 6, "found 'loud', expected a gain"},
    {HEAD "pickup a\n", 6, "found the end of the line, expected a gain"},
    {HEAD "mass a\033[31m 5\n" TAIL, 6, "found 'a?[31m', expected a new name"},
    {"rate 6000\r\nmass a 1\r\nmass a 2\r\n", 3, "found 'a', declared in line 2"},
    {"rate 6000\nbad", 2, "found 'bad', expected rate"},
};

static void what_is_wrong_is_told_by_line_and_word(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(refusals) / sizeof(refusals[0]); ++i) {
    const char* const text = refusals[i].text;
    assert_refused(text, strlen(text), refusals[i].line, refusals[i].what);
  }
}

static void a_nul_byte_is_refused_wherever_it_is(void** state) {
  (void)state;
  static const char inside[] = HEAD "mass b\0 5\n" TAIL;
  static const char in_comment[] = HEAD "# \0\n" TAIL;
  static const char last[] = HEAD TAIL "\0";
  assert_refused(inside, sizeof(inside) - 1, 6, "found a NUL byte, expected text");
  assert_refused(in_comment, sizeof(in_comment) - 1, 6, "found a NUL byte, expected text");
  assert_refused(last, sizeof(last) - 1, 8, "found a NUL byte, expected text");
}

static void a_long_word_is_cut_in_the_message(void** state) {
  (void)state;
  enum { LENGTH = 1000000 };
  char* const text = malloc(LENGTH);
  assert_non_null(text);
  memset(text, 'x', LENGTH);
  assert_refused(text, LENGTH, 1, "found 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...', expected");
  free(text);
}

static void a_long_comment_is_no_matter(void** state) {
  (void)state;
  static const char text[] = HEAD TAIL "#";
  enum { LENGTH = 1000000 };
  Read read;
  char* const longer = malloc(LENGTH);
  assert_non_null(longer);
  memset(longer, '#', LENGTH);
  memcpy(longer, text, sizeof(text) - 1);
  Scene* const scene = read_bytes(longer, LENGTH, SCENE_FOR_SOUND, &read);
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
    Scene* const scene = read_sound(texts[i]);
    assert_true(scene->rate_hz == 6000.0 && scene->end_s == 2.0);
    assert_true(scene->network->mass_kg[0] == 2.0);
    assert_true(scene->network->springs.link[0].value == 5.0);
    scene_free(scene);
  }
}

static void names_have_letters_of_all_alphabets(void** state) {
  (void)state;
  Scene* const scene = read_sound("rate 1\nstring cordes-à_vide2 2 mass 1 stiffness 1 damping 0\n"
                                  "mass rate 1\nspring rate cordes-à_vide2.2 1\n"
                                  "pickup cordes-à_vide2.1 1\nend 1\n");
  assert_int_equal(scene->network->n_masses, 3);
  scene_free(scene);
}

static void modes_need_neither_pickup_nor_end(void** state) {
  (void)state;
  Read read;
  Scene* const scene = read_bytes(HEAD, sizeof(HEAD) - 1, SCENE_FOR_MODES, &read);
  assert_non_null(scene);
  assert_true(scene->end_s == 0.0 && scene->n_pickups == 0);
  scene_free(scene);
}

static void a_file_that_cannot_be_read_is_named(void** state) {
  (void)state;
  char error[SCENE_ERROR_SIZE];
  assert_null(scene_new("/nowhere/x.scene", SCENE_FOR_SOUND, error, sizeof(error)));
  assert_string_equal(error, "/nowhere/x.scene: No such file or directory");
  assert_null(scene_new("/", SCENE_FOR_SOUND, error, sizeof(error)));
  assert_string_equal(error, "/: Is a directory");
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
  Read read;
  add_line(&bytes, "rate 48000\nground ground\nmass number0 1\nspring number0 ground 5\n");
  for (int i = 1; i < N; ++i) {
    add_line(&bytes, "mass number%d 0.00125\nspring number%d number%d 123.456 # a link\n", i, i,
             i - 1);
    add_line(&bytes, "damper number%d ground 1e-3\nat %.5f push number%d 1e-3 for 0.01\n", i,
             1e-4 * (N - i), i);
  }
  add_line(&bytes, "pickup number7 1\nend 10\n");
  const clock_t start = clock();
  Scene* const scene = read_bytes(bytes.data, bytes.size, SCENE_FOR_SOUND, &read);
  const double cpu_s = (double)(clock() - start) / CLOCKS_PER_SEC;
  if (!scene) {
    fail_msg("%s", read.error);
  }
  printf("%d lines: %.3f s\n", 4 * N, cpu_s);
  assert_int_equal(scene->network->n_masses, N);
  assert_int_equal(scene->n_events, N - 1);
  assert_true(cpu_s < 1.0);
  scene_free(scene);
  bytes_clear(&bytes);
}

/* Letters changed, cut out and doubled: a scene or one line about it, and never a free network. */
static void spoilt_scenes_are_read_or_refused(void** state) {
  (void)state;
  static const char text[] = HEAD "at 1 push s.2 3 for 0.5\nat 0 displace a 1e-3\n" TAIL;
  static const char letters[] = "\n\r\t #.0123456789-+eaghs\0\xff";
  Random random = random_start();
  int n_read = 0;
  for (int i = 0; i < 3000; ++i) {
    char spoilt[sizeof(text)];
    Read read;
    memcpy(spoilt, text, sizeof(text));
    for (uint32_t n = 1 + random_below(&random, 3); n > 0; --n) {
      spoilt[random_below(&random, sizeof(text) - 1)] =
          letters[random_below(&random, sizeof(letters) - 1)];
    }
    Scene* const scene = read_bytes(spoilt, sizeof(text) - 1, SCENE_FOR_SOUND, &read);
    n_read += scene ? 1 : 0;
    assert_true(!scene || network_find_free(scene->network, NULL) == STATUS_OK);
    assert_true(scene || (!strncmp(read.error, read.path, strlen(read.path)) &&
                          strstr(read.error, ": found ") && !strchr(read.error, '\n')));
    scene_free(scene);
  }
  printf("%d of 3000 are still scenes\n", n_read);
  assert_in_range(n_read, 30, 2970);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_statements_are_all_there),
      cmocka_unit_test(what_is_wrong_is_told_by_line_and_word),
      cmocka_unit_test(a_nul_byte_is_refused_wherever_it_is),
      cmocka_unit_test(a_long_word_is_cut_in_the_message),
      cmocka_unit_test(a_long_comment_is_no_matter),
      cmocka_unit_test(line_ends_tabs_and_marks_do_not_matter),
      cmocka_unit_test(names_have_letters_of_all_alphabets),
      cmocka_unit_test(modes_need_neither_pickup_nor_end),
      cmocka_unit_test(a_file_that_cannot_be_read_is_named),
      cmocka_unit_test(a_hundred_thousand_lines_load_within_a_second),
      cmocka_unit_test(spoilt_scenes_are_read_or_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
