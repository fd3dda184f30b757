/** The table of `hooke bench scenes`: every kernel, kind of numbers, scene and some sizes. */
#ifndef HOOKE_TOOLS_BENCH_BENCH_TABLE_H
#define HOOKE_TOOLS_BENCH_BENCH_TABLE_H

#include "tools/bench/bench_choice.h"

/** Measure and print. @return false when memory is out, or nothing is left of the choice. */
bool bench_table(const BenchChoice* choice);

#endif
