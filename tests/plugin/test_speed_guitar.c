/* What Hooke Guitar costs. */
#include "tests/support/host_inside.h"
#include "tests/support/speed.h"
#include "tools/host/host.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { RATE_HZ = 48000, BLOCK = 256, N_STRINGS = 6 };

static const uint8_t open_notes[N_STRINGS] = {64, 59, 55, 50, 45, 40};

static Host* open_guitar(void) {
  char error[256];
  Host* const host = host_new("urn:hooke:guitar", RATE_HZ, BLOCK, error, sizeof(error));
  if (!host) {
    fail_msg("%s", error);
  }
  return host;
}

/* Every string open, and the bare chain, which is what the promise is for. */
static void six_strings_cost_less_than_a_percent(void** state) {
  (void)state;
  speed_skip_where_sanitized();
  Host* const host = open_guitar();
  assert_true(host_get(host, "masses") == 80.0f);
  host_set(host, "partials", 0.0f);
  for (int s = 0; s < N_STRINGS; ++s) {
    const uint8_t note_on[3] = {0x90, open_notes[s], 100};
    assert_true(host_midi(host, 0, note_on, 3));
  }
  for (int i = 0; i < 16; ++i) {
    assert_true(host_run(host, BLOCK));
  }
  const double share = speed_usual_share(host, RATE_HZ, BLOCK, 4);
  const double n_masses = (double)host_get(host, "mass_count");
  print_message("six strings, %g masses: %.3f %% of a core, %.3f ns a mass-step\n", n_masses,
                100.0 * share, 1e9 * share / (RATE_HZ * n_masses));
  assert_true(host_get(host, "sounding") == (float)N_STRINGS);
  assert_true(n_masses > 460.0);
  assert_true(share < 0.01);
  host_free(host);
}

static void silence_costs_less_than_a_twentieth_of_a_percent(void** state) {
  (void)state;
  speed_skip_where_sanitized();
  Host* const host = open_guitar();
  assert_true(host_run(host, BLOCK));
  const double share = speed_usual_share(host, RATE_HZ, BLOCK, 40);
  print_message("silence: %.4f %% of a core\n", 100.0 * share);
  assert_true(share < 0.0005);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(six_strings_cost_less_than_a_percent),
      cmocka_unit_test(silence_costs_less_than_a_twentieth_of_a_percent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
