/** `hooke bench loads`: what whole instruments cost, and how many strings a core can run. */
#ifndef HOOKE_TOOLS_BENCH_BENCH_LOAD_H
#define HOOKE_TOOLS_BENCH_BENCH_LOAD_H

#include "tools/bench/bench_choice.h"

/** Measure and print. @return false when memory is out. */
bool bench_load(const BenchChoice* choice);

#endif
