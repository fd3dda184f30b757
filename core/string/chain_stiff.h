/**
   One step of a string that bends: a part of core/string/chain_loop.h.

   The links of a cell need the curvature, and where the string is straightened the flex, of the
   cell itself and of the next, and those the position of the third cell on.  So a window goes along
   the string in front of the cell that moves, and each value is computed once, in registers.

   A hinge carries no moment: curvature and flex are nought at a wall, though their neighbours are
   not. So beyond an end they are not those of the positions there, but those of the other end, a
   lane on or back, with the wall's lane nought.
*/

/* What is known when cell j is about to move. */
typedef struct {
  Vector x2;              /* Position of cell j + 2 */
  Vector slope0;          /* x[j + 1] - x[j] */
  Vector slope1;          /* x[j + 2] - x[j + 1] */
  Vector curvature1;      /* Of cell j + 1 */
  Vector curvature_slope; /* curvature[j + 1] - curvature[j] */
  Vector flex0;           /* Of cell j */
  Vector u0;
  Vector link; /* Before cell j */
} Window;

/* What lies behind the last cell. */
typedef struct {
  Vector x;
  Vector u;
  Vector curvature;
  Vector flex;
} End;

/* Before the first cell moves, while both ends are as they were before the step. */
INLINE void begin(Window* w, End* end, const Strand* strand, const Links* links, ChainScene scene) {
  const Cell* const cells = strand->cells;
  const Cell* const far = cells + strand->n_cells - CHAIN_LEAST_CELLS;
  const size_t last = (size_t)strand->n_cells - 1;
  *end = (End){.x = behind(cells[0].x), .u = behind(cells[0].u)};
  w->u0 = cells[0].u;
  w->x2 = cells[2].x;
  w->slope0 = cells[1].x - cells[0].x;
  w->slope1 = cells[2].x - cells[1].x;
  w->curvature1 = hold_at(w->slope0 - w->slope1, 1, strand);
  Slopes slopes = {.x = cells[0].x - before(far[2].x), .u = w->u0 - before(far[2].u)};
  const Vector curvature0 = hold_at(slopes.x - w->slope0, 0, strand);
  const Vector far_slope = far[2].x - far[1].x;
  const Vector far_curvature = hold_at(far_slope - (end->x - far[2].x), last, strand);
  slopes.curvature = curvature0 - before(far_curvature);
  w->curvature_slope = w->curvature1 - curvature0;
  end->curvature = behind(curvature0);
  if (scene.elasticity >= CHAIN_STRAIGHTENED) {
    const Vector farther_curvature = hold_at((far[1].x - far[0].x) - far_slope, last - 1, strand);
    const Vector far_flex = hold_at(
        (far_curvature - farther_curvature) - (end->curvature - far_curvature), last, strand);
    w->flex0 = hold_at(slopes.curvature - w->curvature_slope, 0, strand);
    slopes.flex = w->flex0 - before(far_flex);
    end->flex = behind(w->flex0);
  }
  w->link = link_of(slopes, dither_at(0, links), links, scene);
}

/* Move cell j, the link behind which has these slopes. */
INLINE void pass(
    Window* w, Cell* cell, Slopes slopes, RealVector dither, const Links* links, ChainScene scene) {
  const Vector link = link_of(slopes, dither, links, scene);
  move(cell, cell->x, w->u0, link - w->link, links->c, scene);
  w->link = link;
}

/* Move cell j, which has another behind it, and let the window go on by one.  `is_free` where the
   wall is in none of the three cells from it on. */
INLINE void roll(Window* w,
                 size_t j,
                 Vector slope2,
                 Vector curvature2,
                 const Strand* strand,
                 const Links* links,
                 bool is_free,
                 ChainScene scene) {
  Cell* const cell = &strand->cells[j];
  const Vector u1 = cell[1].u;
  const Vector bow_slope1 = curvature2 - w->curvature1;
  Slopes slopes = {.x = w->slope0, .u = u1 - w->u0, .curvature = w->curvature_slope};
  if (scene.elasticity >= CHAIN_STRAIGHTENED) {
    const Vector flex = w->curvature_slope - bow_slope1;
    const Vector flex1 = is_free ? flex : hold_at(flex, j + 1, strand);
    slopes.flex = flex1 - w->flex0;
    w->flex0 = flex1;
  }
  pass(w, cell, slopes, dither_at(j + 1, links), links, scene);
  w->slope0 = w->slope1;
  w->slope1 = slope2;
  w->curvature1 = curvature2;
  w->curvature_slope = bow_slope1;
  w->u0 = u1;
}

/* The same, where the third cell on is at x3. */
INLINE void roll_to(Window* w,
                    size_t j,
                    Vector x3,
                    const Strand* strand,
                    const Links* links,
                    bool is_free,
                    ChainScene scene) {
  const Vector slope2 = x3 - w->x2;
  const Vector curvature = w->slope1 - slope2;
  const Vector curvature2 = is_free ? curvature : hold_at(curvature, j + 2, strand);
  w->x2 = x3;
  roll(w, j, slope2, curvature2, strand, links, is_free, scene);
}

INLINE void step_stiff(const Strand* strand, const Links* links, ChainScene scene) {
  Cell* const cells = strand->cells;
  const size_t last = (size_t)strand->n_cells - 1;
  const size_t n_free = strand->n_free;
  Window w;
  End end;
  size_t j = 0;
  begin(&w, &end, strand, links, scene);
  for (; j + 2 < n_free && j + 2 < last; ++j) {
    roll_to(&w, j, cells[j + 3].x, strand, links, true, scene);
  }
  for (; j + 2 < last; ++j) {
    roll_to(&w, j, cells[j + 3].x, strand, links, false, scene);
  }
  roll_to(&w, last - 2, end.x, strand, links, false, scene);
  roll(&w, last - 1, (Vector){0}, end.curvature, strand, links, false, scene);
  const Slopes slopes = {w.slope0, end.u - w.u0, w.curvature_slope, end.flex - w.flex0};
  pass(&w, &cells[last], slopes, dither_at_end(last + 1, links), links, scene);
}
