#include "core/chain.h"

#include <assert.h>
#include <math.h>
#include <string.h>

typedef int32_t ChainMask __attribute__((vector_size(CHAIN_LANES * sizeof(int32_t))));

/* Where a mass, as a float among the floats of the cells, is. */
enum { CELL_FLOATS = sizeof(ChainCell) / sizeof(float) };

/* A tap resolved to floats among the cells. */
typedef struct {
  size_t offset[2];
  float weight[2];
} Reader;

/* What one scene's loop needs. */
typedef struct {
  Chain* chain;
  uint32_t n_frames;
  const Reader* readers;
  float* const* out;
} Work;

static size_t offset_of(const Chain* chain, uint32_t i) {
  return (size_t)(i % chain->n_cells) * CELL_FLOATS + i / chain->n_cells;
}

static float* floats(const Chain* chain) {
  return (float*)chain->cells;
}

static ChainCoefs narrow(StringCoefs coefs) {
  return (ChainCoefs){(float)coefs.k1, (float)coefs.k2, (float)coefs.z0, (float)coefs.z1};
}

/* Lane l takes lane l − 1: what lies before the first cell.  Lane 0 takes the wall. */
static inline __attribute__((always_inline)) ChainVector before(ChainVector v) {
  const ChainVector wall = {0};
  return __builtin_shufflevector(v, wall, 8, 0, 1, 2, 3, 4, 5, 6);
}

/* Lane l takes lane l + 1: what lies behind the last cell.  The last lane takes the wall. */
static inline __attribute__((always_inline)) ChainVector behind(ChainVector v) {
  const ChainVector wall = {0};
  return __builtin_shufflevector(v, wall, 1, 2, 3, 4, 5, 6, 7, 8);
}

/* All ones but for the wall, where the wall is a lane of the cell after the last mass. */
static ChainMask wall_mask(const Chain* chain) {
  const uint32_t lane = chain->n_masses / chain->n_cells;
  ChainMask mask;
  for (uint32_t l = 0; l < CHAIN_LANES; ++l) {
    mask[l] = l == lane ? 0 : -1;
  }
  return mask;
}

static inline __attribute__((always_inline)) ChainVector hold(ChainVector v, ChainMask mask) {
  return (ChainVector)((ChainMask)v & mask);
}

/* One step of a perfectly flexible string: y of the cell ahead is computed once and carried. */
static inline __attribute__((always_inline)) void step_flexible(Chain* chain, const ChainCoefs c) {
  ChainCell* const cells = chain->cells;
  const uint32_t last = chain->n_cells - 1;
  const ChainVector y_last = c.k1 * cells[last].x + c.z1 * cells[last].u;
  const ChainVector y_first = c.k1 * cells[0].x + c.z1 * cells[0].u;
  const ChainVector y_behind = behind(y_first);

  ChainVector y = y_first;
  ChainVector pull_before = y - before(y_last);
  for (uint32_t j = 0; j < last; ++j) {
    const ChainVector y_next = c.k1 * cells[j + 1].x + c.z1 * cells[j + 1].u;
    const ChainVector pull = y_next - y;
    const ChainVector u = cells[j].u + ((pull - pull_before) - c.z0 * cells[j].u);
    cells[j].u = u;
    cells[j].x += u;
    y = y_next;
    pull_before = pull;
  }
  const ChainVector pull = y_behind - y;
  const ChainVector u = cells[last].u + ((pull - pull_before) - c.z0 * cells[last].u);
  cells[last].u = u;
  cells[last].x += u;
}

/* One step of a string with bending: y looks two masses away, so it is computed for all of them
 * first. */
static inline __attribute__((always_inline)) void
step_bending(Chain* chain, const ChainCoefs c, uint32_t wall_cell, ChainMask mask) {
  ChainCell* const cells = chain->cells;
  const uint32_t n = chain->n_cells;
  ChainVector y[CHAIN_MAX_CELLS + 2];

  ChainVector x = cells[0].x;
  ChainVector slope_before = x - before(cells[n - 1].x);
  for (uint32_t j = 0; j < n; ++j) {
    const ChainVector x_next = j + 1 < n ? cells[j + 1].x : behind(cells[0].x);
    const ChainVector slope = x_next - x;
    y[j + 1] = (c.k1 * x + c.z1 * cells[j].u) - c.k2 * (slope - slope_before);
    x = x_next;
    slope_before = slope;
  }
  /* A hinge carries no moment: L x is nought at the wall, though its neighbour is not. */
  y[wall_cell + 1] = hold(y[wall_cell + 1], mask);
  y[0] = before(y[n]);
  y[n + 1] = behind(y[1]);

  for (uint32_t j = 0; j < n; ++j) {
    const ChainVector pulls = (y[j + 2] - y[j + 1]) - (y[j + 1] - y[j]);
    const ChainVector u = cells[j].u + (pulls - c.z0 * cells[j].u);
    cells[j].u = u;
    cells[j].x += u;
  }
}

static inline __attribute__((always_inline)) void advance(ChainCoefs* now, ChainCoefs change) {
  now->k1 += change.k1;
  now->k2 += change.k2;
  now->z0 += change.z0;
  now->z1 += change.z1;
}

/* The loop itself.  The three flags are constants wherever it is used, so that each scene does what
 * it needs alone. */
static inline __attribute__((always_inline)) void
run(Work work, bool is_bending, bool is_moving, uint32_t n_taps) {
  Chain* const chain = work.chain;
  const float* const x = floats(chain);
  const uint32_t wall_cell = chain->n_masses % chain->n_cells;
  const ChainMask mask = wall_mask(chain);
  ChainCoefs now = chain->now;
  for (uint32_t n = 0; n < work.n_frames; ++n) {
    if (is_moving) {
      advance(&now, chain->change);
    }
    if (is_bending) {
      step_bending(chain, now, wall_cell, mask);
    } else {
      step_flexible(chain, now);
    }
    ChainCell* const wall = &chain->cells[wall_cell];
    wall->x = hold(wall->x, mask);
    wall->u = hold(wall->u, mask);
    for (uint32_t t = 0; t < n_taps; ++t) {
      const Reader* const reader = &work.readers[t];
      work.out[t][n] += reader->weight[0] * x[reader->offset[0]] + //
                        reader->weight[1] * x[reader->offset[1]];
    }
  }
  chain->now = now;
}

/* X(name, is_bending, is_moving, n_taps): every scene that a string can be in. */
#define SCENES(X)                                                                                  \
  X(flexible_still_1, false, false, 1)                                                             \
  X(flexible_still_2, false, false, 2)                                                             \
  X(flexible_still_4, false, false, 4)                                                             \
  X(flexible_moving_1, false, true, 1)                                                             \
  X(flexible_moving_2, false, true, 2)                                                             \
  X(flexible_moving_4, false, true, 4)                                                             \
  X(bending_still_1, true, false, 1)                                                               \
  X(bending_still_2, true, false, 2)                                                               \
  X(bending_still_4, true, false, 4)                                                               \
  X(bending_moving_1, true, true, 1)                                                               \
  X(bending_moving_2, true, true, 2)                                                               \
  X(bending_moving_4, true, true, 4)

#define SCENE_FUNCTION(name, is_bending, is_moving, n_taps)                                        \
  static void run_##name(Work work) {                                                              \
    run(work, is_bending, is_moving, n_taps);                                                      \
  }
SCENES(SCENE_FUNCTION)
#undef SCENE_FUNCTION

typedef struct {
  bool is_bending;
  bool is_moving;
  uint32_t n_taps;
  void (*run)(Work work);
} Scene;

#define SCENE_ENTRY(name, is_bending, is_moving, n_taps)                                           \
  {is_bending, is_moving, n_taps, run_##name},
static const Scene scenes[] = {SCENES(SCENE_ENTRY)};
#undef SCENE_ENTRY

static const Scene* scene_of(const Chain* chain, uint32_t n_taps) {
  const bool is_moving = chain->n_gliding > 0;
  const bool is_bending = chain->now.k2 != 0.0f || (is_moving && chain->goal.k2 != 0.0f);
  for (size_t i = 0; i < sizeof(scenes) / sizeof(scenes[0]); ++i) {
    const Scene* const scene = &scenes[i];
    if (scene->is_bending == is_bending && scene->is_moving == is_moving &&
        scene->n_taps == n_taps) {
      return scene;
    }
  }
  assert(false && "every number of taps has its scenes");
  return &scenes[0];
}

uint32_t chain_cells(uint32_t n_masses) {
  return (n_masses + CHAIN_LANES - 1) / CHAIN_LANES;
}

void chain_init(Chain* chain, ChainCell* cells, uint32_t n_masses) {
  assert(n_masses >= 1 && n_masses <= CHAIN_MAX_MASSES);
  *chain = (Chain){.cells = cells, .n_masses = n_masses, .n_cells = chain_cells(n_masses)};
  chain_rest(chain);
}

void chain_rest(Chain* chain) {
  memset(chain->cells, 0, chain->n_cells * sizeof(ChainCell));
}

void chain_set(Chain* chain, StringCoefs coefs) {
  chain->now = chain->goal = narrow(coefs);
  chain->n_gliding = 0;
}

void chain_glide(Chain* chain, StringCoefs coefs, uint32_t n_frames) {
  if (n_frames == 0) {
    chain_set(chain, coefs);
    return;
  }
  const float share = 1.0f / (float)n_frames;
  chain->goal = narrow(coefs);
  chain->n_gliding = n_frames;
  chain->change = (ChainCoefs){
      .k1 = (chain->goal.k1 - chain->now.k1) * share,
      .k2 = (chain->goal.k2 - chain->now.k2) * share,
      .z0 = (chain->goal.z0 - chain->now.z0) * share,
      .z1 = (chain->goal.z1 - chain->now.z1) * share,
  };
}

float chain_position(const Chain* chain, uint32_t i) {
  return floats(chain)[offset_of(chain, i)];
}

float chain_velocity(const Chain* chain, uint32_t i) {
  return floats(chain)[offset_of(chain, i) + CHAIN_LANES];
}

void chain_place(Chain* chain, uint32_t i, float x, float u) {
  floats(chain)[offset_of(chain, i)] = x;
  floats(chain)[offset_of(chain, i) + CHAIN_LANES] = u;
}

void chain_push(Chain* chain, uint32_t i, float u) {
  floats(chain)[offset_of(chain, i) + CHAIN_LANES] += u;
}

float chain_amplitude(const Chain* chain, double a1) {
  ChainVector xx = {0};
  ChainVector uu = {0};
  for (uint32_t j = 0; j < chain->n_cells; ++j) {
    xx += chain->cells[j].x * chain->cells[j].x;
    uu += chain->cells[j].u * chain->cells[j].u;
  }
  double sum = 0.0;
  for (uint32_t l = 0; l < CHAIN_LANES; ++l) {
    sum += (double)xx[l] + (double)uu[l] / a1;
  }
  return (float)sqrt(2.0 * sum / (chain->n_masses + 1.0));
}

void chain_run(
    Chain* chain, uint32_t n_frames, const ChainTap* taps, uint32_t n_taps, float* const* out) {
  Reader readers[CHAIN_MAX_TAPS];
  for (uint32_t t = 0; t < n_taps; ++t) {
    for (int e = 0; e < 2; ++e) {
      readers[t].offset[e] = offset_of(chain, taps[t].mass[e]);
      readers[t].weight[e] = taps[t].weight[e];
    }
  }
  const uint32_t n_moving = chain->n_gliding < n_frames ? chain->n_gliding : n_frames;
  if (n_moving > 0) {
    scene_of(chain, n_taps)->run((Work){chain, n_moving, readers, out});
    chain->n_gliding -= n_moving;
    if (chain->n_gliding == 0) {
      chain->now = chain->goal;
    }
  }
  if (n_moving < n_frames) {
    float* rest[CHAIN_MAX_TAPS];
    for (uint32_t t = 0; t < n_taps; ++t) {
      rest[t] = out[t] + n_moving;
    }
    scene_of(chain, n_taps)->run((Work){chain, n_frames - n_moving, readers, rest});
  }
}
