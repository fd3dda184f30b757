#include "core/chain_kernel.h"

#include <stdbool.h>

#ifdef HOOKE_AVX2
static bool has_avx2(void) {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#endif

const ChainKernel* chain_kernel(uint32_t i) {
#ifdef HOOKE_AVX2
  if (has_avx2()) {
    return i == 0 ? &chain_kernel_eight : i == 1 ? &chain_kernel_four : NULL;
  }
#endif
  return i == 0 ? &chain_kernel_four : NULL;
}
