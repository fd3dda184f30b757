#include "tools/bench/bench_bank.h"

#include <assert.h>
#include <stdbool.h>

#define INLINE static inline __attribute__((always_inline))

enum { BLOCK = 256 /* Samples from one vector to the next */ };

/* Modes outside, samples inside, so that phasors stay in registers; the sum over lanes is last. */
INLINE void run_vector(BenchPhasors* phasors, uint32_t n_frames, BenchLanes* sums) {
  BenchPhasors p = *phasors;
  for (uint32_t i = 0; i < n_frames; ++i) {
    const BenchLanes re = p.c * p.re - p.s * p.im;
    p.im = p.s * p.re + p.c * p.im;
    p.re = re;
    sums[i] += re;
  }
  *phasors = p;
}

/* Two at a time: one would wait for itself. */
INLINE void run_pair(BenchPhasors* phasors, uint32_t n_frames, BenchLanes* sums) {
  BenchPhasors p = phasors[0];
  BenchPhasors q = phasors[1];
  for (uint32_t i = 0; i < n_frames; ++i) {
    const BenchLanes re_p = p.c * p.re - p.s * p.im;
    const BenchLanes re_q = q.c * q.re - q.s * q.im;
    p.im = p.s * p.re + p.c * p.im;
    q.im = q.s * q.re + q.c * q.im;
    p.re = re_p;
    q.re = re_q;
    sums[i] += re_p + re_q;
  }
  phasors[0] = p;
  phasors[1] = q;
}

INLINE void run_block(BenchBank* bank, uint32_t n_frames, float* out) {
  const uint32_t n = (bank->n_modes + BENCH_BANK_LANES - 1) / BENCH_BANK_LANES;
  BenchLanes sums[BLOCK] = {{0}};
  uint32_t m = 0;
  for (; m + 2 <= n; m += 2) {
    run_pair(&bank->phasors[m], n_frames, sums);
  }
  if (m < n) {
    run_vector(&bank->phasors[m], n_frames, sums);
  }
  for (uint32_t i = 0; i < n_frames; ++i) {
    out[i] += (float)((sums[i][0] + sums[i][1]) + (sums[i][2] + sums[i][3]));
  }
}

static void run_plain(BenchBank* bank, uint32_t n_frames, float* out) {
  run_block(bank, n_frames, out);
}

#ifdef __x86_64__
/* For the same processors as the best loops of core/string/chain_kernel.h. */
__attribute__((target("avx2,fma"))) static void
run_avx2(BenchBank* bank, uint32_t n_frames, float* out) {
  run_block(bank, n_frames, out);
}

static bool has_avx2(void) {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
#else
static void run_avx2(BenchBank* bank, uint32_t n_frames, float* out) {
  run_block(bank, n_frames, out);
}

static bool has_avx2(void) {
  return false;
}
#endif

void bench_bank_add(BenchBank* bank, double re, double c, double s) {
  assert(bank->n_modes < BENCH_BANK_MAX);
  const uint32_t i = bank->n_modes++;
  BenchPhasors* const phasors = &bank->phasors[i / BENCH_BANK_LANES];
  phasors->re[i % BENCH_BANK_LANES] = re;
  phasors->c[i % BENCH_BANK_LANES] = c;
  phasors->s[i % BENCH_BANK_LANES] = s;
}

void bench_bank_mode(const BenchBank* bank, uint32_t k, double* re, double* im) {
  const BenchPhasors* const phasors = &bank->phasors[(k - 1) / BENCH_BANK_LANES];
  *re = phasors->re[(k - 1) % BENCH_BANK_LANES];
  *im = phasors->im[(k - 1) % BENCH_BANK_LANES];
}

void bench_bank_run(BenchBank* bank, uint32_t n_frames, float* out) {
  const bool is_fast = has_avx2();
  for (uint32_t from = 0; from < n_frames; from += BLOCK) {
    const uint32_t left = n_frames - from;
    (is_fast ? run_avx2 : run_plain)(bank, left < BLOCK ? left : BLOCK, out + from);
  }
}
