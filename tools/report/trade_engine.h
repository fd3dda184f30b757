/**
   A string of a method (tools/report/trade.h) that is plucked and runs.

   Life: trade_engine_new(), run and look, trade_engine_free().  Thread: one at a time; running
   does not allocate.
*/
#ifndef HOOKE_TOOLS_REPORT_TRADE_ENGINE_H
#define HOOKE_TOOLS_REPORT_TRADE_ENGINE_H

#include "tools/report/trade.h"

typedef struct TradeEngine TradeEngine;

/**
   A string of `n_masses`, plucked with a hard pick at 0.13 of its length.

   @return NULL: out of memory, or the method has no such string, or its numbers cannot hold it
*/
TradeEngine* trade_engine_new(TradeMethod method, TradeString string, uint32_t n_masses);

/**
   The same string as trade_engine_new()'s, coefficients rounded as its numbers have them, but in
   doubles: what is different between the two is the noise of the numbers alone.

   @return NULL, as above, and for networks
*/
TradeEngine* trade_engine_new_exact(TradeMethod method, TradeString string, uint32_t n_masses);

/** NULL is fine. */
void trade_engine_free(TradeEngine* engine);

/** Step it; `out` is overwritten with the displacement at a third of its length, or the sum of the
 * modes. */
void trade_engine_run(TradeEngine* engine, uint32_t n_frames, float* out);

/** How far mode `k` is out and how fast it moves, in any units that stay the same. */
void trade_engine_mode(const TradeEngine* engine, uint32_t k, double* x, double* u);

#endif
