/**
   One step of a string: the part of core/chain_loop.h that is in every loop, and explained there.
*/
#include "core/chain_dither.h"
#include "core/chain_kernel.h"

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
} Scene;

/* What a string is stepped with: read once before the frames. */
typedef struct {
  Cell* cells;
  uint32_t n_cells;
  uint32_t wall_cell;
  Mask mask;
  StringCoefs wide;
  Coefs now;
  double gain;
  uint32_t chance;
} Strand;

enum { MAX_CELLS = CHAIN_MAX_MASSES / CHAIN_LOOP_LANES };

/* L x or L² x of every cell, from [1] on, and of those before and behind. */
typedef Vector Curve[MAX_CELLS + 2];

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

/* L of every `stride`-th vector of `in`.  A hinge carries no moment: at the wall, where the mask
   is, it is nought, though its neighbour is not. */
INLINE void curve(Curve out, const Vector* in, size_t stride, const Strand* strand) {
  const size_t last = (size_t)strand->n_cells - 1;
  const uint32_t wall_cell = strand->wall_cell;
  Vector here = in[0];
  Vector slope_before = here - before(in[last * stride]);
  const Vector end = behind(here);
  for (size_t j = 0; j < last; ++j) {
    const Vector next = in[(j + 1) * stride];
    const Vector slope = next - here;
    out[j + 1] = slope_before - slope;
    slope_before = slope;
    here = next;
  }
  out[last + 1] = slope_before - (end - here);
  out[wall_cell + 1] = hold(out[wall_cell + 1], strand->mask);
  out[0] = before(out[last + 1]);
  out[last + 2] = behind(out[1]);
}

/* What there is to know of the links of one step. */
typedef struct {
  const Coefs* c;
  const Vector* bow;
  const Vector* flex;
  const RealVector* dither;
} Links;

/* The links behind the last cell are those before the first, a lane on, and must be rounded alike,
   or they would pull one mass and not the other. */
INLINE RealVector dither_at(size_t j, const Links* links, bool is_end) {
  const RealVector here = links->dither[j];
  if (is_end) {
    return __builtin_shufflevector(links->dither[0], here, CHAIN_LOOP_BEHIND);
  }
  return here;
}

/* Of the link between cell j − 1 and cell j, whose difference of x and u is given.  The largest
   comes last, so that the small are not lost in its last place. */
INLINE Vector
link_of(Vector dx, Vector du, size_t j, bool is_end, const Links* links, Scene scene) {
  const Coefs* const c = links->c;
  RealVector link = CHAIN_LOOP_IS_FIXED ? dither_at(j, links, is_end) : (RealVector){0};
  if (scene.damping == CHAIN_BETWEEN) {
    link += c->z1 * real(du);
  }
  if (scene.elasticity >= CHAIN_STRAIGHTENED) {
    link += c->k3 * real(links->flex[j + 1] - links->flex[j]);
  }
  if (scene.elasticity >= CHAIN_BENDING) {
    link += c->k2 * real(links->bow[j + 1] - links->bow[j]);
  }
  return number(link + c->k1 * real(dx));
}

/* Velocity first, then position with the new velocity. */
INLINE void move(Cell* cell, Vector x, Vector u, Vector pull, const Coefs* c, Scene scene) {
#if CHAIN_LOOP_IS_FIXED
  (void)c; /* The gain fades instead. */
  (void)scene;
#else
  if (scene.damping != CHAIN_UNDAMPED) {
    pull -= c->z0 * u;
  }
#endif
  u += pull;
  cell->u = u;
  cell->x = x + u;
}

/* One step: each link is computed once and carried. */
INLINE void step(Strand* strand, Scene scene) {
  Cell* const cells = strand->cells;
  const Coefs* const c = &strand->now;
  const size_t last = (size_t)strand->n_cells - 1;
  Curve bow;
  Curve flex;
  if (scene.elasticity >= CHAIN_BENDING) {
    curve(bow, &cells->x, 2, strand);
  }
  if (scene.elasticity >= CHAIN_STRAIGHTENED) {
    curve(flex, bow + 1, 1, strand);
  }
  const Links links = {c, bow, flex, dither_of(strand)};
  Vector x = cells[0].x;
  Vector u = cells[0].u;
  const Vector x_end = behind(x);
  const Vector u_end = behind(u);
  Vector link_before =
      link_of(x - before(cells[last].x), u - before(cells[last].u), 0, false, &links, scene);
  for (size_t j = 0; j < last; ++j) {
    const Vector x_next = cells[j + 1].x;
    const Vector u_next = cells[j + 1].u;
    const Vector link = link_of(x_next - x, u_next - u, j + 1, false, &links, scene);
    move(&cells[j], x, u, link - link_before, c, scene);
    link_before = link;
    x = x_next;
    u = u_next;
  }
  const Vector link = link_of(x_end - x, u_end - u, last + 1, true, &links, scene);
  move(&cells[last], x, u, link - link_before, c, scene);
  Cell* const wall = &cells[strand->wall_cell];
  wall->x = hold(wall->x, strand->mask);
  wall->u = hold(wall->u, strand->mask);
}
