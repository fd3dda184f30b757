#include "tools/report/trade_picture.h"

#include "tools/report/figure_groups.h"

#include <math.h>

/* What has a colour of its own. */
typedef enum { LUMPED, TRUE_ONES, TRUEST, UNCORRECTED, NETWORKS, BANKS, N_CROWDS } Crowd;

#define EVERY "The ring is about what the plugin makes as it comes.  "
#define WHOLE "Chains are shown in whole numbers, and on the frontier in any.  "
#define LINES                                                                                      \
  "The black line is the frontier of all that are strings, the dashed one of all that there is, "  \
  "banks of modes too; the pale ones are the frontiers of strings at the other rates.  "

static const TradePicture pictures[TRADE_N_PICTURES] = {
    {"error-pitch", TRADE_PITCH, 0, "Pitch of the fundamental", "cents",
     "What the fundamental's pitch is off, against the share of one core that plays the string.  "
     "All that is corrected lies on the floor, so that the cheapest is as good as any; what comes "
     "from coefficients as they are is sharp by (ωh)²/24.  " LINES WHOLE EVERY},
    {"error-decay", TRADE_DECAY, 0, "Decay of the fundamental", "%",
     "What the fundamental's τ is off.  Of the schemes backward Euler alone cannot be corrected: "
     "it damps more than is asked for.  The bank in floats rounds its radius.  " LINES WHOLE EVERY},
    {"error-partials", TRADE_PARTIALS, 0, "The first 20 partials against those of the ideal string",
     "cents",
     "The root of the mean square of what those partials are off that the ideal string has below "
     "Nyquist, 20 at most; one that is missing counts 1200 cents, and none counts more.  " LINES
         WHOLE EVERY},
    {"error-partials-stiff", TRADE_PARTIALS, 1,
     "The first 20 partials against those of the stiff string, B = 1e-4", "cents",
     "The same for a stiff string.  Networks have no bending, and are left out.  " LINES WHOLE
         EVERY},
    {"error-noise", TRADE_NOISE, 0, "Noise of the numbers", "dB",
     "By how much the difference between a tenth of a second in these numbers and in doubles is "
     "quieter than the sound.  Doubles lie on the floor.  " LINES EVERY},
};

const TradePicture* trade_picture(unsigned i) {
  return &pictures[i];
}

static Crowd crowd_of(const TradePoint* point) {
  switch (point->method.kind) {
  case BENCH_NETWORK:
    return NETWORKS;
  case BENCH_BANK:
    return BANKS;
  default:
    return point->method.is_corrected ? (Crowd)point->method.partials : UNCORRECTED;
  }
}

static void write_row(FILE* data, const TradePoint* point, TradeError error) {
  (void)fprintf(data, "%.5f %.5g %u\n", 100.0 * point->share, trade_level(point, error),
                point->n_masses);
}

static bool is_drawn(const TradePoint* point, TradeString string, TradeError error) {
  return trade_is_same(point->string, string) && point->is_stable && point->share > 0.0 &&
         trade_level(point, error) < HUGE_VAL;
}

/* Numbers make no difference to what is in closed form, or none to see. */
static bool is_dot(const TradePoint* point, TradeError error) {
  return error == TRADE_NOISE || point->method.kind != BENCH_CHAIN ||
         point->method.numbers == CHAIN_FIXED;
}

/* A block with nothing in it is no block to gnuplot. */
static void head(FILE* data, unsigned pitch, const char* name) {
  char block[64];
  (void)snprintf(block, sizeof(block), "%u %s: share of a core [%%], error, masses", pitch, name);
  figure_block(data, block);
  (void)fputs("? ? ?\n", data);
}

static void write_crowd(
    FILE* data, const TradeSurvey* survey, TradeString string, TradeError error, Crowd crowd) {
  for (size_t i = 0; i < survey->n; ++i) {
    const TradePoint* const point = &survey->points[i];
    if (is_drawn(point, string, error) && is_dot(point, error) && crowd_of(point) == crowd) {
      write_row(data, point, error);
    }
  }
}

/* From the cheapest to the dearest. */
static void write_front(FILE* data,
                        const TradeSurvey* survey,
                        TradeString string,
                        TradeError error,
                        TradeCompany company) {
  const TradePoint* last = NULL;
  const TradePoint* next = NULL;
  do {
    next = NULL;
    for (size_t i = 0; i < survey->n; ++i) {
      const TradePoint* const point = &survey->points[i];
      const bool is_later =
          !last || point->share > last->share || (point->share == last->share && point > last);
      if (is_drawn(point, string, error) && point->is_front[company][error] && is_later &&
          (!next || point->share < next->share)) {
        next = point;
      }
    }
    if (next) {
      write_row(data, next, error);
    }
    last = next;
  } while (next);
}

static void
write_fronts(FILE* data, const TradeSurvey* survey, const TradePicture* picture, unsigned pitch) {
  const unsigned at_48_khz = 2;
  const TradeString string = trade_string(pitch, picture->stiffness, at_48_khz);
  head(data, pitch, "front");
  write_front(data, survey, string, picture->error, TRADE_AMONG_STRINGS);
  head(data, pitch, "whole");
  write_front(data, survey, string, picture->error, TRADE_AMONG_ALL);
  head(data, pitch, "others");
  for (unsigned rate = 0; rate < TRADE_N_RATES; ++rate) {
    if (rate != at_48_khz) {
      write_front(data, survey, trade_string(pitch, picture->stiffness, rate), picture->error,
                  TRADE_AMONG_STRINGS);
      (void)fputs("\n", data);
    }
  }
  head(data, pitch, "default");
  for (size_t i = 0; i < survey->n; ++i) {
    if (survey->points[i].is_default && is_drawn(&survey->points[i], string, picture->error)) {
      write_row(data, &survey->points[i], picture->error);
    }
  }
}

void trade_picture_data(FILE* data, const TradeSurvey* survey, const TradePicture* picture) {
  static const char* const names[N_CROWDS] = {"lumped",      "true",     "truest",
                                              "uncorrected", "networks", "banks"};
  for (unsigned pitch = 0; pitch < TRADE_N_PITCHES; ++pitch) {
    const TradeString string = trade_string(pitch, picture->stiffness, 2);
    for (int crowd = 0; crowd < N_CROWDS; ++crowd) {
      head(data, pitch, names[crowd]);
      write_crowd(data, survey, string, picture->error, (Crowd)crowd);
    }
    write_fronts(data, survey, picture, pitch);
  }
}

static const char head_script[] =
    "reset\n"
    "set encoding utf8\n"
    "set terminal svg size 760,640 font 'sans-serif,13' background '#ffffff'\n"
    "set output '%s.svg'\n"
    "data = '%s.dat'\n"
    "set datafile missing '?'\n"
    "set border lc rgb '#404040'\n"
    "set tics nomirror\n"
    "set logscale x\n"
    "set xtics (0.01, 0.1, 1, 10, 100)\n"
    "%s"
    "set multiplot layout 2,2 margins 0.085,0.98,0.155,0.92 spacing 0.085,0.095\n"
    "set key off\n"
    "set label 11 '%s  [%s]' at screen 0.5, 0.975 center\n"
    "set label 12 'share of one core  [%%]' at screen 0.5, 0.1 center\n"
    "set label 13 'chain, Lumped' at screen 0.1, 0.065 point pt 7 ps 0.6 lc rgb '#0072b2'\n"
    "set label 14 'chain, True' at screen 0.1, 0.03 point pt 7 ps 0.6 lc rgb '#009e73'\n"
    "set label 15 'chain, Truest' at screen 0.33, 0.065 point pt 7 ps 0.6 lc rgb '#d55e00'\n"
    "set label 16 'chain, uncorrected' at screen 0.33, 0.03 point pt 2 ps 0.6 lc rgb '#8c8c8c'\n"
    "set label 17 'networks' at screen 0.58, 0.065 point pt 1 ps 0.6 lc rgb '#b0558a'\n"
    "set label 18 'bank of modes' at screen 0.58, 0.03 point pt 9 ps 0.6 lc rgb '#c98400'\n"
    "set label 19 'frontier of strings' at screen 0.78, 0.065 point pt 4 ps 0.6 lc rgb '#000000'\n"
    "set label 20 'the default' at screen 0.78, 0.03 point pt 6 ps 1 lw 2 lc rgb '#000000'\n"
    "do for [i=13:20] { set label i offset 1,0 }\n";

static const char panel_script[] =
    "set title '%g Hz' offset 0,-0.8\n"
    "plot [0.01:300]%s \\\n"
    "  data index '%u others' with steps lc rgb '#d0d0d0' lw 1 notitle, \\\n"
    "  data index '%u networks' with points lc rgb '#b0558a' pt 1 ps 0.4 notitle, \\\n"
    "  data index '%u uncorrected' with points lc rgb '#8c8c8c' pt 2 ps 0.4 notitle, \\\n"
    "  data index '%u lumped' with points lc rgb '#0072b2' pt 7 ps 0.35 notitle, \\\n"
    "  data index '%u true' with points lc rgb '#009e73' pt 7 ps 0.35 notitle, \\\n"
    "  data index '%u truest' with points lc rgb '#d55e00' pt 7 ps 0.35 notitle, \\\n"
    "  data index '%u banks' with points lc rgb '#c98400' pt 9 ps 0.35 notitle, \\\n"
    "  data index '%u whole' with steps lc rgb '#000000' lw 1 dt 2 notitle, \\\n"
    "  data index '%u front' with steps lc rgb '#000000' lw 1.5 notitle, \\\n"
    "  data index '%u front' with points lc rgb '#000000' pt 4 ps 0.6 notitle, \\\n"
    "  data index '%u default' with points lc rgb '#000000' pt 6 ps 1.1 lw 2 notitle\n";

void trade_picture_script(FILE* script, const TradePicture* picture) {
  const bool is_noise = picture->error == TRADE_NOISE;
  (void)fprintf(script, head_script, picture->name, picture->name,
                is_noise ? "" : "set logscale y\nset format y '10^{%T}'\n", picture->title,
                picture->unit);
  for (unsigned i = 0; i < TRADE_N_PITCHES; ++i) {
    (void)fprintf(script, panel_script, trade_string(i, 0, 0).f0_hz,
                  is_noise ? "[-125:-70]" : "[0.006:2000]", i, i, i, i, i, i, i, i, i, i, i);
    (void)fputs("unset label\n", script);
  }
  (void)fputs("unset multiplot\nunset output\n", script);
}

static const char* letters(const TradePoint* point, TradeCompany company, char name[8]) {
  static const char of_error[TRADE_N_ERRORS + 1] = "abcd";
  char* end = name;
  for (int error = 0; error < TRADE_N_ERRORS; ++error) {
    if (point->is_front[company][error]) {
      *end++ = of_error[error];
    }
  }
  *end = '\0';
  return name;
}

void trade_picture_points(FILE* file, const TradeSurvey* survey) {
  (void)fputs("f0_hz,inharmonicity,rate_hz,method,masses,is_stable,is_default,ns_per_step,"
              "core_percent,pitch_cents,decay_percent,partials_cents,noise_db,"
              "frontiers_of_all,frontiers_of_strings\n",
              file);
  for (size_t i = 0; i < survey->n; ++i) {
    const TradePoint* const point = &survey->points[i];
    char name[TRADE_NAME_SIZE];
    char all[8];
    char strings[8];
    bench_way_name(point->method, name);
    (void)fprintf(
        file, "%g,%g,%g,\"%s\",%u,%d,%d,%.2f,%.5f,%.4g,%.4g,%.4g,%.4g,%s,%s\n", point->string.f0_hz,
        point->string.inharmonicity, point->string.rate_hz, name, point->n_masses, point->is_stable,
        point->is_default, point->ns, 100.0 * point->share, point->error[TRADE_PITCH],
        point->error[TRADE_DECAY], point->error[TRADE_PARTIALS], point->error[TRADE_NOISE],
        letters(point, TRADE_AMONG_ALL, all), letters(point, TRADE_AMONG_STRINGS, strings));
  }
}
