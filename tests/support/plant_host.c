/* An LV2 plugin that does in run() all that none may: the positive control of the watch that is
 * preloaded into hosts. */
#define _POSIX_C_SOURCE 200809L

#include <lv2/core/lv2.h>

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

enum { N_OUTPUTS = 2, FIRST_OUTPUT = 2 };

typedef struct {
  pthread_mutex_t mutex;
  float* outputs[N_OUTPUTS];
} Plant;

static LV2_Handle instantiate(const LV2_Descriptor* descriptor,
                              double rate_hz,
                              const char* bundle,
                              const LV2_Feature* const* features) {
  (void)descriptor, (void)rate_hz, (void)bundle, (void)features;
  Plant* const self = calloc(1, sizeof(*self));
  if (self && pthread_mutex_init(&self->mutex, NULL)) {
    free(self);
    return NULL;
  }
  return self;
}

static void connect_port(LV2_Handle handle, uint32_t port, void* data) {
  Plant* const self = handle;
  if (port >= FIRST_OUTPUT && port < FIRST_OUTPUT + N_OUTPUTS) {
    self->outputs[port - FIRST_OUTPUT] = data;
  }
}

/* A call of the kernel that goes through none of libc's functions that a watch could stand before.
 */
static void call_kernel(void) {
  (void)getppid();
}

static void run(LV2_Handle handle, uint32_t n_frames) {
  Plant* const self = handle;
  void* volatile memory = malloc(16);
  free(memory);
  (void)pthread_mutex_lock(&self->mutex);
  (void)pthread_mutex_unlock(&self->mutex);
  call_kernel();
#if defined(__x86_64__)
  _mm_setcsr(_mm_getcsr() ^ 0x8000u);
#endif
  for (int k = 0; k < N_OUTPUTS; ++k) {
    for (uint32_t i = 0; i < n_frames && self->outputs[k]; ++i) {
      self->outputs[k][i] = 0.0f;
    }
  }
}

static void cleanup(LV2_Handle handle) {
  Plant* const self = handle;
  (void)pthread_mutex_destroy(&self->mutex);
  free(self);
}

LV2_SYMBOL_EXPORT const LV2_Descriptor* lv2_descriptor(uint32_t index) {
  static const LV2_Descriptor descriptor = {
      "urn:hooke:plant", instantiate, connect_port, NULL, run, NULL, cleanup, NULL};
  return index == 0 ? &descriptor : NULL;
}
