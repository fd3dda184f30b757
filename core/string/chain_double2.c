/* The loops for vectors of 16 bytes: SSE2, NEON, or whatever the compiler makes of them. */
#define CHAIN_LOOP_NUMBER double
#define CHAIN_LOOP_REAL double
#define CHAIN_LOOP_IS_FIXED 0
#define CHAIN_LOOP_LANES 2
#define CHAIN_LOOP_BEFORE 2, 0
#define CHAIN_LOOP_BEHIND 1, 2
#define CHAIN_LOOP_NAME chain_loops_double2

#include "core/string/chain_loop.h"
