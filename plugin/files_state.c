#define _POSIX_C_SOURCE 200809L

#include "plugin/files_state.h"

#include <lv2/core/lv2_util.h>

#include <stdlib.h>
#include <string.h>

/* What a host offers for paths, each NULL if it does not. */
typedef struct {
  const LV2_State_Map_Path* map;
  const LV2_State_Free_Path* free;
} Paths;

static Paths paths_of(const LV2_Feature* const* features) {
  return (Paths){
      .map = lv2_features_data(features, LV2_STATE__mapPath),
      .free = lv2_features_data(features, LV2_STATE__freePath),
  };
}

static void free_path(const Paths* paths, char* path) {
  if (paths->free) {
    paths->free->free_path(paths->free->handle, path);
  } else {
    free(path);
  }
}

/* What is put into a state, and where. */
typedef struct {
  LV2_State_Store_Function store;
  LV2_State_Handle handle;
  LV2_URID key;
} Slot;

static LV2_State_Status put(Slot slot, const char* text, LV2_URID type, uint32_t flags) {
  return slot.store(slot.handle, slot.key, text, strlen(text) + 1, type, flags);
}

/* A path that the host has not mapped means nothing on another machine. */
static LV2_State_Status
put_path(const FilesUrids* urids, Slot slot, const char* path, const Paths* paths) {
  const uint32_t portable = LV2_STATE_IS_POD | LV2_STATE_IS_PORTABLE;
  if (!*path) {
    return put(slot, path, urids->atom_Path, portable);
  }
  char* const mapped = paths->map ? paths->map->abstract_path(paths->map->handle, path) : NULL;
  if (!mapped) {
    return put(slot, path, urids->atom_Path, LV2_STATE_IS_POD);
  }
  const LV2_State_Status status = put(slot, mapped, urids->atom_Path, portable);
  free_path(paths, mapped);
  return status;
}

static bool is_path(const FilesUrids* urids, uint32_t type, size_t length) {
  return (type == urids->atom_Path || type == urids->atom_String) && length < FILES_PATH_SIZE;
}

/* Copy what is stored for a file to `path`; false if nothing is. */
static bool fetch(const FilesUrids* urids,
                  int file,
                  char path[FILES_PATH_SIZE],
                  LV2_State_Retrieve_Function retrieve,
                  LV2_State_Handle handle,
                  LV2_State_Status* status) {
  size_t size = 0;
  uint32_t type = 0;
  uint32_t flags = 0;
  const void* const value = retrieve(handle, urids->files[file], &size, &type, &flags);
  const size_t length = value ? strnlen(value, size) : 0;
  if (!value || !is_path(urids, type, length)) {
    *status = value ? LV2_STATE_ERR_BAD_TYPE : *status;
    return false;
  }
  memcpy(path, value, length);
  path[length] = '\0';
  return true;
}

/* A host that writes a path relative to its own file makes that file's of an empty one. */
static bool is_of_host(const char* path) {
  static const char ending[] = ".ttl";
  const size_t length = strlen(path);
  const size_t n = sizeof(ending) - 1;
  return length > n && !strcmp(path + length - n, ending);
}

static void make_absolute(char path[FILES_PATH_SIZE], const Paths* paths) {
  char* const absolute =
      *path && paths->map ? paths->map->absolute_path(paths->map->handle, path) : NULL;
  if (absolute) {
    const size_t length = strnlen(absolute, FILES_PATH_SIZE - 1);
    memcpy(path, absolute, length);
    path[length] = '\0';
    free_path(paths, absolute);
  }
}

LV2_State_Status files_state_save(Files* files,
                                  LV2_State_Store_Function store,
                                  LV2_State_Handle handle,
                                  const LV2_Feature* const* features) {
  const Paths paths = paths_of(features);
  LV2_State_Status status = LV2_STATE_SUCCESS;
  FilesPaths now;
  files_store_paths(&files->store, &now);
  for (int f = 0; f < FILES_COUNT && !status; ++f) {
    const Slot slot = {store, handle, files->urids.files[f]};
    status = put_path(&files->urids, slot, now.path[f], &paths);
  }
  return status;
}

LV2_State_Status files_state_restore(Files* files,
                                     LV2_State_Retrieve_Function retrieve,
                                     LV2_State_Handle handle,
                                     const LV2_Feature* const* features) {
  const Paths paths = paths_of(features);
  LV2_State_Status status = LV2_STATE_SUCCESS;
  FilesPaths found;
  const char* given[FILES_COUNT] = {NULL};
  bool is_any = false;
  for (int f = 0; f < FILES_COUNT; ++f) {
    if (fetch(&files->urids, f, found.path[f], retrieve, handle, &status)) {
      make_absolute(found.path[f], &paths);
      given[f] = is_of_host(found.path[f]) ? "" : found.path[f];
      is_any = true;
    }
  }
  if (is_any) {
    files_load(files, given, false);
  }
  return status;
}
