/**
   The source of all chain loops: not a header to be included for its names, but the loops
   themselves.

   Before it is included, these say for what:
   CHAIN_LOOP_NUMBER    float, double, or int32_t for fixed point
   CHAIN_LOOP_REAL      what is computed with: float or double
   CHAIN_LOOP_IS_FIXED  whether the numbers are in fixed point; if so:
   CHAIN_LOOP_WHOLE(v)  the nearest whole numbers to a vector of float
   CHAIN_LOOP_LANES     numbers in a vector
   CHAIN_LOOP_BEFORE    how to shuffle (v, 0) so that lane l has lane l − 1, and the first the wall
   CHAIN_LOOP_BEHIND    how to shuffle (v, 0) so that lane l has lane l + 1, and the last the wall
   CHAIN_LOOP_NAME      the loops that it makes

   Glossary:  x  position;  u  scaled velocity h v;  link  what pulls two neighbours together, k1 Δx
   + z1 Δu + k2 Δ(L x) + k3 Δ(L² x), Δ being the difference between neighbours;  curvature  L x, how
   far a mass is from the middle of its neighbours;  flex  L² x;  j  cell.

   The differences come before the products: they are nearly exact, so a link is as precise as it is
   small.  In fixed point they are exact, and so is all that moves; only a link is rounded.
*/
#include "core/string/chain_step.h"

#include <math.h>

INLINE Coefs narrow(StringCoefs wide) {
  return (Coefs){
      .k1 = (Real)wide.k1,
      .k2 = (Real)wide.k2,
      .k3 = (Real)wide.k3,
      .z0 = (Real)wide.z0,
      .z1 = (Real)wide.z1,
  };
}

/*
  The string's own clock is bent, not its springs (core/string/chain.h): what goes on is x and v = u
  − ½ K x, v faster by ρ.  The step that does that is one with other coefficients, for

      u' = ρ (u − ½ K x) + ½ K' x − K' x = u − (1 − ρ) u − ½ (ρ K + K') x.

  What is left of the motion in a step is `kept` of it, x and u alike.
*/
INLINE Coefs bent(StringCoefs from, StringCoefs to, double ratio, double kept) {
  const double half = 0.5 * kept;
  const double left = kept * ratio;
  Coefs c = narrow((StringCoefs){
      .k1 = half * (ratio * from.k1 + to.k1),
      .k2 = half * (ratio * from.k2 + to.k2),
      .k3 = half * (ratio * from.k3 + to.k3),
      .z0 = 1.0 - left * (1.0 - to.z0),
      .z1 = left * to.z1,
  });
  c.kept = (Real)kept;
  return c;
}

/* How much faster the clock goes after than before; 1 where there is none, for it does not swing.
 */
INLINE double ratio_of(StringCoefs before, StringCoefs after, double lambda1) {
  const double from = chain_pace_of(before, lambda1);
  const double to = chain_pace_of(after, lambda1);
  return from > 0.0 && to > 0.0 ? sqrt(to / from) : 1.0;
}

INLINE StringCoefs advance(StringCoefs now, StringCoefs change) {
  return (StringCoefs){
      .k1 = now.k1 + change.k1,
      .k2 = now.k2 + change.k2,
      .k3 = now.k3 + change.k3,
      .z0 = now.z0 + change.z0,
      .z1 = now.z1 + change.z1,
  };
}

INLINE StringCoefs scaled(StringCoefs c, double factor) {
  return (StringCoefs){factor * c.k1, factor * c.k2, factor * c.z0, factor * c.z1, factor * c.k3};
}

INLINE void go_on(Strand* strand, const ChainWork* work) {
  const StringCoefs to = advance(strand->wide, strand->change);
  strand->change = scaled(strand->change, work->haste);
  const double ratio = ratio_of(strand->wide, to, work->lambda1);
  strand->now = bent(strand->wide, to, ratio, work->kept);
  strand->wide = to;
}

/* Of a velocity in fixed point, what is before it in its cell is read, too: its position. */
INLINE float read_tap(const Number* numbers, const ChainReader* reader) {
  const float read = (float)((Real)reader->weight[0] * (Real)numbers[reader->offset[0]] +
                             (Real)reader->weight[1] * (Real)numbers[reader->offset[1]]);
  if (CHAIN_LOOP_IS_FIXED && reader->lean != 0.0f) {
    const float x0 = (float)numbers[reader->offset[0] - CHAIN_LOOP_LANES];
    const float x1 = (float)numbers[reader->offset[1] - CHAIN_LOOP_LANES];
    return read + reader->lean * (reader->weight[0] * x0 + reader->weight[1] * x1);
  }
  return read;
}

INLINE Strand strand_of(const ChainWork* work) {
  const uint32_t wall_lane = work->n_masses / work->n_cells;
  const uint32_t wall_cell = work->n_masses % work->n_cells;
  return (Strand){
      .cells = work->cells,
      .n_cells = work->n_cells,
      .wall_cell = wall_cell,
      .n_free = wall_lane < CHAIN_LOOP_LANES ? wall_cell : work->n_cells,
      .mask = wall_mask(wall_lane),
      .wide = *work->now,
      .change = *work->change,
      .now = narrow(*work->now),
      .gain = CHAIN_LOOP_IS_FIXED ? *work->gain : 1.0,
      .chance = CHAIN_LOOP_IS_FIXED ? *work->chance : 0,
  };
}

/* One frame of one string. */
INLINE void
run_frame(Strand* strand, const ChainWork* work, uint32_t n, float* const* out, ChainScene scene) {
  if (scene.is_moving) {
    go_on(strand, work);
  }
  step(strand, scene);
  if (CHAIN_LOOP_IS_FIXED && scene.damping != CHAIN_UNDAMPED) {
    strand->gain *= work->fade;
  }
  for (uint32_t t = 0; t < scene.n_taps; ++t) {
    const float read = read_tap((const Number*)strand->cells, &work->readers[t]);
    out[t][n] += CHAIN_LOOP_IS_FIXED ? (float)strand->gain * read : read;
  }
}

INLINE void run(const ChainWork* works,
                uint32_t n_works,
                uint32_t n_frames,
                float* const* out,
                ChainScene scene) {
  Strand strands[CHAIN_MAX_BATCH];
  for (uint32_t w = 0; w < n_works; ++w) {
    strands[w] = strand_of(&works[w]);
  }
  for (uint32_t n = 0; n < n_frames; ++n) {
    for (uint32_t w = 0; w < n_works; ++w) {
      run_frame(&strands[w], &works[w], n, out, scene);
    }
  }
  for (uint32_t w = 0; w < n_works; ++w) {
    if (scene.is_moving) {
      *works[w].now = strands[w].wide;
      *works[w].change = strands[w].change;
    }
    if (CHAIN_LOOP_IS_FIXED) {
      *works[w].gain = strands[w].gain;
      *works[w].chance = strands[w].chance;
    }
  }
}

INLINE double sum_of(RealVector v) {
  double sum = 0.0;
  for (uint32_t l = 0; l < CHAIN_LOOP_LANES; ++l) {
    sum += (double)v[l];
  }
  return sum;
}

/* A field over the string, from [1] on, and what lies before and behind. */
typedef RealVector Field[CHAIN_MAX_MASSES / CHAIN_LOOP_LANES + 2];

INLINE void close_field(Field field, uint32_t n_cells) {
  const RealVector wall = {0};
  field[0] = __builtin_shufflevector(field[n_cells], wall, CHAIN_LOOP_BEFORE);
  field[n_cells + 1] = __builtin_shufflevector(field[1], wall, CHAIN_LOOP_BEHIND);
}

/* A hinge carries no moment, so the wall has none, where it is a mass that is held. */
INLINE void bend(Field out, const Field in, uint32_t n_masses, uint32_t n_cells) {
  const uint32_t wall = n_masses % n_cells + 1;
  uint32_t j = 1;
  do {
    out[j] = (in[j] - in[j - 1]) - (in[j + 1] - in[j]);
  } while (++j <= n_cells);
  out[wall] = (RealVector)((Mask)out[wall] & wall_mask(n_masses / n_cells));
  close_field(out, n_cells);
}

/* Σ (Δ field)², with the link from the last lane to the wall. */
INLINE double sum_of_slopes(const Field field, uint32_t n_cells) {
  RealVector sum = {0};
  for (uint32_t j = 1; j <= n_cells; ++j) {
    const RealVector slope = field[j] - field[j - 1];
    sum += slope * slope;
  }
  const double end = (double)field[n_cells][CHAIN_LOOP_LANES - 1];
  return sum_of(sum) + end * end;
}

INLINE double sum_of_squares(const Field field, uint32_t n_cells) {
  RealVector sum = {0};
  for (uint32_t j = 1; j <= n_cells; ++j) {
    sum += field[j] * field[j];
  }
  return sum_of(sum);
}

static ChainSums sum(const void* memory, uint32_t n_masses, uint32_t n_cells) {
  const Cell* const cells = memory;
  Field y; /* Half a step back, where x and u are of the same time */
  Field u;
  Field curvature;
  RealVector xx = {0};
  RealVector xu = {0};
  for (uint32_t j = 0; j < n_cells; ++j) {
    const RealVector x = real(cells[j].x);
    u[j + 1] = real(cells[j].u);
    y[j + 1] = x - (Real)0.5 * u[j + 1];
    xx += x * x;
    xu += x * u[j + 1];
  }
  close_field(y, n_cells);
  close_field(u, n_cells);
  ChainSums sums = {
      .xx = sum_of(xx),
      .xu = sum_of(xu),
      .uu = sum_of_squares(u, n_cells),
      .slope = sum_of_slopes(y, n_cells),
  };
  bend(curvature, u, n_masses, n_cells);
  sums.curvature = sum_of_squares(curvature, n_cells);
  bend(curvature, y, n_masses, n_cells);
  sums.twist = sum_of_slopes(curvature, n_cells);
  return sums;
}

#if CHAIN_LOOP_IS_FIXED
/*
  The air is taken out of the loop: what dampers to the ground do to all modes alike, ρ a step, is
  in the gain, x = gain X.  So a step ago it was x − u = (gain/ρ) (X − U).
*/
static void take(void* memory, uint32_t n_cells, double gain, double fade) {
  Cell* const cells = memory;
  const Real of_x = (Real)((1.0 - fade) / gain);
  const Real of_u = (Real)(fade / gain);
  const Real scale = (Real)(1.0 / gain);
  for (uint32_t j = 0; j < n_cells; ++j) {
    const RealVector x = (RealVector)cells[j].x;
    const RealVector u = (RealVector)cells[j].u;
    cells[j] = (Cell){number(scale * x), number(of_x * x + of_u * u)};
  }
}

static void give(void* memory, uint32_t n_cells, double gain, double fade) {
  Cell* const cells = memory;
  const Real of_x = (Real)(gain - gain / fade);
  const Real of_u = (Real)(gain / fade);
  const Real scale = (Real)gain;
  for (uint32_t j = 0; j < n_cells; ++j) {
    const RealVector x = real(cells[j].x);
    const RealVector u = real(cells[j].u);
    cells[j] = (Cell){(Vector)(scale * x), (Vector)(of_x * x + of_u * u)};
  }
}
#endif

#define LOOP(damping, elasticity, is_moving, n_taps)                                               \
  static void run_##damping##_##elasticity##_##is_moving##_##n_taps(                               \
      const ChainWork* works, uint32_t n_works, uint32_t n_frames, float* const* out) {            \
    run(works, n_works, n_frames, out,                                                             \
        (ChainScene){CHAIN_##damping, CHAIN_##elasticity, is_moving, n_taps});                     \
  }
CHAIN_STILL_SCENES(LOOP)
#if !CHAIN_LOOP_IS_FIXED
CHAIN_MOVING_SCENES(LOOP)
#endif
#undef LOOP

#define ENTRY(damping, elasticity, is_moving, n_taps)                                              \
  .loops[CHAIN_##damping][CHAIN_##elasticity][is_moving][n_taps] =                                 \
      run_##damping##_##elasticity##_##is_moving##_##n_taps,
const ChainLoops CHAIN_LOOP_NAME = {
    .number_size = sizeof(Number),
    .n_lanes = CHAIN_LOOP_LANES,
    .sum = sum,
#if CHAIN_LOOP_IS_FIXED
    .take = take,
    .give = give,
#else
    CHAIN_MOVING_SCENES(ENTRY) //
#endif
    CHAIN_STILL_SCENES(ENTRY) //
};
#undef ENTRY
#undef INLINE
