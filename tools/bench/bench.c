#include "tools/bench/bench.h"

#include "tools/bench/bench_block.h"
#include "tools/bench/bench_bodies.h"
#include "tools/bench/bench_clock.h"
#include "tools/bench/bench_count.h"
#include "tools/bench/bench_host.h"
#include "tools/bench/bench_load.h"
#include "tools/bench/bench_modes.h"
#include "tools/bench/bench_scene.h"
#include "tools/bench/bench_start.h"
#include "tools/bench/bench_survey.h"
#include "tools/bench/bench_table.h"
#include "tools/commands/args.h"

#include <stdio.h>
#include <string.h>

const char bench_help[] =
    "usage: hooke bench [OPTION]... [PART]...\n"
    "       hooke bench --host URI [--csv]\n"
    "       hooke bench --one WHAT...\n"
    "\n"
    "Measure what things cost on this machine: the best of many short runs, in turn with each\n"
    "other.  PART is one of these; without any, all are measured, in about half a minute.\n"
    "\n"
    "  scenes   one string, by every kernel that the processor can run, in every kind of numbers,\n"
    "           in every scene: where dampers sit, what pulls masses back, whether coefficients\n"
    "           move, and how many places are read\n"
    "  loads    whole instruments, each string in the numbers that the plugin would choose, and\n"
    "           how many strings one core can run\n"
    "\n"
    "  start    the time and the memory that a harp takes to be made, and the time of the plugin\n"
    "  blocks   a gesture's dearest block of 64 frames, against the mean one when nothing "
    "happens;\n"
    "           and whether a minute of play makes blocks dearer\n"
    "  survey   error against run time: the pitch, the decay, the partials and the noise of a\n"
    "           string, made in every way: as a chain in each kind of numbers with each kind of\n"
    "           partials, under other schemes, as a bank of its modes\n"
    "  bodies   error against run time of every body, of as many of its modes as are kept\n"
    "  modes    a bank of modes by every kernel: driven and heard in stereo, and pushed frame by\n"
    "           frame, beside the masses of the barest string\n"
    "\n"
    "  --scene WORDS    scenes: only those with all WORDS, with - between: bending, "
    "ground-still-2\n"
    "  --numbers KIND   scenes: only float, double or fixed, which are whole numbers\n"
    "  --masses N       scenes, survey: strings of N masses only; blocks: of N at most,\n"
    "                   instead of 256\n"
    "  --seconds S      a part takes about S seconds, and in any case measures all once\n"
    "  --csv            one part, for machines: a line of column names, then a line for each\n"
    "  --host URI       another instrument: what a frame costs with 0, 1, 8, 32 and 88 notes held\n"
    "  --one WHAT       do that alone and print nothing, to be watched by valgrind or perf; each\n"
    "                   begins with a call of bench_count_mark().  WHAT is SCENE,NUMBERS,MASSES,\n"
    "                   FRAMES, or awake,KEYS,FRAMES or asleep,KEYS,FRAMES for a harp\n"
    "\n"
    "The share of the peak is that of the vector operations which a step needs, counted by hand "
    "in\n"
    "tools/bench/bench_scene.c, over what the core could do in that time if nothing waited: "
    "vector\n"
    "multiplications and additions in registers, in turn, as measured just before and after.\n"
    "A multiply-add counts as one operation where the processor has them, else as two.  Loading,\n"
    "storing and shifting lanes are not counted.\n";

enum { SCENE = ARGS_OPTION, NUMBERS, MASSES, SECONDS, CSV, HOST, ONE };

static const struct option options[] = {{"scene", required_argument, NULL, SCENE},
                                        {"numbers", required_argument, NULL, NUMBERS},
                                        {"masses", required_argument, NULL, MASSES},
                                        {"seconds", required_argument, NULL, SECONDS},
                                        {"csv", no_argument, NULL, CSV},
                                        {"host", required_argument, NULL, HOST},
                                        {"one", required_argument, NULL, ONE},
                                        {0}};

typedef struct {
  const char* name;
  double seconds;
  bool (*run)(const BenchChoice* choice);
} Part;

static const Part parts[] = {
    {"scenes", 9.0, bench_table}, {"loads", 4.0, bench_load},    {"start", 0.0, bench_start},
    {"blocks", 0.0, bench_block}, {"survey", 4.0, bench_survey}, {"bodies", 1.0, bench_bodies},
    {"modes", 1.0, bench_modes},
};
enum { N_PARTS = sizeof(parts) / sizeof(parts[0]) };

typedef struct {
  BenchChoice choice;
  bool is_asked[N_PARTS];
  int n_asked;
  const char* plugin_uri; /* NULL: none */
  bool is_counted;        /* Something was run to be counted, and that is all */
} Request;

static bool read_scene(const Args* args, Request* request) {
  bool is_known = false;
  for (uint32_t i = 0; i < BENCH_N_SCENES; ++i) {
    is_known = is_known || bench_scene_matches(bench_scene_at(i), args->value);
  }
  request->choice.scene = args->value;
  if (!is_known) {
    args_fail(args, ARGS_USAGE, "--scene: found '%s', expected words of a scene, such as %s",
              args->value, "ground-bending-still-2");
  }
  return is_known;
}

static bool read_numbers(const Args* args, Request* request) {
  request->choice.numbers = bench_numbers_named(args->value);
  if (request->choice.numbers == N_CHAIN_NUMBERS) {
    args_fail(args, ARGS_USAGE, "--numbers: found '%s', expected float, double or fixed",
              args->value);
    return false;
  }
  return true;
}

static bool read_part(const Args* args, Request* request) {
  for (int i = 0; i < N_PARTS; ++i) {
    if (!strcmp(parts[i].name, args->value)) {
      request->n_asked += !request->is_asked[i];
      request->is_asked[i] = true;
      return true;
    }
  }
  args_fail(args, ARGS_USAGE, "found '%s', expected a part; try hooke help bench", args->value);
  return false;
}

static bool count_one(const Args* args, Request* request) {
  request->is_counted = true;
  if (!bench_count(args->value)) {
    args_fail(args, ARGS_USAGE, "--one: found '%s', expected %s", args->value,
              "SCENE,NUMBERS,MASSES,FRAMES, awake,KEYS,FRAMES or asleep,KEYS,FRAMES");
    return false;
  }
  return true;
}

static bool read_word(const Args* args, int found, Request* request) {
  BenchChoice* const choice = &request->choice;
  long n_masses = 0;
  switch (found) {
  case SCENE:
    return read_scene(args, request);
  case NUMBERS:
    return read_numbers(args, request);
  case MASSES:
    if (!args_whole(args, "--masses", args->value, 1, CHAIN_MAX_MASSES, &n_masses)) {
      return false;
    }
    choice->n_masses = (uint32_t)n_masses;
    return true;
  case SECONDS:
    return args_number(args, "--seconds", args->value, 0.0, 3600.0, &choice->seconds);
  case CSV:
    choice->is_csv = true;
    return true;
  case HOST:
    request->plugin_uri = args->value;
    return true;
  case ONE:
    return count_one(args, request);
  default:
    return found == ARGS_OPERAND && read_part(args, request);
  }
}

static int run_parts(const Args* args, const Request* request) {
  if (request->choice.is_csv && request->n_asked != 1) {
    return args_fail(args, ARGS_USAGE, "--csv: found %d parts, expected one", request->n_asked);
  }
  if (!request->choice.is_csv) {
    printf("clock %.2f GHz, peak %.1f G operations a second\n", 1e-9 * bench_clock_hz(),
           1e-9 * bench_clock_peak(bench_vector_bytes(chain_kernel(0), CHAIN_FLOAT)));
  }
  for (int i = 0; i < N_PARTS; ++i) {
    BenchChoice choice = request->choice;
    choice.seconds = choice.seconds >= 0.0 ? choice.seconds : parts[i].seconds;
    const bool is_wanted = request->n_asked == 0 || request->is_asked[i];
    if (is_wanted && !parts[i].run(&choice)) {
      return args_fail(args, ARGS_FAILURE, "%s: found nothing to measure, or no memory for it",
                       parts[i].name);
    }
    (void)fflush(stdout);
  }
  return ARGS_OK;
}

static int run_host(const Args* args, const Request* request) {
  char error[512] = "";
  if (request->n_asked > 0) {
    return args_fail(args, ARGS_USAGE, "--host: found a part as well, expected no part");
  }
  if (!bench_host(request->plugin_uri, request->choice.is_csv, error, sizeof(error))) {
    return args_fail(args, ARGS_FAILURE, "%s", error);
  }
  return ARGS_OK;
}

int bench_main(int argc, char** argv) {
  Args args = {.command = "hooke bench", .argc = argc, .argv = argv, .options = options};
  Request request = {.choice = {.seconds = -1.0, .scene = "", .numbers = N_CHAIN_NUMBERS}};
  for (int found = args_next(&args); found != ARGS_END; found = args_next(&args)) {
    if (found == ARGS_ERROR || !read_word(&args, found, &request)) {
      return ARGS_USAGE;
    }
  }
  if (request.is_counted) {
    return ARGS_OK;
  }
  return request.plugin_uri ? run_host(&args, &request) : run_parts(&args, &request);
}
