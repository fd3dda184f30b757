/**
   The modes of a string themselves, a phasor each: what one would play if a string were never
   touched but once, and were heard at one place.

       z ← r exp(jθ) z,   out = Σ Re z,   four products a mode and sample.

   Thread: one at a time.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_BANK_H
#define HOOKE_TOOLS_BENCH_BENCH_BANK_H

#include <stdbool.h>
#include <stdint.h>

enum {
  BENCH_BANK_MAX = 1024, /**< Modes */
  BENCH_BANK_FLOATS = 8, /**< Modes in a vector */
  BENCH_BANK_DOUBLES = 4,
  BENCH_BANK_BLOCK = 256 /**< Samples from one vector to the next */
};

/** As many modes. */
typedef float BenchFloats __attribute__((vector_size(BENCH_BANK_FLOATS * sizeof(float))));
typedef double BenchDoubles __attribute__((vector_size(BENCH_BANK_DOUBLES * sizeof(double))));

/** In floats: z = re + j im and what a step makes of it, r cos θ + j r sin θ. */
typedef struct {
  BenchFloats re, im, c, s;
} BenchFloatModes;

/** In doubles. */
typedef struct {
  BenchDoubles re, im, c, s;
} BenchDoubleModes;

/** A bank; zero is one without modes.  One of the two halves is in use. */
typedef struct {
  bool is_double;
  uint32_t n_modes;
  BenchFloatModes floats[BENCH_BANK_MAX / BENCH_BANK_FLOATS];
  BenchDoubleModes doubles[BENCH_BANK_MAX / BENCH_BANK_DOUBLES];
} BenchBank;

/** Add a mode that starts at `re` and turns by c + js a step; at most BENCH_BANK_MAX. */
void bench_bank_add(BenchBank* bank, double re, double c, double s);

/** The phasor of mode `k`, from 1. */
void bench_bank_mode(const BenchBank* bank, uint32_t k, double* re, double* im);

/** Step `n_frames` times, and add what sounds to `out`. */
void bench_bank_run(BenchBank* bank, uint32_t n_frames, float* out);

#endif
