/* The loops for vectors of 32 bytes.  This file is compiled for AVX2 and FMA. */
#include <immintrin.h>

#define CHAIN_LOOP_NUMBER int32_t
#define CHAIN_LOOP_REAL float
#define CHAIN_LOOP_IS_FIXED 1
#define CHAIN_LOOP_WHOLE(v) ((Vector)_mm256_cvtps_epi32((__m256)(v)))
#define CHAIN_LOOP_LANES 8
#define CHAIN_LOOP_BEFORE 8, 0, 1, 2, 3, 4, 5, 6
#define CHAIN_LOOP_BEHIND 1, 2, 3, 4, 5, 6, 7, 8
#define CHAIN_LOOP_NAME chain_loops_fixed8

#include "core/string/chain_loop.h"
