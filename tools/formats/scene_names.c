#include "tools/formats/scene_names.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST_SLOTS = 64 };

static const SceneName* list_of(const SceneNames* names) {
  return (const SceneName*)(const void*)names->list.data;
}

/* Fowler, Noll and Vo's hash 1a. */
static uint32_t hash_of(const char* name) {
  uint32_t hash = 2166136261U;
  for (; *name; ++name) {
    hash = (hash ^ (uint8_t)*name) * 16777619U;
  }
  return hash;
}

/* The slot where a name is, or where it would go. */
static uint32_t* slot_of(const SceneNames* names, const char* name) {
  uint32_t i = hash_of(name) & (names->n_slots - 1);
  while (names->slots[i] && strcmp(list_of(names)[names->slots[i] - 1].name, name) != 0) {
    i = (i + 1) & (names->n_slots - 1);
  }
  return &names->slots[i];
}

/* No more than half of the slots are ever taken. */
static bool reserve(SceneNames* names, uint32_t n) {
  if (2 * n <= names->n_slots) {
    return true;
  }
  const uint32_t n_slots = names->n_slots ? 2 * names->n_slots : FIRST_SLOTS;
  uint32_t* const slots = calloc(n_slots, sizeof(*slots));
  if (!slots) {
    return false;
  }
  free(names->slots);
  names->slots = slots;
  names->n_slots = n_slots;
  for (uint32_t i = 0; i + 1 < n; ++i) {
    *slot_of(names, list_of(names)[i].name) = i + 1;
  }
  return true;
}

void scene_names_clear(SceneNames* names) {
  free(names->slots);
  bytes_clear(&names->list);
}

const SceneName* scene_names_find(const SceneNames* names, const char* name) {
  const uint32_t place = names->n_slots ? *slot_of(names, name) : 0;
  return place ? list_of(names) + place - 1 : NULL;
}

bool scene_names_add(SceneNames* names, SceneName name) {
  const uint32_t n = (uint32_t)(names->list.size / sizeof(name)) + 1;
  if (!reserve(names, n) || !bytes_append(&names->list, &name, sizeof(name))) {
    return false;
  }
  *slot_of(names, name.name) = n;
  return true;
}

const SceneName* scene_names_of_point(const SceneNames* names, uint32_t point) {
  const SceneName* const list = list_of(names);
  size_t low = 0;
  size_t high = names->list.size / sizeof(*list);
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    *(list[middle].first <= point ? &low : &high) = middle;
  }
  return list + low;
}
