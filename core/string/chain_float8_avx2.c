/* The loops for vectors of 32 bytes.  This file is compiled for AVX2 and FMA. */
#define CHAIN_LOOP_NUMBER float
#define CHAIN_LOOP_REAL float
#define CHAIN_LOOP_IS_FIXED 0
#define CHAIN_LOOP_LANES 8
#define CHAIN_LOOP_BEFORE 8, 0, 1, 2, 3, 4, 5, 6
#define CHAIN_LOOP_BEHIND 1, 2, 3, 4, 5, 6, 7, 8
#define CHAIN_LOOP_NAME chain_loops_float8

#include "core/string/chain_loop.h"
