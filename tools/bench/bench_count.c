#include "tools/bench/bench_count.h"

#include "core/harp/harp.h"
#include "plugin/denormals.h"
#include "plugin/strings_ports.h"
#include "tools/bench/bench_scene.h"

#include <stdio.h>
#include <string.h>

enum { RATE_HZ = 48000, FRAMES = 64, LOWEST_KEY = 21, MASSES = 16, MOST_FRAMES = 100000000 };

__attribute__((noinline)) void bench_count_mark(void) {
  __asm__ volatile("");
}

static void run_string(BenchString* string, uint32_t n_frames) {
  bench_count_mark();
  bench_string_run(string, n_frames);
  bench_count_mark();
}

static bool count_string(BenchScene scene, ChainNumbers numbers, uint32_t n, uint32_t n_frames) {
  BenchString string;
  const bool is_there = bench_string_init(&string, chain_kernel(0), numbers, scene, n) &&
                        bench_string_start(&string, n_frames + 1);
  if (is_there) {
    run_string(&string, n_frames);
  }
  bench_string_free(&string);
  return is_there;
}

static void run_harp(Harp* harp, uint32_t n_frames) {
  float left[FRAMES];
  float right[FRAMES];
  for (uint32_t done = 0; done < n_frames; done += FRAMES) {
    harp_run(harp, FRAMES, left, right);
  }
}

static bool count_harp(bool is_asleep, uint32_t n_keys, uint32_t n_frames) {
  Harp* const harp = harp_new(RATE_HZ);
  if (!harp) {
    return false;
  }
  HarpPatch patch = strings_ports_usual();
  patch.string.max_masses = MASSES;
  harp_set_patch(harp, &patch, 0);
  for (uint32_t i = 0; i < n_keys; ++i) {
    harp_note_on(harp, 0, (LOWEST_KEY + i) % HARP_KEYS, 100);
  }
  if (is_asleep) {
    harp_silence(harp);
    while (harp_report(harp).n_strings > 0) {
      run_harp(harp, FRAMES);
    }
  }
  run_harp(harp, 2048);
  bench_count_mark();
  run_harp(harp, n_frames);
  bench_count_mark();
  harp_free(harp);
  return true;
}

static bool scene_named(const char* name, BenchScene* scene) {
  for (uint32_t i = 0; i < BENCH_N_SCENES; ++i) {
    char at[BENCH_NAME_SIZE];
    *scene = bench_scene_at(i);
    bench_scene_name(*scene, at);
    if (!strcmp(at, name)) {
      return true;
    }
  }
  return false;
}

bool bench_count(const char* what) {
  char scene_name[64];
  char numbers_name[16];
  unsigned n;
  unsigned n_frames;
  int end = 0;
  const uint64_t denormals = denormals_flush();
  bool is_done = false;
  if (sscanf(what, "%63[^,],%u,%u%n", scene_name, &n, &n_frames, &end) == 3 && !what[end]) {
    const bool is_asleep = !strcmp(scene_name, "asleep");
    is_done = (is_asleep || !strcmp(scene_name, "awake")) && n <= HARP_KEYS &&
              n_frames <= MOST_FRAMES && count_harp(is_asleep, n, n_frames);
  } else if (sscanf(what, "%63[^,],%15[^,],%u,%u%n", scene_name, numbers_name, &n, &n_frames,
                    &end) == 4 &&
             !what[end]) {
    BenchScene scene;
    const ChainNumbers numbers = bench_numbers_named(numbers_name);
    is_done = scene_named(scene_name, &scene) && numbers != N_CHAIN_NUMBERS && n >= 1 &&
              n <= CHAIN_MAX_MASSES && n_frames <= MOST_FRAMES &&
              count_string(scene, numbers, n, n_frames);
  }
  denormals_restore(denormals);
  return is_done;
}
