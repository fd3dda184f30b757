#include "tools/bench/bench_load.h"

#include "core/excite/pluck.h"
#include "core/string/pickup.h"
#include "core/string/tuning.h"
#include "plugin/denormals.h"
#include "tools/bench/bench_clock.h"
#include "tools/bench/bench_scene.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_STRINGS = 128, SETTLE_FRAMES = 1024, FRESH_FRAMES = 24000, N_TAPS = 2, A4 = 69 };

static const double RATE_HZ = 48000.0;
static const double TAU_S = 2.0;
static const double LOSS = 0.01;
static const double RUN_S = 300e-6;

/* What is played. */
typedef struct {
  const char* name;
  const char* label; /* In CSV */
  uint32_t n_strings;
  uint32_t first_key; /* Of strings that go up by semitones from here */
  uint32_t step;      /* Semitones from one to the next */
  uint32_t max_masses;
  double goal_ns; /* 0: none */
} LoadPlan;

enum { N_LOADS = 4, N_COUNTED = 5, N_PLANS = N_LOADS + N_COUNTED };

/* Six strings in fourths from B1 on: at 80 masses a guitar's highest one would pass its limit. */
static const LoadPlan plans[N_PLANS] = {
    {"one string of 80 masses", "one_80", 1, 45, 0, 80, 0.17},
    {"six strings of 80 masses", "six_80", 6, 35, 5, 80, 0.12},
    {"88 keys, all partials", "keys_88", 88, 21, 1, CHAIN_MAX_MASSES, 0.12},
    {"128 keys, all partials", "keys_128", 128, 0, 1, CHAIN_MAX_MASSES, 0.11},
    {"A0, all partials", "a0", 16, 21, 0, CHAIN_MAX_MASSES, 0.0},
    {"A2, all partials", "a2", 32, 45, 0, CHAIN_MAX_MASSES, 0.0},
    {"A4, all partials", "a4", 64, 69, 0, CHAIN_MAX_MASSES, 0.0},
    {"A6, all partials", "a6", 128, 93, 0, CHAIN_MAX_MASSES, 0.0},
    {"80 masses", "80", 32, 45, 0, 80, 0.0},
};

typedef struct {
  const LoadPlan* plan;
  uint32_t n_strings; /* That are below Nyquist */
  uint32_t n_cut;     /* That would have more masses than there may be */
  uint32_t n_masses;
  uint32_t n_wanted;              /* Masses, were none cut */
  uint32_t n_in[N_CHAIN_NUMBERS]; /* Strings in each kind of numbers */
  double need;                    /* Vector operations a frame */
  uint32_t n_frames;              /* Of a run */
  uint32_t n_stale;               /* Frames since the last pluck */
  BenchBest best;
  Chain chains[MOST_STRINGS];
  ChainPart parts[MOST_STRINGS];
  void* memory; /* Owned */
} Load;

static TuningTarget target_of(const LoadPlan* plan, uint32_t i) {
  const double key = plan->first_key + (double)plan->step * i;
  return (TuningTarget){
      .rate_hz = RATE_HZ,
      .tone = {.f0_hz = 440.0 * exp2((key - A4) / 12.0), .tau_s = TAU_S},
      .loss = LOSS,
      .partials = PARTIALS_LUMPED,
  };
}

static void run_frames(Load* load, uint32_t n_frames) {
  float mix[N_TAPS][BENCH_RUN_FRAMES];
  float* const out[N_TAPS] = {mix[0], mix[1]};
  memset(mix, 0, sizeof(mix));
  for (uint32_t done = 0; done < n_frames; done += BENCH_RUN_FRAMES) {
    chain_run_all(load->parts, load->n_strings, BENCH_RUN_FRAMES, N_TAPS, out);
  }
}

static void run(void* data) {
  Load* const load = data;
  run_frames(load, load->n_frames);
}

/* Pluck all, and keep them in the numbers in which the harp would. */
static void start(Load* load) {
  const Pluck pluck = {.place = 0.13, .hardness = 0.5, .amplitude = 0.25};
  for (uint32_t i = 0; i < load->n_strings; ++i) {
    chain_rest(&load->chains[i]);
    pluck_pull(&load->chains[i], pluck);
  }
  run_frames(load, SETTLE_FRAMES);
  for (uint32_t i = 0; i < load->n_strings; ++i) {
    chain_settle(&load->chains[i]);
  }
  run_frames(load, BENCH_RUN_FRAMES);
  load->n_stale = 0;
}

/* Add a string; the bytes of memory that it takes. */
static size_t add_string(Load* load, uint32_t i, char* memory) {
  const TuningTarget target = target_of(load->plan, i);
  const uint32_t limit = load->plan->max_masses;
  const uint32_t n_masses = tuning_max_masses(&target, limit);
  StringCoefs coefs;
  if (n_masses == 0 || tuning_solve(&target, n_masses, &coefs)) {
    return 0;
  }
  Chain* const chain = &load->chains[load->n_strings];
  ChainPart* const part = &load->parts[load->n_strings];
  chain_init(chain, chain_kernel(0), memory, n_masses);
  chain_set(chain, coefs);
  part->chain = chain;
  part->taps[0] = pickup_tap(n_masses, 0.15);
  part->taps[1] = pickup_tap(n_masses, 0.25);
  const bool is_whole = limit < CHAIN_MAX_MASSES;
  const uint32_t n_wanted = is_whole ? n_masses : tuning_max_masses(&target, INT32_MAX);
  load->n_cut += n_wanted > n_masses;
  load->n_wanted += n_wanted;
  load->n_masses += n_masses;
  ++load->n_strings;
  return chain_size(n_masses);
}

static void count_needs(Load* load) {
  for (uint32_t i = 0; i < load->n_strings; ++i) {
    const Chain* const chain = &load->chains[i];
    load->need += chain->n_masses *
                  bench_scene_need(chain->kernel, chain->numbers, bench_scene_of(chain, N_TAPS));
    ++load->n_in[chain->numbers];
  }
}

static Load* load_new(const LoadPlan* plan) {
  Load* const load = calloc(1, sizeof(Load));
  char* const memory =
      aligned_alloc(CHAIN_ALIGNMENT, plan->n_strings * chain_size(plan->max_masses));
  if (!load || !memory) {
    free(load);
    free(memory);
    return NULL;
  }
  *load = (Load){.plan = plan, .memory = memory, .best = {.time_s = HUGE_VAL}};
  size_t size = 0;
  for (uint32_t i = 0; i < plan->n_strings; ++i) {
    size += add_string(load, i, memory + size);
  }
  start(load);
  count_needs(load);
  load->n_frames = BENCH_RUN_FRAMES;
  const double begin = bench_clock_now_s();
  run(load);
  load->n_frames *= (uint32_t)ceil(RUN_S / fmax(bench_clock_now_s() - begin, 1e-6));
  return load;
}

static void load_free(Load* load) {
  if (load) {
    free(load->memory);
    free(load);
  }
}

static void measure_all(Load* const* loads, double seconds) {
  const double end_s = bench_clock_wall_s() + seconds;
  const size_t bytes = bench_vector_bytes(chain_kernel(0), CHAIN_FLOAT);
  do {
    for (int i = 0; i < N_PLANS; ++i) {
      Load* const load = loads[i];
      if (load->n_stale > FRESH_FRAMES) {
        start(load);
      }
      bench_clock_measure(&load->best, run, load, load->need * load->n_frames, bytes);
      load->n_stale += load->n_frames;
    }
  } while (bench_clock_wall_s() < end_s);
}

static double ns_of(const Load* load) {
  return 1e9 * load->best.time_s / ((double)load->n_frames * load->n_masses);
}

static double core_of(const Load* load) {
  return load->best.time_s * RATE_HZ / load->n_frames;
}

static void print_load(const Load* load) {
  printf("%-27s%8u%10.3f%7.2f%8.2f%%%5.0f%%  ", load->plan->name, load->n_masses, ns_of(load),
         load->plan->goal_ns, 100.0 * core_of(load), 100.0 * load->best.share);
  for (int n = 0; n < N_CHAIN_NUMBERS; ++n) {
    printf(" %u %s", load->n_in[n], bench_numbers_name((ChainNumbers)n));
  }
  if (load->n_cut > 0) {
    printf("; %u cut to %d of %u masses in all", load->n_cut, CHAIN_MAX_MASSES, load->n_wanted);
  }
  printf("\n");
}

static void print_loads(Load* const* loads) {
  printf("\nAs the harp runs them, by the %s kernel, at %g Hz, tau %g s, loss %g\n"
         "%-27s%8s%10s%7s%9s%6s   strings in\n",
         chain_kernel(0)->name, RATE_HZ, TAU_S, LOSS, "", "masses", "ns a step", "goal", "% core",
         "peak");
  for (int i = 0; i < N_LOADS; ++i) {
    print_load(loads[i]);
  }
}

static void print_counts(Load* const* loads) {
  printf("\n%-27s%8s%10s%18s%6s\n", "strings alike", "masses", "ns a step", "strings per core",
         "peak");
  for (int i = N_LOADS; i < N_PLANS; ++i) {
    const Load* const load = loads[i];
    printf("%-27s%8u%10.3f%18.0f%5.0f%%\n", load->plan->name, load->chains[0].n_masses, ns_of(load),
           load->n_strings / core_of(load), 100.0 * load->best.share);
  }
}

static void print_csv(Load* const* loads) {
  printf("load,strings,masses,ns_per_mass_step,goal_ns,share_of_core,share_of_peak,"
         "strings_per_core,strings_cut\n");
  for (int i = 0; i < N_PLANS; ++i) {
    const Load* const load = loads[i];
    printf("%s,%u,%u,%.4f,%g,%.6f,%.4f,%.1f,%u\n", load->plan->label, load->n_strings,
           load->n_masses, ns_of(load), load->plan->goal_ns, core_of(load), load->best.share,
           load->n_strings / core_of(load), load->n_cut);
  }
}

bool bench_load(const BenchChoice* choice) {
  Load* loads[N_PLANS];
  bool is_ok = true;
  for (int i = 0; i < N_PLANS; ++i) {
    loads[i] = load_new(&plans[i]);
    is_ok = is_ok && loads[i];
  }
  if (is_ok) {
    const uint64_t denormals = denormals_flush();
    measure_all(loads, choice->seconds);
    denormals_restore(denormals);
  }
  if (is_ok && choice->is_csv) {
    print_csv(loads);
  } else if (is_ok) {
    print_loads(loads);
    print_counts(loads);
  }
  for (int i = 0; i < N_PLANS; ++i) {
    load_free(loads[i]);
  }
  return is_ok;
}
