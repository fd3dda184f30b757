/**
   Bytes that grow: the one place where the tools enlarge memory.
*/
#ifndef HOOKE_TOOLS_FORMATS_BYTES_H
#define HOOKE_TOOLS_FORMATS_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** A growing array of bytes; all zero is a valid, empty one. */
typedef struct {
  uint8_t* data;   ///< From malloc, or NULL while nothing was ever stored
  size_t size;     ///< Bytes in use
  size_t capacity; ///< Bytes allocated
} Bytes;

/**
   Add `size` bytes at the end; the array moves when it grows.

   @param data  The bytes to copy, or NULL for zeros
   @return false when memory is out; then `bytes` is as it was.
*/
bool bytes_append(Bytes* bytes, const void* data, size_t size);

/** Free the memory and leave an empty array. */
void bytes_clear(Bytes* bytes);

#endif
