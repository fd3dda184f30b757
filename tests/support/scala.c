#include "tests/support/scala.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

Status scala_read_scale(const char* text, size_t n_bytes, void* scale, ScaleError* error) {
  return scale_read(text, n_bytes, scale, error);
}

Status scala_read_map(const char* text, size_t n_bytes, void* map, ScaleError* error) {
  return scale_map_read(text, n_bytes, map, error);
}

Status
scala_read_copy(ScalaRead read, const char* text, size_t n_bytes, void* out, ScaleError* error) {
  char* const copy = malloc(n_bytes ? n_bytes : 1);
  assert_non_null(copy);
  memcpy(copy, text, n_bytes);
  const Status status = read(copy, n_bytes, out, error);
  free(copy);
  return status;
}

static void read_well(ScalaRead read, const char* text, size_t n_bytes, void* out) {
  ScaleError error;
  if (scala_read_copy(read, text, n_bytes, out, &error)) {
    fail_msg("%u: found %s, expected %s", error.line, error.found, error.expected);
  }
}

static void read_file(ScalaRead read, const char* file, void* out) {
  char path[4096];
  char bytes[4096];
  const char* const source = getenv("HOOKE_SOURCE");
  assert_non_null(source);
  (void)snprintf(path, sizeof(path), "%s/tests/scales/%s", source, file);
  FILE* const stream = fopen(path, "rb");
  assert_non_null(stream);
  const size_t n_bytes = fread(bytes, 1, sizeof(bytes), stream);
  assert_int_equal(fclose(stream), 0);
  read_well(read, bytes, n_bytes, out);
}

void scala_scale(const char* text, Scale* scale) {
  read_well(scala_read_scale, text, strlen(text), scale);
}

void scala_map(const char* text, ScaleMap* map) {
  read_well(scala_read_map, text, strlen(text), map);
}

void scala_scale_file(const char* file, Scale* scale) {
  read_file(scala_read_scale, file, scale);
}

void scala_map_file(const char* file, ScaleMap* map) {
  read_file(scala_read_map, file, map);
}
