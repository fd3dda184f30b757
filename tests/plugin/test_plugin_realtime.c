/* What is called on the audio thread takes no memory. */
#define _POSIX_C_SOURCE 200809L

#include "tests/support/guitar_host.h"
#include "tests/support/host_inside.h"
#include "tests/support/host_state.h"
#include "tests/support/random.h"
#include "tests/support/scale_host.h"

#include <dlfcn.h>
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Sanitizers bring a heap of their own, which cannot be watched from here. */
#if defined(__SANITIZE_ADDRESS__)
#define HAS_OWN_HEAP 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAS_OWN_HEAP 1
#endif
#endif

enum { RATE = 48000, BLOCK = 512, N_RUNS = 800 };

static const char* program;

/* Calls of the heap that the thread has made while it was watched. */
static _Thread_local bool is_watched;
static _Thread_local unsigned n_heap_calls;

#if !defined(HAS_OWN_HEAP) && defined(__GLIBC__)

#define SEEN __attribute__((visibility("default")))

void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* memory);

static void count(void) {
  n_heap_calls += is_watched;
}

SEEN void* malloc(size_t size) {
  count();
  return __libc_malloc(size);
}

SEEN void* calloc(size_t n, size_t size) {
  count();
  return __libc_calloc(n, size);
}

SEEN void* realloc(void* memory, size_t size) {
  count();
  return __libc_realloc(memory, size);
}

SEEN void* aligned_alloc(size_t alignment, size_t size) {
  count();
  return __libc_memalign(alignment, size);
}

SEEN int posix_memalign(void** memory, size_t alignment, size_t size) {
  count();
  *memory = __libc_memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}

SEEN void free(void* memory) {
  count();
  __libc_free(memory);
}

#define CAN_WATCH 1
#else
#define CAN_WATCH 0
#endif

/* The four functions that a host may call on the audio thread, each watched. */
typedef struct {
  const LV2_Descriptor* descriptor;
  LV2_Handle handle;
} Watched;

static Watched watch(Host* host) {
  LilvInstance* const instance = host_instance(host);
  return (Watched){lilv_instance_get_descriptor(instance), lilv_instance_get_handle(instance)};
}

static void watched_activate(Watched plugin) {
  is_watched = true;
  plugin.descriptor->activate(plugin.handle);
  is_watched = false;
}

static void watched_deactivate(Watched plugin) {
  is_watched = true;
  if (plugin.descriptor->deactivate) {
    plugin.descriptor->deactivate(plugin.handle);
  }
  is_watched = false;
}

static void watched_connect(Watched plugin, uint32_t port, void* data) {
  is_watched = true;
  plugin.descriptor->connect_port(plugin.handle, port, data);
  is_watched = false;
}

static void watched_run(Watched plugin, uint32_t n_frames) {
  is_watched = true;
  plugin.descriptor->run(plugin.handle, n_frames);
  is_watched = false;
}

/* What a run is given when the host's own run() is not used: its event atoms are written here. */
typedef struct {
  LV2_Atom_Sequence head;
  LV2_Atom_Event event;
  uint8_t bytes[8];
} OneEvent;

static OneEvent one_event(Host* host, uint32_t frame, unsigned status, unsigned a, unsigned b) {
  return (OneEvent){
      .head = {.atom = {sizeof(OneEvent) - sizeof(LV2_Atom),
                        host_map(host, "http://lv2plug.in/ns/ext/atom#Sequence")}},
      .event = {.time.frames = frame,
                .body = {status == 0xC0 ? 2 : 3,
                         host_map(host, "http://lv2plug.in/ns/ext/midi#MidiEvent")}},
      .bytes = {(uint8_t)status, (uint8_t)a, (uint8_t)b},
  };
}

/* A run with one random message, and now and then a port moved, anywhere in its range. */
static void run_something(Host* host, Watched plugin, Random* random) {
  static const unsigned statuses[] = {0x90, 0x90, 0x90, 0x80, 0xB0, 0xC0, 0xE0, 0xF0};
  static const unsigned controllers[] = {64, 64, 120, 121, 123, 1, 6, 38, 67, 100, 101};
  const unsigned status = statuses[random_below(random, 8)];
  const unsigned a =
      status == 0xB0 ? controllers[random_below(random, 11)] : random_below(random, 128);
  OneEvent event =
      one_event(host, random_below(random, BLOCK), status, a, random_below(random, 128));
  const uint32_t port = random_below(random, host_n_ports(host));
  HostRange range;
  if (host_range(host, host_port_symbol(host, port), &range)) {
    strings_set(host, host_port_symbol(host, port),
                random_between(random, (double)range.min, (double)range.max));
  }
  watched_connect(plugin, 0, &event);
  watched_run(plugin, random_below(random, BLOCK + 1));
  watched_connect(plugin, 0, NULL);
}

static void check_plugin(Host* host) {
  const Watched plugin = watch(host);
  Random random = random_start();
  n_heap_calls = 0;
  watched_activate(plugin);
  for (int i = 0; i < N_RUNS; ++i) {
    run_something(host, plugin, &random);
    if (i % 100 == 99) {
      watched_deactivate(plugin);
      watched_activate(plugin);
    }
  }
  watched_deactivate(plugin);
  host_free(host);
  print_message("%u calls of the heap\n", n_heap_calls);
  assert_int_equal(n_heap_calls, 0);
}

static void the_audio_thread_takes_no_memory(void** state) {
  (void)state;
  if (!CAN_WATCH) {
    skip();
  }
  check_plugin(strings_open(RATE, BLOCK));
  check_plugin(guitar_open(RATE, BLOCK));
}

/* A message about the files, and room for its answers. */
typedef struct {
  LV2_Atom_Sequence head;
  int64_t frame;
  uint8_t message[SCALE_HOST_PATH];
} Wish;

typedef struct {
  LV2_Atom_Sequence head;
  uint8_t bytes[4 * SCALE_HOST_PATH];
} Answers;

static void run_wish(Host* host, Watched plugin, const char* parameter, const char* path) {
  static Wish wish;
  static Answers answers;
  memset(&wish, 0, sizeof(wish));
  wish.head.atom.type = host_map(host, "http://lv2plug.in/ns/ext/atom#Sequence");
  wish.head.atom.size =
      16 + 8 + scale_message(host, parameter, path, wish.message, sizeof(wish.message));
  answers.head.atom.size = sizeof(answers) - sizeof(LV2_Atom);
  watched_connect(plugin, 0, &wish);
  watched_connect(plugin, 1, &answers);
  watched_run(plugin, BLOCK);
  watched_connect(plugin, 0, NULL);
  assert_true(path || answers.head.atom.size > sizeof(LV2_Atom_Sequence_Body));
}

static ScalePath parameter_of(const char* uri, const char* name) {
  ScalePath parameter;
  (void)snprintf(parameter.text, sizeof(parameter.text), "%s#%s", uri, name);
  return parameter;
}

/* The worker has no room, for what else it does here is the host's own and takes memory; so tables
 * come from a session, between the runs. */
static void check_files(Host* host, const char* uri) {
  const Watched plugin = watch(host);
  const ScalePath directory = scale_new_directory();
  const ScalePath body = scale_write_body(&directory, "a.body", BODIES_GRAND);
  const ScalePath path = scale_path("just-major.scl");
  LilvState* states[2];
  for (int i = 0; i < 2; ++i) {
    const char* const names[] = {i ? "19-equal.scl" : NULL, i ? NULL : "white-keys.kbm"};
    assert_true(host_set_file(host, parameter_of(uri, "scale").text, scale_path(names[0]).text));
    assert_true(host_set_file(host, parameter_of(uri, "mapping").text, scale_path(names[1]).text));
    assert_true(host_set_file(host, parameter_of(uri, "body").text, i ? body.text : ""));
    states[i] = host_save_state(host);
  }
  strings_set(host, "body", BODIES_FILE);
  host_worker(host)->mode = HOST_WORK_REFUSED;
  for (uint32_t key = 30; key < 90; key += 4) {
    strings_note_on(host, 0, key, 127);
  }
  assert_true(host_run(host, BLOCK));
  n_heap_calls = 0;
  for (int i = 0; i < 20; ++i) {
    host_restore_state(host, states[i % 2]);
    run_wish(host, plugin, parameter_of(uri, i % 4 < 2 ? "scale" : "body").text, path.text);
    run_wish(host, plugin, NULL, NULL);
  }
  lilv_state_free(states[0]);
  lilv_state_free(states[1]);
  host_free(host);
  scale_remove_directory(&directory);
  print_message("%u calls of the heap\n", n_heap_calls);
  assert_int_equal(n_heap_calls, 0);
}

static void new_files_take_no_memory(void** state) {
  (void)state;
  if (!CAN_WATCH) {
    skip();
  }
  check_files(strings_open(RATE, BLOCK), STRINGS_URI);
  check_files(guitar_open(RATE, BLOCK), GUITAR_URI);
}

/* The control: a library built as the plugin is, whose function calls the heap seven times. */
static void the_watch_sees_a_planted_use_of_the_heap(void** state) {
  (void)state;
  if (!CAN_WATCH) {
    skip();
  }
  char path[4096];
  const char* const slash = strrchr(program, '/');
  (void)snprintf(path, sizeof(path), "%.*splant_heap.so", slash ? (int)(slash - program + 1) : 0,
                 program);
  void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    fail_msg("%s", dlerror());
  }
  void (*plant)(void) = NULL;
  void* const symbol = dlsym(library, "plant_heap");
  assert_non_null(symbol);
  memcpy(&plant, &symbol, sizeof(plant));
  n_heap_calls = 0;
  is_watched = true;
  plant();
  is_watched = false;
  const unsigned n_seen = n_heap_calls;
  n_heap_calls = 0;
  plant();
  (void)dlclose(library);
  print_message("%u calls of the heap\n", n_seen);
  assert_int_equal(n_seen, 7);
  assert_int_equal(n_heap_calls, 0);
}

int main(int argc, char** argv) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_audio_thread_takes_no_memory),
      cmocka_unit_test(new_files_take_no_memory),
      cmocka_unit_test(the_watch_sees_a_planted_use_of_the_heap),
  };
  program = argc > 0 ? argv[0] : "";
  return cmocka_run_group_tests(tests, NULL, NULL);
}
