/** `hooke bench start`: what it takes to make a harp, and the plugin around it. */
#ifndef HOOKE_TOOLS_BENCH_BENCH_START_H
#define HOOKE_TOOLS_BENCH_BENCH_START_H

#include "tools/bench/bench_choice.h"

/** Measure and print. @return false when memory is out. */
bool bench_start(const BenchChoice* choice);

#endif
