#include "tools/bench/bench_start.h"

#include "core/harp/harp.h"
#include "tools/bench/bench_clock.h"
#include "tools/bench/bench_host.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef __GLIBC__
#if __GLIBC_PREREQ(2, 33)
#define HAS_MALLINFO2
#include <malloc.h>
#endif
#endif

enum { N_TIMES = 7 };

static const double rates_hz[] = {44100.0, 48000.0, 96000.0, 192000.0};
enum { N_RATES = sizeof(rates_hz) / sizeof(rates_hz[0]) };

/* Bytes that the heap has lent out; NAN where it does not say. */
static double heap_bytes(void) {
#ifdef HAS_MALLINFO2
  const struct mallinfo2 info = mallinfo2();
  return (double)info.uordblks + (double)info.hblkhd;
#else
  return (double)NAN;
#endif
}

static bool time_harp(double rate_hz, double* best_s, double* bytes) {
  *best_s = HUGE_VAL;
  for (int i = 0; i < N_TIMES; ++i) {
    const double before = heap_bytes();
    const double start_s = bench_clock_now_s();
    Harp* const harp = harp_new(rate_hz);
    *best_s = fmin(*best_s, bench_clock_now_s() - start_s);
    *bytes = heap_bytes() - before;
    harp_free(harp);
    if (!harp) {
      return false;
    }
  }
  return true;
}

/* Finding it, reading what it says of itself, loading and instantiating it: NAN if there is none.
 */
static double time_plugin(double rate_hz) {
  char error[256];
  double best_s = HUGE_VAL;
  for (int i = 0; i < 3 && !isnan(best_s); ++i) {
    const double start_s = bench_clock_now_s();
    Host* const host = bench_host_open("urn:hooke:strings", rate_hz, error, sizeof(error));
    const double time_s = bench_clock_now_s() - start_s;
    best_s = host ? fmin(best_s, time_s) : (double)NAN;
    host_free(host);
  }
  return best_s;
}

bool bench_start(const BenchChoice* choice) {
  printf(choice->is_csv ? "rate_hz,harp_ms,harp_bytes,plugin_ms\n" : "\n%-27s%9s%9s%19s\n",
         "To make a harp at rest", "ms", "MB", "the plugin, found");
  for (int i = 0; i < N_RATES; ++i) {
    double harp_s;
    double bytes;
    if (!time_harp(rates_hz[i], &harp_s, &bytes)) {
      return false;
    }
    const double plugin_s = time_plugin(rates_hz[i]);
    if (choice->is_csv) {
      printf("%g,%.4f,%.0f,%.4f\n", rates_hz[i], 1e3 * harp_s, bytes, 1e3 * plugin_s);
    } else {
      printf("%-6g Hz %27.3f%9.2f%16.1f ms\n", rates_hz[i], 1e3 * harp_s, 1e-6 * bytes,
             1e3 * plugin_s);
    }
  }
  return true;
}
