/**
   The closed forms of tools/bench/bench_way.h beside what strings really play.

   Thread: any; allocates.
*/
#ifndef HOOKE_TOOLS_REPORT_TRADE_CHECK_H
#define HOOKE_TOOLS_REPORT_TRADE_CHECK_H

#include "tools/bench/bench_way.h"

/** The farthest that any was off. */
typedef struct {
  unsigned n; /**< Partials that were looked at */
  double cents;
  double decay_percent; /**< Of τ */
} TradeOff;

/** Zero before the first. */
typedef struct {
  TradeOff in_doubles;
  TradeOff in_floats; /**< And in whole numbers */
} TradeCheck;

/** Play a string, and measure partials 1, 2, 5, 10 and 20 of it that there are.  Nothing is done
 * for one that does not exist or is not stable. */
void trade_check_string(TradeCheck* check, BenchWay method, TradeString string, uint32_t n_masses);

/** All methods, strings of 55 and 440 Hz at 48 kHz, with 20 and 80 masses and as many as go. */
TradeCheck trade_check_all(void);

#endif
