/**
   `hooke bench`: what strings, the harp and other instruments cost on this machine.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_H
#define HOOKE_TOOLS_BENCH_BENCH_H

#include "core/string/chain_kernel.h"

#include <stdbool.h>
#include <stdint.h>

/** What `hooke help bench` says. */
extern const char bench_help[];

/** What is asked for. */
typedef struct {
  double seconds;       /**< That a part may take, about */
  const char* scene;    /**< Filter, see bench_scene_matches(); "": all */
  ChainNumbers numbers; /**< N_CHAIN_NUMBERS: all */
  uint32_t n_masses;    /**< 0: several */
  bool is_csv;
} BenchChoice;

/**
   Run the subcommand.

   @param argc  Words in `argv`, without the program's name
   @param argv  "bench" and what follows, ended by NULL
   @return ARGS_OK, ARGS_FAILURE or ARGS_USAGE; unless ARGS_OK, one line is on stderr
*/
int bench_main(int argc, char** argv);

#endif
