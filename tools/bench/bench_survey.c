#include "tools/bench/bench_survey.h"

#include "tools/bench/bench_clock.h"
#include "tools/bench/bench_player.h"
#include "tools/bench/bench_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Half an octave from one to the next, and powers of two; then the most that are stable. */
static const uint32_t counts[] = {4,   5,   7,   10,  14,  20,  28,  40,  57, 80,
                                  113, 128, 160, 226, 256, 320, 453, 640, 905};
enum { N_COUNTS = sizeof(counts) / sizeof(counts[0]), TOLD_MASSES = 80, AT_48_KHZ = 2 };

/* Of one look at the clock. */
static const double LOOK_S = 30e-6;

/* A string of so many masses, made in one way. */
typedef struct {
  BenchWay way;
  TuningTarget wanted;
  uint32_t n_masses;
  size_t clock; /* That measures it: the same for all that take the same time */
} Point;

/* What is timed. */
typedef struct {
  const Point* point;
  unsigned loop;
  uint32_t n_frames; /* In one look; 0 before the first */
  double frame_s;    /* The least that a frame took so far; NAN: there is no such string */
} Clock;

typedef struct {
  Point* points;
  size_t n_points;
  Clock* clocks;
  size_t n_clocks;
} Survey;

TuningTarget bench_survey_string(unsigned pitch, unsigned stiffness, unsigned rate) {
  static const double pitches_hz[BENCH_N_PITCHES] = {55.0, 110.0, 440.0, 1760.0};
  static const double stiffnesses[BENCH_N_STIFFNESSES] = {0.0, 1e-4};
  static const double rates_hz[BENCH_N_RATES] = {22050.0, 44100.0, 48000.0, 96000.0, 192000.0};
  return (TuningTarget){.rate_hz = rates_hz[rate],
                        .tone = {pitches_hz[pitch], 2.0},
                        .loss = 0.01,
                        .inharmonicity = stiffnesses[stiffness]};
}

/* Nothing to compare with a stiff string. */
static bool can_be_stiff(BenchWay way) {
  return way.kind != BENCH_NETWORK && way.is_corrected;
}

static void add_point(Survey* survey, BenchWay way, TuningTarget wanted, uint32_t n_masses) {
  Tone tone = {0};
  if (bench_way_tone(way, wanted, n_masses, 1, &tone)) {
    survey->points[survey->n_points++] =
        (Point){.way = way, .wanted = wanted, .n_masses = n_masses};
  }
}

/* All numbers of masses, or the one that is asked for. */
static void add_points(Survey* survey, BenchWay way, TuningTarget wanted, uint32_t n_masses) {
  const uint32_t most = bench_way_max_masses(way, wanted);
  if (n_masses > 0 && n_masses <= most) {
    add_point(survey, way, wanted, n_masses);
  }
  uint32_t last = 0;
  for (unsigned c = 0; n_masses == 0 && c <= N_COUNTS && last < most; ++c) {
    last = c < N_COUNTS && counts[c] < most ? counts[c] : most;
    add_point(survey, way, wanted, last);
  }
}

static void add_string(Survey* survey, TuningTarget wanted, uint32_t n_masses) {
  for (unsigned w = 0; w < BENCH_N_WAYS; ++w) {
    if (wanted.inharmonicity == 0.0 || can_be_stiff(bench_way_at(w))) {
      add_points(survey, bench_way_at(w), wanted, n_masses);
    }
  }
}

static void add_strings(Survey* survey, const BenchChoice* choice) {
  if (!choice->is_csv) {
    const uint32_t n_masses = choice->n_masses ? choice->n_masses : TOLD_MASSES;
    add_string(survey, bench_survey_string(0, 0, AT_48_KHZ), n_masses);
    return;
  }
  for (unsigned pitch = 0; pitch < BENCH_N_PITCHES; ++pitch) {
    for (unsigned stiffness = 0; stiffness < BENCH_N_STIFFNESSES; ++stiffness) {
      for (unsigned rate = 0; rate < BENCH_N_RATES; ++rate) {
        add_string(survey, bench_survey_string(pitch, stiffness, rate), choice->n_masses);
      }
    }
  }
}

static bool is_same_string(TuningTarget a, TuningTarget b) {
  return a.tone.f0_hz == b.tone.f0_hz && a.inharmonicity == b.inharmonicity &&
         a.rate_hz == b.rate_hz;
}

/* Backward Euler takes as long as it needs to converge, which is up to the string. */
static bool is_measured_by(const Clock* clock, const Point* point, unsigned loop) {
  const bool is_backward =
      point->way.kind == BENCH_NETWORK && point->way.scheme == NETWORK_BACKWARD;
  return clock->loop == loop && clock->point->n_masses == point->n_masses &&
         (!is_backward || is_same_string(clock->point->wanted, point->wanted));
}

static void assign_clock(Survey* survey, Point* point) {
  StringCoefs coefs = {0};
  (void)bench_way_coefs(point->way, point->wanted, point->n_masses, &coefs);
  const unsigned loop = bench_way_loop(point->way, coefs);
  size_t c = 0;
  while (c < survey->n_clocks && !is_measured_by(&survey->clocks[c], point, loop)) {
    ++c;
  }
  if (c == survey->n_clocks) {
    survey->clocks[survey->n_clocks++] = (Clock){.point = point, .loop = loop, .frame_s = HUGE_VAL};
  }
  point->clock = c;
}

static double run_s(BenchPlayer* player, uint32_t n_frames) {
  float out[BENCH_RUN_FRAMES];
  const double start_s = bench_clock_now_s();
  for (uint32_t left = n_frames; left > 0;) {
    const uint32_t n = left < BENCH_RUN_FRAMES ? left : BENCH_RUN_FRAMES;
    bench_player_run(player, n, out);
    left -= n;
  }
  return bench_clock_now_s() - start_s;
}

/* Each time a string that was just plucked. */
static void look(Clock* clock) {
  const Point* const point = clock->point;
  BenchPlayer* const player = bench_player_new(point->way, point->wanted, point->n_masses);
  if (!player) {
    clock->frame_s = (double)NAN;
    return;
  }
  double taken_s = 0.0;
  if (clock->n_frames == 0) {
    clock->n_frames = 1;
    while ((taken_s = run_s(player, clock->n_frames)) < LOOK_S) {
      clock->n_frames *= 2;
    }
  } else {
    (void)run_s(player, clock->n_frames / 16 + 1);
    taken_s = run_s(player, clock->n_frames);
  }
  clock->frame_s = fmin(clock->frame_s, taken_s / clock->n_frames);
  bench_player_free(player);
}

/* All in turn, so that a moment in which the machine is busy spoils few looks at each. */
static void measure_all(Survey* survey, double seconds) {
  for (size_t i = 0; i < survey->n_points; ++i) {
    assign_clock(survey, &survey->points[i]);
  }
  const double end_s = bench_clock_wall_s() + seconds;
  do {
    for (size_t c = 0; c < survey->n_clocks; ++c) {
      look(&survey->clocks[c]);
    }
  } while (bench_clock_wall_s() < end_s);
}

static const char* kind_name(BenchKind kind) {
#define TEXT(name, text) text,
  static const char* const names[BENCH_N_KINDS] = {BENCH_KIND_LIST(TEXT)};
#undef TEXT
  return names[kind];
}

static const char* partials_name(Partials partials) {
  static const char* const names[] = {"Lumped", "True", "Truest"};
  return names[partials];
}

/* Of a flexible chain that is in tune. */
static double noise_of(const Point* point) {
  const bool has_noise = point->way.kind == BENCH_CHAIN && point->way.is_corrected &&
                         point->wanted.inharmonicity == 0.0;
  return has_noise ? bench_player_noise_db(point->way, point->wanted, point->n_masses)
                   : (double)NAN;
}

/* Empty where there is none. */
static void print_cell(double value, char end) {
  if (!isnan(value)) {
    printf("%.6g", value);
  }
  putchar(end);
}

static void print_csv(const Survey* survey) {
  printf("f0_hz,inharmonicity,rate_hz,kind,scheme,numbers,partials,corrected,masses,stable,"
         "ns_per_frame,share_of_core,pitch_cents,decay_percent,partials_cents,noise_db\n");
  for (size_t i = 0; i < survey->n_points; ++i) {
    const Point* const p = &survey->points[i];
    const double frame_s = survey->clocks[p->clock].frame_s;
    printf("%g,%g,%g,%s,%s,%s,%s,%d,%u,%d,", p->wanted.tone.f0_hz, p->wanted.inharmonicity,
           p->wanted.rate_hz, kind_name(p->way.kind), network_scheme_text(p->way.scheme),
           bench_numbers_name(p->way.numbers), partials_name(p->way.partials), p->way.is_corrected,
           p->n_masses, bench_way_is_stable(p->way, p->wanted, p->n_masses));
    print_cell(1e9 * frame_s, ',');
    print_cell(frame_s * p->wanted.rate_hz, ',');
    print_cell(fabs(bench_way_partial_cents(p->way, p->wanted, p->n_masses, 1)), ',');
    print_cell(bench_way_decay_percent(p->way, p->wanted, p->n_masses), ',');
    print_cell(bench_way_partials_cents(p->way, p->wanted, p->n_masses), ',');
    print_cell(noise_of(p), '\n');
  }
}

static void print_column(double value) {
  if (isnan(value)) {
    printf("%10s", "-");
  } else {
    printf("%10.3g", value);
  }
}

static void print_name(const Point* point) {
  const BenchWay way = point->way;
  char name[64];
  (void)snprintf(name, sizeof(name), "%s, %s%s%s%s", kind_name(way.kind),
                 way.kind == BENCH_NETWORK ? network_scheme_text(way.scheme)
                                           : bench_numbers_name(way.numbers),
                 way.kind == BENCH_CHAIN ? ", " : "",
                 way.kind == BENCH_CHAIN ? partials_name(way.partials) : "",
                 way.is_corrected ? "" : ", uncorrected");
  printf("%-44s", name);
}

static void print_table(const Survey* survey) {
  const TuningTarget wanted = survey->points[0].wanted;
  printf("\n%g Hz at %g Hz, %u masses: errors of the pitch, the decay and %d partials, noise\n"
         "%-44s%10s%10s%10s%10s%10s%10s\n",
         wanted.tone.f0_hz, wanted.rate_hz, survey->points[0].n_masses, BENCH_N_PARTIALS, "",
         "cents", "% decay", "cents", "dB", "ns", "% core");
  for (size_t i = 0; i < survey->n_points; ++i) {
    const Point* const p = &survey->points[i];
    const double frame_s = survey->clocks[p->clock].frame_s;
    print_name(p);
    print_column(fabs(bench_way_partial_cents(p->way, p->wanted, p->n_masses, 1)));
    print_column(bench_way_decay_percent(p->way, p->wanted, p->n_masses));
    print_column(bench_way_partials_cents(p->way, p->wanted, p->n_masses));
    print_column(noise_of(p));
    print_column(1e9 * frame_s);
    print_column(100.0 * frame_s * wanted.rate_hz);
    printf("%s\n", bench_way_is_stable(p->way, p->wanted, p->n_masses) ? "" : "  grows");
  }
}

bool bench_survey(const BenchChoice* choice) {
  enum {
    MOST = BENCH_N_PITCHES * BENCH_N_STIFFNESSES * BENCH_N_RATES * BENCH_N_WAYS * (N_COUNTS + 1)
  };
  Survey survey = {.points = malloc(MOST * sizeof(*survey.points)),
                   .clocks = malloc(MOST * sizeof(*survey.clocks))};
  if (survey.points && survey.clocks) {
    add_strings(&survey, choice);
  }
  const bool is_some = survey.n_points > 0;
  if (is_some) {
    measure_all(&survey, choice->seconds);
    (choice->is_csv ? print_csv : print_table)(&survey);
  }
  free(survey.points);
  free(survey.clocks);
  return is_some;
}
