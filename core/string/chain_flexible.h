/**
   One step of a string whose masses know their neighbours alone: a part of
   core/string/chain_loop.h.
*/

/* Each link is computed once and carried. */
INLINE void step_flexible(Strand* strand, const Links* links, ChainScene scene) {
  Cell* const cells = strand->cells;
  const Coefs* const c = links->c;
  const size_t last = (size_t)strand->n_cells - 1;
  Vector x = cells[0].x;
  Vector u = cells[0].u;
  const Vector x_end = behind(x);
  const Vector u_end = behind(u);
  const Slopes first = {.x = x - before(cells[last].x), .u = u - before(cells[last].u)};
  Vector link_before = link_of(first, dither_at(0, links), links, scene);
#pragma GCC unroll 4
  for (size_t j = 0; j < last; ++j) {
    const Vector x_next = cells[j + 1].x;
    const Vector u_next = cells[j + 1].u;
    const Slopes slopes = {.x = x_next - x, .u = u_next - u};
    const Vector link = link_of(slopes, dither_at(j + 1, links), links, scene);
    move(&cells[j], x, u, link - link_before, c, scene);
    link_before = link;
    x = x_next;
    u = u_next;
  }
  const Slopes end = {.x = x_end - x, .u = u_end - u};
  const Vector link = link_of(end, dither_at_end(last + 1, links), links, scene);
  move(&cells[last], x, u, link - link_before, c, scene);
}
