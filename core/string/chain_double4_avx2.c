/* The loops for vectors of 32 bytes.  This file is compiled for AVX2 and FMA. */
#define CHAIN_LOOP_NUMBER double
#define CHAIN_LOOP_REAL double
#define CHAIN_LOOP_IS_FIXED 0
#define CHAIN_LOOP_LANES 4
#define CHAIN_LOOP_BEFORE 4, 0, 1, 2
#define CHAIN_LOOP_BEHIND 1, 2, 3, 4
#define CHAIN_LOOP_NAME chain_loops_double4

#include "core/string/chain_loop.h"
