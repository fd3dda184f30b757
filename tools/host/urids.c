#define _POSIX_C_SOURCE 200809L

#include "tools/host/urids.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static bool urids_reserve(Urids* urids) {
  if (urids->n_uris < urids->capacity) {
    return true;
  }
  const size_t capacity = urids->capacity ? 2 * urids->capacity : 64;
  char** const uris = realloc(urids->uris, capacity * sizeof(*uris));
  if (!uris) {
    return false;
  }
  urids->uris = uris;
  urids->capacity = capacity;
  return true;
}

LV2_URID
urids_map(Urids* urids, const char* uri) {
  for (uint32_t i = 0; i < urids->n_uris; ++i) {
    if (!strcmp(urids->uris[i], uri)) {
      return i + 1;
    }
  }
  char* const copy = urids_reserve(urids) ? strdup(uri) : NULL;
  if (!copy) {
    return 0;
  }
  urids->uris[urids->n_uris] = copy;
  return ++urids->n_uris;
}

const char* urids_unmap(const Urids* urids, LV2_URID urid) {
  return urid > 0 && urid <= urids->n_uris ? urids->uris[urid - 1] : NULL;
}

void urids_clear(Urids* urids) {
  for (uint32_t i = 0; i < urids->n_uris; ++i) {
    free(urids->uris[i]);
  }
  free(urids->uris);
  *urids = (Urids){0};
}
