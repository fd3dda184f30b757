/* What Hooke Strings costs, as a share of one core that nothing else runs on.  Machines are noisy,
 * and who shares a core with others has its clock but not all of its arithmetic; so the time of a
 * run counts by as much of the peak as there was at that moment. */
#include "core/chain_kernel.h"
#include "tools/bench_clock.h"
#include "tools/host.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { RATE_HZ = 48000, BLOCK = 256, LOWEST_KEY = 21, HIGHEST_KEY = 108, N_TRIES = 499 };

/* Vector operations that a core does in a cycle when it has itself to itself. */
static const double MOST_OPERATIONS = 4.0;

static Host* open_strings(void) {
  char error[256];
  Host* const host = host_new("urn:hooke:strings", RATE_HZ, BLOCK, error, sizeof(error));
  if (!host) {
    fail_msg("%s", error);
  }
  return host;
}

static void run_blocks(LilvInstance* instance, int n_blocks) {
  for (int k = 0; k < n_blocks; ++k) {
    lilv_instance_run(instance, BLOCK);
  }
}

static int compare(const void* a, const void* b) {
  const double difference = *(const double*)a - *(const double*)b;
  return (difference > 0.0) - (difference < 0.0);
}

/* The share of its peak that the core has left for us; of two readings, the caller takes the
 * higher, for the other would flatter. */
static double peak_left(size_t vector_bytes) {
  return fmin(1.0, bench_clock_peak(vector_bytes) / (MOST_OPERATIONS * bench_clock_hz()));
}

/* The plugin's run() alone, without the host around it, as a share of the core: the median of many
 * short runs. */
static double usual_share(Host* host, int n_blocks) {
  LilvInstance* const instance = host_instance(host);
  const size_t vector_bytes = chain_kernel(0)->loops[CHAIN_FLOAT]->n_lanes * sizeof(float);
  double times_s[N_TRIES];
  double least_s = HUGE_VAL;
  for (int i = 0; i < N_TRIES; ++i) {
    const double before = peak_left(vector_bytes);
    const double start = bench_clock_now_s();
    run_blocks(instance, n_blocks);
    const double time_s = bench_clock_now_s() - start;
    least_s = fmin(least_s, time_s);
    times_s[i] = time_s * fmax(before, peak_left(vector_bytes));
  }
  qsort(times_s, N_TRIES, sizeof(double), compare);
  const double audio_s = (double)n_blocks * BLOCK / RATE_HZ;
  print_message("the least time, however busy the core: %.4f %%\n", 100.0 * least_s / audio_s);
  return times_s[N_TRIES / 2] / audio_s;
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
  const double share = usual_share(host, 1);
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
  skip_where_sanitized();
  Host* const host = open_strings();
  assert_true(host_run(host, BLOCK));
  const double share = usual_share(host, 40);
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
