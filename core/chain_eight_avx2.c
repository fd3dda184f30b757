/* The loops with eight lanes.  This file alone is compiled for AVX2 and FMA. */
#define CHAIN_LOOP_LANES 8
#define CHAIN_LOOP_BEFORE 8, 0, 1, 2, 3, 4, 5, 6
#define CHAIN_LOOP_BEHIND 1, 2, 3, 4, 5, 6, 7, 8
#define CHAIN_LOOP_KERNEL chain_kernel_eight
#define CHAIN_LOOP_NAME "eight lanes, AVX2 and FMA"

#include "core/chain_loop.h"
