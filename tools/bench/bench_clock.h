/**
   Time, and the peak that a core's arithmetic is held against.

   The clocks of shared machines swing, so a peak is worth something only close to what is compared
   with it: each takes some 20 µs, and is taken before and after every measurement.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_CLOCK_H
#define HOOKE_TOOLS_BENCH_BENCH_CLOCK_H

#include <stddef.h>

/** Time that this thread has had a core [s]. */
double bench_clock_now_s(void);

/** Time, whoever had the cores [s]. */
double bench_clock_wall_s(void);

/** The clock of now [Hz]: additions that wait for each other take a cycle each. */
double bench_clock_hz(void);

/**
   The peak of now: vector operations on numbers in registers, none of which waits for another, a
   multiplication and an addition in turn, for that is what processors have most pipes for.

   @param vector_bytes  32 where the processor has AVX2, else 16
   @return Operations a second
*/
double bench_clock_peak(size_t vector_bytes);

/** The best of several measurements of the same work. */
typedef struct {
  double time_s; /**< The least that it took; HUGE_VAL: not measured yet */
  double share;  /**< Of the peak of then that was reached */
} BenchBest;

/**
   Measure once, and keep the best.  The peak is taken before and after, and the higher one counts:
   the other would flatter.

   @param work          Done with `data`
   @param n_operations  Vector operations that it needs
   @param vector_bytes  As for bench_clock_peak()
*/
void bench_clock_measure(BenchBest* best,
                         void (*work)(void* data),
                         void* data,
                         double n_operations,
                         size_t vector_bytes);

#endif
