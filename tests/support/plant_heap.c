/* What a plugin must not do, built as a plugin is: the positive control of the heap watch. */
#include <stdlib.h>

__attribute__((visibility("default"))) void plant_heap(void);

void plant_heap(void) {
  void* volatile memory = malloc(16);
  memory = realloc(memory, 32);
  free(memory);
  memory = calloc(2, 8);
  free(memory);
  memory = aligned_alloc(64, 128);
  free(memory);
}
