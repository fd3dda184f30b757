#include "tools/formats/scene.h"

#include "tests/support/random.h"
#include "tests/support/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void assert_refused(const char* text, size_t size, unsigned line, const char* what) {
  ScenesRead read;
  char start[TEMPORARY_SIZE + 64];
  assert_null(scenes_read_bytes(text, size, SCENE_FOR_SOUND, &read));
  (void)snprintf(start, sizeof(start), "%s:%u: found ", read.path, line);
  if (strncmp(read.error, start, strlen(start)) != 0 || !strstr(read.error, what) ||
      !strstr(read.error, ", expected ") || strchr(read.error, '\n')) {
    fail_msg("'%s' does not say '%s…%s' in one line", read.error, start, what);
  }
}

#define HEAD                                                                                       \
  "rate 6000\nmass a 2\nground g\nspring a g 5\nstring s 3 mass 1 stiffness 2 damping 0\n"
#define TAIL "pickup a 1\nend 2\n"

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
    {"rate 0\n", 1, "found '0', expected a rate above 0"},
    {"rate 2e9\n", 1, "found '2e9', expected a rate above 0"},
    {"rate\n", 1, "found the end of the line, expected a rate"},
    {HEAD "end 0\n", 6, "found '0', expected a duration above 0"},
    {HEAD "pickup a loud\n", 6, "found 'loud', expected a gain"},
    {HEAD "pickup a\n", 6, "found the end of the line, expected a gain"},
    {HEAD "mass a\033[31m 5\n" TAIL, 6, "found 'a\\x1b[31m', expected a new name"},
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

static void a_file_that_cannot_be_read_is_named(void** state) {
  (void)state;
  char error[SCENE_ERROR_SIZE];
  assert_null(scene_new("/nowhere/x.scene", SCENE_FOR_SOUND, error, sizeof(error)));
  assert_string_equal(error, "/nowhere/x.scene: No such file or directory");
  assert_null(scene_new("/", SCENE_FOR_SOUND, error, sizeof(error)));
  assert_string_equal(error, "/: Is a directory");
  assert_null(scene_new("/dev/zero", SCENE_FOR_SOUND, error, sizeof(error)));
  assert_string_equal(error, "/dev/zero: found more than 64 MiB, expected at most that");
}

/* Letters changed, cut out and doubled: a scene or one line about it. */
static void spoilt_scenes_are_read_or_refused(void** state) {
  (void)state;
  static const char text[] = HEAD "at 1 push s.2 3 for 0.5\nat 0 displace a 1e-3\n" TAIL;
  static const char letters[] = "\n\r\t #.0123456789-+eaghs\0\xff";
  Random random = random_start();
  int n_read = 0;
  for (int i = 0; i < 3000; ++i) {
    char spoilt[sizeof(text)];
    ScenesRead read;
    memcpy(spoilt, text, sizeof(text));
    for (uint32_t n = 1 + random_below(&random, 3); n > 0; --n) {
      spoilt[random_below(&random, sizeof(text) - 1)] =
          letters[random_below(&random, sizeof(letters) - 1)];
    }
    Scene* const scene = scenes_read_bytes(spoilt, sizeof(text) - 1, SCENE_FOR_SOUND, &read);
    n_read += scene ? 1 : 0;
    assert_true(!scene || scene->network->is_checked);
    assert_true(scene || (!strncmp(read.error, read.path, strlen(read.path)) &&
                          strstr(read.error, ": found ") && !strchr(read.error, '\n')));
    scene_free(scene);
  }
  printf("%d of 3000 are still scenes\n", n_read);
  assert_in_range(n_read, 30, 2970);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_wrong_is_told_by_line_and_word),
      cmocka_unit_test(a_nul_byte_is_refused_wherever_it_is),
      cmocka_unit_test(a_long_word_is_cut_in_the_message),
      cmocka_unit_test(a_file_that_cannot_be_read_is_named),
      cmocka_unit_test(spoilt_scenes_are_read_or_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
