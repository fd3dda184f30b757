/* The loops for vectors of 16 bytes: SSE2, NEON, or whatever the compiler makes of them. */
#if defined(__SSE2__)
#include <emmintrin.h>
#define CHAIN_LOOP_WHOLE(v) ((Vector)_mm_cvtps_epi32((__m128)(v)))
#elif defined(__aarch64__)
#include <arm_neon.h>
#define CHAIN_LOOP_WHOLE(v) ((Vector)vcvtnq_s32_f32((float32x4_t)(v)))
#else
#include <math.h>
#define CHAIN_LOOP_WHOLE(v)                                                                        \
  ((Vector){(int32_t)rintf((v)[0]), (int32_t)rintf((v)[1]), (int32_t)rintf((v)[2]),                \
            (int32_t)rintf((v)[3])})
#endif

#define CHAIN_LOOP_NUMBER int32_t
#define CHAIN_LOOP_REAL float
#define CHAIN_LOOP_IS_FIXED 1
#define CHAIN_LOOP_LANES 4
#define CHAIN_LOOP_BEFORE 4, 0, 1, 2
#define CHAIN_LOOP_BEHIND 1, 2, 3, 4
#define CHAIN_LOOP_NAME chain_loops_fixed4

#include "core/string/chain_loop.h"
