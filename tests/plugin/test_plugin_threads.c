/* A host with threads: one runs the instrument, one does its work, one saves sessions.  Under
 * ThreadSanitizer no two of them may touch the same memory unheeded; anywhere, what was asked for
 * last is what holds. */
#define _POSIX_C_SOURCE 200809L

#include "plugin/bundle.h"
#include "plugin/files.h"
#include "plugin/ports.h"

#include <lv2/atom/forge.h>
#include <lv2/log/log.h>
#include <lv2/midi/midi.h>
#include <lv2/patch/patch.h>
#include <lv2/state/state.h>
#include <lv2/worker/worker.h>

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
  MAX_URIS = 64,
  FRAMES = 64,
  ROOM = 16384,
  MAX_WAITING = 8,
  N_LOADS = 150,
  MOST_RUNS = 200000
};

static const double RATE_HZ = 48000.0;

/* Work that waits for its thread. */
typedef struct {
  uint32_t n_bytes;
  _Alignas(8) uint8_t bytes[sizeof(FilesRequest)];
} Job;

typedef struct {
  const LV2_Descriptor* descriptor;
  LV2_Handle handle;
  const LV2_Worker_Interface* worker;
  const LV2_State_Interface* state;
  pthread_mutex_t lock;
  Job jobs[MAX_WAITING];
  uint32_t n_jobs;
  atomic_uint n_loads;
  atomic_uint n_saves;
  atomic_uint n_lines;
  atomic_bool is_over;
  float values[PORTS_MAX];
  _Alignas(8) uint8_t control[ROOM];
  _Alignas(8) uint8_t notify[ROOM];
} Player;

static LV2_URID map_uri(LV2_URID_Map_Handle handle, const char* uri) {
  static char uris[MAX_URIS][128];
  static uint32_t n_uris;
  (void)handle;
  for (uint32_t i = 0; i < n_uris; ++i) {
    if (!strcmp(uris[i], uri)) {
      return i + 1;
    }
  }
  assert_true(n_uris < MAX_URIS && strlen(uri) < sizeof(uris[0]));
  strcpy(uris[n_uris], uri);
  return ++n_uris;
}

static LV2_Worker_Status
schedule(LV2_Worker_Schedule_Handle handle, uint32_t n_bytes, const void* data) {
  Player* const player = handle;
  (void)pthread_mutex_lock(&player->lock);
  const bool has_room = player->n_jobs < MAX_WAITING && n_bytes <= sizeof(player->jobs[0].bytes);
  if (has_room) {
    Job* const job = &player->jobs[player->n_jobs++];
    job->n_bytes = n_bytes;
    memcpy(job->bytes, data, n_bytes);
  }
  (void)pthread_mutex_unlock(&player->lock);
  return has_room ? LV2_WORKER_SUCCESS : LV2_WORKER_ERR_NO_SPACE;
}

static LV2_Worker_Status
respond(LV2_Worker_Respond_Handle handle, uint32_t n_bytes, const void* data) {
  (void)handle;
  (void)n_bytes;
  (void)data;
  return LV2_WORKER_SUCCESS;
}

__attribute__((format(printf, 3, 4))) static int
print(LV2_Log_Handle handle, LV2_URID type, const char* format, ...) {
  Player* const player = handle;
  (void)type;
  (void)format;
  atomic_fetch_add(&player->n_lines, 1);
  return 0;
}

static bool take_job(Player* player, Job* job) {
  (void)pthread_mutex_lock(&player->lock);
  const bool is_there = player->n_jobs > 0;
  if (is_there) {
    *job = player->jobs[0];
    memmove(&player->jobs[0], &player->jobs[1], --player->n_jobs * sizeof(Job));
  }
  (void)pthread_mutex_unlock(&player->lock);
  return is_there;
}

/* What is left when all is over is done still. */
static void* do_work(void* data) {
  Player* const player = data;
  for (bool is_over = false; !is_over;) {
    Job job;
    is_over = atomic_load(&player->is_over);
    while (take_job(player, &job)) {
      (void)player->worker->work(player->handle, respond, player, job.n_bytes, job.bytes);
      atomic_fetch_add(&player->n_loads, 1);
    }
  }
  return NULL;
}

/* The path of one of the files. */
static LV2_State_Status keep_path(LV2_State_Handle handle,
                                  uint32_t key,
                                  const void* value,
                                  size_t n_bytes,
                                  uint32_t type,
                                  uint32_t flags) {
  char* const path = handle;
  (void)type;
  (void)flags;
  if (key == map_uri(NULL, "urn:hooke:strings#scale")) {
    assert_true(n_bytes > 0 && n_bytes <= FILES_PATH_SIZE);
    memcpy(path, value, n_bytes);
  }
  return LV2_STATE_SUCCESS;
}

static void* save_all_the_time(void* data) {
  Player* const player = data;
  static const LV2_Feature* const none[] = {NULL};
  static char path[FILES_PATH_SIZE];
  while (!atomic_load(&player->is_over)) {
    (void)player->state->save(player->handle, keep_path, path, 0, none);
    atomic_fetch_add(&player->n_saves, 1);
  }
  return NULL;
}

static void path_of(const char* name, char path[FILES_PATH_SIZE]) {
  const char* const source = getenv("HOOKE_SOURCE");
  (void)snprintf(path, FILES_PATH_SIZE, "%s/tests/scales/%s", source ? source : ".", name);
}

/* A note, and a file that is asked for. */
static void write_control(Player* player, const char* path, uint8_t key) {
  LV2_URID_Map map = {NULL, map_uri};
  LV2_Atom_Forge forge;
  LV2_Atom_Forge_Frame sequence;
  LV2_Atom_Forge_Frame object;
  const uint8_t note[3] = {0x90, key, 90};
  lv2_atom_forge_init(&forge, &map);
  lv2_atom_forge_set_buffer(&forge, player->control, ROOM);
  lv2_atom_forge_sequence_head(&forge, &sequence, 0);
  if (path) {
    lv2_atom_forge_frame_time(&forge, 0);
    lv2_atom_forge_object(&forge, &object, 0, map_uri(NULL, LV2_PATCH__Set));
    lv2_atom_forge_key(&forge, map_uri(NULL, LV2_PATCH__property));
    lv2_atom_forge_urid(&forge, map_uri(NULL, "urn:hooke:strings#scale"));
    lv2_atom_forge_key(&forge, map_uri(NULL, LV2_PATCH__value));
    lv2_atom_forge_path(&forge, path, (uint32_t)strlen(path) + 1);
    lv2_atom_forge_pop(&forge, &object);
    lv2_atom_forge_frame_time(&forge, FRAMES / 2);
    lv2_atom_forge_atom(&forge, sizeof(note), map_uri(NULL, LV2_MIDI__MidiEvent));
    lv2_atom_forge_write(&forge, note, sizeof(note));
  }
  lv2_atom_forge_pop(&forge, &sequence);
}

static void run(Player* player, const char* path, uint8_t key) {
  static float out[2][FRAMES];
  LV2_Atom* const notify = (LV2_Atom*)(void*)player->notify;
  write_control(player, path, key);
  *notify = (LV2_Atom){ROOM - sizeof(LV2_Atom), 0};
  player->descriptor->connect_port(player->handle, PORT_CONTROL, player->control);
  player->descriptor->connect_port(player->handle, PORT_NOTIFY, player->notify);
  player->descriptor->connect_port(player->handle, PORT_OUT_LEFT, out[0]);
  player->descriptor->connect_port(player->handle, PORT_OUT_RIGHT, out[1]);
  player->descriptor->run(player->handle, FRAMES);
  for (int i = 0; i < FRAMES; ++i) {
    assert_true(isfinite(out[0][i]) && isfinite(out[1][i]));
  }
}

static void start(Player* player) {
  static LV2_URID_Map map = {NULL, map_uri};
  static LV2_Log_Log log;
  static LV2_Worker_Schedule work;
  log = (LV2_Log_Log){player, print, NULL};
  work = (LV2_Worker_Schedule){player, schedule};
  static const LV2_Feature features[] = {
      {LV2_URID__map, &map}, {LV2_LOG__log, &log}, {LV2_WORKER__schedule, &work}};
  static const LV2_Feature* const list[] = {&features[0], &features[1], &features[2], NULL};
  assert_int_equal(pthread_mutex_init(&player->lock, NULL), 0);
  player->handle = player->descriptor->instantiate(player->descriptor, RATE_HZ, "", list);
  assert_non_null(player->handle);
  player->worker = player->descriptor->extension_data(LV2_WORKER__interface);
  player->state = player->descriptor->extension_data(LV2_STATE__interface);
  assert_true(player->worker && player->state);
  for (uint32_t i = 0; i < PORTS_MAX; ++i) {
    player->descriptor->connect_port(player->handle, i, &player->values[i]);
  }
  player->descriptor->activate(player->handle);
}

static void files_load_while_it_runs_and_is_saved(void** state) {
  (void)state;
  static Player player;
  static const LV2_Feature* const none[] = {NULL};
  static const char* const names[] = {"19-equal.scl", "none.scl", "just-major.scl",
                                      "../fuzz/seeds/body/guitar.body"};
  char path[FILES_PATH_SIZE];
  char saved[FILES_PATH_SIZE] = "";
  pthread_t threads[2];
  uint32_t n_runs = 0;
  player.descriptor = &strings_descriptor;
  start(&player);
  assert_int_equal(pthread_create(&threads[0], NULL, do_work, &player), 0);
  assert_int_equal(pthread_create(&threads[1], NULL, save_all_the_time, &player), 0);
  for (; n_runs < MOST_RUNS && atomic_load(&player.n_loads) < N_LOADS; ++n_runs) {
    path_of(names[n_runs / 8 % 4], path);
    run(&player, n_runs % 8 ? NULL : path, (uint8_t)(40 + n_runs % 40));
  }
  path_of("meantone.scl", path);
  run(&player, path, 60);
  atomic_store(&player.is_over, true);
  assert_int_equal(pthread_join(threads[0], NULL), 0);
  assert_int_equal(pthread_join(threads[1], NULL), 0);
  run(&player, NULL, 60);
  print_message("  %u loads, %u of them in vain, and %u saves in %u runs\n",
                atomic_load(&player.n_loads), atomic_load(&player.n_lines),
                atomic_load(&player.n_saves), n_runs);
  assert_true(atomic_load(&player.n_loads) >= N_LOADS && atomic_load(&player.n_lines) > 10);
  assert_true(atomic_load(&player.n_saves) > 10);
  assert_int_equal(player.state->save(player.handle, keep_path, saved, 0, none), LV2_STATE_SUCCESS);
  assert_string_equal(saved, path);
  player.descriptor->cleanup(player.handle);
  assert_int_equal(pthread_mutex_destroy(&player.lock), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(files_load_while_it_runs_and_is_saved),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
