/* What Hooke Strings costs. */
#include "tests/support/host_inside.h"
#include "tests/support/speed.h"
#include "tools/host/host.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { RATE_HZ = 48000, BLOCK = 256, LOWEST_KEY = 21, HIGHEST_KEY = 108 };

static Host* open_strings(void) {
  char error[256];
  Host* const host = host_new("urn:hooke:strings", RATE_HZ, BLOCK, error, sizeof(error));
  if (!host) {
    fail_msg("%s", error);
  }
  return host;
}

static void all_88_keys_cost_less_than_15_percent(void** state) {
  (void)state;
  speed_skip_where_sanitized();
  Host* const host = open_strings();
  host_set(host, "masses", 128.0f);
  host_set(host, "partials", 0.0f); /* Those of the bare chain, which is what the promise is for */
  host_set(host, "damping", 0.3f);
  for (unsigned key = LOWEST_KEY; key <= HIGHEST_KEY; ++key) {
    const uint8_t note_on[3] = {0x90, (uint8_t)key, 100};
    assert_true(host_midi(host, 0, note_on, 3));
  }
  assert_true(host_run(host, BLOCK));
  assert_true(host_run(host, BLOCK));
  const double share = speed_usual_share(host, RATE_HZ, BLOCK, 1);
  const double n_masses = (double)host_get(host, "mass_count");
  print_message("88 keys, %g masses: %.2f %% of a core, %.3f ns a mass-step\n", n_masses,
                100.0 * share, 1e9 * share / (RATE_HZ * n_masses));
  assert_true((double)host_get(host, "sounding") == 88.0);
  assert_true(n_masses > 6200.0);
  assert_true(share < 0.15);
  host_free(host);
}

static void silence_costs_less_than_a_twentieth_of_a_percent(void** state) {
  (void)state;
  speed_skip_where_sanitized();
  Host* const host = open_strings();
  assert_true(host_run(host, BLOCK));
  const double share = speed_usual_share(host, RATE_HZ, BLOCK, 40);
  print_message("silence: %.4f %% of a core\n", 100.0 * share);
  assert_true(share < 0.0005);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_88_keys_cost_less_than_15_percent),
      cmocka_unit_test(silence_costs_less_than_a_twentieth_of_a_percent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
