#include "tools/formats/escape.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const struct {
  const char* text;
  const char* shown;
} cases[] = {
    {"", ""},
    {"tune.mid", "tune.mid"},
    {"a b\\c'd\"~", "a b\\c'd\"~"},
    {"a\nb\tc\rd", "a\\nb\\tc\\rd"},
    {"\033[31m\x7f\x01", "\\x1b[31m\\x7f\\x01"},
    {"Übung ♯ 𝄞", "Übung ♯ 𝄞"},
    {"\xc2\x9b"
     "31m",
     "\\xc2\\x9b31m"},
    {"\xc2\xa0", "\xc2\xa0"},
    {"\x9b"
     "1m",
     "\\x9b1m"},
    {"\xff\xc0\x80", "\\xff\\xc0\\x80"},
    {"\xe2\x99", "\\xe2\\x99"},
    {"\xe2\x99\n", "\\xe2\\x99\\n"},
    {"\xf5\x80\x80\x80", "\\xf5\\x80\\x80\\x80"},
};

static void what_moves_a_terminal_is_spelt(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
    char shown[128];
    assert_string_equal(escape_text(cases[i].text, shown, sizeof(shown)), "");
    assert_string_equal(shown, cases[i].shown);
  }
}

/* Every byte, before and behind every other: what is shown is one line without a control
 * character. */
static void no_two_bytes_make_another_line(void** state) {
  (void)state;
  for (unsigned a = 1; a < 256; ++a) {
    for (unsigned b = 1; b < 256; ++b) {
      const char text[] = {(char)a, (char)b, '\0'};
      char shown[16];
      assert_string_equal(escape_text(text, shown, sizeof(shown)), "");
      for (const char* letter = shown; *letter; ++letter) {
        assert_true((unsigned char)*letter >= ' ' && *letter != 0x7f);
      }
      if (strlen(shown) == 2 && a >= 0x80) {
        assert_true(a >= 0xc2 && (a > 0xc2 || b >= 0xa0));
      }
    }
  }
}

static void it_is_cut_between_characters(void** state) {
  (void)state;
  static const char TEXT[] = "a\nb♯c";
  static const char* const SHOWN[] = {"", "a", "a", "a\\n", "a\\nb", "a\\nb", "a\\nb", "a\\nb♯"};
  static const char* const REST[] = {TEXT,     TEXT + 1, TEXT + 1, TEXT + 2,
                                     TEXT + 3, TEXT + 3, TEXT + 3, TEXT + 6};
  for (size_t size = 1; size <= 8; ++size) {
    char shown[16];
    memset(shown, 'x', sizeof(shown));
    assert_ptr_equal(escape_text(TEXT, shown, size), REST[size - 1]);
    assert_string_equal(shown, SHOWN[size - 1]);
    assert_int_equal(shown[size], 'x');
  }
  char shown[16];
  assert_ptr_equal(escape_text(TEXT, shown, 9), TEXT + 7);
  assert_string_equal(shown, "a\\nb♯c");
}

static void streams_get_all_of_it(void** state) {
  (void)state;
  enum { N = 1000 };
  char text[N + 1] = "";
  char shown[4 * N + 1] = "";
  FILE* const stream = tmpfile();
  assert_non_null(stream);
  memset(text, '\033', N);
  escape_print(stream, text);
  rewind(stream);
  assert_int_equal(fread(shown, 1, sizeof(shown), stream), 4 * N);
  for (size_t i = 0; i < N; ++i) {
    assert_memory_equal(shown + 4 * i, "\\x1b", 4);
  }
  assert_int_equal(fclose(stream), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_moves_a_terminal_is_spelt),
      cmocka_unit_test(no_two_bytes_make_another_line),
      cmocka_unit_test(it_is_cut_between_characters),
      cmocka_unit_test(streams_get_all_of_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
