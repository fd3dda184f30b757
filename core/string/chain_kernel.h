/**
   The loops of core/string/chain.h, one set for each kind of processor, from one source
   (core/string/chain_loop.h).

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_STRING_CHAIN_KERNEL_H
#define HOOKE_CORE_STRING_CHAIN_KERNEL_H

#include "core/string/tuning.h"

#include <stddef.h>
#include <stdint.h>

enum {
  CHAIN_MAX_MASSES = 1024,
  CHAIN_MAX_TAPS = 6,
  CHAIN_MAX_LANES = 8,
  CHAIN_LEAST_CELLS = 3, /**< That a string is laid over, so that no end is its own neighbour */
  CHAIN_MAX_BATCH = 4,   /**< Strings that are stepped together */
  CHAIN_ALIGNMENT = 64,  /**< Of the cells [bytes] */
};

/** What a string's masses are kept in. */
typedef enum {
  CHAIN_FLOAT,
  CHAIN_DOUBLE,
  CHAIN_FIXED, /**< Fixed point; for strings that stand still, see core/string/chain_numbers.h */
  N_CHAIN_NUMBERS
} ChainNumbers;

/** Where dampers sit. */
typedef enum {
  CHAIN_UNDAMPED,
  CHAIN_GROUND,  /**< To the ground: z0 */
  CHAIN_BETWEEN, /**< Between the masses as well: z0 and z1 */
  N_CHAIN_DAMPINGS
} ChainDamping;

/** What pulls a mass back. */
typedef enum {
  CHAIN_FLEXIBLE,     /**< Its neighbours: k1 */
  CHAIN_BENDING,      /**< And theirs: k1 and k2 */
  CHAIN_STRAIGHTENED, /**< And theirs: k1, k2 and k3 */
  N_CHAIN_ELASTICITIES
} ChainElasticity;

/** A tap resolved to numbers among the cells. */
typedef struct {
  size_t offset[2];
  float weight[2];
  float lean; /**< CHAIN_FIXED: what a velocity has of its position; else 0 */
} ChainReader;

/** A string for a loop to step; see Chain. */
typedef struct {
  void* cells;
  uint32_t n_masses;
  uint32_t n_cells;
  StringCoefs* now;    /**< Read; written where they move */
  StringCoefs* change; /**< Per frame; written where they move */
  double haste;        /**< What each frame makes of the change */
  double lambda1;      /**< Of the fundamental, by which the clock is bent where they move */
  double kept;         /**< Where they move: what a frame leaves of the motion, see chain_drain() */
  double* gain;        /**< CHAIN_FIXED: of a number, after the last step; written */
  double fade;         /**< CHAIN_FIXED: what a step makes of the gain */
  uint32_t* chance;    /**< CHAIN_FIXED: where the dither is; written */
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

/**
   How fast the string's clock goes, squared: sin² of the fundamental's digital angle ω times what
   its damping leaves in a step, (1 − g) sin² ω = a − (a + g)²/4.
*/
static inline double chain_pace_of(StringCoefs c, double lambda1) {
  const double a = ((c.k3 * lambda1 + c.k2) * lambda1 + c.k1) * lambda1;
  const double half = 0.5 * (a + c.z0 + c.z1 * lambda1);
  return a - half * half;
}

/** Sums over a string's masses, in the units of its numbers. */
typedef struct {
  double xx;        /**< Σ x² */
  double xu;        /**< Σ x u */
  double uu;        /**< Σ u² */
  double slope;     /**< Σ (Δy)² over the links, those to the walls too; y = x − u/2 */
  double curvature; /**< Σ (L u)² */
  double twist;     /**< Σ (Δ L y)² over the links, L y being nought at the walls */
} ChainSums;

/** The loops of one kind of numbers. */
typedef struct {
  size_t number_size; /**< Of a number in the cells [bytes] */
  uint32_t n_lanes;   /**< Segments that a string is cut into */
  ChainSums (*sum)(const void* cells, uint32_t n_masses, uint32_t n_cells);
  /** CHAIN_FIXED: from floats in the same cells and back; NULL elsewhere.  See ChainWork. */
  void (*take)(void* cells, uint32_t n_cells, double gain, double fade);
  void (*give)(void* cells, uint32_t n_cells, double gain, double fade);
  /** NULL where taps are not 1, 2, 4 or 6, or 6 without all dampers, and for moving strings in
   * fixed point */
  ChainLoop loops[N_CHAIN_DAMPINGS][N_CHAIN_ELASTICITIES][2][CHAIN_MAX_TAPS + 1];
} ChainLoops;

/** What one kind of processor has. */
typedef struct {
  const char* name;
  const ChainLoops* loops[N_CHAIN_NUMBERS];
} ChainKernel;

/**
   Every scene that a string can be in: X(damping, elasticity, is_moving, n_taps).  A loop is made
   for each, and does what its scene needs alone.
*/
#define CHAIN_SCENES_OF(X, damping, elasticity, is_moving)                                         \
  X(damping, elasticity, is_moving, 1)                                                             \
  X(damping, elasticity, is_moving, 2)                                                             \
  X(damping, elasticity, is_moving, 4)

/** Six are read for a moment alone, while pickups fade beside a body: with all dampers. */
#define CHAIN_SCENES_OF_SIX(X, is_moving)                                                          \
  X(BETWEEN, FLEXIBLE, is_moving, 6)                                                               \
  X(BETWEEN, BENDING, is_moving, 6)                                                                \
  X(BETWEEN, STRAIGHTENED, is_moving, 6)

/** Those whose coefficients stand still. */
#define CHAIN_STILL_SCENES(X)                                                                      \
  CHAIN_SCENES_OF(X, UNDAMPED, FLEXIBLE, 0)                                                        \
  CHAIN_SCENES_OF(X, UNDAMPED, BENDING, 0)                                                         \
  CHAIN_SCENES_OF(X, UNDAMPED, STRAIGHTENED, 0)                                                    \
  CHAIN_SCENES_OF(X, GROUND, FLEXIBLE, 0)                                                          \
  CHAIN_SCENES_OF(X, GROUND, BENDING, 0)                                                           \
  CHAIN_SCENES_OF(X, GROUND, STRAIGHTENED, 0)                                                      \
  CHAIN_SCENES_OF(X, BETWEEN, FLEXIBLE, 0)                                                         \
  CHAIN_SCENES_OF(X, BETWEEN, BENDING, 0)                                                          \
  CHAIN_SCENES_OF(X, BETWEEN, STRAIGHTENED, 0)                                                     \
  CHAIN_SCENES_OF_SIX(X, 0)

/** Those whose coefficients move, with all dampers, for a glide may begin or end without. */
#define CHAIN_MOVING_SCENES(X)                                                                     \
  CHAIN_SCENES_OF(X, BETWEEN, FLEXIBLE, 1)                                                         \
  CHAIN_SCENES_OF(X, BETWEEN, BENDING, 1)                                                          \
  CHAIN_SCENES_OF(X, BETWEEN, STRAIGHTENED, 1)                                                     \
  CHAIN_SCENES_OF_SIX(X, 1)

/** Vectors of 16 bytes: what every processor that has vectors has. */
extern const ChainLoops chain_loops_float4;
extern const ChainLoops chain_loops_double2;
extern const ChainLoops chain_loops_fixed4;

#ifdef HOOKE_AVX2
/** Vectors of 32 bytes with fused multiply and add; only where the processor has AVX2 and FMA. */
extern const ChainLoops chain_loops_float8;
extern const ChainLoops chain_loops_double4;
extern const ChainLoops chain_loops_fixed8;
#endif

/** The `i`-th kernel that this processor can run, the best first; NULL past the last. */
const ChainKernel* chain_kernel(uint32_t i);

#endif
