#include "tools/report/trade_words.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Error of the partials that nobody hears [cents]. */
static const double FAIR_CENTS = 0.5;

/* Where the partials are looked at up to which all are true [cents]. */
static const double TRUE_CENTS = 5.0;

enum { AT_48_KHZ = 2, N_JUDGED = 3, LOWEST = 0 };

static const TradeSetting present = {TRADE_DEFAULT_PARTIALS, TRADE_DEFAULT_MASSES};

static const char* const partials_names[] = {"Lumped", "True", "Truest"};

__attribute__((format(printf, 2, 3))) static void add(char* text, const char* format, ...) {
  const size_t length = strlen(text);
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(text + length, TRADE_TEXT_SIZE - length, format, arguments);
  va_end(arguments);
}

const TradePoint* trade_words_point(const TradeSurvey* survey,
                                    TradeSetting setting,
                                    unsigned pitch,
                                    unsigned stiffness) {
  const BenchWay method = {.kind = BENCH_CHAIN,
                           .scheme = NETWORK_SYMPLECTIC,
                           .partials = setting.partials,
                           .numbers = CHAIN_FIXED,
                           .is_corrected = true};
  const TradeString string = trade_string(pitch, stiffness, AT_48_KHZ);
  const uint32_t most = bench_way_max_masses(method, string);
  return trade_find(survey, method, string, most < setting.masses ? most : setting.masses);
}

double trade_words_worst(const TradeSurvey* survey, TradeSetting setting, double* share) {
  double worst = 0.0;
  *share = 0.0;
  for (unsigned i = 0; i < N_JUDGED * TRADE_N_STIFFNESSES; ++i) {
    const TradePoint* const point = trade_words_point(survey, setting, i % N_JUDGED, i / N_JUDGED);
    if (!point) {
      return HUGE_VAL;
    }
    worst = fmax(worst, point->error[TRADE_PARTIALS]);
    *share += point->share;
  }
  return worst;
}

/* Of the settings that the lowest string was surveyed with, the cheapest that is fair; or, within
 * `most_share`, the one of most masses. */
static TradeSetting choose(const TradeSurvey* survey, double most_share) {
  TradeSetting best = present;
  double least = HUGE_VAL;
  for (size_t i = 0; i < survey->n; ++i) {
    const TradePoint* const point = &survey->points[i];
    const TradeSetting setting = {point->method.partials, point->n_masses};
    double share = 0.0;
    if (trade_is_same(point->string, trade_string(LOWEST, 0, AT_48_KHZ)) &&
        point->method.kind == BENCH_CHAIN &&
        trade_words_worst(survey, setting, &share) <= FAIR_CENTS && share <= most_share) {
      const double price = most_share < HUGE_VAL ? -(double)setting.masses : share;
      best = price < least ? setting : best;
      least = fmin(price, least);
    }
  }
  return best;
}

TradeSetting trade_words_best(const TradeSurvey* survey) {
  return choose(survey, HUGE_VAL);
}

TradeSetting trade_words_as_dear(const TradeSurvey* survey) {
  double share = 0.0;
  (void)trade_words_worst(survey, present, &share);
  return choose(survey, TRADE_GRAIN * share);
}

void trade_words_sentence(const TradeSurvey* survey,
                          TradeSetting setting,
                          char text[TRADE_TEXT_SIZE]) {
  const TradePoint* const point = trade_words_point(survey, setting, LOWEST, 0);
  assert(point);
  (void)snprintf(
      text, TRADE_TEXT_SIZE,
      "%u masses (%s) give %.2g cents at the tenth partial of 55 Hz, for %.2g %% of a core.",
      point->n_masses, partials_names[setting.partials],
      bench_way_partial_cents(point->method, point->string, point->n_masses, 10),
      100.0 * point->share);
}

void trade_words_method(const TradeSurvey* survey, char text[TRADE_TEXT_SIZE]) {
  *text = '\0';
  add(text,
      "%zu strings: of 55, 110, 440 and 1760 Hz, with B = 0 and 1e-4, at 22.05, 44.1, 48, 96 and "
      "192 kHz, of 4 masses up to as many as are stable; τ is 2 s, and 1 %% of the fundamental's "
      "damping sits between the masses.  They are made as chains in whole numbers, floats and "
      "doubles, with partials Lumped, True and Truest, of coefficients that are solved for or "
      "taken as they are; as networks under each scheme; and as banks of their exact modes, a "
      "phasor each.  ",
      survey->n);
  add(text,
      "Pitch, decay and partials are in closed form, from the coefficients as the loop has them; "
      "noise and run time are measured.  Run time is that of one string alone, read at one place: "
      "the least of %d looks at the processor's time, on the machine that made this page.  On a "
      "frontier is what nothing else of its string beats in both, by more than "
      "5 %% or 0.5 dB; errors below 0.01 cent, 0.01 %% and −120 dB count as none.  ",
      TRADE_N_LOOKS);
  add(text, "Forward Euler grows in its upper modes whatever it is tuned to; its strings are in "
            "errors.csv, as unstable, and in no picture.  Backward Euler cannot be corrected, for "
            "no damper takes less than nothing.");
}

static void add_off(char* text, const TradeOff* off) {
  add(text, "%.1e cents and %.1e %% of τ in %u", off->cents, off->decay_percent, off->n);
}

void trade_words_check(const TradeCheck* check, char text[TRADE_TEXT_SIZE]) {
  *text = '\0';
  add(text,
      "Played and measured from the motion, partials were off these closed forms by at most ");
  add_off(text, &check->in_doubles);
  add(text, " in doubles, and ");
  add_off(text, &check->in_floats);
  add(text, " in floats and whole numbers, whose noise is in this.");
}

static void
add_default(char* text, const TradeSurvey* survey, const TradePicture* picture, unsigned pitch) {
  const TradePoint* const point = trade_words_point(survey, present, pitch, picture->stiffness);
  char name[TRADE_NAME_SIZE];
  assert(point);
  add(text, "%g Hz (%u masses, %.3g %s, %.2g %%): ", point->string.f0_hz, point->n_masses,
      trade_level(point, picture->error), picture->unit, 100.0 * point->share);
  if (point->is_front[TRADE_AMONG_STRINGS][picture->error]) {
    add(text, "on it.  ");
    return;
  }
  const TradePoint* const first =
      trade_cheapest(survey, point, picture->error, TRADE_AMONG_STRINGS);
  bench_way_name(first->method, name);
  if (first == point) {
    add(text, "within a grain of it.  ");
  } else {
    add(text, "not on it, for %u masses as %s err by %.3g %s for %.2g %%.  ", first->n_masses, name,
        trade_level(first, picture->error), picture->unit, 100.0 * first->share);
  }
}

void trade_words_default(const TradeSurvey* survey,
                         const TradePicture* picture,
                         char text[TRADE_TEXT_SIZE]) {
  *text = '\0';
  add(text, "The default and the frontier of strings.  ");
  for (unsigned pitch = 0; pitch < TRADE_N_PITCHES; ++pitch) {
    add_default(text, survey, picture, pitch);
  }
  if (picture->error == TRADE_PARTIALS) {
    add(text,
        "What is before it has Truest partials, which need fewer masses; or, close to the most "
        "that are stable, Lumped ones, where there is nothing to mend; or floats, for a few "
        "per cent of time.");
  } else {
    add(text,
        "Pitch, decay and noise are as good with few masses: the default has its many for the "
        "partials, and cannot be on this one.");
  }
}

static void add_setting(char* text, const TradeSurvey* survey, TradeSetting setting) {
  double all = 0.0;
  const double worst = trade_words_worst(survey, setting, &all);
  const TradePoint* const low = trade_words_point(survey, setting, LOWEST, 0);
  assert(low);
  const uint32_t k = bench_way_true_up_to(low->method, low->string, low->n_masses, TRUE_CENTS);
  add(text,
      "%s with %u masses errs by at most %.2g cents; at 55 Hz it takes %.2g %% of a core, is "
      "within "
      "%g cents up to %.0f Hz and has partials up to %.0f Hz.  ",
      partials_names[setting.partials], setting.masses, worst, 100.0 * low->share, TRUE_CENTS,
      bench_way_ideal_hz(low->string, k),
      bench_way_ideal_hz(low->string, low->n_masses) *
          exp2(bench_way_partial_cents(low->method, low->string, low->n_masses, low->n_masses) /
               1200.0));
}

void trade_words_advice(const TradeSurvey* survey, char text[TRADE_TEXT_SIZE]) {
  const TradeSetting best = trade_words_best(survey);
  const TradeSetting as_dear = trade_words_as_dear(survey);
  const TradeSetting truest = {best.partials, present.masses};
  *text = '\0';
  add(text,
      "Which default?  The cheapest whose first 20 partials err by no more than %g cent (root of "
      "the mean square) at 55, 110 and 440 Hz, B = 0 and 1e-4, 48 kHz, is %s with %u masses.  ",
      FAIR_CENTS, partials_names[best.partials], best.masses);
  add_setting(text, survey, best);
  add_setting(text, survey, present);
  add_setting(text, survey, truest);
  if (as_dear.masses != best.masses && as_dear.masses != present.masses) {
    add(text, "In the time of the present one:  ");
    add_setting(text, survey, as_dear);
  }
  add(text,
      "More masses are not for the first 20 partials but for those above, which fewer masses have "
      "not got: they make low strings brighter, and from %.0f Hz up no string can have more than "
      "%u.  So by these errors the default of partials is to be %s; that of masses may be %u where "
      "run time counts, and stays %u for brightness.  At 1760 Hz the 13th partial, just below "
      "Nyquist, is missing from every chain: whatever is set there, it counts for nearly all of "
      "the error.",
      0.5 * TRADE_DEFAULT_RATE_HZ / (best.masses + 1), best.masses, partials_names[best.partials],
      best.masses, present.masses);
}
