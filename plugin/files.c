#define _POSIX_C_SOURCE 200809L

#include "plugin/files.h"

#include "plugin/atom_object.h"
#include "plugin/events.h"

#include <lv2/core/lv2_util.h>

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { REQUEST_HEAD = offsetof(FilesRequest, path) };

static void say(const Files* files, LV2_URID type, const char* line) {
  if (files->log) {
    (void)files->log->printf(files->log->handle, type, "hooke: %s\n", line);
  }
}

static LV2_URID urid_of(const Property* property, LV2_URID type) {
  LV2_URID urid = 0;
  if (property->type == type && property->size == sizeof(urid)) {
    memcpy(&urid, property->value, sizeof(urid));
  }
  return urid;
}

/* A message that names no subject is meant for whom it reaches. */
static bool is_for_us(const Files* files, const uint8_t* body, uint32_t n_bytes) {
  Property subject;
  return !atom_object_find(body, n_bytes, files->urids.patch_subject, &subject) ||
         urid_of(&subject, files->urids.atom_URID) == files->urids.plugin;
}

/* A path that cannot be kept is answered with the one that is. */
static void want(Files* files, FilesKind file, const Property* value) {
  FilesRequest* const request = &files->requests[file];
  const size_t n_bytes = strnlen((const char*)value->value, value->size);
  const bool is_path =
      value->type == files->urids.atom_Path || value->type == files->urids.atom_String;
  if (!files->worker || n_bytes >= FILES_PATH_SIZE || !is_path) {
    files->is_due[file] = true;
    return;
  }
  request->file = file;
  memcpy(request->path, value->value, n_bytes);
  request->path[n_bytes] = '\0';
  files->is_wanted[file] = true;
}

static void hear_set(Files* files, const uint8_t* body, uint32_t n_bytes) {
  Property property;
  Property value;
  if (!atom_object_find(body, n_bytes, files->urids.patch_property, &property) ||
      !atom_object_find(body, n_bytes, files->urids.patch_value, &value)) {
    return;
  }
  for (int f = 0; f < FILES_COUNT; ++f) {
    if (urid_of(&property, files->urids.atom_URID) == files->urids.files[f]) {
      want(files, (FilesKind)f, &value);
    }
  }
}

/* Who asks for nothing in particular asks for all. */
static void hear_get(Files* files, const uint8_t* body, uint32_t n_bytes) {
  Property property;
  const bool is_one = atom_object_find(body, n_bytes, files->urids.patch_property, &property);
  for (int f = 0; f < FILES_COUNT; ++f) {
    if (!is_one || urid_of(&property, files->urids.atom_URID) == files->urids.files[f]) {
      files->is_due[f] = true;
    }
  }
}

static void ask_worker(Files* files) {
  for (int f = 0; f < FILES_COUNT; ++f) {
    const FilesRequest* const request = &files->requests[f];
    if (files->is_wanted[f]) {
      const uint32_t n_bytes = REQUEST_HEAD + (uint32_t)strlen(request->path) + 1;
      files->is_wanted[f] =
          files->worker->schedule_work(files->worker->handle, n_bytes, request) != 0;
    }
  }
}

static const LV2_Atom* write_set(Files* files, int file) {
  const FilesUrids* const urids = &files->urids;
  const char* const path = files_store_table(&files->store)->paths.path[file];
  LV2_Atom_Forge* const forge = &files->forge;
  LV2_Atom_Forge_Frame frame;
  lv2_atom_forge_set_buffer(forge, files->message, sizeof(files->message));
  lv2_atom_forge_object(forge, &frame, 0, urids->patch_Set);
  lv2_atom_forge_key(forge, urids->patch_subject);
  lv2_atom_forge_urid(forge, urids->plugin);
  lv2_atom_forge_key(forge, urids->patch_property);
  lv2_atom_forge_urid(forge, urids->files[file]);
  lv2_atom_forge_key(forge, urids->patch_value);
  lv2_atom_forge_path(forge, path, (uint32_t)strlen(path));
  lv2_atom_forge_pop(forge, &frame);
  return (const LV2_Atom*)(const void*)files->message;
}

static const LV2_Atom* write_change(Files* files) {
  LV2_Atom_Forge_Frame frame;
  lv2_atom_forge_set_buffer(&files->forge, files->message, sizeof(files->message));
  lv2_atom_forge_object(&files->forge, &frame, 0, files->urids.state_StateChanged);
  lv2_atom_forge_pop(&files->forge, &frame);
  return (const LV2_Atom*)(const void*)files->message;
}

Files*
files_new(const LV2_URID_Map* map, const LV2_Feature* const* features, const FilesNames* names) {
  Files* const files = calloc(1, sizeof(Files));
  if (!files || !files_store_init(&files->store)) {
    free(files);
    return NULL;
  }
  LV2_URID_Map writable = *map;
  files->urids = files_urids(map, names);
  files->log = lv2_features_data(features, LV2_LOG__log);
  files->worker = lv2_features_data(features, LV2_WORKER__schedule);
  lv2_atom_forge_init(&files->forge, &writable);
  if (!files->worker) {
    say(files, files->urids.log_Note,
        "found no work:schedule, so files are read for sessions and presets alone, and a patch:Set "
        "is refused");
  }
  return files;
}

void files_free(Files* files) {
  if (files) {
    files_store_clear(&files->store);
    free(files);
  }
}

FilesNews files_take(Files* files) {
  if (!files_store_take(&files->store)) {
    return (FilesNews){false, false};
  }
  const FilesCounts before = files->counts;
  files->counts = files_store_table(&files->store)->counts;
  for (int f = 0; f < FILES_COUNT; ++f) {
    files->is_due[f] = true;
  }
  files->is_change_due = files->is_change_due || files->counts.n_wishes != before.n_wishes;
  return (FilesNews){.has_pitches = files->counts.n_tunings != before.n_tunings,
                     .has_body = files->counts.n_bodies != before.n_bodies};
}

const double* files_pitches(const Files* files) {
  return files_store_table(&files->store)->semitones;
}

const Body* files_body(const Files* files) {
  const Body* const body = &files_store_table(&files->store)->body;
  return body->n_modes > 0 ? body : NULL;
}

void files_hear(Files* files, LV2_URID type, const uint8_t* body, uint32_t n_bytes) {
  const FilesUrids* const urids = &files->urids;
  const LV2_URID class = atom_object_class(body, n_bytes);
  const bool is_object =
      type == urids->atom_Object || type == urids->atom_Blank || type == urids->atom_Resource;
  if (!is_object || !is_for_us(files, body, n_bytes)) {
    return;
  }
  if (class == urids->patch_Set) {
    hear_set(files, body, n_bytes);
  } else if (class == urids->patch_Get) {
    hear_get(files, body, n_bytes);
  }
}

void files_tell(Files* files, LV2_Atom_Sequence* notify, uint32_t room) {
  ask_worker(files);
  for (int f = 0; f < FILES_COUNT; ++f) {
    files->is_due[f] = files->is_due[f] && !events_append(notify, room, write_set(files, f));
  }
  files->is_change_due = files->is_change_due && !events_append(notify, room, write_change(files));
}

LV2_Worker_Status files_work(Files* files, uint32_t n_bytes, const void* request) {
  FilesRequest wish = {0};
  if (n_bytes <= REQUEST_HEAD || n_bytes > sizeof(wish)) {
    return LV2_WORKER_ERR_UNKNOWN;
  }
  memcpy(&wish, request, n_bytes);
  if (wish.file >= FILES_COUNT || wish.path[n_bytes - REQUEST_HEAD - 1] != '\0') {
    return LV2_WORKER_ERR_UNKNOWN;
  }
  const char* paths[FILES_COUNT] = {NULL};
  paths[wish.file] = wish.path;
  files_load(files, paths, true);
  return LV2_WORKER_SUCCESS;
}

void files_load(Files* files, const char* const paths[FILES_COUNT], bool is_wish) {
  FilesFaults faults;
  files_store_load(&files->store, paths, is_wish, &faults);
  for (int f = 0; f < FILES_COUNT; ++f) {
    if (faults.fault[f].line[0]) {
      say(files, files->urids.log_Error, faults.fault[f].line);
    }
  }
}
