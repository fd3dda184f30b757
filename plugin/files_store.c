#define _POSIX_C_SOURCE 200809L

#include "plugin/files_store.h"

#include <math.h>
#include <string.h>

enum { IS_NEW = 4, INDEX = 3 };

static const double A4_HZ = 440.0;

/* The instrument's own tuning of A4 multiplies what is made for 440 Hz.  What is equal temperament
 * is so to the last bit. */
static double semitones_of(uint32_t key, double hz) {
  const double equal = (double)key - 69.0;
  return hz == A4_HZ * exp2(equal / 12.0) ? equal : 12.0 * log2(hz / A4_HZ);
}

/* The readers leave nothing that cannot be tuned. */
static void tune(const FilesStore* store, double semitones[SCALE_KEYS]) {
  double hz[SCALE_KEYS];
  for (uint32_t key = 0; key < SCALE_KEYS; ++key) {
    hz[key] = (double)NAN;
  }
  (void)scale_tune(&store->scale, &store->map, A4_HZ, hz);
  for (uint32_t key = 0; key < SCALE_KEYS; ++key) {
    semitones[key] = semitones_of(key, hz[key]);
  }
}

static void write_table(const FilesStore* store, FilesTable* table) {
  tune(store, table->semitones);
  table->body = store->body;
  table->paths = store->paths;
  table->counts = store->counts;
}

static void hand_over(FilesStore* store) {
  write_table(store, &store->tables[store->written]);
  const uint32_t passed =
      atomic_exchange_explicit(&store->between, store->written | IS_NEW, memory_order_acq_rel);
  store->written = passed & INDEX;
}

static void keep_path(FilesStore* store, FilesKind file, const char* path) {
  char* const kept = store->paths.path[file];
  const size_t n_bytes = strnlen(path, FILES_PATH_SIZE - 1);
  memcpy(kept, path, n_bytes);
  kept[n_bytes] = '\0';
}

static void forget(FilesStore* store, FilesKind file) {
  keep_path(store, file, "");
  switch (file) {
  case FILES_SCALE:
    scale_free(&store->scale);
    scale_equal(&store->scale);
    break;
  case FILES_MAPPING:
    scale_map_free(&store->map);
    scale_map_linear(&store->map);
    break;
  case FILES_BODY:
  case FILES_COUNT:
    store->body.n_modes = 0;
    break;
  }
  store->counts.n_tunings += file == FILES_BODY ? 0 : 1;
}

static void take_content(FilesStore* store, const FilesContent* content) {
  switch (content->file) {
  case FILES_SCALE:
    store->scale = content->scale;
    break;
  case FILES_MAPPING:
    store->map = content->map;
    break;
  case FILES_BODY:
  case FILES_COUNT:
    store->body = content->body;
    break;
  }
}

static void
take_file(FilesStore* store, FilesKind asked, const char* path, bool is_wish, FilesFault* fault) {
  FilesContent content;
  files_read(path, asked, is_wish, &content, fault);
  forget(store, content.file);
  keep_path(store, content.file, path);
  if (content.is_good) {
    take_content(store, &content);
  }
}

/* All else of a body follows from its modes. */
static bool is_same_body(const Body* a, const Body* b) {
  return a->n_modes == b->n_modes && !memcmp(a->modes, b->modes, a->n_modes * sizeof(BodyMode));
}

bool files_store_init(FilesStore* store) {
  memset(store, 0, sizeof(*store));
  if (pthread_mutex_init(&store->lock, NULL)) {
    return false;
  }
  scale_equal(&store->scale);
  scale_map_linear(&store->map);
  store->written = 0;
  atomic_init(&store->between, 1u);
  store->played = 2;
  write_table(store, &store->tables[store->played]);
  return true;
}

void files_store_clear(FilesStore* store) {
  scale_free(&store->scale);
  scale_map_free(&store->map);
  (void)pthread_mutex_destroy(&store->lock);
}

void files_store_load(FilesStore* store,
                      const char* const paths[FILES_COUNT],
                      bool is_wish,
                      FilesFaults* faults) {
  (void)pthread_mutex_lock(&store->lock);
  const Body before = store->body;
  for (int f = 0; f < FILES_COUNT; ++f) {
    faults->fault[f].line[0] = '\0';
    if (paths[f] && !*paths[f]) {
      forget(store, (FilesKind)f);
    }
  }
  for (int f = 0; f < FILES_COUNT; ++f) {
    if (paths[f] && *paths[f]) {
      take_file(store, (FilesKind)f, paths[f], is_wish, &faults->fault[f]);
    }
  }
  store->counts.n_wishes += is_wish ? 1 : 0;
  store->counts.n_bodies += is_same_body(&before, &store->body) ? 0 : 1;
  hand_over(store);
  (void)pthread_mutex_unlock(&store->lock);
}

void files_store_paths(FilesStore* store, FilesPaths* paths) {
  (void)pthread_mutex_lock(&store->lock);
  *paths = store->paths;
  (void)pthread_mutex_unlock(&store->lock);
}

bool files_store_take(FilesStore* store) {
  if (!(atomic_load_explicit(&store->between, memory_order_relaxed) & IS_NEW)) {
    return false;
  }
  const uint32_t taken =
      atomic_exchange_explicit(&store->between, store->played, memory_order_acq_rel);
  store->played = taken & INDEX;
  return true;
}

const FilesTable* files_store_table(const FilesStore* store) {
  return &store->tables[store->played];
}
