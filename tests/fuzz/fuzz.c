#define _POSIX_C_SOURCE 200809L

#include "tests/fuzz/fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t n_bytes) {
  fuzz_one(bytes, n_bytes);
  return 0;
}

void fuzz_fail(const char* claim, const char* file, int line) {
  (void)fprintf(stderr, "%s:%d: found otherwise, expected %s\n", file, line, claim);
  abort();
}

uint32_t fuzz_byte(FuzzFeed* feed) {
  if (feed->n_left == 0) {
    return 0;
  }
  --feed->n_left;
  return *feed->at++;
}

uint32_t fuzz_word(FuzzFeed* feed) {
  const uint32_t upper = fuzz_byte(feed);
  return upper << 8 | fuzz_byte(feed);
}

uint8_t* fuzz_take(FuzzFeed* feed, size_t most, size_t* n_bytes) {
  *n_bytes = most < feed->n_left ? most : feed->n_left;
  uint8_t* const copy = fuzz_copy(feed->at, *n_bytes);
  feed->at += *n_bytes;
  feed->n_left -= *n_bytes;
  return copy;
}

uint8_t* fuzz_copy(const uint8_t* bytes, size_t n_bytes) {
  uint8_t* const copy = malloc(n_bytes > 0 ? n_bytes : 1);
  FUZZ_CLAIM(copy);
  if (n_bytes > 0) {
    memcpy(copy, bytes, n_bytes);
  }
  return copy;
}

/* It has no name: nothing of it is left, however the program ends. */
const char* fuzz_file(const uint8_t* bytes, size_t n_bytes) {
  static char path[32];
  static int file = -1;
  if (file < 0) {
    FILE* const stream = tmpfile();
    FUZZ_CLAIM(stream);
    file = fileno(stream);
    (void)snprintf(path, sizeof(path), "/dev/fd/%d", file);
  }
  FUZZ_CLAIM(!ftruncate(file, 0) && !lseek(file, 0, SEEK_SET));
  FUZZ_CLAIM(pwrite(file, bytes, n_bytes, 0) == (ssize_t)n_bytes);
  return path;
}

static unsigned count_lines(const uint8_t* bytes, size_t n_bytes) {
  unsigned n_lines = 1;
  for (size_t i = 0; i + 1 < n_bytes; ++i) {
    n_lines += bytes[i] == '\n' || bytes[i] == '\r';
  }
  return n_lines;
}

void fuzz_claim_message(
    const char* error, const char* path, bool has_line, const uint8_t* bytes, size_t n_bytes) {
  const size_t n_path = strlen(path);
  FUZZ_CLAIM(!strncmp(error, path, n_path) && error[n_path] == ':');
  const char* const found = strstr(error, "found ");
  FUZZ_CLAIM(found && strstr(found, ", expected "));
  for (const char* c = error; *c; ++c) {
    FUZZ_CLAIM((unsigned char)*c >= ' ' && *c != 0x7F);
  }
  if (has_line) {
    char* end = NULL;
    const unsigned long line = strtoul(error + n_path + 1, &end, 10);
    FUZZ_CLAIM(*end == ':' && line >= 1 && line <= count_lines(bytes, n_bytes));
  }
}
