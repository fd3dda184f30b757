#include "tools/bench/bench_modes.h"

#include "core/bank/bank.h"
#include "tools/bench/bench_clock.h"
#include "tools/bench/bench_scene.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK = 64, FRAMES = 32 * BLOCK, MASSES = 640, N_SIZES = 5, MOST_KERNELS = 3 };

static const uint32_t sizes[N_SIZES] = {8, 32, 64, 128, 256};

static const double RATE_HZ = 48000.0;
static const double LOW_HZ = 60.0;
static const double HIGH_HZ = 16000.0;
static const double TAU_S = 0.1;

/* Of what pushes, for each unit of what it has pushed by. */
static const double SPRING = 1e-3;

typedef struct {
  Bank bank;
  float force[BLOCK];
  float sides[2][BLOCK];
  double pushed;
} Run;

/* Memory of its own, for a stack may be small. */
static Run runs[MOST_KERNELS][N_SIZES];

/* The best time of FRAMES frames [s]. */
typedef struct {
  double heard_s;
  double pushed_s;
} Best;

static void fill(Bank* bank, const BankKernel* kernel, uint32_t n_modes) {
  bank_clear(bank);
  for (uint32_t k = 0; k < n_modes; ++k) {
    BankMode mode = {.in = 0.01, .out = {1.0, 0.5}};
    const double f0_hz = LOW_HZ * pow(HIGH_HZ / LOW_HZ, (k + 0.5) / n_modes);
    const Status status = pole_solve(RATE_HZ, (Tone){f0_hz, TAU_S}, &mode.pole);
    assert(status == STATUS_OK);
    (void)status;
    bank_add(bank, mode);
  }
  bank->kernel = kernel;
}

static void init(Run* run, const BankKernel* kernel, uint32_t n_modes) {
  fill(&run->bank, kernel, n_modes);
  for (int n = 0; n < BLOCK; ++n) {
    run->force[n] = (float)sin(0.3 * n);
  }
}

static void hear(Run* run) {
  for (int n = 0; n < FRAMES; n += BLOCK) {
    bank_run(&run->bank, run->force, BLOCK, run->sides[0], run->sides[1]);
  }
}

static void push(Run* run) {
  double y = 0.0;
  for (int n = 0; n < FRAMES; ++n) {
    y = bank_push(&run->bank, (double)run->force[n % BLOCK] - SPRING * y);
  }
  run->pushed = y;
}

static void measure(Run* run, Best* best) {
  memset(run->sides, 0, sizeof(run->sides));
  const double start_s = bench_clock_now_s();
  hear(run);
  const double between_s = bench_clock_now_s();
  push(run);
  best->pushed_s = fmin(best->pushed_s, bench_clock_now_s() - between_s);
  best->heard_s = fmin(best->heard_s, between_s - start_s);
}

static void measure_string(BenchString* string, double* best_s) {
  const double start_s = bench_clock_now_s();
  bench_string_run(string, FRAMES);
  *best_s = fmin(*best_s, bench_clock_now_s() - start_s);
}

static double ns_of(double time_s, uint32_t n) {
  return 1e9 * time_s / ((double)FRAMES * n);
}

static void
print_row(const BenchChoice* choice, const Bank* bank, const Best* best, double mass_ns) {
  const double heard_ns = ns_of(best->heard_s, bank->n_added);
  const double pushed_ns = ns_of(best->pushed_s, bank->n_added);
  printf(choice->is_csv ? "%s,%u,%.4f,%.4f,%.4f,%.3f,%.3f\n"
                        : "%-14s%6u%10.3f%10.3f%10.3f%16.2f%10.2f\n",
         bank->kernel->name, bank->n_added, heard_ns, pushed_ns, mass_ns, heard_ns / mass_ns,
         pushed_ns / mass_ns);
}

static void print_heading(const BenchChoice* choice) {
  if (choice->is_csv) {
    printf("kernel,modes,heard_ns_per_mode_step,pushed_ns_per_mode_step,ns_per_mass_step,"
           "heard_ratio,pushed_ratio\n");
    return;
  }
  printf("\nns a step of a mode, heard in stereo or pushed frame by frame, and of %d masses\n"
         "%-14s%6s%10s%10s%10s%16s%10s\n",
         MASSES, "", "modes", "heard", "pushed", "a mass", "heard/mass", "pushed");
}

typedef struct {
  uint32_t n_kernels;
  Best best[MOST_KERNELS][N_SIZES];
  BenchString string;
  double string_s;
} Modes;

static void init_all(Modes* modes) {
  while (modes->n_kernels < MOST_KERNELS && bank_kernel(modes->n_kernels)) {
    const uint32_t kernel = modes->n_kernels++;
    for (int i = 0; i < N_SIZES; ++i) {
      init(&runs[kernel][i], bank_kernel(kernel), sizes[i]);
      modes->best[kernel][i] = (Best){HUGE_VAL, HUGE_VAL};
    }
  }
}

static void measure_all(Modes* modes, double seconds) {
  const double until_s = bench_clock_wall_s() + seconds;
  do {
    for (uint32_t kernel = 0; kernel < modes->n_kernels; ++kernel) {
      for (int i = 0; i < N_SIZES; ++i) {
        measure(&runs[kernel][i], &modes->best[kernel][i]);
        measure_string(&modes->string, &modes->string_s);
      }
    }
  } while (bench_clock_wall_s() < until_s);
}

bool bench_modes(const BenchChoice* choice) {
  const BenchScene barest = {CHAIN_UNDAMPED, CHAIN_FLEXIBLE, false, 1};
  Modes modes = {.string_s = HUGE_VAL};
  if (!bench_string_init(&modes.string, chain_kernel(0), CHAIN_FLOAT, barest, MASSES)) {
    return false;
  }
  (void)bench_string_start(&modes.string, FRAMES);
  init_all(&modes);
  measure_all(&modes, choice->seconds);
  print_heading(choice);
  for (uint32_t kernel = 0; kernel < modes.n_kernels; ++kernel) {
    for (int i = 0; i < N_SIZES; ++i) {
      print_row(choice, &runs[kernel][i].bank, &modes.best[kernel][i],
                ns_of(modes.string_s, MASSES));
    }
  }
  bench_string_free(&modes.string);
  return true;
}
