#include "core/bank/bank_kernel.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef HOOKE_AVX2
static bool has_avx2(void) {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#endif

#ifdef HOOKE_AVX512
static bool has_avx512(void) {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("fma");
}
#endif

const BankKernel* bank_kernel(uint32_t i) {
  const BankKernel* all[3];
  uint32_t n = 0;
#if defined(HOOKE_AVX2) || defined(HOOKE_AVX512)
  __builtin_cpu_init();
#endif
#ifdef HOOKE_AVX512
  if (has_avx512()) {
    all[n++] = &bank_kernel_double8;
  }
#endif
#ifdef HOOKE_AVX2
  if (has_avx2()) {
    all[n++] = &bank_kernel_double4;
  }
#endif
  all[n++] = &bank_kernel_double2;
  return i < n ? all[i] : NULL;
}
