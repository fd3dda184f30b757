/* The functions that a plugin might call, in front of libc's: what they do is libc's business. */
#define _GNU_SOURCE

#include "tests/hosts/watch.h"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define SEEN __attribute__((visibility("default")))

void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* memory);

SEEN void* malloc(size_t size) {
  watch_fault(WATCH_HEAP, "malloc");
  return __libc_malloc(size);
}

SEEN void* calloc(size_t count, size_t size) {
  watch_fault(WATCH_HEAP, "calloc");
  return __libc_calloc(count, size);
}

SEEN void* realloc(void* memory, size_t size) {
  watch_fault(WATCH_HEAP, "realloc");
  return __libc_realloc(memory, size);
}

SEEN void* aligned_alloc(size_t alignment, size_t size) {
  watch_fault(WATCH_HEAP, "aligned_alloc");
  return __libc_memalign(alignment, size);
}

SEEN int posix_memalign(void** memory, size_t alignment, size_t size) {
  watch_fault(WATCH_HEAP, "posix_memalign");
  void* const found = __libc_memalign(alignment, size);
  if (!found) {
    return ENOMEM;
  }
  *memory = found;
  return 0;
}

SEEN void free(void* memory) {
  if (memory) {
    watch_fault(WATCH_HEAP, "free");
  }
  __libc_free(memory);
}

/* What has no other name in libc is looked up, once, by whoever calls it first. */
#define LOCK(name, type)                                                                           \
  SEEN int name(type* it);                                                                         \
  SEEN int name(type* it) {                                                                        \
    static int (*real)(type*);                                                                     \
    watch_fault(WATCH_LOCK, #name);                                                                \
    if (!real) {                                                                                   \
      void* const found = dlsym(RTLD_NEXT, #name);                                                 \
      memcpy(&real, &found, sizeof(real));                                                         \
    }                                                                                              \
    return real(it);                                                                               \
  }

LOCK(pthread_mutex_lock, pthread_mutex_t)
LOCK(pthread_rwlock_rdlock, pthread_rwlock_t)
LOCK(pthread_rwlock_wrlock, pthread_rwlock_t)
LOCK(sem_wait, sem_t)
