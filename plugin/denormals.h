/**
   Denormals as zeros while run() runs, and the processor as it was found thereafter: not every host
   sees to it.

   Thread: each on its own; real-time safe.
*/
#ifndef HOOKE_PLUGIN_DENORMALS_H
#define HOOKE_PLUGIN_DENORMALS_H

#include <stdint.h>

#if defined(__SSE2__)
#include <xmmintrin.h>

/** Flush denormals; what denormals_restore() wants. */
static inline uint64_t denormals_flush(void) {
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040u); /* FTZ and DAZ */
  return before;
}

/** Put the processor back to what denormals_flush() found. */
static inline void denormals_restore(uint64_t before) {
  _mm_setcsr((unsigned)before);
}

#elif defined(__aarch64__)

static inline uint64_t denormals_flush(void) {
  uint64_t before;
  __asm__ volatile("mrs %0, fpcr" : "=r"(before));
  __asm__ volatile("msr fpcr, %0" : : "r"(before | (UINT64_C(1) << 24))); /* FZ */
  return before;
}

static inline void denormals_restore(uint64_t before) {
  __asm__ volatile("msr fpcr, %0" : : "r"(before));
}

#else

static inline uint64_t denormals_flush(void) {
  return 0;
}

static inline void denormals_restore(uint64_t before) {
  (void)before;
}

#endif
#endif
