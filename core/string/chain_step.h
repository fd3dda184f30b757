/**
   One step of a string: the part of core/string/chain_loop.h that is in every loop, and explained
   there.
*/
#include "core/string/chain_dither.h"
#include "core/string/chain_kernel.h"

#include <stdbool.h>

#define INLINE static inline __attribute__((always_inline))

typedef CHAIN_LOOP_NUMBER Number;
typedef CHAIN_LOOP_REAL Real;
typedef Number Vector __attribute__((vector_size(CHAIN_LOOP_LANES * sizeof(Number)), may_alias));
typedef Real RealVector __attribute__((vector_size(CHAIN_LOOP_LANES * sizeof(Real)), may_alias));
typedef int64_t Mask __attribute__((vector_size(CHAIN_LOOP_LANES * sizeof(Number))));

/* The coefficients in the precision of the loop. */
typedef struct {
  Real k1, k2, k3, z0, z1;
  Real kept; /* Of a position, where they move */
} Coefs;

/* As many masses as lanes: where they are, and how far they move in a step. */
typedef struct {
  Vector x;
  Vector u;
} Cell;

/* What a loop is made for; constants wherever it is used, so nothing is left to test in the loop.
 */
typedef struct {
  ChainDamping damping;
  ChainElasticity elasticity;
  bool is_moving;
  uint32_t n_taps;
} ChainScene;

/* What a string is stepped with: read once before the frames. */
typedef struct {
  Cell* cells;
  uint32_t n_cells;
  uint32_t wall_cell;
  uint32_t n_free; /* Cells before the wall's */
  Mask mask;
  StringCoefs wide;
  StringCoefs change;
  Coefs now;
  double gain;
  uint32_t chance;
} Strand;

#if CHAIN_LOOP_IS_FIXED
INLINE RealVector real(Vector v) {
  return __builtin_convertvector(v, RealVector);
}

INLINE Vector number(RealVector v) {
  return CHAIN_LOOP_WHOLE(v);
}

/* Where the dither of this step begins: anywhere, by a generator of full period. */
INLINE const RealVector* dither_of(Strand* strand) {
  enum { PERIOD = CHAIN_DITHER_PERIOD * CHAIN_MAX_LANES / CHAIN_LOOP_LANES };
  strand->chance = strand->chance * 1664525u + 1013904223u;
  return (const RealVector*)chain_dither + (strand->chance >> 8) / ((1u << 24) / PERIOD);
}
#else
INLINE RealVector real(Vector v) {
  return v;
}

INLINE Vector number(RealVector v) {
  return v;
}

INLINE const RealVector* dither_of(Strand* strand) {
  (void)strand;
  return NULL;
}
#endif

/* Lane l takes lane l − 1: what lies before the first cell.  Lane 0 takes the wall. */
INLINE Vector before(Vector v) {
  const Vector wall = {0};
  return __builtin_shufflevector(v, wall, CHAIN_LOOP_BEFORE);
}

/* Lane l takes lane l + 1: what lies behind the last cell.  The last lane takes the wall. */
INLINE Vector behind(Vector v) {
  const Vector wall = {0};
  return __builtin_shufflevector(v, wall, CHAIN_LOOP_BEHIND);
}

/* All ones but for the wall, where the wall is a lane of the cell after the last mass. */
INLINE Mask wall_mask(uint32_t wall_lane) {
  union {
    unsigned char bytes[CHAIN_LOOP_LANES][sizeof(Number)];
    Mask mask;
  } all;
  for (uint32_t l = 0; l < CHAIN_LOOP_LANES; ++l) {
    for (size_t i = 0; i < sizeof(Number); ++i) {
      all.bytes[l][i] = l == wall_lane ? 0x00 : 0xFF;
    }
  }
  return all.mask;
}

INLINE Vector hold(Vector v, Mask mask) {
  return (Vector)((Mask)v & mask);
}

/* All but what is at the wall, if cell `j` is the one that the wall is in. */
INLINE Vector hold_at(Vector v, size_t j, const Strand* strand) {
  return j == strand->wall_cell ? hold(v, strand->mask) : v;
}

/* What there is to know of the links of one step. */
typedef struct {
  const Coefs* c;
  const RealVector* dither;
} Links;

/* From one neighbour to the next. */
typedef struct {
  Vector x;
  Vector u;
  Vector curvature;
  Vector flex;
} Slopes;

INLINE RealVector dither_at(size_t j, const Links* links) {
  return CHAIN_LOOP_IS_FIXED ? links->dither[j] : (RealVector){0};
}

/* The links behind the last cell are those before the first, a lane on, and must be rounded alike,
   or they would pull one mass and not the other. */
INLINE RealVector dither_at_end(size_t n_cells, const Links* links) {
  if (!CHAIN_LOOP_IS_FIXED) {
    return (RealVector){0};
  }
  return __builtin_shufflevector(links->dither[0], links->dither[n_cells], CHAIN_LOOP_BEHIND);
}

/* The largest comes last, so that the small are not lost in its last place. */
INLINE Vector link_of(Slopes slopes, RealVector dither, const Links* links, ChainScene scene) {
  const Coefs* const c = links->c;
  RealVector link = dither;
  if (scene.damping == CHAIN_BETWEEN) {
    link += c->z1 * real(slopes.u);
  }
  if (scene.elasticity >= CHAIN_STRAIGHTENED) {
    link += c->k3 * real(slopes.flex);
  }
  if (scene.elasticity >= CHAIN_BENDING) {
    link += c->k2 * real(slopes.curvature);
  }
  return number(link + c->k1 * real(slopes.x));
}

/* Velocity first, then position with the new velocity. */
INLINE void move(Cell* cell, Vector x, Vector u, Vector pull, const Coefs* c, ChainScene scene) {
#if CHAIN_LOOP_IS_FIXED
  (void)c; /* The gain fades instead. */
#else
  if (scene.damping != CHAIN_UNDAMPED) {
    pull -= c->z0 * u;
  }
#endif
  u += pull;
  cell->u = u;
  cell->x = (scene.is_moving ? number(c->kept * real(x)) : x) + u;
}

#include "core/string/chain_flexible.h"
#include "core/string/chain_stiff.h"

INLINE void step(Strand* strand, ChainScene scene) {
  const Links links = {&strand->now, dither_of(strand)};
  Cell* const wall = &strand->cells[strand->wall_cell];
  if (scene.elasticity == CHAIN_FLEXIBLE) {
    step_flexible(strand, &links, scene);
  } else {
    step_stiff(strand, &links, scene);
  }
  wall->x = hold(wall->x, strand->mask);
  wall->u = hold(wall->u, strand->mask);
}
