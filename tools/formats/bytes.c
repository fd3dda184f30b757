#include "tools/formats/bytes.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 1 << 16, MIB = 1 << 20 };

static bool bytes_reserve(Bytes* bytes, size_t extra) {
  if (extra > SIZE_MAX / 2 - bytes->size) {
    return false;
  }
  const size_t needed = bytes->size + extra;
  if (needed <= bytes->capacity) {
    return true;
  }
  const size_t capacity = needed < 128 ? 256 : 2 * needed;
  uint8_t* const data = realloc(bytes->data, capacity);
  if (!data) {
    return false;
  }
  bytes->data = data;
  bytes->capacity = capacity;
  return true;
}

bool bytes_append(Bytes* bytes, const void* data, size_t size) {
  if (!bytes_reserve(bytes, size)) {
    return false;
  }
  if (size > 0 && data) {
    memcpy(bytes->data + bytes->size, data, size);
  } else if (size > 0) {
    memset(bytes->data + bytes->size, 0, size);
  }
  bytes->size += size;
  return true;
}

/* A reason as errno has it, 0 for none. */
static int read_all(Bytes* bytes, FILE* file, size_t max_size) {
  char chunk[CHUNK];
  const size_t start = bytes->size;
  size_t n = 0;
  while ((n = fread(chunk, 1, sizeof(chunk), file)) > 0) {
    if (bytes->size - start + n > max_size) {
      return EFBIG;
    }
    if (!bytes_append(bytes, chunk, n)) {
      return ENOMEM;
    }
  }
  return ferror(file) ? errno : 0;
}

bool bytes_read(Bytes* bytes, const char* path, size_t max_size, char* error, size_t error_size) {
  FILE* const file = fopen(path, "rb");
  const int reason = file ? read_all(bytes, file, max_size) : errno;
  if (file) {
    (void)fclose(file);
  }
  if (reason == EFBIG) {
    (void)snprintf(error, error_size, "%s: found more than %zu MiB, expected at most that", path,
                   max_size / MIB);
  } else if (reason) {
    (void)snprintf(error, error_size, "%s: %s", path,
                   reason == ENOMEM ? "out of memory" : strerror(reason));
  }
  return !reason;
}

bool bytes_are_free(size_t size) {
  void* const memory = malloc(size);
  free(memory);
  return memory;
}

void bytes_clear(Bytes* bytes) {
  free(bytes->data);
  *bytes = (Bytes){0};
}
