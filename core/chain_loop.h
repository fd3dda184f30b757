/**
   The source of all chain loops: not a header to be included for its names, but the loops
   themselves.

   Before it is included, these say for what:
   CHAIN_LOOP_NUMBER   float or double
   CHAIN_LOOP_LANES    numbers in a vector
   CHAIN_LOOP_BEFORE   how to shuffle (v, 0) so that lane l has lane l − 1, and the first the wall
   CHAIN_LOOP_BEHIND   how to shuffle (v, 0) so that lane l has lane l + 1, and the last the wall
   CHAIN_LOOP_NAME     the loops that it makes

   Glossary:  x  position;  u  scaled velocity h v;  link  what a spring and damper pull with, k1 Δx
   + z1 Δu + k2 Δ(L x), Δ being the difference between neighbours;  bow  L x, how far a mass is from
   the middle of its neighbours;  j  cell.

   The differences come before the products: they are nearly exact, so a link is as precise as it is
   small.
*/
#include "core/chain_kernel.h"

#include <stdbool.h>

#define INLINE static inline __attribute__((always_inline))

typedef CHAIN_LOOP_NUMBER Number;
typedef Number Vector __attribute__((vector_size(CHAIN_LOOP_LANES * sizeof(Number)), may_alias));
typedef int64_t Mask __attribute__((vector_size(CHAIN_LOOP_LANES * sizeof(Number))));

/* The coefficients in the precision of the loop. */
typedef struct {
  Number k1, k2, z0, z1;
} Coefs;

/* As many masses as lanes: where they are, and how far they move in a step. */
typedef struct {
  Vector x;
  Vector u;
} Cell;

enum { MAX_CELLS = CHAIN_MAX_MASSES / CHAIN_LOOP_LANES };

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

INLINE Vector link_of(Vector dx, Vector du, Coefs c) {
  return c.k1 * dx + c.z1 * du;
}

INLINE Vector link_ahead(const Cell* cell, Coefs c) {
  return link_of(cell[1].x - cell->x, cell[1].u - cell->u, c);
}

/* Velocity first, then position with the new velocity. */
INLINE void move(Cell* cell, Vector pulls, Number z0) {
  const Vector u = cell->u + (pulls - z0 * cell->u);
  cell->u = u;
  cell->x += u;
}

/* One step of a perfectly flexible string: each link is computed once and carried. */
INLINE void step_flexible(Cell* cells, uint32_t n_cells, Coefs c) {
  const uint32_t last = n_cells - 1;
  const Vector x_behind = behind(cells[0].x);
  const Vector u_behind = behind(cells[0].u);
  Vector link_before =
      link_of(cells[0].x - before(cells[last].x), cells[0].u - before(cells[last].u), c);
  for (uint32_t j = 0; j < last; ++j) {
    const Vector link = link_ahead(&cells[j], c);
    move(&cells[j], link - link_before, c.z0);
    link_before = link;
  }
  const Vector link = link_of(x_behind - cells[last].x, u_behind - cells[last].u, c);
  move(&cells[last], link - link_before, c.z0);
}

/* L x of every cell, into bow[1 …], and of those before and behind. */
INLINE void
find_bow(Vector* bow, const Cell* cells, uint32_t n_cells, uint32_t wall_cell, Mask mask) {
  const uint32_t last = n_cells - 1;
  Vector slope_before = cells[0].x - before(cells[last].x);
  for (uint32_t j = 0; j < last; ++j) {
    const Vector slope = cells[j + 1].x - cells[j].x;
    bow[j + 1] = slope_before - slope;
    slope_before = slope;
  }
  bow[n_cells] = slope_before - (behind(cells[0].x) - cells[last].x);
  /* A hinge carries no moment: L x is nought at the wall, though its neighbour is not. */
  bow[wall_cell + 1] = hold(bow[wall_cell + 1], mask);
  bow[0] = before(bow[n_cells]);
  bow[n_cells + 1] = behind(bow[1]);
}

/* One step of a string with bending: links look two masses away, so L x is computed for all first.
 */
INLINE void step_bending(Cell* cells, uint32_t n_cells, Coefs c, uint32_t wall_cell, Mask mask) {
  Vector bow[MAX_CELLS + 2];
  const uint32_t last = n_cells - 1;
  const Vector x_behind = behind(cells[0].x);
  const Vector u_behind = behind(cells[0].u);
  find_bow(bow, cells, n_cells, wall_cell, mask);
  Vector link_before =
      link_of(cells[0].x - before(cells[last].x), cells[0].u - before(cells[last].u), c) +
      c.k2 * (bow[1] - bow[0]);
  for (uint32_t j = 0; j < last; ++j) {
    const Vector link = link_ahead(&cells[j], c) + c.k2 * (bow[j + 2] - bow[j + 1]);
    move(&cells[j], link - link_before, c.z0);
    link_before = link;
  }
  const Vector link = link_of(x_behind - cells[last].x, u_behind - cells[last].u, c) +
                      c.k2 * (bow[n_cells + 1] - bow[n_cells]);
  move(&cells[last], link - link_before, c.z0);
}

INLINE Coefs narrow(StringCoefs wide) {
  return (Coefs){(Number)wide.k1, (Number)wide.k2, (Number)wide.z0, (Number)wide.z1};
}

INLINE StringCoefs advance(StringCoefs now, StringCoefs change) {
  return (StringCoefs){now.k1 + change.k1, now.k2 + change.k2, now.z0 + change.z0,
                       now.z1 + change.z1};
}

INLINE float read_tap(const Number* numbers, const ChainReader* reader) {
  return (float)((Number)reader->weight[0] * numbers[reader->offset[0]] +
                 (Number)reader->weight[1] * numbers[reader->offset[1]]);
}

/* What a string is stepped with: read once before the frames. */
typedef struct {
  Cell* cells;
  uint32_t n_cells;
  uint32_t wall_cell;
  Mask mask;
  StringCoefs wide;
  Coefs now;
} Strand;

INLINE Strand strand_of(const ChainWork* work) {
  return (Strand){
      .cells = work->cells,
      .n_cells = work->n_cells,
      .wall_cell = work->n_masses % work->n_cells,
      .mask = wall_mask(work->n_masses / work->n_cells),
      .wide = *work->now,
      .now = narrow(*work->now),
  };
}

INLINE void step(Strand* strand, bool is_bending) {
  Cell* const cells = strand->cells;
  if (is_bending) {
    step_bending(cells, strand->n_cells, strand->now, strand->wall_cell, strand->mask);
  } else {
    step_flexible(cells, strand->n_cells, strand->now);
  }
  cells[strand->wall_cell].x = hold(cells[strand->wall_cell].x, strand->mask);
  cells[strand->wall_cell].u = hold(cells[strand->wall_cell].u, strand->mask);
}

/* The flags are constants wherever this is used, so nothing of them is left to test in the loop. */
INLINE void run(const ChainWork* works,
                uint32_t n_works,
                uint32_t n_frames,
                float* const* out,
                bool is_bending,
                bool is_moving,
                uint32_t n_taps) {
  Strand strands[CHAIN_MAX_BATCH];
  for (uint32_t w = 0; w < n_works; ++w) {
    strands[w] = strand_of(&works[w]);
  }
  for (uint32_t n = 0; n < n_frames; ++n) {
    for (uint32_t w = 0; w < n_works; ++w) {
      Strand* const strand = &strands[w];
      if (is_moving) {
        strand->wide = advance(strand->wide, works[w].change);
        strand->now = narrow(strand->wide);
      }
      step(strand, is_bending);
      for (uint32_t t = 0; t < n_taps; ++t) {
        out[t][n] += read_tap((const Number*)strand->cells, &works[w].readers[t]);
      }
    }
  }
  for (uint32_t w = 0; is_moving && w < n_works; ++w) {
    *works[w].now = strands[w].wide;
  }
}

#define LOOP(name, is_bending, is_moving, n_taps)                                                  \
  static void run_##name(const ChainWork* works, uint32_t n_works, uint32_t n_frames,              \
                         float* const* out) {                                                      \
    run(works, n_works, n_frames, out, is_bending, is_moving, n_taps);                             \
  }
CHAIN_SCENES(LOOP)
#undef LOOP

#define ENTRY(name, is_bending, is_moving, n_taps)                                                 \
  .loops[is_bending][is_moving][n_taps] = run_##name,
const ChainLoops CHAIN_LOOP_NAME = {
    .number_size = sizeof(Number),
    .n_lanes = CHAIN_LOOP_LANES,
    CHAIN_SCENES(ENTRY) //
};
#undef ENTRY
#undef INLINE
