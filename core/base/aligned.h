/**
   Memory that begins where a vector may, for chains.

   It is C11's aligned_alloc(), which Windows does not have: there, such memory is not for free().
*/
#ifndef HOOKE_CORE_BASE_ALIGNED_H
#define HOOKE_CORE_BASE_ALIGNED_H

#include <stddef.h>
#include <stdlib.h>

#ifdef _WIN32
#include <malloc.h>
#endif

/**
   Take memory for `size` bytes, a multiple of `alignment`, which is a power of 2. Its contents are
   not set.

   @return NULL if there is not so much. Not for the audio thread.
*/
static inline void* aligned_new(size_t alignment, size_t size) {
#ifdef _WIN32
  return _aligned_malloc(size, alignment);
#else
  return aligned_alloc(alignment, size);
#endif
}

/** Give back what aligned_new() returned; NULL is nothing. Not for the audio thread. */
static inline void aligned_free(void* memory) {
#ifdef _WIN32
  _aligned_free(memory);
#else
  free(memory);
#endif
}

#endif
