#include "tests/support/speed.h"

#include "core/string/chain_kernel.h"
#include "tools/bench/bench_clock.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { N_TRIES = 499 };

/* Vector operations that a core does in a cycle when it has itself to itself. */
static const double MOST_OPERATIONS = 4.0;

void speed_skip_where_sanitized(void) {
#ifdef __SANITIZE_ADDRESS__
  print_message("built with a sanitizer: its cost is not measured\n");
  skip();
#endif
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

double speed_slowdown(void) {
  const char* const slowdown = getenv("HOOKE_SLOWDOWN");
  return slowdown ? strtod(slowdown, NULL) : 1.0;
}

static void run_blocks(LilvInstance* instance, uint32_t block, int n_blocks) {
  for (int k = 0; k < n_blocks; ++k) {
    lilv_instance_run(instance, block);
  }
}

double speed_usual_share(Host* host, double rate_hz, uint32_t block, int n_blocks) {
  LilvInstance* const instance = host_instance(host);
  const size_t vector_bytes = chain_kernel(0)->loops[CHAIN_FLOAT]->n_lanes * sizeof(float);
  double times_s[N_TRIES];
  double least_s = HUGE_VAL;
  for (int i = 0; i < N_TRIES; ++i) {
    const double before = peak_left(vector_bytes);
    const double start = bench_clock_now_s();
    run_blocks(instance, block, n_blocks);
    const double time_s = bench_clock_now_s() - start;
    least_s = fmin(least_s, time_s);
    times_s[i] = time_s * fmax(before, peak_left(vector_bytes));
  }
  qsort(times_s, N_TRIES, sizeof(double), compare);
  const double audio_s = (double)n_blocks * block / rate_hz;
  print_message("the least time, however busy the core: %.4f %%\n", 100.0 * least_s / audio_s);
  return times_s[N_TRIES / 2] / audio_s;
}
