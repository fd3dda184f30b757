#include "tools/formats/scene_names.h"

static const SceneName* list_of(const SceneNames* names) {
  return (const SceneName*)(const void*)names->list.data;
}

void scene_names_init(SceneNames* names) {
  *names = (SceneNames){.index = g_hash_table_new(g_str_hash, g_str_equal)};
}

void scene_names_clear(SceneNames* names) {
  g_hash_table_destroy(names->index);
  bytes_clear(&names->list);
}

const SceneName* scene_names_find(const SceneNames* names, const char* name) {
  const guint place = GPOINTER_TO_UINT(g_hash_table_lookup(names->index, name));
  return place ? list_of(names) + place - 1 : NULL;
}

bool scene_names_add(SceneNames* names, SceneName name) {
  if (!bytes_append(&names->list, &name, sizeof(name))) {
    return false;
  }
  const size_t place = names->list.size / sizeof(name);
  return g_hash_table_insert(names->index, name.name, GUINT_TO_POINTER((guint)place));
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
