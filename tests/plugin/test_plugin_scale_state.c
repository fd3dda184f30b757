/* A player's files in sessions and presets. */
#define _POSIX_C_SOURCE 200809L

#include "tests/support/host_inside.h"
#include "tests/support/host_state.h"
#include "tests/support/scale_host.h"

#include <lv2/atom/atom.h>
#include <lv2/state/state.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { RATE = 48000, BLOCK = 256 };

static const char SCALE[] = "19-equal.scl";
static const char MAPPING[] = "white-keys.kbm";
static const char FIFTHS[] = "Fifths\n1\n3/2\n";

/* A host whose state is that of a directory, as a session begins: without a worker. */
static Host* open_session(const ScalePath* directory) {
  Host* const host = strings_open(RATE, BLOCK);
  LilvState* const state = host_load_state_dir(host, directory->text);
  assert_non_null(state);
  host_worker(host)->mode = HOST_WORK_REFUSED;
  host_restore_state(host, state);
  lilv_state_free(state);
  assert_true(host_run(host, BLOCK));
  return host;
}

static void save(Host* host, const ScalePath* directory) {
  assert_true(host_save_state_dir(host, directory->text));
}

static void use_file_as(Host* host, const char* parameter, const ScalePath* path) {
  scale_set(host, parameter, path->text);
  assert_true(host_run(host, BLOCK) && host_run(host, BLOCK));
}

/* By the end of its path; an empty one: none at all. */
static void assert_told(Host* host, const char* parameter, const char* end) {
  ScalePath told;
  scale_get(host, parameter);
  assert_true(host_run(host, BLOCK));
  assert_true(scale_told(host, parameter, &told));
  assert_true(strlen(told.text) >= strlen(end) && (*end || !*told.text));
  assert_string_equal(told.text + strlen(told.text) - strlen(end), end);
}

static void assert_told_scale(Host* host, const char* end) {
  assert_told(host, SCALE_PARAMETER, end);
}

static void a_session_brings_its_files_back(void** state) {
  (void)state;
  const ScalePath directory = scale_new_directory();
  Host* const before = strings_open(RATE, BLOCK);
  scale_use(before, SCALE, MAPPING);
  save(before, &directory);
  host_free(before);
  Host* const after = open_session(&directory);
  scale_assert_heard(after, SCALE, MAPPING);
  assert_int_equal(host_worker(after)->n_works, 0);
  char path[2 * SCALE_HOST_PATH];
  (void)snprintf(path, sizeof(path), "%s/%s", directory.text, SCALE);
  assert_told_scale(after, path);
  host_free(after);
  scale_remove_directory(&directory);
}

/* The state names no place outside: it is moved as a whole, and the file with it. */
static void a_session_may_move(void** state) {
  (void)state;
  const ScalePath old = scale_new_directory();
  const ScalePath new = scale_new_directory();
  const ScalePath file = scale_write(&old, "fifths.scl", FIFTHS);
  Host* const before = strings_open(RATE, BLOCK);
  use_file_as(before, SCALE_PARAMETER, &file);
  save(before, &old);
  host_free(before);
  assert_int_equal(rename(old.text, new.text), 0);
  Host* const after = open_session(&new);
  scale_assert_pitch(after, 68, 440.0 / 1.5);
  save(after, &new);
  host_free(after);
  Host* const again = open_session(&new);
  scale_assert_pitch(again, 70, 440.0 * 1.5);
  host_free(again);
  scale_remove_directory(&new);
}

/* To have none is a state as well. */
static void a_session_without_files_takes_them_away(void** state) {
  (void)state;
  const ScalePath directory = scale_new_directory();
  Host* const host = strings_open(RATE, BLOCK);
  save(host, &directory);
  scale_use(host, SCALE, MAPPING);
  LilvState* const saved = host_load_state_dir(host, directory.text);
  const ScalePath body = scale_write_body(&directory, "a.body", BODIES_HARP);
  use_file_as(host, BODY_PARAMETER, &body);
  host_restore_preset(host, saved);
  assert_true(host_run(host, BLOCK));
  scale_assert_heard(host, NULL, NULL);
  assert_told_scale(host, "");
  assert_told(host, BODY_PARAMETER, "");
  lilv_state_free(saved);
  host_free(host);
  scale_remove_directory(&directory);
}

static void a_preset_of_ports_keeps_the_scale(void** state) {
  (void)state;
  Host* const host = strings_open(RATE, BLOCK);
  scale_use(host, SCALE, MAPPING);
  assert_true(host_preset(host, "Concert Harp"));
  strings_set(host, "body", BODIES_NONE);
  strings_set(host, "damping", 0.5);
  strings_set(host, "tracking", 0.5);
  strings_set(host, "tuning", 440.0);
  scale_assert_heard(host, SCALE, MAPPING);
  assert_told_scale(host, SCALE);
  host_free(host);
}

static unsigned n_lines(const char* text, const char* word) {
  unsigned n = 0;
  for (const char* at = strstr(text, word); at; at = strstr(at + 1, word)) {
    ++n;
  }
  return n;
}

static LilvState* state_of(Host* host, const char* properties) {
  char turtle[2 * SCALE_HOST_PATH];
  (void)snprintf(turtle, sizeof(turtle),
                 "@prefix pset: <http://lv2plug.in/ns/ext/presets#> .\n"
                 "@prefix state: <http://lv2plug.in/ns/ext/state#> .\n"
                 "@prefix atom: <http://lv2plug.in/ns/ext/atom#> .\n"
                 "<urn:hooke:state> a pset:Preset ;\n"
                 "  <http://lv2plug.in/ns/lv2core#appliesTo> <" STRINGS_URI "> ;\n"
                 "  state:state [ %s ] .\n",
                 properties);
  LilvState* const state = host_state_from_string(host, turtle);
  assert_non_null(state);
  return state;
}

static void restore(Host* host, const char* properties) {
  LilvState* const state = state_of(host, properties);
  host_restore_state(host, state);
  lilv_state_free(state);
  assert_true(host_run(host, BLOCK));
}

/* One alone; and something that is no path. */
static void what_a_state_does_not_say_stays(void** state) {
  (void)state;
  char properties[SCALE_HOST_PATH + 200];
  Host* const host = strings_open(RATE, BLOCK);
  scale_use(host, SCALE, NULL);
  (void)snprintf(properties, sizeof(properties), "<" MAPPING_PARAMETER "> \"%s\"^^atom:Path",
                 scale_path(MAPPING).text);
  restore(host, properties);
  scale_assert_heard(host, SCALE, MAPPING);
  restore(host, "<" SCALE_PARAMETER "> 12 ; <" MAPPING_PARAMETER "> true");
  scale_assert_heard(host, SCALE, MAPPING);
  restore(host, "<" MAPPING_PARAMETER "> \"\"");
  scale_assert_heard(host, SCALE, NULL);
  host_free(host);
}

static void a_path_may_come_as_a_string(void** state) {
  (void)state;
  char properties[SCALE_HOST_PATH + 200];
  Host* const host = strings_open(RATE, BLOCK);
  (void)snprintf(properties, sizeof(properties), "<" SCALE_PARAMETER "> \"%s\"",
                 scale_path(SCALE).text);
  restore(host, properties);
  scale_assert_heard(host, SCALE, NULL);
  assert_told_scale(host, SCALE);
  host_free(host);
}

enum { N_KEYS = 3 };

/* A host as Carla: values of all, each with the type that was stored first. */
typedef struct {
  LV2_URID keys[N_KEYS];
  LV2_URID types[N_KEYS];
  char values[N_KEYS][SCALE_HOST_PATH];
} Keeper;

static int index_of(const Keeper* keeper, LV2_URID key) {
  int i = 0;
  while (i < N_KEYS && keeper->keys[i] != key) {
    ++i;
  }
  assert_true(i < N_KEYS);
  return i;
}

static LV2_State_Status keep(LV2_State_Handle handle,
                             uint32_t key,
                             const void* value,
                             size_t size,
                             uint32_t type,
                             uint32_t flags) {
  Keeper* const keeper = handle;
  const int i = index_of(keeper, key);
  (void)flags;
  assert_true(size <= SCALE_HOST_PATH);
  memcpy(keeper->values[i], value, size);
  keeper->types[i] = keeper->types[i] ? keeper->types[i] : type;
  return LV2_STATE_SUCCESS;
}

static const void*
bring_back(LV2_State_Handle handle, uint32_t key, size_t* size, uint32_t* type, uint32_t* flags) {
  const Keeper* const keeper = handle;
  const int i = index_of(keeper, key);
  *size = strlen(keeper->values[i]) + 1;
  *type = keeper->types[i];
  *flags = LV2_STATE_IS_POD;
  return keeper->values[i];
}

static const LV2_State_Interface* state_interface(Host* host) {
  return lilv_instance_get_extension_data(host_instance(host), LV2_STATE__interface);
}

/* It saves before a file is chosen, and again after; the types may be ours, or those of 0.2.0. */
static void a_host_that_keeps_the_first_type_keeps_the_files(void** state) {
  const ScalePath directory = scale_new_directory();
  const ScalePath body = scale_write_body(&directory, "a.body", BODIES_HARP);
  (void)state;
  for (int is_old = 0; is_old < 2; ++is_old) {
    Host* const host = strings_open(RATE, BLOCK);
    Keeper keeper = {{host_map(host, SCALE_PARAMETER), host_map(host, MAPPING_PARAMETER),
                      host_map(host, BODY_PARAMETER)},
                     {0},
                     {{0}}};
    if (is_old) {
      keeper.types[0] = keeper.types[1] = keeper.types[2] = host_map(host, LV2_ATOM__String);
    }
    LV2_Handle plugin = lilv_instance_get_handle(host_instance(host));
    const LV2_Feature* const none = NULL;
    assert_int_equal(state_interface(host)->save(plugin, keep, &keeper, 0, &none), 0);
    assert_int_equal(keeper.types[0], host_map(host, is_old ? LV2_ATOM__String : LV2_ATOM__Path));
    scale_use(host, SCALE, MAPPING);
    use_file_as(host, BODY_PARAMETER, &body);
    assert_int_equal(state_interface(host)->save(plugin, keep, &keeper, 0, &none), 0);
    scale_use(host, "pythagorean.scl", NULL);
    use_file_as(host, BODY_PARAMETER, &(ScalePath){""});
    assert_int_equal(state_interface(host)->restore(plugin, bring_back, &keeper, 0, &none), 0);
    assert_true(host_run(host, BLOCK));
    scale_assert_heard(host, SCALE, MAPPING);
    assert_told(host, BODY_PARAMETER, "a.body");
    host_free(host);
  }
  scale_remove_directory(&directory);
}

/* Whoever makes a state may name any file, and the log may be read by others. */
static void a_state_puts_no_word_of_a_file_into_the_log(void** state) {
  (void)state;
  static const char* const texts[] = {"secret\n",
                                      "1\nsecret\n",
                                      "name\n1\nsecret\n",
                                      "12\nsecret",
                                      "12\n5\n127\n60\nsecret\n",
                                      "mode 100 20 1 1 1\nsecret\n"};
  const ScalePath directory = scale_new_directory();
  Host* const host = strings_open(RATE, BLOCK);
  static const char* const names[] = {"passwd", "a.kbm", "a.body"};
  static const char* const parameters[] = {SCALE_PARAMETER, MAPPING_PARAMETER, BODY_PARAMETER};
  for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); ++i) {
    for (size_t p = 0; p < 9; ++p) {
      char properties[SCALE_HOST_PATH + 200];
      const ScalePath file = scale_write(&directory, names[p / 3], texts[i]);
      (void)snprintf(properties, sizeof(properties), "<%s> \"%s\"^^atom:Path", parameters[p % 3],
                     file.text);
      scale_log_begin();
      restore(host, properties);
      char* const said = scale_log_end();
      assert_int_equal(n_lines(said, "\n"), 1);
      assert_int_equal(n_lines(said, file.text), 1);
      assert_int_equal(n_lines(said, ": expected "), 1);
      assert_int_equal(n_lines(said, "secret"), 0);
      free(said);
    }
  }
  host_free(host);
  scale_remove_directory(&directory);
}

/* As it is chosen in Carla, which has one button alone: a mapping chosen as a scale leaves the
 * scale where it is, and a body both.  Its ending says that it is one, or its text. */
static void any_parameter_takes_any_file(void** state) {
  (void)state;
  const char* const parameters[] = {SCALE_PARAMETER, MAPPING_PARAMETER, BODY_PARAMETER};
  for (int i = 0; i < 3; ++i) {
    const ScalePath scale = scale_path(SCALE);
    const ScalePath mapping = scale_path(MAPPING);
    const ScalePath directory = scale_new_directory();
    const ScalePath files = scale_new_directory();
    const char* const name = i == 1 ? "modes.txt" : "a.body";
    const ScalePath body = scale_write_body(&files, name, BODIES_HARP);
    Host* const host = strings_open(RATE, BLOCK);
    use_file_as(host, parameters[i], &scale);
    use_file_as(host, parameters[i], &body);
    use_file_as(host, parameters[i], &mapping);
    for (int is_after = 0; is_after < 2; ++is_after) {
      Host* const now = is_after ? open_session(&directory) : host;
      scale_assert_heard(now, SCALE, MAPPING);
      assert_told_scale(now, SCALE);
      assert_told(now, MAPPING_PARAMETER, MAPPING);
      assert_told(now, BODY_PARAMETER, name);
      if (!is_after) {
        save(now, &directory);
      }
      host_free(now);
    }
    scale_remove_directory(&directory);
    scale_remove_directory(&files);
  }
}

static char* log_of_session(const ScalePath* directory, Host** host) {
  scale_log_begin();
  *host = open_session(directory);
  return scale_log_end();
}

/* It is named once; meanwhile equal temperament; saved again nothing is lost. */
static void a_file_that_is_gone_may_come_back(void** state) {
  (void)state;
  const ScalePath directory = scale_new_directory();
  const ScalePath elsewhere = scale_new_directory();
  const ScalePath file = scale_write(&elsewhere, "fifths.scl", FIFTHS);
  Host* before = strings_open(RATE, BLOCK);
  use_file_as(before, SCALE_PARAMETER, &file);
  scale_assert_pitch(before, 70, 660.0);
  save(before, &directory);
  host_free(before);
  assert_int_equal(unlink(file.text), 0);
  for (int i = 0; i < 2; ++i) {
    char* const said = log_of_session(&directory, &before);
    assert_int_equal(n_lines(said, "fifths.scl:1: found no text (No such file or directory), "
                                   "expected a Scala scale (.scl)\n"),
                     1);
    free(said);
    scale_assert_pitch(before, 70, 440.0 * 1.0594630943592953);
    save(before, &directory);
    assert_told_scale(before, "fifths.scl");
    host_free(before);
  }
  (void)scale_write(&elsewhere, "fifths.scl", FIFTHS);
  Host* const after = open_session(&directory);
  scale_assert_pitch(after, 70, 660.0);
  host_free(after);
  scale_remove_directory(&directory);
  scale_remove_directory(&elsewhere);
}

/* What is heard does not depend on what was heard before. */
static void a_broken_file_is_named_with_its_line(void** state) {
  (void)state;
  const ScalePath directory = scale_new_directory();
  const ScalePath scale = scale_write(&directory, "a.scl", "Fifths\n2\n3/2\nsecond\n");
  const ScalePath map = scale_write(&directory, "a.kbm", "0\n0\n127\n60\n200\n");
  const ScalePath paths[] = {scale, map, directory};
  static const char* const words[] = {"a.scl:4: found 'second', expected pitch 2 of 2",
                                      "a.kbm:5: found '200', expected ",
                                      ":1: found no text (Is a "};
  Host* const host = strings_open(RATE, BLOCK);
  for (size_t i = 0; i < 3; ++i) {
    scale_use(host, SCALE, MAPPING);
    scale_log_begin();
    scale_set(host, i == 1 ? MAPPING_PARAMETER : SCALE_PARAMETER, paths[i].text);
    assert_true(host_run(host, BLOCK) && host_run(host, BLOCK));
    char* const said = scale_log_end();
    assert_int_equal(n_lines(said, "\n"), 1);
    assert_int_equal(n_lines(said, words[i]), 1);
    assert_int_equal(n_lines(said, paths[i].text), 1);
    free(said);
    scale_assert_heard(host, i == 1 ? SCALE : NULL, i == 1 ? NULL : MAPPING);
  }
  assert_told_scale(host, directory.text);
  host_free(host);
  scale_remove_directory(&directory);
}

/* A host that restores, saves and lets work while it runs. */
typedef struct {
  Host* host;
  atomic_bool is_over;
  unsigned n_runs;
} Runner;

static void* run_all_the_time(void* data) {
  Runner* const runner = data;
  LilvInstance* const instance = host_instance(runner->host);
  for (; !atomic_load(&runner->is_over); ++runner->n_runs) {
    lilv_instance_run(instance, runner->n_runs % BLOCK);
  }
  return NULL;
}

/* The files alone: a host does not write to ports that an instrument is reading. */
static void restore_files(Host* host, const LilvState* state) {
  static const LV2_Feature* const none[] = {NULL};
  lilv_state_restore(state, host_instance(host), NULL, NULL, 0, none);
}

static void it_may_be_restored_while_it_runs(void** state) {
  (void)state;
  enum { N_TIMES = 500 };
  static Runner runner;
  LilvState* states[2];
  pthread_t thread;
  Host* const host = strings_open(RATE, BLOCK);
  for (int i = 0; i < 2; ++i) {
    scale_use(host, i ? SCALE : "just-major.scl", i ? NULL : MAPPING);
    states[i] = host_save_state(host);
    assert_non_null(states[i]);
  }
  strings_note_on(host, 0, 40, 127);
  strings_note_on(host, 0, 61, 127);
  assert_true(host_run(host, BLOCK));
  host_connect(host, host_port_index(host, "control"), NULL);
  runner.host = host;
  assert_int_equal(pthread_create(&thread, NULL, run_all_the_time, &runner), 0);
  for (int i = 0; i < N_TIMES; ++i) {
    restore_files(host, states[i % 2]);
    LilvState* const now = host_save_state(host);
    assert_true(lilv_state_equals(now, states[i % 2]));
    lilv_state_free(now);
  }
  atomic_store(&runner.is_over, true);
  assert_int_equal(pthread_join(thread, NULL), 0);
  print_message("%u runs\n", runner.n_runs);
  assert_true(runner.n_runs > 10);
  host_reconnect(host);
  scale_assert_heard(host, SCALE, NULL);
  lilv_state_free(states[0]);
  lilv_state_free(states[1]);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_session_brings_its_files_back),
      cmocka_unit_test(a_session_may_move),
      cmocka_unit_test(a_session_without_files_takes_them_away),
      cmocka_unit_test(a_preset_of_ports_keeps_the_scale),
      cmocka_unit_test(what_a_state_does_not_say_stays),
      cmocka_unit_test(a_path_may_come_as_a_string),
      cmocka_unit_test(a_host_that_keeps_the_first_type_keeps_the_files),
      cmocka_unit_test(a_state_puts_no_word_of_a_file_into_the_log),
      cmocka_unit_test(any_parameter_takes_any_file),
      cmocka_unit_test(a_file_that_is_gone_may_come_back),
      cmocka_unit_test(a_broken_file_is_named_with_its_line),
      cmocka_unit_test(it_may_be_restored_while_it_runs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
