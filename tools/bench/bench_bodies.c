#include "tools/bench/bench_bodies.h"

#include "core/bank/bodies.h"
#include "tools/bench/bench_clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK = 64, N_BLOCKS = 32, N_PLACES = 24 };

static const double RATE_HZ = 48000.0;
static const double LOW_HZ = 80.0;
static const double HIGH_HZ = 8000.0;

#define NAME(name, file, text) text,
static const char* const names[] = {"", BODIES_LIST(NAME)};
#undef NAME

typedef struct {
  Body body;
  Bank bank;
  float force[BLOCK];
  float sides[2][BLOCK];
} Run;

/* Memory of its own, for a stack may be small. */
static Run run;

typedef struct {
  double rms_db;
  double worst_db;
} Errors;

static double band_power(const Body* body, double hz) {
  double sum = 0.0;
  for (int i = 0; i < N_PLACES; ++i) {
    const double octaves = ((i + 0.5) / N_PLACES - 0.5) / 3.0;
    sum += body_gain_square(body, (BodyShape){1.0, 1.0}, hz * exp2(octaves));
  }
  return sum;
}

static Errors errors_of(const Body* kept, const Body* whole) {
  Errors errors = {0.0, 0.0};
  int n = 0;
  double hz = LOW_HZ;
  while (hz < HIGH_HZ) {
    const double db = 10.0 * log10(band_power(kept, hz) / band_power(whole, hz));
    errors.rms_db += db * db;
    errors.worst_db = fmax(errors.worst_db, fabs(db));
    ++n;
    hz *= cbrt(2.0);
  }
  errors.rms_db = sqrt(errors.rms_db / n);
  return errors;
}

/* As a player's strings would; the bank rings on from one to the next. */
static void run_blocks(void* data) {
  Run* const on = data;
  for (int i = 0; i < N_BLOCKS; ++i) {
    bank_run(&on->bank, on->force, BLOCK, on->sides[0], on->sides[1]);
  }
}

static double time_of(double seconds) {
  double best_s = HUGE_VAL;
  const double until_s = bench_clock_now_s() + seconds;
  do {
    const double start_s = bench_clock_now_s();
    run_blocks(&run);
    best_s = fmin(best_s, bench_clock_now_s() - start_s);
  } while (bench_clock_now_s() < until_s);
  memset(run.sides, 0, sizeof(run.sides));
  return best_s / (BLOCK * N_BLOCKS);
}

static void
print_row(const BenchChoice* choice, const char* name, uint32_t n_modes, double s, Errors e) {
  printf(choice->is_csv ? "%s,%u,%.3f,%.4f,%.4f\n" : "%-18s%6u%12.1f%12.2f%12.2f\n", name, n_modes,
         1e9 * s, e.rms_db, e.worst_db);
}

static void weigh(const BenchChoice* choice, const char* name, const Body* whole, double seconds) {
  for (uint32_t n = 8; n < 2 * whole->n_modes; n *= 2) {
    run.body = *whole;
    body_keep(&run.body, n);
    body_bank(&run.body, (BodyShape){1.0, 1.0}, RATE_HZ, &run.bank);
    print_row(choice, name, run.body.n_modes, time_of(seconds), errors_of(&run.body, whole));
  }
}

bool bench_bodies(const BenchChoice* choice) {
  const double each_s = choice->seconds / (6.0 * (BODIES_FILE - 1));
  printf(choice->is_csv ? "body,modes,ns_per_frame,error_db,worst_db\n"
                        : "\n%-18s%6s%12s%12s%12s\n",
         "Body", "modes", "ns a frame", "error [dB]", "worst [dB]");
  for (int n = 0; n < BLOCK; ++n) {
    run.force[n] = (float)sin(0.3 * n);
  }
  for (BodiesChoice body = BODIES_NONE + 1; body < BODIES_FILE; ++body) {
    weigh(choice, names[body], bodies_shipped(body), each_s);
  }
  return true;
}
