#include "core/string/chain_kernel.h"

#include <stdbool.h>

static const ChainKernel plain = {"plain",
                                  {&chain_loops_float4, &chain_loops_double2, &chain_loops_fixed4}};

#ifdef HOOKE_AVX2
static const ChainKernel avx2 = {"AVX2 and FMA",
                                 {&chain_loops_float8, &chain_loops_double4, &chain_loops_fixed8}};

static bool has_avx2(void) {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#endif

const ChainKernel* chain_kernel(uint32_t i) {
#ifdef HOOKE_AVX2
  if (has_avx2()) {
    return i == 0 ? &avx2 : i == 1 ? &plain : NULL;
  }
#endif
  return i == 0 ? &plain : NULL;
}
