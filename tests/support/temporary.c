#define _POSIX_C_SOURCE 200809L

#include "tests/support/temporary.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmocka.h>

static void name(char* path) {
  const char* const folder = getenv("TMPDIR");
  const int length =
      snprintf(path, TEMPORARY_SIZE, "%s/hooke_XXXXXX", folder && *folder ? folder : "/tmp");
  assert_true(length > 0 && length < TEMPORARY_SIZE);
}

void temporary_file(const void* data, size_t size, char* path) {
  name(path);
  const int file = mkstemp(path);
  assert_true(file >= 0);
  assert_int_equal(write(file, data, size), size);
  assert_int_equal(close(file), 0);
}

void temporary_folder(char* path) {
  name(path);
  assert_non_null(mkdtemp(path));
}
