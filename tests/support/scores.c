#include "tests/support/scores.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

Score* scores_read_bytes(const void* data, size_t size, ScoresRead* read) {
  temporary_file(data, size, read->path);
  read->error[0] = '\0';
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
