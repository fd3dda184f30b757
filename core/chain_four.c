/* The loops with four lanes: SSE2, NEON, or whatever the compiler makes of them. */
#define CHAIN_LOOP_LANES 4
#define CHAIN_LOOP_BEFORE 4, 0, 1, 2
#define CHAIN_LOOP_BEHIND 1, 2, 3, 4
#define CHAIN_LOOP_KERNEL chain_kernel_four
#define CHAIN_LOOP_NAME "four lanes"

#include "core/chain_loop.h"
