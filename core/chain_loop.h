/**
   The source of every chain kernel: not a header to be included for its names, but the loops
   themselves.

   Before it is included, these say for what:
   CHAIN_LOOP_LANES    floats in a vector
   CHAIN_LOOP_BEFORE   how to shuffle (v, 0) so that lane l has lane l − 1, and the first the wall
   CHAIN_LOOP_BEHIND   how to shuffle (v, 0) so that lane l has lane l + 1, and the last the wall
   CHAIN_LOOP_KERNEL, CHAIN_LOOP_NAME   the kernel that it makes

   Glossary:  x  position;  u  scaled velocity h v;  link  what a spring and damper pull with, k1 Δx
   + z1 Δu + k2 Δ(L x), Δ being the difference between neighbours;  bow  L x, how far a mass is from
   the middle of its neighbours;  j  cell.

   The differences come before the products.  They are nearly exact, so a link is as precise as it
   is small; were k1 x + z1 u rounded first, a link would be a multiple of the last place of x, the
   sum with u would always round to the same side, and weakly damped strings would die up to 20 %
   too soon or too late.
*/
#include "core/chain_kernel.h"

#include <stdbool.h>

#define INLINE static inline __attribute__((always_inline))

typedef float Vector __attribute__((vector_size(CHAIN_LOOP_LANES * sizeof(float)), may_alias));
typedef int32_t Mask __attribute__((vector_size(CHAIN_LOOP_LANES * sizeof(int32_t))));

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
  Mask mask;
  for (uint32_t l = 0; l < CHAIN_LOOP_LANES; ++l) {
    mask[l] = l == wall_lane ? 0 : -1;
  }
  return mask;
}

INLINE Vector hold(Vector v, Mask mask) {
  return (Vector)((Mask)v & mask);
}

INLINE Vector link_of(Vector dx, Vector du, ChainCoefs c) {
  return c.k1 * dx + c.z1 * du;
}

INLINE Vector link_ahead(const Cell* cell, ChainCoefs c) {
  return link_of(cell[1].x - cell->x, cell[1].u - cell->u, c);
}

/* sum + part, and what rounding took from it; `rest` is what it took the last time. */
INLINE Vector add_exactly(Vector sum, Vector part, Vector* rest) {
  const Vector whole = part + *rest;
  const Vector rounded = sum + whole;
  *rest = whole - (rounded - sum);
  return rounded;
}

/* Velocity first, then position with the new velocity. */
INLINE void move(Cell* cell, Cell* residue, Vector pulls, float z0, ChainMode mode) {
  const Vector force = pulls - z0 * cell->u;
  if (mode == CHAIN_EXACT) {
    cell->u = add_exactly(cell->u, force, &residue->u);
    cell->x = add_exactly(cell->x, cell->u, &residue->x);
  } else {
    const Vector u = cell->u + force;
    cell->u = u;
    cell->x += u;
  }
}

/* One step of a perfectly flexible string: each link is computed once and carried. */
INLINE void
step_flexible(Cell* cells, Cell* residues, uint32_t n_cells, ChainCoefs c, ChainMode mode) {
  const uint32_t last = n_cells - 1;
  const Vector x_behind = behind(cells[0].x);
  const Vector u_behind = behind(cells[0].u);
  Vector link_before =
      link_of(cells[0].x - before(cells[last].x), cells[0].u - before(cells[last].u), c);
  for (uint32_t j = 0; j < last; ++j) {
    const Vector link = link_ahead(&cells[j], c);
    move(&cells[j], &residues[j], link - link_before, c.z0, mode);
    link_before = link;
  }
  const Vector link = link_of(x_behind - cells[last].x, u_behind - cells[last].u, c);
  move(&cells[last], &residues[last], link - link_before, c.z0, mode);
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
INLINE void step_bending(Cell* cells,
                         Cell* residues,
                         uint32_t n_cells,
                         ChainCoefs c,
                         ChainMode mode,
                         uint32_t wall_cell,
                         Mask mask) {
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
    move(&cells[j], &residues[j], link - link_before, c.z0, mode);
    link_before = link;
  }
  const Vector link = link_of(x_behind - cells[last].x, u_behind - cells[last].u, c) +
                      c.k2 * (bow[n_cells + 1] - bow[n_cells]);
  move(&cells[last], &residues[last], link - link_before, c.z0, mode);
}

INLINE ChainCoefs advance(ChainCoefs now, ChainCoefs change) {
  return (ChainCoefs){now.k1 + change.k1, now.k2 + change.k2, now.z0 + change.z0,
                      now.z1 + change.z1};
}

INLINE void hold_wall(Cell* cell, Mask mask) {
  cell->x = hold(cell->x, mask);
  cell->u = hold(cell->u, mask);
}

/* The flags are constants wherever this is used, so nothing of them is left to test in the loop. */
INLINE void run(ChainWork work, bool is_bending, ChainMode mode, uint32_t n_taps) {
  Cell* const cells = (Cell*)work.cells;
  Cell* const residues = (Cell*)work.residues;
  const uint32_t n_cells = work.n_cells;
  const uint32_t wall_cell = work.n_masses % n_cells;
  const Mask mask = wall_mask(work.n_masses / n_cells);
  ChainCoefs now = *work.now;
  for (uint32_t n = 0; n < work.n_frames; ++n) {
    if (mode == CHAIN_MOVING) {
      now = advance(now, work.change);
    }
    if (is_bending) {
      step_bending(cells, residues, n_cells, now, mode, wall_cell, mask);
    } else {
      step_flexible(cells, residues, n_cells, now, mode);
    }
    hold_wall(&cells[wall_cell], mask);
    if (mode == CHAIN_EXACT) {
      hold_wall(&residues[wall_cell], mask);
    }
    for (uint32_t t = 0; t < n_taps; ++t) {
      const ChainReader* const reader = &work.readers[t];
      work.out[t][n] += reader->weight[0] * work.cells[reader->offset[0]] +
                        reader->weight[1] * work.cells[reader->offset[1]];
    }
  }
  *work.now = now;
}

#define LOOP(name, is_bending, mode, n_taps)                                                       \
  static void run_##name(ChainWork work) {                                                         \
    run(work, is_bending, mode, n_taps);                                                           \
  }
CHAIN_SCENES(LOOP)
#undef LOOP

#define ENTRY(name, is_bending, mode, n_taps) .loops[is_bending][mode][n_taps] = run_##name,
const ChainKernel CHAIN_LOOP_KERNEL = {
    .name = CHAIN_LOOP_NAME,
    .n_lanes = CHAIN_LOOP_LANES,
    CHAIN_SCENES(ENTRY) //
};
#undef ENTRY
#undef INLINE
