/* What Hooke Strings costs, as a share of one core: the best of many short runs, for machines are
 * noisy. */
#include "tools/bench_clock.h"
#include "tools/host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { RATE_HZ = 48000, BLOCK = 256, LOWEST_KEY = 21, HIGHEST_KEY = 108 };

/* The core that the promises are made for. */
static const double NOMINAL_HZ = 2.45e9;

static Host* open_strings(void) {
  char error[256];
  Host* const host = host_new("urn:hooke:strings", RATE_HZ, BLOCK, error, sizeof(error));
  if (!host) {
    fail_msg("%s", error);
  }
  return host;
}

/* The plugin's run() alone, without the host around it, as a share of the nominal core.  Of the
 * clock before and after, the faster counts: the other would flatter. */
static double best_share(Host* host, int n_tries, int n_blocks) {
  LilvInstance* const instance = host_instance(host);
  double best = HUGE_VAL;
  double least_s = HUGE_VAL;
  for (int i = 0; i < n_tries; ++i) {
    const double before_hz = bench_clock_hz();
    const double start = bench_clock_now_s();
    for (int k = 0; k < n_blocks; ++k) {
      lilv_instance_run(instance, BLOCK);
    }
    const double time_s = bench_clock_now_s() - start;
    least_s = fmin(least_s, time_s);
    best = fmin(best, time_s * fmax(before_hz, bench_clock_hz()));
  }
  const double audio_s = (double)n_blocks * BLOCK / RATE_HZ;
  print_message("by the time alone, at the clock as it is: %.4f %% of a core\n",
                100.0 * least_s / audio_s);
  return best / NOMINAL_HZ / audio_s;
}

/* A sanitizer's checks are not what the instrument costs. */
static void skip_where_sanitized(void) {
#ifdef __SANITIZE_ADDRESS__
  print_message("built with a sanitizer: its cost is not measured\n");
  skip();
#endif
}

static void all_88_keys_cost_less_than_15_percent(void** state) {
  (void)state;
  skip_where_sanitized();
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
  const double share = best_share(host, 40, 20);
  const double n_masses = (double)host_get(host, "mass_count");
  print_message("88 keys, %g masses: %.2f %% of a 2.45 GHz core, %.3f ns a mass-step\n", n_masses,
                100.0 * share, 1e9 * share / (RATE_HZ * n_masses));
  assert_true((double)host_get(host, "sounding") == 88.0);
  assert_true(n_masses > 6200.0);
  assert_true(share < 0.15);
  host_free(host);
}

static void silence_costs_less_than_a_twentieth_of_a_percent(void** state) {
  (void)state;
  skip_where_sanitized();
  Host* const host = open_strings();
  assert_true(host_run(host, BLOCK));
  const double share = best_share(host, 20, 200);
  print_message("silence: %.4f %% of that core\n", 100.0 * share);
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
