/* What a program change has set is kept in the state, whatever hosts do with that. */
#include "tests/support/host_state.h"
#include "tests/support/programs.h"

#include "plugin/ports.h"

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { BLOCK = PROGRAMS_BLOCK };

static char* save_as_text(Host* host) {
  LilvState* const state = host_save_state(host);
  assert_non_null(state);
  char* const turtle = host_state_to_string(host, state);
  assert_non_null(turtle);
  lilv_state_free(state);
  return turtle;
}

static void restore_text(Host* host, const char* turtle) {
  LilvState* const state = host_state_from_string(host, turtle);
  assert_non_null(state);
  host_restore_state(host, state);
  lilv_state_free(state);
}

/* A session that is loaded into a new instance sounds as it did, and so does one that is saved from
 * that, whether it has run or not. */
static void a_session_keeps_it(void** state) {
  (void)state;
  for (int i = 0; i < 2 * PROGRAMS_PLUGINS; ++i) {
    ProgramPair pair = programs_open_pair(i / 2);
    programs_set(pair, "release", 0.7);
    programs_run(pair);
    for (int n = 0; n < 2; ++n) {
      char* const saved = save_as_text(pair.program);
      host_free(pair.program);
      pair.program = programs_open(i / 2);
      restore_text(pair.program, saved);
      if (i % 2) {
        assert_true(host_run(pair.program, BLOCK));
      }
      lilv_free(saved);
    }
    strings_restart(pair.program);
    strings_restart(pair.preset);
    programs_assert_same(pair.preset, pair.program);
    programs_set(pair, "damping", 2.5);
    programs_assert_pair(pair);
    programs_close_pair(pair);
  }
}

static void a_session_without_takes_it_away(void** state) {
  (void)state;
  const ProgramPair pair = programs_open_pair(0);
  Host* const plain = strings_open(PROGRAMS_RATE, BLOCK);
  char* const saved = save_as_text(plain);
  assert_null(strstr(saved, "overlay"));
  restore_text(pair.program, saved);
  assert_true(host_run(pair.program, BLOCK));
  strings_restart(pair.program);
  programs_assert_same(plain, pair.program);
  lilv_free(saved);
  host_free(plain);
  programs_close_pair(pair);
}

/* Ports come back before the state, after it, while it runs, and rounded. */
static void a_session_may_bring_its_ports_late_and_rounded(void** state) {
  (void)state;
  Host* const before = programs_open(0);
  strings_set(before, "damping", 1.2345678);
  strings_set(before, "loss", 0.0123456);
  programs_select(before, 0, programs_place(before, "Koto"));
  assert_true(host_run(before, BLOCK));
  char* const saved = save_as_text(before);
  for (int i = 0; i < 4; ++i) {
    ProgramPair pair = {programs_open(0), programs_open(0), {0, 0}};
    assert_true(host_preset(pair.preset, "Koto"));
    programs_run(pair);
    restore_text(pair.program, saved);
    strings_set(pair.program, "damping", i & 1 ? 0.6 : 1.23457);
    strings_set(pair.program, "loss", i & 2 ? 0.01 : 0.012346);
    programs_run(pair);
    programs_run(pair);
    strings_set(pair.program, "damping", 1.23457);
    strings_set(pair.program, "loss", 0.012346);
    programs_run(pair);
    strings_restart(pair.program);
    strings_restart(pair.preset);
    programs_assert_same(pair.preset, pair.program);
    programs_set(pair, "damping", 0.6);
    programs_assert_pair(pair);
    programs_set(pair, "damping", 1.23457);
    programs_assert_pair(pair);
    programs_close_pair(pair);
  }
  lilv_free(saved);
  host_free(before);
}

/* Once the ports are back, the least move is the host's. */
static void ports_that_are_back_are_moved_as_any(void** state) {
  (void)state;
  const ProgramPair pair = programs_open_pair(0);
  char* const saved = save_as_text(pair.program);
  restore_text(pair.program, saved);
  programs_assert_pair(pair);
  programs_set(pair, "loss", (double)nextafterf(0.01f, 1.0f));
  programs_assert_pair(pair);
  lilv_free(saved);
  programs_close_pair(pair);
}

static void restore_words(Host* host, const char* words) {
  char turtle[4096];
  (void)snprintf(turtle, sizeof(turtle),
                 "@prefix pset: <http://lv2plug.in/ns/ext/presets#> .\n"
                 "@prefix state: <http://lv2plug.in/ns/ext/state#> .\n"
                 "@prefix atom: <http://lv2plug.in/ns/ext/atom#> .\n"
                 "<urn:hooke:state> a pset:Preset ;\n"
                 "  <http://lv2plug.in/ns/lv2core#appliesTo> <" STRINGS_URI "> ;\n"
                 "  state:state [ <" STRINGS_URI "#overlay> %s ] .\n",
                 words);
  restore_text(host, turtle);
}

/* It is as if nothing stood there; the second is past the room for it. */
static void a_broken_state_is_none(void** state) {
  static const char* const broken[] = {"\"6:c1200000:0;\"^^atom:Path",
                                       "12",
                                       "\"6:c1200000\"",
                                       "\"2:0:0;\"",
                                       "\"6:c1200000:0;x\"",
                                       "\"99:0:0;\"",
                                       "\"-1:0:0;\"",
                                       "\"x\"",
                                       "\"17:0:0;\"",
                                       "\"6:c1200000:0;4:0:0;\""};
  (void)state;
  Host* const plain = programs_open(0);
  Host* const host = programs_open(0);
  for (size_t i = 0; i < sizeof(broken) / sizeof(broken[0]); ++i) {
    restore_words(host, "\"6:c1200000:0;\"");
    assert_true(host_run(host, BLOCK) && host_run(plain, BLOCK));
    strings_restart(host);
    strings_restart(plain);
    programs_assert_other(plain, host);
    restore_words(host, broken[i]);
    assert_true(host_run(host, BLOCK) && host_run(plain, BLOCK));
    strings_restart(host);
    strings_restart(plain);
    print_message("%s\n", broken[i]);
    programs_assert_same(plain, host);
  }
  char many[3000] = "\"";
  for (int i = 0; i < 200; ++i) {
    (void)snprintf(many + strlen(many), sizeof(many) - strlen(many), "6:c1200000:0;");
  }
  (void)snprintf(many + strlen(many), sizeof(many) - strlen(many), "\"");
  restore_words(host, many);
  assert_true(host_run(host, BLOCK) && host_run(plain, BLOCK));
  strings_restart(host);
  strings_restart(plain);
  programs_assert_same(plain, host);
  host_free(plain);
  host_free(host);
}

/* What is no number, or out of range, is brought in as a port's value is. */
static void values_in_a_state_are_brought_into_range(void** state) {
  static const struct {
    const char* words;
    double level;
  } cases[] = {{"\"6:7fc00000:0;\"", 0.0},
               {"\"6:7f800000:0;\"", 12.0},
               {"\"6:c3000000:0;\"", -60.0},
               {"\"6:c1200000:0;\"", -10.0}};
  (void)state;
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
    Host* const host = programs_open(0);
    Host* const plain = programs_open(0);
    restore_words(host, cases[i].words);
    strings_set(plain, "level", cases[i].level);
    strings_set(plain, "masses", 20.0);
    strings_set(host, "masses", 20.0);
    Sound a = programs_play(plain);
    Sound b = programs_play(host);
    assert_true(sound_is_same(&a, &b));
    sound_free(&a);
    sound_free(&b);
    host_free(host);
    host_free(plain);
  }
}

/* A host that restores and saves while it runs, and programs that change. */
typedef struct {
  Host* host;
  atomic_bool is_over;
  unsigned n_runs;
} Runner;

static void* run_all_the_time(void* data) {
  Runner* const runner = data;
  LilvInstance* const instance = host_instance(runner->host);
  for (; !atomic_load(&runner->is_over); ++runner->n_runs) {
    lilv_instance_run(instance, runner->n_runs % 64);
  }
  return NULL;
}

static void it_may_be_saved_and_restored_while_it_runs(void** state) {
  enum { N_TIMES = 500 };
  static Runner runner;
  (void)state;
  LilvState* states[2];
  pthread_t thread;
  Host* const host = programs_open(0);
  for (int i = 0; i < 2; ++i) {
    programs_select(host, 0, programs_place(host, i ? "Koto" : "Felt Piano"));
    assert_true(host_run(host, BLOCK));
    states[i] = host_save_state(host);
    assert_non_null(states[i]);
  }
  assert_false(lilv_state_equals(states[0], states[1]));
  host_connect(host, PORT_CONTROL, NULL);
  runner.host = host;
  assert_int_equal(pthread_create(&thread, NULL, run_all_the_time, &runner), 0);
  for (int i = 0; i < N_TIMES; ++i) {
    host_restore_state(host, states[i % 2]);
    LilvState* const now = host_save_state(host);
    assert_true(lilv_state_equals(now, states[i % 2]));
    lilv_state_free(now);
  }
  atomic_store(&runner.is_over, true);
  assert_int_equal(pthread_join(thread, NULL), 0);
  print_message("%u runs\n", runner.n_runs);
  assert_true(runner.n_runs > 10);
  lilv_state_free(states[0]);
  lilv_state_free(states[1]);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_session_keeps_it),
      cmocka_unit_test(a_session_without_takes_it_away),
      cmocka_unit_test(a_session_may_bring_its_ports_late_and_rounded),
      cmocka_unit_test(ports_that_are_back_are_moved_as_any),
      cmocka_unit_test(a_broken_state_is_none),
      cmocka_unit_test(values_in_a_state_are_brought_into_range),
      cmocka_unit_test(it_may_be_saved_and_restored_while_it_runs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
