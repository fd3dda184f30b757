/**
   The loops of core/chain.h, one set for each kind of processor, from one source
   (core/chain_loop.h).

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_CHAIN_KERNEL_H
#define HOOKE_CORE_CHAIN_KERNEL_H

#include <stddef.h>
#include <stdint.h>

enum {
  CHAIN_MAX_MASSES = 1024,
  CHAIN_MAX_TAPS = 4,
  CHAIN_MAX_LANES = 8,
  CHAIN_ALIGNMENT = 64, /**< Of the cells [bytes] */
};

/** The coefficients of core/tuning.h in the precision of the loop. */
typedef struct {
  float k1, k2, z0, z1;
} ChainCoefs;

/** A tap resolved to floats among the cells. */
typedef struct {
  size_t offset[2];
  float weight[2];
} ChainReader;

/** What a loop works on; see Chain. */
typedef struct {
  float* cells;
  float* residues; /**< Of the cells, laid out as they are */
  uint32_t n_masses;
  uint32_t n_cells;
  uint32_t n_frames;
  ChainCoefs* now;   /**< Read; written where they move */
  ChainCoefs change; /**< Per frame */
  const ChainReader* readers;
  float* const* out; /**< A buffer of n_frames for each reader, added to */
} ChainWork;

typedef void (*ChainLoop)(ChainWork work);

/** How the coefficients and the rounding are handled. */
typedef enum {
  CHAIN_STILL,  /**< The coefficients stand still */
  CHAIN_MOVING, /**< They move */
  CHAIN_EXACT, /**< They stand still, and what rounding takes from x and u is given back in the next
                  step */
  CHAIN_MODES
} ChainMode;

/** One set of loops. */
typedef struct {
  const char* name;
  uint32_t n_lanes; /**< Segments that a string is cut into */
  /** [is bending][mode][taps]; NULL where taps are not 1, 2 or 4 */
  ChainLoop loops[2][CHAIN_MODES][CHAIN_MAX_TAPS + 1];
} ChainKernel;

/**
   X(name, is_bending, mode, n_taps): every scene that a string can be in.  A loop is made for each,
   and does what its scene needs alone.
*/
#define CHAIN_SCENES(X)                                                                            \
  X(flexible_still_1, 0, CHAIN_STILL, 1)                                                           \
  X(flexible_still_2, 0, CHAIN_STILL, 2)                                                           \
  X(flexible_still_4, 0, CHAIN_STILL, 4)                                                           \
  X(flexible_moving_1, 0, CHAIN_MOVING, 1)                                                         \
  X(flexible_moving_2, 0, CHAIN_MOVING, 2)                                                         \
  X(flexible_moving_4, 0, CHAIN_MOVING, 4)                                                         \
  X(flexible_exact_1, 0, CHAIN_EXACT, 1)                                                           \
  X(flexible_exact_2, 0, CHAIN_EXACT, 2)                                                           \
  X(flexible_exact_4, 0, CHAIN_EXACT, 4)                                                           \
  X(bending_still_1, 1, CHAIN_STILL, 1)                                                            \
  X(bending_still_2, 1, CHAIN_STILL, 2)                                                            \
  X(bending_still_4, 1, CHAIN_STILL, 4)                                                            \
  X(bending_moving_1, 1, CHAIN_MOVING, 1)                                                          \
  X(bending_moving_2, 1, CHAIN_MOVING, 2)                                                          \
  X(bending_moving_4, 1, CHAIN_MOVING, 4)                                                          \
  X(bending_exact_1, 1, CHAIN_EXACT, 1)                                                            \
  X(bending_exact_2, 1, CHAIN_EXACT, 2)                                                            \
  X(bending_exact_4, 1, CHAIN_EXACT, 4)

/** Four lanes: what every processor with vectors has. */
extern const ChainKernel chain_kernel_four;

#ifdef HOOKE_AVX2
/** Eight lanes with fused multiply and add; only where the processor has AVX2 and FMA. */
extern const ChainKernel chain_kernel_eight;
#endif

/** The `i`-th kernel that this processor can run, the best first; NULL past the last. */
const ChainKernel* chain_kernel(uint32_t i);

#endif
