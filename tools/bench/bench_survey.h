/**
   All ways to make a string beside each other: what each costs, by how much it errs, and which are
   on the frontier, where nothing is both cheaper and truer.

   Thread: one at a time; allocates.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_SURVEY_H
#define HOOKE_TOOLS_BENCH_BENCH_SURVEY_H

#include "core/base/status.h"
#include "tools/bench/bench_way.h"

#include <stdbool.h>
#include <stddef.h>

/** What is weighed against run time. */
typedef enum {
  TRADE_PITCH,    /**< bench_way_pitch_error() [cents] */
  TRADE_DECAY,    /**< bench_way_decay_error() [%] */
  TRADE_PARTIALS, /**< bench_way_partials_error() [cents] */
  TRADE_NOISE,    /**< trade_measure_noise() [dB] */
  TRADE_N_ERRORS
} TradeError;

/** Who is compared with whom. */
typedef enum {
  TRADE_AMONG_ALL,
  TRADE_AMONG_STRINGS, /**< All but the banks of modes, which cannot be touched */
  TRADE_N_COMPANIES
} TradeCompany;

/** Below these two errors are the same to anyone: 0.01 cent, 0.01 %, −120 dB. */
double trade_floor(TradeError error);

/** Two shares or two errors are the same if they are in the same of steps of 5 %, 0.5 dB. */
#define TRADE_GRAIN 1.05

/** A string of so many masses. */
typedef struct {
  BenchWay method;
  TradeString string;
  uint32_t n_masses;
  double ns;                    /**< Of a step, measured */
  double share;                 /**< Of one core that plays it, ns · rate */
  double error[TRADE_N_ERRORS]; /**< NAN where it was not measured */
  bool is_stable;
  bool is_default; /**< What the plugin makes as it comes */
  bool is_front[TRADE_N_COMPANIES][TRADE_N_ERRORS];
} TradePoint;

/** The points, by string; zero is an empty one. */
typedef struct {
  TradePoint* points;
  size_t n;
} TradeSurvey;

/** What the plugin makes as it comes, at 48 kHz. */
#define TRADE_DEFAULT_MASSES 128
#define TRADE_DEFAULT_PARTIALS PARTIALS_TRUEST
#define TRADE_DEFAULT_RATE_HZ 48000.0

/** The strings: 55, 110, 440 and 1760 Hz, with B = 0 and 1e-4, at five rates. */
enum { TRADE_N_PITCHES = 4, TRADE_N_STIFFNESSES = 2, TRADE_N_RATES = 5 };
TradeString trade_string(unsigned pitch, unsigned stiffness, unsigned rate);

/** Whether two strings are the same. */
bool trade_is_same(TradeString a, TradeString b);

/** The error of `point`, raised to its floor; HUGE_VAL where there is none. */
double trade_level(const TradePoint* point, TradeError error);

/** Mark the frontiers of `n` points, those of a string together: a point is on one if it is stable
 * and no other of its string and company is, by steps of TRADE_GRAIN, at most as dear and as wrong;
 * where two are the same in both it is the first. */
void trade_find_fronts(TradePoint* points, size_t n);

/** Of a company, the cheapest point of `point`'s string that errs no more; never NULL. */
const TradePoint* trade_cheapest(const TradeSurvey* survey,
                                 const TradePoint* point,
                                 TradeError error,
                                 TradeCompany company);

/** The point of a method and a number of masses; NULL if there is none. */
const TradePoint*
trade_find(const TradeSurvey* survey, BenchWay method, TradeString string, uint32_t n_masses);

/** Looks at the clock for each point, at all points in turn, so that a moment in which the machine
 * is busy spoils few of a point's. */
enum { TRADE_N_LOOKS = 48 };

/** Make all points, in a few seconds. @return STATUS_OK or STATUS_NO_MEMORY */
Status trade_survey(TradeSurvey* survey);

/** Free what is in it. */
void trade_survey_free(TradeSurvey* survey);

#endif
