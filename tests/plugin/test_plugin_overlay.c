/* What a program change has set holds until the host moves a port, however the port was moved. */
#include "tests/support/programs.h"

#include "plugin/strings_ports.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { BLOCK = PROGRAMS_BLOCK };

/* Each port by itself, though it be moved to what it held long ago. */
static void a_port_that_is_moved_is_the_hosts(void** state) {
  (void)state;
  for (int p = 0; p < PROGRAMS_PLUGINS; ++p) {
    const ProgramPair pair = programs_open_pair(p);
    const double before = (double)host_get(pair.program, "hardness");
    programs_assert_same(pair.preset, pair.program);
    programs_set(pair, "hardness", 0.3);
    programs_assert_pair(pair);
    programs_set(pair, "hardness", before);
    programs_assert_pair(pair);
    programs_set(pair, "damping", 2.5);
    programs_set(pair, "level", -6.0);
    programs_assert_pair(pair);
    programs_close_pair(pair);
  }
}

static void a_port_that_is_not_connected_is_not_moved(void** state) {
  (void)state;
  const ProgramPair pair = programs_open_pair(0);
  host_connect(pair.program, STRINGS_PORT_DAMPING, NULL);
  programs_assert_pair(pair);
  programs_select(pair.program, 0, pair.place);
  programs_assert_pair(pair);
  host_reconnect(pair.program);
  programs_assert_pair(pair);
  programs_set(pair, "damping", 3.0);
  programs_assert_pair(pair);
  programs_close_pair(pair);
}

/* It is the host's from its next value on. */
static void another_program_sets_what_was_moved(void** state) {
  (void)state;
  const ProgramPair pair = programs_open_pair(1);
  programs_set(pair, "damping", 2.5);
  programs_run(pair);
  assert_true(host_preset(pair.preset, "Nylon Fingers"));
  programs_select(pair.program, 0, programs_place(pair.program, "Nylon Fingers"));
  programs_assert_pair(pair);
  programs_set(pair, "damping", 2.0);
  programs_assert_pair(pair);
  programs_close_pair(pair);
}

/* Though it move no port, for they say the same already. */
static void a_preset_of_the_hosts_takes_it_away(void** state) {
  (void)state;
  for (int p = 0; p < PROGRAMS_PLUGINS; ++p) {
    const ProgramPair pair = programs_open_pair(p);
    assert_true(host_preset(pair.preset, "Default") && host_preset(pair.program, "Default"));
    programs_assert_pair(pair);
    programs_close_pair(pair);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_port_that_is_moved_is_the_hosts),
      cmocka_unit_test(a_port_that_is_not_connected_is_not_moved),
      cmocka_unit_test(another_program_sets_what_was_moved),
      cmocka_unit_test(a_preset_of_the_hosts_takes_it_away),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
