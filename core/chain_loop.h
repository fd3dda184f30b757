/**
   The source of every chain kernel: not a header to be included for its names, but the loops
   themselves.

   Before it is included, these say for what:
   CHAIN_LOOP_LANES    floats in a vector
   CHAIN_LOOP_BEFORE   how to shuffle (v, 0) so that lane l has lane l − 1, and the first the wall
   CHAIN_LOOP_BEHIND   how to shuffle (v, 0) so that lane l has lane l + 1, and the last the wall
   CHAIN_LOOP_KERNEL, CHAIN_LOOP_NAME   the kernel that it makes

   Glossary:  x  position;  u  scaled velocity h v;  y = k1 x + k2 L x + z1 u, what pulls on the
   neighbours; slope, pull  differences of x and of y between neighbours;  j  cell;  S  cells.
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

/* Velocity first, then position with the new velocity. */
INLINE void move(Cell* cell, Vector pulls, float z0) {
  const Vector u = cell->u + (pulls - z0 * cell->u);
  cell->u = u;
  cell->x += u;
}

INLINE Vector pull_of(const Cell* cell, ChainCoefs c) {
  return c.k1 * cell->x + c.z1 * cell->u;
}

/* One step of a perfectly flexible string: y of the cell ahead is computed once and carried. */
INLINE void step_flexible(Cell* cells, uint32_t n_cells, ChainCoefs c) {
  const uint32_t last = n_cells - 1;
  const Vector y_first = pull_of(&cells[0], c);
  const Vector y_behind = behind(y_first);
  Vector y = y_first;
  Vector pull_before = y - before(pull_of(&cells[last], c));
  for (uint32_t j = 0; j < last; ++j) {
    const Vector y_next = pull_of(&cells[j + 1], c);
    const Vector pull = y_next - y;
    move(&cells[j], pull - pull_before, c.z0);
    y = y_next;
    pull_before = pull;
  }
  move(&cells[last], (y_behind - y) - pull_before, c.z0);
}

/* One step of a string with bending: y looks two masses away, so all of it is computed first. */
INLINE void
step_bending(Cell* cells, uint32_t n_cells, ChainCoefs c, uint32_t wall_cell, Mask mask) {
  Vector y[MAX_CELLS + 2];
  const uint32_t last = n_cells - 1;
  const Vector x_behind = behind(cells[0].x);
  Vector slope_before = cells[0].x - before(cells[last].x);
  for (uint32_t j = 0; j < last; ++j) {
    const Vector slope = cells[j + 1].x - cells[j].x;
    y[j + 1] = pull_of(&cells[j], c) - c.k2 * (slope - slope_before);
    slope_before = slope;
  }
  y[n_cells] = pull_of(&cells[last], c) - c.k2 * ((x_behind - cells[last].x) - slope_before);
  /* A hinge carries no moment: L x is nought at the wall, though its neighbour is not. */
  y[wall_cell + 1] = hold(y[wall_cell + 1], mask);
  y[0] = before(y[n_cells]);
  y[n_cells + 1] = behind(y[1]);
  Vector pull_before = y[1] - y[0];
  for (uint32_t j = 0; j < n_cells; ++j) {
    const Vector pull = y[j + 2] - y[j + 1];
    move(&cells[j], pull - pull_before, c.z0);
    pull_before = pull;
  }
}

INLINE ChainCoefs advance(ChainCoefs now, ChainCoefs change) {
  return (ChainCoefs){now.k1 + change.k1, now.k2 + change.k2, now.z0 + change.z0,
                      now.z1 + change.z1};
}

/* The flags are constants wherever this is used, so nothing of them is left to test in the loop. */
INLINE void run(ChainWork work, bool is_bending, bool is_moving, uint32_t n_taps) {
  Cell* const cells = (Cell*)work.cells;
  const uint32_t n_cells = work.n_cells;
  const uint32_t wall_cell = work.n_masses % n_cells;
  const Mask mask = wall_mask(work.n_masses / n_cells);
  ChainCoefs now = *work.now;
  for (uint32_t n = 0; n < work.n_frames; ++n) {
    if (is_moving) {
      now = advance(now, work.change);
    }
    if (is_bending) {
      step_bending(cells, n_cells, now, wall_cell, mask);
    } else {
      step_flexible(cells, n_cells, now);
    }
    cells[wall_cell].x = hold(cells[wall_cell].x, mask);
    cells[wall_cell].u = hold(cells[wall_cell].u, mask);
    for (uint32_t t = 0; t < n_taps; ++t) {
      const ChainReader* const reader = &work.readers[t];
      work.out[t][n] += reader->weight[0] * work.cells[reader->offset[0]] +
                        reader->weight[1] * work.cells[reader->offset[1]];
    }
  }
  *work.now = now;
}

#define LOOP(name, is_bending, is_moving, n_taps)                                                  \
  static void run_##name(ChainWork work) {                                                         \
    run(work, is_bending, is_moving, n_taps);                                                      \
  }
CHAIN_SCENES(LOOP)
#undef LOOP

#define ENTRY(name, is_bending, is_moving, n_taps)                                                 \
  .loops[is_bending][is_moving][n_taps] = run_##name,
const ChainKernel CHAIN_LOOP_KERNEL = {
    .name = CHAIN_LOOP_NAME,
    .n_lanes = CHAIN_LOOP_LANES,
    CHAIN_SCENES(ENTRY) //
};
#undef ENTRY
#undef INLINE
