/** `hooke bench modes`: what a bank of modes costs by every kernel, beside the masses of a string.
 */
#ifndef HOOKE_TOOLS_BENCH_BENCH_MODES_H
#define HOOKE_TOOLS_BENCH_BENCH_MODES_H

#include "tools/bench/bench_choice.h"

/**
   Measure and print.

   A bank is driven in every frame and heard on both sides, in blocks of 64, or it is pushed frame
   by frame by what pulls back at it.  Beside it runs the barest string, flexible and undamped, of
   640 masses in floats, by the best kernel.

   @return false when memory is out
*/
bool bench_modes(const BenchChoice* choice);

#endif
