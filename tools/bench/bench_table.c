#include "tools/bench/bench_table.h"

#include "tools/bench/bench_clock.h"
#include "tools/bench/bench_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A run is short, so that many fall between what disturbs them [s]. */
static const double RUN_S = 200e-6;

static const uint32_t sizes[] = {8, 40, 80, 320, 1024};
enum { N_SIZES = sizeof(sizes) / sizeof(sizes[0]), MOST_KERNELS = 4 };
enum { MOST_ROWS = MOST_KERNELS * N_CHAIN_NUMBERS * BENCH_N_SCENES };

/* A string, and how it did. */
typedef struct {
  BenchString string;
  uint32_t n_frames; /* Of a run */
  BenchBest best;
} Entry;

/* All sizes of one scene. */
typedef struct {
  const ChainKernel* kernel;
  ChainNumbers numbers;
  BenchScene scene;
  uint32_t n_sizes;
  Entry entries[N_SIZES];
} Row;

typedef struct {
  uint32_t n_rows;
  Row rows[MOST_ROWS];
} Table;

static void run(void* data) {
  Entry* const entry = data;
  bench_string_run(&entry->string, entry->n_frames);
}

/* As many frames as take about RUN_S, for runs that are cut into as many as the harp runs in one
 * go. */
static void choose_frames(Entry* entry) {
  entry->n_frames = BENCH_RUN_FRAMES;
  const double start = bench_clock_now_s();
  run(entry);
  const double n_runs = ceil(RUN_S / fmax(bench_clock_now_s() - start, 1e-6));
  entry->n_frames *= (uint32_t)fmin(n_runs, 1000.0);
}

static void measure(Row* row, uint32_t i) {
  Entry* const entry = &row->entries[i];
  const double n_steps = (double)entry->string.chain.n_masses * entry->n_frames;
  bench_string_start(&entry->string, entry->n_frames + BENCH_RUN_FRAMES);
  bench_string_run(&entry->string, BENCH_RUN_FRAMES);
  bench_clock_measure(&entry->best, run, entry,
                      n_steps * bench_scene_need(row->kernel, row->numbers, row->scene),
                      bench_vector_bytes(row->kernel, row->numbers));
}

/* false when memory is out; a scene that these numbers do not have is left out. */
static bool add_row(Table* table, Row row, const BenchChoice* choice) {
  row.n_sizes = choice->n_masses ? 1 : N_SIZES;
  bool is_there = true;
  for (uint32_t i = 0; i < row.n_sizes; ++i) {
    Entry* const entry = &row.entries[i];
    const uint32_t n_masses = choice->n_masses ? choice->n_masses : sizes[i];
    if (!bench_string_init(&entry->string, row.kernel, row.numbers, row.scene, n_masses)) {
      return false;
    }
    entry->best.time_s = HUGE_VAL;
    is_there = is_there && bench_string_start(&entry->string, 2 * BENCH_RUN_FRAMES);
    if (is_there) {
      choose_frames(entry);
    }
  }
  if (is_there) {
    table->rows[table->n_rows++] = row;
  }
  for (uint32_t i = 0; !is_there && i < row.n_sizes; ++i) {
    bench_string_free(&row.entries[i].string);
  }
  return true;
}

static bool fill(Table* table, const BenchChoice* choice) {
  bool is_ok = true;
  for (uint32_t k = 0; k < MOST_KERNELS && chain_kernel(k); ++k) {
    for (int numbers = 0; numbers < N_CHAIN_NUMBERS; ++numbers) {
      for (uint32_t i = 0; i < BENCH_N_SCENES; ++i) {
        const Row row = {.kernel = chain_kernel(k),
                         .numbers = (ChainNumbers)numbers,
                         .scene = bench_scene_at(i)};
        const bool is_chosen =
            (choice->numbers == N_CHAIN_NUMBERS || choice->numbers == row.numbers) &&
            bench_scene_matches(row.scene, choice->scene);
        is_ok = is_ok && (!is_chosen || add_row(table, row, choice));
      }
    }
  }
  return is_ok && table->n_rows > 0;
}

static void measure_all(Table* table, double seconds) {
  const double end_s = bench_clock_wall_s() + seconds;
  do {
    for (uint32_t r = 0; r < table->n_rows; ++r) {
      for (uint32_t i = 0; i < table->rows[r].n_sizes; ++i) {
        measure(&table->rows[r], i);
      }
    }
  } while (bench_clock_wall_s() < end_s);
}

static double ns_of(const Entry* entry) {
  return 1e9 * entry->best.time_s / ((double)entry->n_frames * entry->string.chain.n_masses);
}

static void print_heading(const Row* row) {
  printf("\n%s, %s: ns a mass-step, and %% of peak\n%-31s", row->kernel->name,
         bench_numbers_name(row->numbers), "masses");
  for (uint32_t i = 0; i < row->n_sizes; ++i) {
    printf("%8u     ", row->entries[i].string.chain.n_masses);
  }
  printf("\n");
}

static void print_table(const Table* table) {
  for (uint32_t r = 0; r < table->n_rows; ++r) {
    const Row* const row = &table->rows[r];
    char name[BENCH_NAME_SIZE];
    bench_scene_name(row->scene, name);
    if (r == 0 || row->kernel != row[-1].kernel || row->numbers != row[-1].numbers) {
      print_heading(row);
    }
    printf("%-31s", name);
    for (uint32_t i = 0; i < row->n_sizes; ++i) {
      printf("%8.3f %3.0f%%", ns_of(&row->entries[i]), 100.0 * row->entries[i].best.share);
    }
    printf("\n");
  }
}

static void print_csv(const Table* table) {
  printf("kernel,numbers,scene,masses,ns_per_mass_step,share_of_peak\n");
  for (uint32_t r = 0; r < table->n_rows; ++r) {
    const Row* const row = &table->rows[r];
    char name[BENCH_NAME_SIZE];
    bench_scene_name(row->scene, name);
    for (uint32_t i = 0; i < row->n_sizes; ++i) {
      const Entry* const entry = &row->entries[i];
      printf("%s,%s,%s,%u,%.4f,%.4f\n", row->kernel->name, bench_numbers_name(row->numbers), name,
             entry->string.chain.n_masses, ns_of(entry), entry->best.share);
    }
  }
}

static void table_free(Table* table) {
  for (uint32_t r = 0; r < table->n_rows; ++r) {
    for (uint32_t i = 0; i < table->rows[r].n_sizes; ++i) {
      bench_string_free(&table->rows[r].entries[i].string);
    }
  }
  free(table);
}

bool bench_table(const BenchChoice* choice) {
  Table* const table = calloc(1, sizeof(Table));
  const bool is_full = table && fill(table, choice);
  if (is_full) {
    measure_all(table, choice->seconds);
    (choice->is_csv ? print_csv : print_table)(table);
  }
  if (table) {
    table_free(table);
  }
  return is_full;
}
