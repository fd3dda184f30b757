#define _POSIX_C_SOURCE 200809L

#include "plugin/tuner.h"

#include "plugin/atom_object.h"
#include "plugin/events.h"

#include <lv2/core/lv2_util.h>

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { REQUEST_HEAD = offsetof(TunerRequest, path) };

static void say(const Tuner* tuner, LV2_URID type, const char* line) {
  if (tuner->log) {
    (void)tuner->log->printf(tuner->log->handle, type, "hooke: %s\n", line);
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
static bool is_for_us(const Tuner* tuner, const uint8_t* body, uint32_t n_bytes) {
  Property subject;
  return !atom_object_find(body, n_bytes, tuner->urids.patch_subject, &subject) ||
         urid_of(&subject, tuner->urids.atom_URID) == tuner->urids.plugin;
}

/* A path that cannot be kept is answered with the one that is. */
static void want(Tuner* tuner, TunerFile file, const Property* value) {
  TunerRequest* const request = &tuner->requests[file];
  const size_t n_bytes = strnlen((const char*)value->value, value->size);
  const bool is_path =
      value->type == tuner->urids.atom_Path || value->type == tuner->urids.atom_String;
  if (!tuner->worker || n_bytes >= TUNER_PATH_SIZE || !is_path) {
    tuner->is_due[file] = true;
    return;
  }
  request->file = file;
  memcpy(request->path, value->value, n_bytes);
  request->path[n_bytes] = '\0';
  tuner->is_wanted[file] = true;
}

static void hear_set(Tuner* tuner, const uint8_t* body, uint32_t n_bytes) {
  Property property;
  Property value;
  if (!atom_object_find(body, n_bytes, tuner->urids.patch_property, &property) ||
      !atom_object_find(body, n_bytes, tuner->urids.patch_value, &value)) {
    return;
  }
  for (int f = 0; f < TUNER_N_FILES; ++f) {
    if (urid_of(&property, tuner->urids.atom_URID) == tuner->urids.files[f]) {
      want(tuner, (TunerFile)f, &value);
    }
  }
}

/* Who asks for nothing in particular asks for all. */
static void hear_get(Tuner* tuner, const uint8_t* body, uint32_t n_bytes) {
  Property property;
  const bool is_one = atom_object_find(body, n_bytes, tuner->urids.patch_property, &property);
  for (int f = 0; f < TUNER_N_FILES; ++f) {
    if (!is_one || urid_of(&property, tuner->urids.atom_URID) == tuner->urids.files[f]) {
      tuner->is_due[f] = true;
    }
  }
}

static void ask_worker(Tuner* tuner) {
  for (int f = 0; f < TUNER_N_FILES; ++f) {
    const TunerRequest* const request = &tuner->requests[f];
    if (tuner->is_wanted[f]) {
      const uint32_t n_bytes = REQUEST_HEAD + (uint32_t)strlen(request->path) + 1;
      tuner->is_wanted[f] =
          tuner->worker->schedule_work(tuner->worker->handle, n_bytes, request) != 0;
    }
  }
}

static const LV2_Atom* write_set(Tuner* tuner, int file) {
  const TunerUrids* const urids = &tuner->urids;
  const char* const path = tuner_store_table(&tuner->store)->paths.path[file];
  LV2_Atom_Forge* const forge = &tuner->forge;
  LV2_Atom_Forge_Frame frame;
  lv2_atom_forge_set_buffer(forge, tuner->message, sizeof(tuner->message));
  lv2_atom_forge_object(forge, &frame, 0, urids->patch_Set);
  lv2_atom_forge_key(forge, urids->patch_subject);
  lv2_atom_forge_urid(forge, urids->plugin);
  lv2_atom_forge_key(forge, urids->patch_property);
  lv2_atom_forge_urid(forge, urids->files[file]);
  lv2_atom_forge_key(forge, urids->patch_value);
  lv2_atom_forge_path(forge, path, (uint32_t)strlen(path));
  lv2_atom_forge_pop(forge, &frame);
  return (const LV2_Atom*)(const void*)tuner->message;
}

static const LV2_Atom* write_change(Tuner* tuner) {
  LV2_Atom_Forge_Frame frame;
  lv2_atom_forge_set_buffer(&tuner->forge, tuner->message, sizeof(tuner->message));
  lv2_atom_forge_object(&tuner->forge, &frame, 0, tuner->urids.state_StateChanged);
  lv2_atom_forge_pop(&tuner->forge, &frame);
  return (const LV2_Atom*)(const void*)tuner->message;
}

Tuner*
tuner_new(const LV2_URID_Map* map, const LV2_Feature* const* features, const TunerNames* names) {
  Tuner* const tuner = calloc(1, sizeof(Tuner));
  if (!tuner || !tuner_store_init(&tuner->store)) {
    free(tuner);
    return NULL;
  }
  LV2_URID_Map writable = *map;
  tuner->urids = tuner_urids(map, names);
  tuner->log = lv2_features_data(features, LV2_LOG__log);
  tuner->worker = lv2_features_data(features, LV2_WORKER__schedule);
  lv2_atom_forge_init(&tuner->forge, &writable);
  if (!tuner->worker) {
    say(tuner, tuner->urids.log_Note,
        "found no work:schedule, so files are read for sessions and presets alone, and a patch:Set "
        "is refused");
  }
  return tuner;
}

void tuner_free(Tuner* tuner) {
  if (tuner) {
    tuner_store_clear(&tuner->store);
    free(tuner);
  }
}

const double* tuner_take(Tuner* tuner) {
  if (!tuner_store_take(&tuner->store)) {
    return NULL;
  }
  const TunerTable* const table = tuner_store_table(&tuner->store);
  tuner->is_due[TUNER_SCALE] = tuner->is_due[TUNER_MAPPING] = true;
  tuner->is_change_due = tuner->is_change_due || table->n_wishes != tuner->n_wishes;
  tuner->n_wishes = table->n_wishes;
  return table->semitones;
}

const double* tuner_pitches(const Tuner* tuner) {
  return tuner_store_table(&tuner->store)->semitones;
}

void tuner_hear(Tuner* tuner, LV2_URID type, const uint8_t* body, uint32_t n_bytes) {
  const TunerUrids* const urids = &tuner->urids;
  const LV2_URID class = atom_object_class(body, n_bytes);
  const bool is_object =
      type == urids->atom_Object || type == urids->atom_Blank || type == urids->atom_Resource;
  if (!is_object || !is_for_us(tuner, body, n_bytes)) {
    return;
  }
  if (class == urids->patch_Set) {
    hear_set(tuner, body, n_bytes);
  } else if (class == urids->patch_Get) {
    hear_get(tuner, body, n_bytes);
  }
}

void tuner_tell(Tuner* tuner, LV2_Atom_Sequence* notify, uint32_t room) {
  ask_worker(tuner);
  for (int f = 0; f < TUNER_N_FILES; ++f) {
    tuner->is_due[f] = tuner->is_due[f] && !events_append(notify, room, write_set(tuner, f));
  }
  tuner->is_change_due = tuner->is_change_due && !events_append(notify, room, write_change(tuner));
}

LV2_Worker_Status tuner_work(Tuner* tuner, uint32_t n_bytes, const void* request) {
  TunerRequest wish = {0};
  if (n_bytes <= REQUEST_HEAD || n_bytes > sizeof(wish)) {
    return LV2_WORKER_ERR_UNKNOWN;
  }
  memcpy(&wish, request, n_bytes);
  if (wish.file >= TUNER_N_FILES || wish.path[n_bytes - REQUEST_HEAD - 1] != '\0') {
    return LV2_WORKER_ERR_UNKNOWN;
  }
  const char* paths[TUNER_N_FILES] = {NULL, NULL};
  paths[wish.file] = wish.path;
  tuner_load(tuner, paths, true);
  return LV2_WORKER_SUCCESS;
}

void tuner_load(Tuner* tuner, const char* const paths[TUNER_N_FILES], bool is_wish) {
  TunerFaults faults;
  tuner_store_load(&tuner->store, paths, is_wish, &faults);
  for (int f = 0; f < TUNER_N_FILES; ++f) {
    if (faults.fault[f].line[0]) {
      say(tuner, tuner->urids.log_Error, faults.fault[f].line);
    }
  }
}
