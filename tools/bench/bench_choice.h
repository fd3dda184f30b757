/** What is asked of the parts of `hooke bench`. */
#ifndef HOOKE_TOOLS_BENCH_BENCH_CHOICE_H
#define HOOKE_TOOLS_BENCH_BENCH_CHOICE_H

#include "core/string/chain_kernel.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct {
  double seconds;       /**< That a part may take, about */
  const char* scene;    /**< Filter, see bench_scene_matches(); "": all */
  ChainNumbers numbers; /**< N_CHAIN_NUMBERS: all */
  uint32_t n_masses;    /**< 0: several */
  bool is_csv;
} BenchChoice;

#endif
