/**
   Bytes that grow, the one place where the tools enlarge memory, and files read into them.
*/
#ifndef HOOKE_TOOLS_FORMATS_BYTES_H
#define HOOKE_TOOLS_FORMATS_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** A growing array of bytes; all zero is a valid, empty one. */
typedef struct {
  uint8_t* data;   /**< From malloc, or NULL while nothing was ever stored */
  size_t size;     /**< Bytes in use */
  size_t capacity; /**< Bytes allocated */
} Bytes;

/**
   Add `size` bytes at the end; the array moves when it grows.

   @param data  The bytes to copy, or NULL for zeros
   @return false when memory is out; then `bytes` is as it was.
*/
bool bytes_append(Bytes* bytes, const void* data, size_t size);

/**
   Add the content of a file at the end.

   @param max_size     More of it than that is a failure [bytes], in whole MiB
   @param[out] error   "PATH: " and why not, one line; untouched on success
   @param error_size   Room in `error` [bytes]
   @return false if the file cannot be read or is too large, or memory is out.
*/
bool bytes_read(Bytes* bytes, const char* path, size_t max_size, char* error, size_t error_size);

/** @return Whether there are so many bytes of memory: for libraries that take it for granted. */
bool bytes_are_free(size_t size);

/** Free the memory and leave an empty array. */
void bytes_clear(Bytes* bytes);

#endif
