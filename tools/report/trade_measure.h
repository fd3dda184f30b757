/**
   What is measured of a string of a method (tools/bench/bench_way.h): what it plays, its noise, its
   run time.

   Thread: any; allocates.
*/
#ifndef HOOKE_TOOLS_REPORT_TRADE_MEASURE_H
#define HOOKE_TOOLS_REPORT_TRADE_MEASURE_H

#include "tools/bench/bench_way.h"

/**
   Measure mode `k` from the motion.

   Three states of the mode, m steps apart, are tied by s[2m] = p s[m] − q s[0], whatever the
   scheme: p and q are the sum and the product of the m-th powers of its two poles.

   @param[out] tone  What is heard; untouched on failure
   @return false if there is no such string or no memory, or the mode does not vibrate
*/
bool trade_measure_tone(
    BenchWay method, TradeString string, uint32_t n_masses, uint32_t k, Tone* tone);

/**
   Play a tenth of a second in the method's numbers and in doubles.

   @return How much quieter the difference is than the sound [dB], negative; NAN if it cannot be had
*/
double trade_measure_noise(BenchWay method, TradeString string, uint32_t n_masses);

/** Something to be timed. */
typedef struct {
  BenchWay method;
  TradeString string;
  uint32_t n_masses;
  uint32_t n_frames; /**< In one look; 0 before the first */
  double ns;         /**< The least processor time of a step so far [ns]; HUGE_VAL before the first;
                          NAN if there is no such string */
} TradeClock;

/** Run it for some 30 µs, and keep the time of a step if none was shorter. */
void trade_measure_time(TradeClock* clock);

#endif
