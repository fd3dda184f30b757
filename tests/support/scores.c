#define _POSIX_C_SOURCE 200809L

#include "tests/support/scores.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

Score* scores_read_bytes(const void* data, size_t size, ScoresRead* read) {
  strcpy(read->path, "/tmp/hooke_score_XXXXXX");
  read->error[0] = '\0';
  const int fd = mkstemp(read->path);
  assert_true(fd >= 0);
  assert_int_equal(write(fd, data, size), size);
  assert_int_equal(close(fd), 0);
  Score* const score = score_new(read->path, read->error, sizeof(read->error));
  assert_int_equal(unlink(read->path), 0);
  return score;
}

Score* scores_read(const char* text) {
  ScoresRead read;
  Score* const score = scores_read_bytes(text, strlen(text), &read);
  if (!score) {
    fail_msg("%s", read.error);
  }
  return score;
}
