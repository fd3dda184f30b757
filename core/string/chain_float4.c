/* The loops for vectors of 16 bytes: SSE2, NEON, or whatever the compiler makes of them. */
#define CHAIN_LOOP_NUMBER float
#define CHAIN_LOOP_REAL float
#define CHAIN_LOOP_IS_FIXED 0
#define CHAIN_LOOP_LANES 4
#define CHAIN_LOOP_BEFORE 4, 0, 1, 2
#define CHAIN_LOOP_BEHIND 1, 2, 3, 4
#define CHAIN_LOOP_NAME chain_loops_float4

#include "core/string/chain_loop.h"
