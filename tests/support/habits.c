#include "tests/support/habits.h"

#include "tests/support/guitar_host.h"
#include "tests/support/host_inside.h"
#include "tests/support/host_state.h"
#include "tests/support/measure.h"
#include "tests/support/scale_host.h"

#include <lv2/midi/midi.h>

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { BLOCK = PLUGINS_BLOCK };

void habits_play(Host* host) {
  strings_note_on(host, 3, 45, 100);
  strings_note_on(host, 700, 52, 80);
  strings_bend(host, 1500, 1.0);
  strings_note_off(host, 5000, 45);
}

Sound habits_alone(int plugin) {
  Host* const host = plugins_open(plugin);
  Sound sound = sound_new(HABITS_FRAMES);
  habits_play(host);
  strings_run(host, &sound, 0, HABITS_FRAMES, BLOCK);
  host_free(host);
  return sound;
}

void habits_assert_alike(int plugin, Host* host) {
  Sound alone = habits_alone(plugin);
  Sound sound = sound_new(HABITS_FRAMES);
  habits_play(host);
  strings_run(host, &sound, 0, HABITS_FRAMES, BLOCK);
  assert_true(measure_peak(sound.left, HABITS_FRAMES) > 0.01);
  assert_true(sound_is_same(&alone, &sound));
  sound_free(&alone);
  sound_free(&sound);
  host_free(host);
}

/* Behind the head of the sequence, which takes 16 bytes with its body, stands one event. */
void habits_run_at_odd_places(Host* host, float* left, float* right) {
  const LV2_Atom_Sequence head = {{24 + 8, host_map(host, LV2_ATOM__Sequence)}, {0, 0}};
  const LV2_Atom_Event event = {{0}, {3, host_map(host, LV2_MIDI__MidiEvent)}};
  const uint8_t note_on[8] = {0x90, 60, 100};
  uint8_t* const memory = malloc(4 + 16 + 24);
  assert_non_null(memory);
  memcpy(memory + 4, &head, 16);
  memcpy(memory + 20, &event, 16);
  memcpy(memory + 36, note_on, 8);
  host_connect(host, host_port_index(host, "control"), memory + 4);
  host_connect(host, host_port_index(host, "out_left"), left);
  host_connect(host, host_port_index(host, "out_right"), right);
  host_activate(host);
  lilv_instance_run(host_instance(host), BLOCK);
  host_reconnect(host);
  free(memory);
}

typedef struct {
  Host* host;
  atomic_bool is_over;
  atomic_uint n_runs;
} Runner;

static void* run_all_the_time(void* data) {
  Runner* const runner = data;
  while (!atomic_load(&runner->is_over)) {
    lilv_instance_run(host_instance(runner->host), atomic_fetch_add(&runner->n_runs, 1) % BLOCK);
  }
  return NULL;
}

void habits_restore_while_it_runs(Host* host, LilvState* const states[2]) {
  enum { TIMES = 400, RUNS = 20 };
  Runner runner = {host, false, 0};
  pthread_t thread;
  host_activate(host);
  host_connect(host, host_port_index(host, "control"), NULL);
  assert_int_equal(pthread_create(&thread, NULL, run_all_the_time, &runner), 0);
  for (unsigned i = 0; i % 2 == 1 || i < TIMES || atomic_load(&runner.n_runs) < RUNS; ++i) {
    host_restore_state(host, states[i % 2]);
    LilvState* const now = host_save_state(host);
    assert_true(lilv_state_equals(now, states[i % 2]));
    lilv_state_free(now);
  }
  atomic_store(&runner.is_over, true);
  assert_int_equal(pthread_join(thread, NULL), 0);
  host_reconnect(host);
}

Host* habits_open_session(int plugin, HostWork mode, const char* statements) {
  char turtle[2 * SCALE_HOST_PATH];
  (void)snprintf(turtle, sizeof(turtle),
                 "@prefix pset: <http://lv2plug.in/ns/ext/presets#> .\n"
                 "@prefix state: <http://lv2plug.in/ns/ext/state#> .\n"
                 "@prefix atom: <http://lv2plug.in/ns/ext/atom#> .\n"
                 "@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .\n"
                 "<urn:hooke:state> a pset:Preset ;\n"
                 "  <http://lv2plug.in/ns/lv2core#appliesTo> <%s> ;\n"
                 "  state:state [ %s ] .\n",
                 plugin ? GUITAR_URI : STRINGS_URI, statements);
  Host* const host = plugins_open(plugin);
  LilvState* const state = host_state_from_string(host, turtle);
  assert_non_null(state);
  host_worker(host)->mode = mode;
  host_restore_state(host, state);
  lilv_state_free(state);
  assert_true(host_run(host, BLOCK));
  strings_restart(host);
  return host;
}

void habits_assert_same(Host* a, Host* b) {
  assert_true(host_run(a, BLOCK) && host_run(b, BLOCK));
  strings_restart(a);
  strings_restart(b);
  plugins_assert_same(a, b);
  host_free(a);
  host_free(b);
}
