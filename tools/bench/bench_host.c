#include "tools/bench/bench_host.h"

#include "plugin/denormals.h"
#include "tools/bench/bench_clock.h"
#include "tools/host/locate.h"

#include <math.h>
#include <stdio.h>

enum { RATE_HZ = 48000, BLOCK = 256, PATH_SIZE = 4096, N_WARM = 40, N_RUNS = 300, MIDDLE_C = 60 };

static const int held[] = {0, 1, 8, 32, 88};
enum { N_HELD = sizeof(held) / sizeof(held[0]) };

Host* bench_host_open(const char* plugin_uri, double rate_hz, char* error, size_t error_size) {
  char bundle[PATH_SIZE];
  const HostConfig config = {.rate_hz = rate_hz,
                             .max_block = BLOCK,
                             .bundle = locate_bundle(bundle, sizeof(bundle)) ? bundle : NULL,
                             .is_silent = true};
  return host_new_with(plugin_uri, &config, error, error_size);
}

/* The `i`-th note: around the middle of the keyboard, each key once. */
static uint8_t key_of(int i) {
  return (uint8_t)(i % 2 ? MIDDLE_C - (i + 1) / 2 : MIDDLE_C + i / 2);
}

static bool hold(Host* host, int n_notes) {
  bool is_ok = true;
  for (int i = 0; i < n_notes; ++i) {
    const uint8_t note_on[3] = {0x90, key_of(i), 100};
    is_ok = is_ok && host_midi(host, 0, note_on, sizeof(note_on));
  }
  for (int i = 0; i < N_WARM; ++i) {
    is_ok = is_ok && host_run(host, BLOCK);
  }
  return is_ok;
}

/* Of the plugin alone, without the host around it. */
static double best_block_s(Host* host) {
  double best_s = HUGE_VAL;
  const uint64_t denormals = denormals_flush();
  for (int i = 0; i < N_RUNS; ++i) {
    const double start_s = bench_clock_now_s();
    lilv_instance_run(host_instance(host), BLOCK);
    best_s = fmin(best_s, bench_clock_now_s() - start_s);
  }
  denormals_restore(denormals);
  return best_s;
}

static void print(int n_notes, double block_s, double start_s, bool is_csv) {
  const double share = block_s * RATE_HZ / BLOCK;
  printf(is_csv ? "%d,%.3f,%.6f,%.4f\n" : "%5d%14.2f%13.3f%%%14.2f ms\n", n_notes,
         1e9 * block_s / BLOCK, is_csv ? share : 100.0 * share, 1e3 * start_s);
}

bool bench_host(const char* plugin_uri, bool is_csv, char* error, size_t error_size) {
  for (int i = 0; i < N_HELD; ++i) {
    const double begin_s = bench_clock_now_s();
    Host* const host = bench_host_open(plugin_uri, RATE_HZ, error, error_size);
    const double start_s = bench_clock_now_s() - begin_s;
    if (!host) {
      return false;
    }
    /* The first asks for a note as well, so that a plugin without MIDI is refused at once. */
    const uint8_t note_off[3] = {0x80, MIDDLE_C, 64};
    if (!host_midi(host, 0, note_off, sizeof(note_off)) || !hold(host, held[i])) {
      (void)snprintf(error, error_size, "%s: %s", plugin_uri, host_error(host));
      host_free(host);
      return false;
    }
    if (i == 0) {
      printf("%s", is_csv ? "notes,ns_per_frame,share_of_core,start_ms\n"
                          : "notes    ns a frame    of a core   found and made\n");
    }
    print(held[i], best_block_s(host), start_s, is_csv);
    host_free(host);
  }
  return true;
}
