#include "tools/bench/bench_block.h"

#include "core/harp/harp.h"
#include "plugin/denormals.h"
#include "plugin/strings_ports.h"
#include "tools/bench/bench_clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  RATE_HZ = 48000,
  FRAMES = 64, /* In a block */
  LOWEST_KEY = 21,
  N_KEYS = 88,
  BEFORE = 64, /* Blocks before the gesture */
  AFTER = 96,  /* And from it on */
  CALM = 32,   /* Blocks that are looked at when nothing happens; those before the gesture, or
                  the last of all */
  WHEEL_BLOCKS = 16,
  SECOND = 752, /* Blocks: strings are looked at every 16 blocks, and so at the same ones in
                   each second */
  N_TIMES = 12,
  N_SECONDS = 12,
  PLAY_S = 60,
};

enum { MOST_MASSES = 256 /* As many as a harp of 88 strings is likely to have */ };

static HarpPatch usual_patch(void) {
  HarpPatch patch = strings_ports_usual();
  patch.string.max_masses = MOST_MASSES;
  return patch;
}

/* A port jumps: what rings gets there as the plugin would have it, in 5 ms. */
static void jump(Harp* harp) {
  HarpPatch patch = usual_patch();
  patch.string.damping_per_s = 5.0;
  patch.string.inharmonicity = 1e-3;
  patch.string.loss = 0.3;
  patch.pickup = 0.4;
  harp_set_patch(harp, &patch, RATE_HZ / 200 + 1);
}

static void play(Harp* harp, uint32_t first, uint32_t n_keys, uint32_t step) {
  for (uint32_t i = 0; i < n_keys; ++i) {
    harp_note_on(harp, 0, first + i * step, 100);
  }
}

/* What happens before the gesture. */
static void prepare(Harp* harp, BenchGesture gesture, uint32_t max_masses) {
  HarpPatch patch = usual_patch();
  patch.string.max_masses = max_masses;
  harp_reset(harp);
  harp_set_patch(harp, &patch, 0);
  if (gesture == BENCH_TEN_KEYS) {
    return;
  }
  harp_pedal(harp, 0, gesture == BENCH_PEDAL ? 1.0 : 0.0);
  play(harp, LOWEST_KEY, N_KEYS, 1);
  if (gesture == BENCH_PEDAL) {
    harp_all_notes_off(harp, 0);
  }
}

/* What happens before block `i`, from the gesture on. */
static void act(Harp* harp, BenchGesture gesture, uint32_t i) {
  switch (gesture) {
  case BENCH_TEN_KEYS:
    if (i == 0) {
      play(harp, LOWEST_KEY + 3, 10, 7);
    }
    break;
  case BENCH_PEDAL:
    if (i == 0) {
      harp_pedal(harp, 0, 0.0);
    }
    break;
  case BENCH_BEND:
    if (i == 0) {
      harp_bend(harp, 0, 1.0);
    }
    break;
  case BENCH_WHEEL:
    if (i < WHEEL_BLOCKS) {
      harp_bend(harp, 0, 2.0 * (i + 1) / WHEEL_BLOCKS);
    }
    break;
  case BENCH_JUMP:
    if (i == 0) {
      jump(harp);
    }
    break;
  case BENCH_N_GESTURES:
    break;
  }
}

static void run(Harp* harp) {
  float left[FRAMES];
  float right[FRAMES];
  harp_run(harp, FRAMES, left, right);
}

static void play_once(Harp* harp, BenchGesture gesture, uint32_t max_masses, double* least_s) {
  prepare(harp, gesture, max_masses);
  for (uint32_t i = 0; i < BEFORE + AFTER; ++i) {
    const double start = bench_clock_now_s();
    if (i >= BEFORE) {
      act(harp, gesture, i - BEFORE);
    }
    run(harp);
    least_s[i] = fmin(least_s[i], bench_clock_now_s() - start);
  }
}

static double mean(const double* values, uint32_t n) {
  double sum = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    sum += values[i];
  }
  return sum / n;
}

static void set_all(double* values, uint32_t n, double value) {
  for (uint32_t i = 0; i < n; ++i) {
    values[i] = value;
  }
}

/* Ten keys come from silence, so theirs is the calm after. */
static BenchBlocks judge(const double* least_s, BenchGesture gesture) {
  const uint32_t calm = gesture == BENCH_TEN_KEYS ? BEFORE + AFTER - CALM : BEFORE - CALM;
  BenchBlocks blocks = {.steady_s = mean(least_s + calm, CALM)};
  for (uint32_t i = 0; i < AFTER; ++i) {
    if (least_s[BEFORE + i] > blocks.worst_s) {
      blocks.worst_s = least_s[BEFORE + i];
      blocks.worst_block = i;
    }
  }
  return blocks;
}

bool bench_block_gesture(BenchGesture gesture,
                         uint32_t max_masses,
                         uint32_t n_times,
                         BenchBlocks* blocks) {
  Harp* const harp = harp_new(RATE_HZ);
  double least_s[BEFORE + AFTER];
  if (!harp) {
    return false;
  }
  set_all(least_s, BEFORE + AFTER, HUGE_VAL);
  const uint64_t denormals = denormals_flush();
  for (uint32_t i = 0; i < n_times; ++i) {
    play_once(harp, gesture, max_masses, least_s);
  }
  denormals_restore(denormals);
  harp_free(harp);
  *blocks = judge(least_s, gesture);
  return true;
}

static void play_second(Harp* harp, double* least_s) {
  play(harp, LOWEST_KEY, N_KEYS, 1);
  for (uint32_t i = 0; i < SECOND; ++i) {
    const double start = bench_clock_now_s();
    run(harp);
    least_s[i] = fmin(least_s[i], bench_clock_now_s() - start);
  }
}

/* Its first second, or one more. */
static void play_first(Harp* harp, double* least_s) {
  HarpPatch patch = usual_patch();
  patch.string.max_masses = 32;
  harp_reset(harp);
  harp_set_patch(harp, &patch, 0);
  play_second(harp, least_s);
}

/* Clocks swing, so a harp that has been played for long takes turns with one that begins. */
static void compare(Harp* old, Harp* fresh, uint32_t n_seconds, double* first, double* last) {
  play_first(old, last);
  for (uint32_t i = 1; i < n_seconds; ++i) {
    play_second(old, last);
  }
  set_all(first, SECOND, HUGE_VAL);
  set_all(last, SECOND, HUGE_VAL);
  for (uint32_t i = 0; i < N_SECONDS; ++i) {
    play_first(fresh, first);
    play_second(old, last);
  }
}

bool bench_block_growth(uint32_t n_seconds, double* first_s, double* last_s) {
  double first[SECOND];
  double last[SECOND];
  Harp* const old = harp_new(RATE_HZ);
  Harp* const fresh = harp_new(RATE_HZ);
  const bool is_there = old && fresh;
  if (is_there) {
    const uint64_t denormals = denormals_flush();
    compare(old, fresh, n_seconds, first, last);
    denormals_restore(denormals);
    *first_s = mean(first, SECOND);
    *last_s = mean(last, SECOND);
  }
  harp_free(old);
  harp_free(fresh);
  return is_there;
}

static const char* const names[BENCH_N_GESTURES] = {
    [BENCH_TEN_KEYS] = "ten keys in one block", [BENCH_PEDAL] = "pedal up, 88 strings",
    [BENCH_BEND] = "a bend of 88 strings",      [BENCH_WHEEL] = "16 bends of 88 strings",
    [BENCH_JUMP] = "ports jump, 88 strings",
};
static const char* const labels[BENCH_N_GESTURES] = {
    [BENCH_TEN_KEYS] = "ten_keys", [BENCH_PEDAL] = "pedal", [BENCH_BEND] = "bend",
    [BENCH_WHEEL] = "wheel",       [BENCH_JUMP] = "jump",
};

static void print_growth(double first_s, double last_s, bool is_csv) {
  if (is_csv) {
    printf("growth,%.3f,%.3f,%.3f,\n", 1e6 * first_s, 1e6 * last_s, last_s / first_s);
  } else {
    printf("%-27s%9.1f%9.1f%8.2f   first second; after %d s of play\n",
           "88 keys a second, 32 masses", 1e6 * first_s, 1e6 * last_s, last_s / first_s, PLAY_S);
  }
}

static void print(BenchGesture gesture, BenchBlocks blocks, bool is_csv) {
  if (is_csv) {
    printf("%s,%.3f,%.3f,%.3f,%u\n", labels[gesture], 1e6 * blocks.steady_s, 1e6 * blocks.worst_s,
           blocks.worst_s / blocks.steady_s, blocks.worst_block);
  } else {
    printf("%-27s%9.1f%9.1f%8.2f   block %u\n", names[gesture], 1e6 * blocks.steady_s,
           1e6 * blocks.worst_s, blocks.worst_s / blocks.steady_s, blocks.worst_block);
  }
}

bool bench_block(const BenchChoice* choice) {
  const uint32_t max_masses = choice->n_masses ? choice->n_masses : MOST_MASSES;
  double first_s;
  double last_s;
  if (choice->is_csv) {
    printf("gesture,steady_us,worst_us,ratio,worst_block\n");
  } else {
    printf("\nBlocks of %d frames, %d masses a string at most\n%-27s%9s%9s%8s\n", FRAMES,
           (int)max_masses, "", "calm us", "worst us", "ratio");
  }
  for (int i = 0; i < BENCH_N_GESTURES; ++i) {
    BenchBlocks blocks;
    if (!bench_block_gesture((BenchGesture)i, max_masses, N_TIMES, &blocks)) {
      return false;
    }
    print((BenchGesture)i, blocks, choice->is_csv);
  }
  if (!bench_block_growth(PLAY_S, &first_s, &last_s)) {
    return false;
  }
  print_growth(first_s, last_s, choice->is_csv);
  return true;
}
