/* Whatever a state holds under the names of an instrument's files: it is restored or not, the
 * instrument plays on, and what it then saves is whole. */
#define _POSIX_C_SOURCE 200809L

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/plug.h"

#include <stdlib.h>
#include <string.h>

enum { N_FILES = 3, LONGEST = 5000 };

typedef struct {
  uint8_t* bytes; /* NULL: there is nothing */
  size_t n_bytes;
  LV2_URID type;
} Value;

typedef struct {
  LV2_URID keys[N_FILES];
  Value values[N_FILES];
  uint32_t mapping; /* What the host makes of a path */
  const char* file;
  bool is_saved[N_FILES];
} State;

static int index_of(const State* state, uint32_t key) {
  int i = 0;
  while (i < N_FILES && state->keys[i] != key) {
    ++i;
  }
  return i;
}

static const void*
retrieve(LV2_State_Handle handle, uint32_t key, size_t* n_bytes, uint32_t* type, uint32_t* flags) {
  const State* const state = handle;
  const int i = index_of(state, key);
  FUZZ_CLAIM(i < N_FILES);
  *n_bytes = state->values[i].n_bytes;
  *type = state->values[i].type;
  *flags = LV2_STATE_IS_POD;
  return state->values[i].bytes;
}

static LV2_State_Status store(LV2_State_Handle handle,
                              uint32_t key,
                              const void* value,
                              size_t n_bytes,
                              uint32_t type,
                              uint32_t flags) {
  State* const state = handle;
  const int i = index_of(state, key);
  FUZZ_CLAIM(i < N_FILES && !state->is_saved[i]);
  FUZZ_CLAIM(n_bytes > 0 && strnlen(value, n_bytes) == n_bytes - 1);
  FUZZ_CLAIM(type == plug_urid(LV2_ATOM__Path));
  FUZZ_CLAIM(flags & LV2_STATE_IS_POD);
  state->is_saved[i] = true;
  return LV2_STATE_SUCCESS;
}

static char* long_path(void) {
  char* const path = malloc(LONGEST + 1);
  FUZZ_CLAIM(path);
  memset(path, 'a', LONGEST);
  path[LONGEST] = '\0';
  return path;
}

static char* map_path(LV2_State_Map_Path_Handle handle, const char* path) {
  const State* const state = handle;
  switch (state->mapping) {
  case 0:
    return (char*)fuzz_copy((const uint8_t*)state->file, strlen(state->file) + 1);
  case 1:
    return long_path();
  case 2:
    return NULL;
  default:
    return (char*)fuzz_copy((const uint8_t*)path, strlen(path) + 1);
  }
}

/* A value of no type, of the right ones and of wrong ones, and of a size that is its own. */
static Value take_value(FuzzFeed* feed) {
  const uint32_t what = fuzz_byte(feed);
  const char* const types[] = {LV2_ATOM__Path, LV2_ATOM__String, LV2_ATOM__String, LV2_ATOM__Int};
  Value value = {.type = plug_urid(types[what % 4])};
  if (what >= 16) {
    const size_t length = what < 128 ? what / 4 : fuzz_word(feed);
    value.bytes = fuzz_take(feed, length, &value.n_bytes);
  }
  return value;
}

static State take_state(FuzzFeed* feed) {
  State state = {.keys = {plug_urid("urn:hooke:strings#scale"),
                          plug_urid("urn:hooke:strings#mapping"),
                          plug_urid("urn:hooke:strings#body")},
                 .mapping = fuzz_byte(feed) % 5};
  for (int i = 0; i < N_FILES; ++i) {
    state.values[i] = take_value(feed);
  }
  state.file = fuzz_file(feed->at, feed->n_left);
  return state;
}

/* Playing on takes what is new, and tells of it. */
static void play_on(Plug* plug) {
  for (int i = 0; i < 3; ++i) {
    plug_run(plug, NULL, 16);
  }
}

static void restore_and_save(Plug* plug, State* state) {
  LV2_State_Map_Path paths = {state, map_path, map_path};
  const LV2_Feature feature = {LV2_STATE__mapPath, &paths};
  const LV2_Feature* const features[] = {state->mapping < 4 ? &feature : NULL, NULL};
  const LV2_State_Status status = plug->state->restore(plug->handle, retrieve, state, 0, features);
  FUZZ_CLAIM(status == LV2_STATE_SUCCESS || status == LV2_STATE_ERR_BAD_TYPE);
  play_on(plug);
  FUZZ_CLAIM(!plug->state->save(plug->handle, store, state, 0, features));
}

void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  FuzzFeed feed = {bytes, n_bytes};
  const uint32_t head = fuzz_byte(&feed);
  State state = take_state(&feed);
  Plug* const plug = plug_in(&plug_strings, 48000.0);
  plug->n_room = head < 128 ? PLUG_MAX_NOTIFY : 0;
  restore_and_save(plug, &state);
  FUZZ_CLAIM(state.is_saved[0] && state.is_saved[1] && state.is_saved[2]);
  for (int i = 0; i < N_FILES; ++i) {
    free(state.values[i].bytes);
  }
}
