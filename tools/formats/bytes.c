#include "tools/formats/bytes.h"

#include <stdlib.h>
#include <string.h>

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

void bytes_clear(Bytes* bytes) {
  free(bytes->data);
  *bytes = (Bytes){0};
}
