#define _POSIX_C_SOURCE 200809L

#include "tools/bench/bench_clock.h"

#include <math.h>
#include <time.h>

#ifdef __x86_64__
#define HOLD(v) __asm__ volatile("" : "+x"(v))
#elif defined(__aarch64__)
#define HOLD(v) __asm__ volatile("" : "+w"(v))
#else
#define HOLD(v) __asm__ volatile("" : "+m"(v))
#endif

enum { TRIES = 4, ADDITIONS = 20000, ROUNDS = 3000, OPERATIONS = 16 };

static double seconds_of(clockid_t clock) {
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_clock_now_s(void) {
  return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

double bench_clock_wall_s(void) {
  return seconds_of(CLOCK_MONOTONIC);
}

/* Eight of each, for a result takes four cycles, and there are pipes that take two a cycle. */
#define EIGHT(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7)

/* Eight to a turn, for cores that take less than a turn a cycle when they are shared. */
static void add_in_turn(void) {
  unsigned long sum = 0;
  for (int i = 0; i < ADDITIONS; i += 8) {
#define ADD(i)                                                                                     \
  sum += 1;                                                                                        \
  __asm__ volatile("" : "+r"(sum));
    EIGHT(ADD)
#undef ADD
  }
}

#define ZERO(i)                                                                                    \
  Vector a##i = {0};                                                                               \
  Vector b##i = {0};
#define TURN(i)                                                                                    \
  a##i = a##i * a##i;                                                                              \
  HOLD(a##i);                                                                                      \
  b##i = b##i + b##i;                                                                              \
  HOLD(b##i);

static void narrow(void) {
  typedef float Vector __attribute__((vector_size(16)));
  EIGHT(ZERO)
  for (int i = 0; i < ROUNDS; ++i) {
    EIGHT(TURN)
  }
}

#ifdef __x86_64__
__attribute__((target("avx2"))) static void wide(void) {
  typedef float Vector __attribute__((vector_size(32)));
  EIGHT(ZERO)
  for (int i = 0; i < ROUNDS; ++i) {
    EIGHT(TURN)
  }
}
#else
static void wide(void) {
  narrow();
}
#endif

/* By the wall: there are machines whose clock of a thread stands still for so short a time. */
static double best_s(void (*work)(void)) {
  double best = HUGE_VAL;
  for (int i = 0; i < TRIES; ++i) {
    const double start = bench_clock_wall_s();
    work();
    best = fmin(best, bench_clock_wall_s() - start);
  }
  return best;
}

double bench_clock_hz(void) {
  return ADDITIONS / best_s(add_in_turn);
}

double bench_clock_peak(size_t vector_bytes) {
  return (double)ROUNDS * OPERATIONS / best_s(vector_bytes >= 32 ? wide : narrow);
}

void bench_clock_measure(BenchBest* best,
                         void (*work)(void* data),
                         void* data,
                         double n_operations,
                         size_t vector_bytes) {
  const double before = bench_clock_peak(vector_bytes);
  const double start = bench_clock_now_s();
  work(data);
  const double time_s = bench_clock_now_s() - start;
  const double peak = fmax(before, bench_clock_peak(vector_bytes));
  if (time_s < best->time_s) {
    *best = (BenchBest){time_s, n_operations / (time_s * peak)};
  }
}
