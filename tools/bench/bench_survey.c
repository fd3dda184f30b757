#include "tools/bench/bench_survey.h"

#include "tools/report/trade_measure.h"

#include <math.h>
#include <stdlib.h>

/* Half an octave from one to the next, and what the plugin has; then the most that are stable. */
static const uint32_t counts[] = {
    4,   5,   7,   10,  14,  20,  28, 40, 57, 80, 113, TRADE_DEFAULT_MASSES,
    160, 226, 256, 320, 453, 640, 905};
enum { N_COUNTS = sizeof(counts) / sizeof(counts[0]) };

/* Clocks, by what takes the same time. */
typedef struct {
  TradeClock* clocks;
  unsigned* loops;
  size_t* of_point;
  size_t n;
} Clocks;

TradeString trade_string(unsigned pitch, unsigned stiffness, unsigned rate) {
  static const double pitches_hz[TRADE_N_PITCHES] = {55.0, 110.0, 440.0, 1760.0};
  static const double stiffnesses[TRADE_N_STIFFNESSES] = {0.0, 1e-4};
  static const double rates_hz[TRADE_N_RATES] = {22050.0, 44100.0, 48000.0, 96000.0, 192000.0};
  return (TradeString){.f0_hz = pitches_hz[pitch],
                       .tau_s = 2.0,
                       .inharmonicity = stiffnesses[stiffness],
                       .loss = 0.01,
                       .rate_hz = rates_hz[rate]};
}

/* Networks have no bending: nothing to compare with a stiff string. */
static bool can_have(BenchWay method, TradeString string) {
  return string.inharmonicity == 0.0 || (method.kind != BENCH_NETWORK && method.is_corrected);
}

static bool is_default(BenchWay method, TradeString string, uint32_t n, uint32_t most) {
  return method.kind == BENCH_CHAIN && method.partials == TRADE_DEFAULT_PARTIALS &&
         method.numbers == CHAIN_FIXED && method.is_corrected &&
         string.rate_hz == TRADE_DEFAULT_RATE_HZ &&
         n == (most < TRADE_DEFAULT_MASSES ? most : TRADE_DEFAULT_MASSES);
}

static bool has_noise(const TradePoint* point) {
  return point->method.is_corrected && point->string.inharmonicity == 0.0 &&
         point->method.kind != BENCH_NETWORK;
}

static TradePoint make_point(BenchWay method, TradeString string, uint32_t n, uint32_t most) {
  TradePoint point = {.method = method, .string = string, .n_masses = n};
  point.is_stable = bench_way_is_stable(method, string, n);
  point.is_default = is_default(method, string, n, most);
  point.error[TRADE_PITCH] = bench_way_pitch_error(method, string, n);
  point.error[TRADE_DECAY] = bench_way_decay_error(method, string, n);
  point.error[TRADE_PARTIALS] = bench_way_partials_error(method, string, n);
  point.error[TRADE_NOISE] = (double)NAN;
  if (has_noise(&point)) {
    point.error[TRADE_NOISE] =
        method.numbers == CHAIN_DOUBLE ? -HUGE_VAL : trade_measure_noise(method, string, n);
  }
  return point;
}

/* All numbers of masses of one method. */
static void add_points(TradeSurvey* survey, BenchWay method, TradeString string) {
  const uint32_t most = bench_way_max_masses(method, string);
  uint32_t last = 0;
  for (unsigned c = 0; c <= N_COUNTS && last < most; ++c) {
    last = c < N_COUNTS && counts[c] < most ? counts[c] : most;
    Tone tone = {0};
    if (bench_way_tone(method, string, last, 1, &tone)) {
      survey->points[survey->n++] = make_point(method, string, last, most);
    }
  }
}

/* Backward Euler takes as long as it needs to converge, which is up to the string. */
static bool is_same_clock(const TradeClock* clock, const TradePoint* point) {
  const bool is_backward =
      point->method.kind == BENCH_NETWORK && point->method.scheme == NETWORK_BACKWARD;
  return clock->n_masses == point->n_masses &&
         (!is_backward || trade_is_same(clock->string, point->string));
}

static void assign_clock(Clocks* clocks, const TradePoint* point, size_t i) {
  StringCoefs coefs = {0};
  (void)bench_way_coefs(point->method, point->string, point->n_masses, &coefs);
  const unsigned loop = bench_way_loop(point->method, coefs);
  size_t c = 0;
  while (c < clocks->n && !(clocks->loops[c] == loop && is_same_clock(&clocks->clocks[c], point))) {
    ++c;
  }
  if (c == clocks->n) {
    clocks->clocks[clocks->n] = (TradeClock){.method = point->method,
                                             .string = point->string,
                                             .n_masses = point->n_masses,
                                             .ns = HUGE_VAL};
    clocks->loops[clocks->n++] = loop;
  }
  clocks->of_point[i] = c;
}

static void run_clocks(TradeSurvey* survey, Clocks* clocks) {
  for (size_t i = 0; i < survey->n; ++i) {
    assign_clock(clocks, &survey->points[i], i);
  }
  for (int look = 0; look < TRADE_N_LOOKS; ++look) {
    for (size_t c = 0; c < clocks->n; ++c) {
      trade_measure_time(&clocks->clocks[c]);
    }
  }
  for (size_t i = 0; i < survey->n; ++i) {
    TradePoint* const point = &survey->points[i];
    point->ns = clocks->clocks[clocks->of_point[i]].ns;
    point->share = 1e-9 * point->ns * point->string.rate_hz;
  }
}

static Status take_time(TradeSurvey* survey) {
  Clocks clocks = {.clocks = malloc(survey->n * sizeof(*clocks.clocks)),
                   .loops = malloc(survey->n * sizeof(*clocks.loops)),
                   .of_point = malloc(survey->n * sizeof(*clocks.of_point))};
  const bool is_there = clocks.clocks && clocks.loops && clocks.of_point;
  if (is_there) {
    run_clocks(survey, &clocks);
  }
  free(clocks.clocks);
  free(clocks.loops);
  free(clocks.of_point);
  return is_there ? STATUS_OK : STATUS_NO_MEMORY;
}

static void add_string(TradeSurvey* survey, TradeString string) {
  for (unsigned m = 0; m < BENCH_N_WAYS; ++m) {
    if (can_have(bench_way_at(m), string)) {
      add_points(survey, bench_way_at(m), string);
    }
  }
}

Status trade_survey(TradeSurvey* survey) {
  enum { N_STRINGS = TRADE_N_PITCHES * TRADE_N_STIFFNESSES * TRADE_N_RATES };
  *survey = (TradeSurvey){0};
  survey->points =
      malloc((size_t)N_STRINGS * BENCH_N_WAYS * (N_COUNTS + 1) * sizeof(*survey->points));
  if (!survey->points) {
    return STATUS_NO_MEMORY;
  }
  for (unsigned i = 0; i < N_STRINGS; ++i) {
    const unsigned of_pitch = i / TRADE_N_RATES;
    add_string(survey, trade_string(of_pitch % TRADE_N_PITCHES, of_pitch / TRADE_N_PITCHES,
                                    i % TRADE_N_RATES));
  }
  const Status status = take_time(survey);
  if (status == STATUS_OK) {
    trade_find_fronts(survey->points, survey->n);
  } else {
    trade_survey_free(survey);
  }
  return status;
}

void trade_survey_free(TradeSurvey* survey) {
  free(survey->points);
  *survey = (TradeSurvey){0};
}
