#define _POSIX_C_SOURCE 200809L

#include "plugin/files_read.h"

#include "tests/support/scale_host.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#define FIFTHS "fifths\n1\n3/2\n"
#define BOX "# a box\n\nmode 100 20 0.1 1 0.5\n"
#define FROM_C "0\n0\n127\n60\n60\n261\n0\n"

static void clear(FilesContent* content) {
  scale_free(&content->scale);
  scale_map_free(&content->map);
}

static void the_ending_or_else_the_text_says_what_a_file_is(void** state) {
  static const struct {
    const char* name;
    const char* text;
    FilesKind file;
    bool is_good;
  } files[] = {
      {"a.scl", FIFTHS, FILES_SCALE, true},
      {"a.SCL", FIFTHS, FILES_SCALE, true},
      {"a.ascl", "! @ABL NOTE_NAMES C D\n! a.ascl\n" FIFTHS "! @ABL REFERENCE_PITCH 4 0 261.6\n",
       FILES_SCALE, true},
      {"a.kbm", FROM_C, FILES_MAPPING, true},
      {"a.Kbm", FROM_C, FILES_MAPPING, true},
      {"a.scl", FROM_C, FILES_SCALE, true}, // 0 notes
      {"a.kbm", FIFTHS, FILES_MAPPING, false},
      {"a.txt", FIFTHS, FILES_SCALE, true},
      {"a", FROM_C, FILES_MAPPING, true},
      {"a.body", BOX, FILES_BODY, true},
      {"a.BODY", BOX, FILES_BODY, true},
      {"a.body", FIFTHS, FILES_BODY, false},
      {"a.scl", BOX, FILES_SCALE, false},
      {"a.kbm", BOX, FILES_MAPPING, false},
      {"a.txt", BOX, FILES_BODY, true},
      {"body", BOX, FILES_BODY, true},
  };
  const ScalePath directory = scale_new_directory();
  (void)state;
  for (size_t i = 0; i < sizeof(files) / sizeof(*files); ++i) {
    for (int asked = 0; asked < FILES_COUNT; ++asked) {
      FilesContent content;
      FilesFault fault = {""};
      const ScalePath path = scale_write(&directory, files[i].name, files[i].text);
      files_read(path.text, (FilesKind)asked, true, &content, &fault);
      assert_int_equal(content.file, files[i].file);
      assert_int_equal(content.is_good, files[i].is_good);
      assert_int_equal(fault.line[0] == '\0', content.is_good);
      assert_int_equal(content.body.n_modes, content.is_good && content.file == FILES_BODY);
      clear(&content);
    }
  }
  scale_remove_directory(&directory);
}

static void what_is_nothing_counts_as_what_was_asked_for(void** state) {
  static const char* const expected[FILES_COUNT] = {"the number of notes", "the size", "mode"};
  const ScalePath directory = scale_new_directory();
  const ScalePath path = scale_write(&directory, "letter", "Dear all,\n");
  (void)state;
  for (int asked = 0; asked < FILES_COUNT; ++asked) {
    FilesContent content;
    FilesFault fault;
    files_read(path.text, (FilesKind)asked, true, &content, &fault);
    assert_int_equal(content.file, asked);
    assert_false(content.is_good);
    assert_non_null(strstr(fault.line, expected[asked]));
  }
  scale_remove_directory(&directory);
}

/* A pipe that nobody writes to, one that never ends, and the kernel's log, which waits for the next
 * line, are refused or empty at once. */
static void nobody_is_waited_for(void** state) {
  const ScalePath directory = scale_new_directory();
  const ScalePath pipe = scale_write(&directory, "pipe.scl", "");
  static const char* const others[] = {"/dev/zero", "/dev/tty", "/proc/kmsg", "/"};
  static const char* const why[] = {"(not a plain file)", "(not a plain file)",
                                    "(not a plain file)", "", "(Is a directory)"};
  (void)state;
  assert_int_equal(remove(pipe.text), 0);
  assert_int_equal(mkfifo(pipe.text, 0600), 0);
  for (size_t i = 0; i <= sizeof(others) / sizeof(*others); ++i) {
    FilesContent content;
    FilesFault fault = {""};
    files_read(i ? others[i - 1] : pipe.text, FILES_SCALE, false, &content, &fault);
    assert_false(content.is_good);
    assert_true(strlen(fault.line) > 0);
    assert_non_null(strstr(fault.line, why[i]));
    print_message("%s\n", fault.line);
  }
  scale_remove_directory(&directory);
}

static void a_line_of_the_log_is_one_line(void** state) {
  FilesContent content;
  FilesFault fault;
  (void)state;
  files_read("/no\nsuch\x1b[2Jfile\x7f", FILES_SCALE, true, &content, &fault);
  assert_string_equal(fault.line, "/no?such?[2Jfile?:1: found no text (No such file or directory), "
                                  "expected a Scala scale (.scl)");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_ending_or_else_the_text_says_what_a_file_is),
      cmocka_unit_test(what_is_nothing_counts_as_what_was_asked_for),
      cmocka_unit_test(nobody_is_waited_for),
      cmocka_unit_test(a_line_of_the_log_is_one_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
