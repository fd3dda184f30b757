#include "tools/bench/bench_bank.h"

#include <assert.h>

#define INLINE static inline __attribute__((always_inline))

/* Modes outside, samples inside, so that phasors stay in registers; the sum over lanes comes last.
 */
INLINE void run_floats(BenchFloatModes* modes, uint32_t n, uint32_t n_frames, float* out) {
  BenchFloats sums[BENCH_BANK_BLOCK] = {{0}};
  uint32_t m = 0;
  for (; m + 2 <= n; m += 2) {
    BenchFloatModes a = modes[m];
    BenchFloatModes b = modes[m + 1];
    for (uint32_t i = 0; i < n_frames; ++i) {
      const BenchFloats re_a = a.c * a.re - a.s * a.im;
      const BenchFloats re_b = b.c * b.re - b.s * b.im;
      a.im = a.s * a.re + a.c * a.im;
      b.im = b.s * b.re + b.c * b.im;
      a.re = re_a;
      b.re = re_b;
      sums[i] += re_a + re_b;
    }
    modes[m] = a;
    modes[m + 1] = b;
  }
  for (; m < n; ++m) {
    BenchFloatModes a = modes[m];
    for (uint32_t i = 0; i < n_frames; ++i) {
      const BenchFloats re = a.c * a.re - a.s * a.im;
      a.im = a.s * a.re + a.c * a.im;
      a.re = re;
      sums[i] += re;
    }
    modes[m] = a;
  }
  for (uint32_t i = 0; i < n_frames; ++i) {
    const BenchFloats v = sums[i];
    out[i] += ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
  }
}

INLINE void run_doubles(BenchDoubleModes* modes, uint32_t n, uint32_t n_frames, float* out) {
  BenchDoubles sums[BENCH_BANK_BLOCK] = {{0}};
  uint32_t m = 0;
  for (; m + 2 <= n; m += 2) {
    BenchDoubleModes a = modes[m];
    BenchDoubleModes b = modes[m + 1];
    for (uint32_t i = 0; i < n_frames; ++i) {
      const BenchDoubles re_a = a.c * a.re - a.s * a.im;
      const BenchDoubles re_b = b.c * b.re - b.s * b.im;
      a.im = a.s * a.re + a.c * a.im;
      b.im = b.s * b.re + b.c * b.im;
      a.re = re_a;
      b.re = re_b;
      sums[i] += re_a + re_b;
    }
    modes[m] = a;
    modes[m + 1] = b;
  }
  for (; m < n; ++m) {
    BenchDoubleModes a = modes[m];
    for (uint32_t i = 0; i < n_frames; ++i) {
      const BenchDoubles re = a.c * a.re - a.s * a.im;
      a.im = a.s * a.re + a.c * a.im;
      a.re = re;
      sums[i] += re;
    }
    modes[m] = a;
  }
  for (uint32_t i = 0; i < n_frames; ++i) {
    const BenchDoubles v = sums[i];
    out[i] += (float)((v[0] + v[1]) + (v[2] + v[3]));
  }
}

INLINE void run_block(BenchBank* bank, uint32_t n_frames, float* out) {
  const uint32_t n = bank->n_modes;
  if (bank->is_double) {
    const uint32_t n_vectors = (n + BENCH_BANK_DOUBLES - 1) / BENCH_BANK_DOUBLES;
    run_doubles(bank->doubles, n_vectors, n_frames, out);
  } else {
    const uint32_t n_vectors = (n + BENCH_BANK_FLOATS - 1) / BENCH_BANK_FLOATS;
    run_floats(bank->floats, n_vectors, n_frames, out);
  }
}

#ifdef __x86_64__
/* For the same processors as the best loops of core/string/chain_kernel.h. */
__attribute__((target("avx2,fma"))) static void
run_block_avx2(BenchBank* bank, uint32_t n_frames, float* out) {
  run_block(bank, n_frames, out);
}

static bool has_avx2(void) {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#else
static void run_block_avx2(BenchBank* bank, uint32_t n_frames, float* out) {
  run_block(bank, n_frames, out);
}

static bool has_avx2(void) {
  return false;
}
#endif

static void run_block_plain(BenchBank* bank, uint32_t n_frames, float* out) {
  run_block(bank, n_frames, out);
}

void bench_bank_add(BenchBank* bank, double re, double c, double s) {
  assert(bank->n_modes < BENCH_BANK_MAX);
  const uint32_t i = bank->n_modes++;
  BenchDoubleModes* const doubles = &bank->doubles[i / BENCH_BANK_DOUBLES];
  BenchFloatModes* const floats = &bank->floats[i / BENCH_BANK_FLOATS];
  doubles->re[i % BENCH_BANK_DOUBLES] = re;
  doubles->c[i % BENCH_BANK_DOUBLES] = c;
  doubles->s[i % BENCH_BANK_DOUBLES] = s;
  floats->re[i % BENCH_BANK_FLOATS] = (float)re;
  floats->c[i % BENCH_BANK_FLOATS] = (float)c;
  floats->s[i % BENCH_BANK_FLOATS] = (float)s;
}

void bench_bank_mode(const BenchBank* bank, uint32_t k, double* re, double* im) {
  const uint32_t i = k - 1;
  const BenchDoubleModes* const doubles = &bank->doubles[i / BENCH_BANK_DOUBLES];
  const BenchFloatModes* const floats = &bank->floats[i / BENCH_BANK_FLOATS];
  const uint32_t in_doubles = i % BENCH_BANK_DOUBLES;
  const uint32_t in_floats = i % BENCH_BANK_FLOATS;
  *re = bank->is_double ? doubles->re[in_doubles] : (double)floats->re[in_floats];
  *im = bank->is_double ? doubles->im[in_doubles] : (double)floats->im[in_floats];
}

void bench_bank_run(BenchBank* bank, uint32_t n_frames, float* out) {
  const bool is_fast = has_avx2();
  for (uint32_t from = 0; from < n_frames; from += BENCH_BANK_BLOCK) {
    const uint32_t left = n_frames - from;
    const uint32_t n = left < BENCH_BANK_BLOCK ? left : BENCH_BANK_BLOCK;
    if (is_fast) {
      run_block_avx2(bank, n, out + from);
    } else {
      run_block_plain(bank, n, out + from);
    }
  }
}
