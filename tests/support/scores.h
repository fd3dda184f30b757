/** Scores from text, for tests. */
#ifndef HOOKE_TESTS_SUPPORT_SCORES_H
#define HOOKE_TESTS_SUPPORT_SCORES_H

#include "tests/support/temporary.h"
#include "tools/formats/score.h"

#include <stddef.h>

/** Where a score was, and what was said about it. */
typedef struct {
  char path[TEMPORARY_SIZE];
  char error[SCORE_ERROR_SIZE];
} ScoresRead;

/** score_new() of a file with these bytes, which is gone again. */
Score* scores_read_bytes(const void* data, size_t size, ScoresRead* read);

/** A score; the test fails if it is refused. */
Score* scores_read(const char* text);

#endif
