/** `hooke bench bodies`: error against run time of every shipped body, by how many modes are kept.
 */
#ifndef HOOKE_TOOLS_BENCH_BENCH_BODIES_H
#define HOOKE_TOOLS_BENCH_BENCH_BODIES_H

#include "tools/bench/bench_choice.h"

/**
   Measure and print.

   The error is of the power in thirds of octaves from 80 Hz to 8 kHz, against that of all modes of
   the body; the time is that of a frame, driven and heard on both sides, at 48 kHz.

   @return false when memory is out
*/
bool bench_bodies(const BenchChoice* choice);

#endif
