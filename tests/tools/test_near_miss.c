#include "tools/commands/near_miss.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const char* const NAMES[] = {"release", "level",   "damping", "exciter", "pickup",
                                    "pickup2", "enabled", "string1", "strum",   "Iron Frame",
                                    "render",  "capo",    "a"};

static const struct {
  const char* word;
  const char* name; /* NULL: none is near */
} cases[] = {
    {"relase", "release"},
    {"releaze", "release"},
    {"rlease", "release"},
    {"releaes", "release"},
    {"releases", "release"},
    {"RELEASE", "release"},
    {"leevl", "level"},
    {"dampnig", "damping"},
    {"pickup3", "pickup"},
    {"srtum", "strum"},
    {"iron fram", "Iron Frame"},
    {"Iron", "Iron Frame"},
    {"Ir", NULL},
    {"ron", NULL},
    {"loudness", NULL},
    {"xyz", NULL},
    {"", NULL},
    {"b", NULL},
    {"rednre", "render"},
    {"cpao", "capo"},
};

static void the_nearest_name_is_meant(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
    NearMiss miss = near_miss_of(cases[i].word);
    for (size_t k = 0; k < sizeof(NAMES) / sizeof(NAMES[0]); ++k) {
      near_miss_try(&miss, NAMES[k]);
    }
    if (cases[i].name) {
      assert_non_null(miss.name);
      assert_string_equal(miss.name, cases[i].name);
    } else {
      assert_null(miss.name);
    }
  }
}

static void the_hint_is_said_or_not(void** state) {
  (void)state;
  char hint[64] = "x";
  NearMiss miss = near_miss_of("relase");
  assert_string_equal(near_miss_hint(&miss, hint, sizeof(hint)), "");
  near_miss_try(&miss, "release");
  assert_string_equal(near_miss_hint(&miss, hint, sizeof(hint)), "; did you mean release?");
  assert_string_equal(near_miss_hint(&miss, hint, 5), "; di");
}

static void words_of_any_length_are_borne(void** state) {
  (void)state;
  char longest[4096];
  memset(longest, 'x', sizeof(longest));
  longest[sizeof(longest) - 1] = '\0';
  NearMiss miss = near_miss_of(longest);
  near_miss_try(&miss, "release");
  near_miss_try(&miss, longest);
  assert_null(miss.name);
  miss = near_miss_of("release");
  near_miss_try(&miss, longest);
  near_miss_try(&miss, "");
  assert_null(miss.name);
  longest[63] = '\0';
  miss = near_miss_of(longest);
  near_miss_try(&miss, longest);
  assert_ptr_equal(miss.name, longest);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_nearest_name_is_meant),
      cmocka_unit_test(the_hint_is_said_or_not),
      cmocka_unit_test(words_of_any_length_are_borne),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
