/**
   The loops of core/chain.h, one set for each kind of processor, from one source
   (core/chain_loop.h).

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_CHAIN_KERNEL_H
#define HOOKE_CORE_CHAIN_KERNEL_H

#include "core/tuning.h"

#include <stddef.h>
#include <stdint.h>

enum {
  CHAIN_MAX_MASSES = 1024,
  CHAIN_MAX_TAPS = 4,
  CHAIN_MAX_LANES = 8,
  CHAIN_MAX_BATCH = 4,  /**< Strings that are stepped together */
  CHAIN_ALIGNMENT = 64, /**< Of the cells [bytes] */
};

/** A tap resolved to numbers among the cells. */
typedef struct {
  size_t offset[2];
  float weight[2];
} ChainReader;

/** A string for a loop to step; see Chain. */
typedef struct {
  void* cells;
  uint32_t n_masses;
  uint32_t n_cells;
  StringCoefs* now;   /**< Read; written where they move */
  StringCoefs change; /**< Per frame */
  ChainReader readers[CHAIN_MAX_TAPS];
} ChainWork;

/**
   Step `n_works` strings, at most CHAIN_MAX_BATCH, `n_frames` times, all of them in every frame: a
   short string is a chain of operations that wait for each other, and another fills the gaps.

   @param out  A buffer of n_frames for each tap, added to in the order of `works`
*/
typedef void (*ChainLoop)(const ChainWork* works,
                          uint32_t n_works,
                          uint32_t n_frames,
                          float* const* out);

/** The loops of one precision. */
typedef struct {
  size_t number_size; /**< Of a number in the cells [bytes] */
  uint32_t n_lanes;   /**< Segments that a string is cut into */
  /** [is bending][is moving][taps]; NULL where taps are not 1, 2 or 4 */
  ChainLoop loops[2][2][CHAIN_MAX_TAPS + 1];
} ChainLoops;

/** What one kind of processor has. */
typedef struct {
  const char* name;
  const ChainLoops* in_float;
  const ChainLoops* in_double;
} ChainKernel;

/**
   X(name, is_bending, is_moving, n_taps): every scene that a string can be in.  A loop is made for
   each, and does what its scene needs alone.
*/
#define CHAIN_SCENES(X)                                                                            \
  X(flexible_still_1, 0, 0, 1)                                                                     \
  X(flexible_still_2, 0, 0, 2)                                                                     \
  X(flexible_still_4, 0, 0, 4)                                                                     \
  X(flexible_moving_1, 0, 1, 1)                                                                    \
  X(flexible_moving_2, 0, 1, 2)                                                                    \
  X(flexible_moving_4, 0, 1, 4)                                                                    \
  X(bending_still_1, 1, 0, 1)                                                                      \
  X(bending_still_2, 1, 0, 2)                                                                      \
  X(bending_still_4, 1, 0, 4)                                                                      \
  X(bending_moving_1, 1, 1, 1)                                                                     \
  X(bending_moving_2, 1, 1, 2)                                                                     \
  X(bending_moving_4, 1, 1, 4)

/** Vectors of 16 bytes: what every processor that has vectors has. */
extern const ChainLoops chain_loops_float4;
extern const ChainLoops chain_loops_double2;

#ifdef HOOKE_AVX2
/** Vectors of 32 bytes with fused multiply and add; only where the processor has AVX2 and FMA. */
extern const ChainLoops chain_loops_float8;
extern const ChainLoops chain_loops_double4;
#endif

/** The `i`-th kernel that this processor can run, the best first; NULL past the last. */
const ChainKernel* chain_kernel(uint32_t i);

#endif
