/**
   The modes of a string themselves, a phasor each: what one would play if a string were never
   touched but once, and were heard at one place.

       z ← r exp(jθ) z,   out = Σ Re z,   four products a mode and sample.

   Thread: one at a time.
*/
#ifndef HOOKE_TOOLS_REPORT_TRADE_BANK_H
#define HOOKE_TOOLS_REPORT_TRADE_BANK_H

#include <stdbool.h>
#include <stdint.h>

enum {
  TRADE_BANK_MAX = 1024, /**< Modes */
  TRADE_BANK_FLOATS = 8, /**< Modes in a vector */
  TRADE_BANK_DOUBLES = 4,
  TRADE_BANK_BLOCK = 256 /**< Samples from one vector to the next */
};

/** As many modes. */
typedef float TradeFloats __attribute__((vector_size(TRADE_BANK_FLOATS * sizeof(float))));
typedef double TradeDoubles __attribute__((vector_size(TRADE_BANK_DOUBLES * sizeof(double))));

/** In floats: z = re + j im and what a step makes of it, r cos θ + j r sin θ. */
typedef struct {
  TradeFloats re, im, c, s;
} TradeFloatModes;

/** In doubles. */
typedef struct {
  TradeDoubles re, im, c, s;
} TradeDoubleModes;

/** A bank; zero is one without modes.  One of the two halves is in use. */
typedef struct {
  bool is_double;
  uint32_t n_modes;
  TradeFloatModes floats[TRADE_BANK_MAX / TRADE_BANK_FLOATS];
  TradeDoubleModes doubles[TRADE_BANK_MAX / TRADE_BANK_DOUBLES];
} TradeBank;

/** Add a mode that starts at `re` and turns by c + js a step; at most TRADE_BANK_MAX. */
void trade_bank_add(TradeBank* bank, double re, double c, double s);

/** The phasor of mode `k`, from 1. */
void trade_bank_mode(const TradeBank* bank, uint32_t k, double* re, double* im);

/** Step `n_frames` times, and add what sounds to `out`. */
void trade_bank_run(TradeBank* bank, uint32_t n_frames, float* out);

#endif
