/**
   The modes of a string themselves, a phasor each: what one would play if a string were never
   touched but once, and were heard at one place.

       z ← r exp(jθ) z,   out = Σ Re z,   four products a mode and sample.

   Thread: one at a time.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_BANK_H
#define HOOKE_TOOLS_BENCH_BENCH_BANK_H

#include <stdint.h>

enum { BENCH_BANK_MAX = 1024, /**< Modes */ BENCH_BANK_LANES = 4 /**< Modes in a vector */ };

/** As many modes. */
typedef double BenchLanes __attribute__((vector_size(BENCH_BANK_LANES * sizeof(double))));

/** z = re + j im and what a step makes of it, r cos θ + j r sin θ. */
typedef struct {
  BenchLanes re, im, c, s;
} BenchPhasors;

/** A bank; zero is one without modes. */
typedef struct {
  uint32_t n_modes;
  BenchPhasors phasors[BENCH_BANK_MAX / BENCH_BANK_LANES];
} BenchBank;

/** Add a mode that starts at `re` and turns by c + js a step; at most BENCH_BANK_MAX. */
void bench_bank_add(BenchBank* bank, double re, double c, double s);

/** The phasor of mode `k`, from 1. */
void bench_bank_mode(const BenchBank* bank, uint32_t k, double* re, double* im);

/** Step `n_frames` times, and add what sounds to `out`. */
void bench_bank_run(BenchBank* bank, uint32_t n_frames, float* out);

#endif
