/* Fifteen habits of hosts, of which each has broken some plugin: neither of ours may crash, reach
 * outside, or sound otherwise. */
#include "tests/support/guitar_host.h"
#include "tests/support/habits.h"
#include "tests/support/host_inside.h"
#include "tests/support/host_state.h"
#include "tests/support/measure.h"
#include "tests/support/scale_host.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { BLOCK = PLUGINS_BLOCK };

static const char* const uris[N_PLUGINS] = {STRINGS_URI, GUITAR_URI};
static const char* const labels[N_PLUGINS] = {"Koto", "Banjo"};

static void ports_may_be_null(void** state) {
  const int plugin = *(const int*)*state;
  Host* const host = plugins_open(plugin);
  for (int k = 0; k < 2; ++k) {
    for (uint32_t port = 0; port < host_n_ports(host); ++port) {
      host_connect(host, port, NULL);
    }
    assert_true(host_run(host, 0) && host_run(host, BLOCK));
    host_reconnect(host);
    strings_note_on(host, 0, 60, 100);
    assert_true(host_run(host, BLOCK));
  }
  strings_restart(host);
  habits_assert_alike(plugin, host);
}

static void runs_may_be_empty_and_odd(void** state) {
  static const uint32_t blocks[] = {1, 0, 255, 17, 0, 0, 256, 3, 128, 31};
  const int plugin = *(const int*)*state;
  Sound alone = habits_alone(plugin);
  Sound sound = sound_new(HABITS_FRAMES);
  Host* const host = plugins_open(plugin);
  habits_play(host);
  for (size_t at = 0, k = 0; at < HABITS_FRAMES; ++k) {
    const size_t n = blocks[k % 10] < HABITS_FRAMES - at ? blocks[k % 10] : HABITS_FRAMES - at;
    assert_true(n > 0 || host_run(host, 0));
    strings_run(host, &sound, at, at + n, BLOCK);
    at += n;
  }
  assert_true(sound_is_same(&alone, &sound));
  sound_free(&alone);
  sound_free(&sound);
  host_free(host);
}

static void buffers_may_be_aligned_to_four_bytes(void** state) {
  const int plugin = *(const int*)*state;
  for (size_t shift = 1; shift < 4; ++shift) {
    Host* const host = plugins_open(plugin);
    Host* const plain = plugins_open(plugin);
    Sound sound = sound_new(BLOCK);
    float* const memory = aligned_alloc(64, 2 * (BLOCK + 16) * sizeof(float));
    float* const right = memory + BLOCK + 16 + shift;
    habits_run_at_odd_places(host, memory + shift, right);
    strings_note_on(plain, 0, 60, 100);
    strings_run(plain, &sound, 0, BLOCK, BLOCK);
    assert_true(host_get(host, "sounding") == 1.0f);
    assert_memory_equal(memory + shift, sound.left, BLOCK * sizeof(float));
    assert_memory_equal(right, sound.right, BLOCK * sizeof(float));
    free(memory);
    sound_free(&sound);
    host_free(plain);
    host_free(host);
  }
}

/* There is no room for what a question would be answered with. */
static void the_notify_port_may_have_eight_bytes(void** state) {
  const int plugin = *(const int*)*state;
  Host* const host = plugins_open(plugin);
  Host* const roomy = plugins_open(plugin);
  assert_true(host_set_notify_capacity(host, 8));
  for (int k = 0; k < 2; ++k) {
    Host* const each = k ? host : roomy;
    scale_get(each, NULL);
    assert_true(host_run(each, BLOCK) && host_run(each, BLOCK));
    assert_true(host_notify(each)->atom.size <= (k ? 8u : 8192u));
  }
  plugins_assert_same(roomy, host);
  host_free(roomy);
  host_free(host);
}

static void left_and_right_may_be_one_buffer(void** state) {
  const int plugin = *(const int*)*state;
  Sound alone = habits_alone(plugin);
  Host* const host = plugins_open(plugin);
  float both[BLOCK];
  host_connect(host, host_port_index(host, "out_left"), both);
  host_connect(host, host_port_index(host, "out_right"), both);
  habits_play(host);
  assert_memory_not_equal(alone.left, alone.right, HABITS_FRAMES * sizeof(float));
  for (size_t at = 0; at < HABITS_FRAMES; at += BLOCK) {
    assert_true(host_run(host, BLOCK));
    for (size_t k = 0; k < BLOCK; ++k) {
      assert_true(both[k] == 0.5f * (alone.left[at + k] + alone.right[at + k]));
    }
  }
  sound_free(&alone);
  host_free(host);
}

/* It is that of the next block's first frame. */
static void an_event_may_stand_at_the_end_of_its_block(void** state) {
  const uint8_t note_on[3] = {0x90, 64, 127};
  const int plugin = *(const int*)*state;
  for (int k = 0; k < 2; ++k) {
    Host* const host = plugins_open(plugin);
    Sound sound = sound_new(2 * BLOCK);
    strings_set(host, "masses", 1.0);
    assert_true(host_midi_raw(host, BLOCK - k, note_on, 3));
    strings_run(host, &sound, 0, 2 * BLOCK, BLOCK);
    assert_true(measure_peak(sound.left, (size_t)(BLOCK - k)) == 0.0);
    assert_true(sound.left[BLOCK - k] != 0.0f);
    sound_free(&sound);
    host_free(host);
  }
}

static void events_may_be_out_of_order(void** state) {
  const uint8_t notes[2][3] = {{0x90, 45, 100}, {0x90, 57, 100}};
  const int plugin = *(const int*)*state;
  Host* hosts[2];
  for (int k = 0; k < 2; ++k) {
    hosts[k] = plugins_open(plugin);
    assert_true(host_midi_raw(hosts[k], 100, notes[0], 3));
    assert_true(host_midi_raw(hosts[k], k ? 20 : 100, notes[1], 3));
  }
  plugins_assert_same(hosts[0], hosts[1]);
  host_free(hosts[0]);
  host_free(hosts[1]);
}

static void* deactivate_twice(void* data) {
  LilvInstance* const instance = host_instance(data);
  host_deactivate(data);
  lilv_instance_deactivate(instance);
  lilv_instance_activate(instance);
  lilv_instance_activate(instance);
  return NULL;
}

static void activation_may_come_in_mid_note_and_on_any_thread(void** state) {
  const int plugin = *(const int*)*state;
  Host* const host = plugins_open(plugin);
  pthread_t thread;
  strings_controller(host, 0, STRINGS_PEDAL, 127);
  strings_bend(host, 0, -2.0);
  strings_note_on(host, 1, 60, 127);
  assert_true(host_run(host, BLOCK) && host_run(host, 7));
  assert_int_equal(pthread_create(&thread, NULL, deactivate_twice, host), 0);
  assert_int_equal(pthread_join(thread, NULL), 0);
  habits_assert_alike(plugin, host);
}

static LilvState* state_of_preset(Host* host, const char* label) {
  assert_true(host_preset(host, label) && host_run(host, BLOCK));
  return host_save_state(host);
}

/* A body takes some time to fade to another. */
static void let_fade(Host* host) {
  for (int i = 0; i < 20; ++i) {
    assert_true(host_run(host, BLOCK));
  }
}

/* In the end it sounds as the last of them. */
static void a_state_may_be_restored_while_it_runs(void** state) {
  const int plugin = *(const int*)*state;
  Host* const host = plugins_open(plugin);
  Host* const plain = plugins_open(plugin);
  LilvState* states[2] = {state_of_preset(host, "Default"), state_of_preset(host, labels[plugin])};
  assert_false(lilv_state_equals(states[0], states[1]));
  habits_restore_while_it_runs(host, states);
  assert_true(host_preset(plain, labels[plugin]));
  let_fade(host);
  habits_assert_same(plain, host);
  lilv_state_free(states[0]);
  lilv_state_free(states[1]);
}

/* What a session says of a tuning file of Hooke Strings. */
static const char* scale_statement(const char* path) {
  static char statement[SCALE_HOST_PATH + 256];
  (void)snprintf(statement, sizeof(statement), "<" SCALE_PARAMETER "> \"%s\"^^atom:Path", path);
  return statement;
}

static void there_may_be_no_worker(void** state) {
  static const HostConfig bare = {.rate_hz = PLUGINS_RATE, .max_block = BLOCK, .is_bare = true};
  const int plugin = *(const int*)*state;
  Host* const host = host_new_with(uris[plugin], &bare, NULL, 0);
  assert_non_null(host);
  habits_assert_alike(plugin, host);
  if (plugin == 0) {
    const ScalePath path = scale_path("19-equal.scl");
    Host* const tuned = habits_open_session(0, HOST_WORK_REFUSED, scale_statement(path.text));
    scale_assert_heard(tuned, "19-equal.scl", NULL);
    host_free(tuned);
  }
}

/* Hooke Guitar has no work. */
static void the_worker_may_work_inside_run(void** state) {
  const int plugin = *(const int*)*state;
  Host* const host = plugins_open(plugin);
  host_worker(host)->mode = HOST_WORK_IN_RUN;
  if (plugin == 0) {
    scale_use(host, "19-equal.scl", NULL);
    assert_int_equal(host_worker(host)->n_works, 2);
    scale_assert_heard(host, "19-equal.scl", NULL);
    host_free(host);
  } else {
    habits_assert_alike(plugin, host);
  }
}

/* They leave the files alone. */
static void presets_may_hold_ports_alone(void** state) {
  const int plugin = *(const int*)*state;
  Host* const host = plugins_open(plugin);
  Host* const plain = plugins_open(plugin);
  assert_true(host_preset(host, labels[plugin]) && host_run(host, BLOCK));
  assert_true(host_preset(host, "Default") && host_preset(plain, "Default"));
  let_fade(host);
  habits_assert_same(plain, host);
  if (plugin == 0) {
    Host* const tuned = plugins_open(plugin);
    scale_use(tuned, "19-equal.scl", NULL);
    assert_true(host_preset(tuned, "Default"));
    scale_assert_heard(tuned, "19-equal.scl", NULL);
    host_free(tuned);
  }
}

/* Of a plugin that is yet to come or of one that has been, and of any type. */
static void state_keys_may_be_unknown_newer_and_older(void** state) {
  const int plugin = *(const int*)*state;
  char statements[1024];
  (void)snprintf(statements, sizeof(statements),
                 "<%s#version> 99 ; <%s#bridge> \"oak\" ; <urn:x:any> \"/x\"^^atom:Path ; "
                 "<%s#table> \"AAECAw==\"^^xsd:base64Binary ; <%s#overlay> \"6:c1200000:0;\"",
                 uris[plugin], uris[plugin], uris[plugin], uris[plugin]);
  Host* const host = habits_open_session(plugin, HOST_WORK_AFTER_RUN, statements);
  habits_assert_alike(plugin, host);
}

/* Presets are theirs: a program and its bank change nothing, in mid-note neither. */
static void programs_may_be_changed(void** state) {
  const int plugin = *(const int*)*state;
  Host* const host = plugins_open(plugin);
  for (uint32_t channel = 0; channel < 16; ++channel) {
    for (uint32_t frame = 0; frame < HABITS_FRAMES; frame += 900 + channel) {
      strings_midi(host, frame, 0xB0 | channel, 0, channel);
      strings_midi(host, frame, 0xB0 | channel, 32, 1);
      strings_midi(host, frame, 0xC0 | channel, frame / 900, 0);
    }
  }
  habits_assert_alike(plugin, host);
}

/* Of Hooke Guitar a session says nothing of files, or what it has no ear for. */
static void files_may_be_missing(void** state) {
  const int plugin = *(const int*)*state;
  scale_log_begin();
  Host* const host =
      habits_open_session(plugin, HOST_WORK_REFUSED, scale_statement("/nowhere/a.scl"));
  char* const said = scale_log_end();
  assert_int_equal(strstr(said, "/nowhere/a.scl:1: found no text") != NULL, plugin == 0);
  free(said);
  LilvState* const saved = host_save_state(host);
  char* const turtle = host_state_to_string(host, saved);
  assert_int_equal(strstr(turtle, "/nowhere/a.scl") != NULL, plugin == 0);
  lilv_free(turtle);
  lilv_state_free(saved);
  habits_assert_alike(plugin, host);
}

#define OF_BOTH(claim)                                                                             \
  {"strings: " #claim, claim, NULL, NULL, &plugins[0]}, {                                          \
    "guitar: " #claim, claim, NULL, NULL, &plugins[1]                                              \
  }

int main(void) {
  static int plugins[N_PLUGINS] = {0, 1};
  const struct CMUnitTest tests[] = {
      OF_BOTH(ports_may_be_null),
      OF_BOTH(runs_may_be_empty_and_odd),
      OF_BOTH(buffers_may_be_aligned_to_four_bytes),
      OF_BOTH(the_notify_port_may_have_eight_bytes),
      OF_BOTH(left_and_right_may_be_one_buffer),
      OF_BOTH(an_event_may_stand_at_the_end_of_its_block),
      OF_BOTH(events_may_be_out_of_order),
      OF_BOTH(activation_may_come_in_mid_note_and_on_any_thread),
      OF_BOTH(a_state_may_be_restored_while_it_runs),
      OF_BOTH(there_may_be_no_worker),
      OF_BOTH(the_worker_may_work_inside_run),
      OF_BOTH(presets_may_hold_ports_alone),
      OF_BOTH(state_keys_may_be_unknown_newer_and_older),
      OF_BOTH(programs_may_be_changed),
      OF_BOTH(files_may_be_missing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
