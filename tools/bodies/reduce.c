#include "tools/bodies/reduce.h"

#include "core/analysis/shapes.h"
#include "core/bank/body_read.h"
#include "core/base/maths.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* [m/s] */
static const double SOUND_SPEED = 343.0;

/* Where listeners are: to the side, and above, as parts of the way to them. */
static const double ASIDE = 0.5;
static const double ABOVE = 0.5;

/* Frequencies that differ by less are the same, relative; and parts below this are not heard. */
static const double SAME = 1e-9;
static const double UNHEARD = 1e-12;

static const double LEAST_Q = 0.51;

/* One mode as it is at the bridge and in the air. */
typedef struct {
  double omega;
  double damping;
  double bridge;
  double heard[2];
} Part;

/* The Q that a scene's lines ask for. */
static double law_at(const Scene* scene, double hz) {
  const SceneLoss* const losses = scene->losses;
  size_t i = 0;
  while (i + 2 < scene->n_losses && hz > losses[i + 1].f0_hz) {
    ++i;
  }
  if (scene->n_losses == 1) {
    return losses[0].q;
  }
  const double share =
      clamp(log(hz / losses[i].f0_hz) / log(losses[i + 1].f0_hz / losses[i].f0_hz), 0.0, 1.0);
  return losses[i].q * pow(losses[i + 1].q / losses[i].q, share);
}

static Part part_of(const Scene* scene, const Shapes* shapes, uint32_t k) {
  Part part = {.omega = shapes->omega[k], .damping = shapes->damping[k]};
  for (size_t i = 0; i < scene->n_bridge; ++i) {
    part.bridge += scene->bridge[i].gain * shapes_at(shapes, k, scene->bridge[i].point);
  }
  for (size_t i = 0; i < scene->n_radiators; ++i) {
    const SceneRadiator* const radiator = &scene->radiators[i];
    const double moved = radiator->area_m2 * shapes_at(shapes, k, radiator->point);
    for (int side = 0; side < 2; ++side) {
      const double nearer_m =
          (side ? ASIDE : -ASIDE) * radiator->place_m[0] + ABOVE * radiator->place_m[1];
      const double kappa = part.omega / SOUND_SPEED * nearer_m;
      part.heard[side] += moved * (cos(kappa) + sin(kappa));
    }
  }
  return part;
}

/* Of modes at one frequency any turn is as good: into one that has all of the bridge, and others
 * that have none of it. */
static Part join(const Part* parts, uint32_t n) {
  Part joint = {.omega = parts[0].omega};
  double square = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    square += parts[i].bridge * parts[i].bridge;
  }
  joint.bridge = sqrt(square);
  for (uint32_t i = 0; i < n && square > 0.0; ++i) {
    const double share = parts[i].bridge / joint.bridge;
    joint.damping += share * share * parts[i].damping;
    joint.heard[0] += share * parts[i].heard[0];
    joint.heard[1] += share * parts[i].heard[1];
  }
  return joint;
}

static BodyMode mode_of(const Scene* scene, const Part* part) {
  const double f0_hz = part->omega / (2.0 * PI);
  const double loss = 1.0 / law_at(scene, f0_hz) + part->damping / part->omega;
  BodyMode mode = {
      .f0_hz = f0_hz,
      .q = fmax(LEAST_Q, 1.0 / loss),
      .mass_kg = 1.0 / (part->bridge * part->bridge),
      .radiation = {part->heard[0] / part->bridge, part->heard[1] / part->bridge},
  };
  body_narrow(&mode);
  return mode;
}

static bool is_heard(const Part* part) {
  return part->omega > 2.0 * PI * REDUCE_LEAST_HZ && part->omega < 2.0 * PI * REDUCE_MOST_HZ &&
         part->bridge != 0.0 && (part->heard[0] != 0.0 || part->heard[1] != 0.0);
}

/* The modes of the network, and those beyond it. */
static uint32_t collect(const Scene* scene, const Shapes* shapes, Part* parts, BodyMode* modes) {
  const uint32_t n = shapes->n;
  uint32_t n_modes = 0;
  for (uint32_t k = 0; k < n; ++k) {
    parts[k] = part_of(scene, shapes, k);
  }
  for (uint32_t k = 0; k < n;) {
    uint32_t end = k + 1;
    while (end < n && parts[end].omega - parts[k].omega <= SAME * parts[end].omega) {
      ++end;
    }
    const Part joint = join(parts + k, end - k);
    if (is_heard(&joint)) {
      modes[n_modes++] = mode_of(scene, &joint);
    }
    k = end;
  }
  for (size_t i = 0; i < scene->n_more; ++i) {
    modes[n_modes++] = scene->more[i];
  }
  return n_modes;
}

static int compare_frequencies(const void* left, const void* right) {
  const BodyMode* const p = left;
  const BodyMode* const q = right;
  return p->f0_hz < q->f0_hz ? -1 : p->f0_hz > q->f0_hz;
}

static int compare_strengths(const void* left, const void* right) {
  const double p = body_strength(left);
  const double q = body_strength(right);
  return p > q ? -1 : p < q;
}

/* Leave out what is not heard beside the strongest. */
static uint32_t drop_unheard(BodyMode* modes, uint32_t n_modes) {
  double most = 0.0;
  uint32_t n = 0;
  for (uint32_t k = 0; k < n_modes; ++k) {
    most = fmax(most, body_strength(&modes[k]));
  }
  for (uint32_t k = 0; k < n_modes; ++k) {
    if (body_strength(&modes[k]) > UNHEARD * most) {
      modes[n++] = modes[k];
    }
  }
  return n;
}

Status reduce_modes(const Scene* scene, BodyMode** modes, uint32_t* n_modes) {
  Shapes shapes;
  const Status status = shapes_solve(scene->network, &shapes);
  if (status) {
    return status;
  }
  Part* const parts = malloc(shapes.n * sizeof(Part));
  BodyMode* const all = malloc((shapes.n + scene->n_more) * sizeof(BodyMode));
  uint32_t n = 0;
  if (parts && all) {
    n = drop_unheard(all, collect(scene, &shapes, parts, all));
    qsort(all, n, sizeof(BodyMode), compare_frequencies);
  }
  const bool has_room = parts && all;
  free(parts);
  shapes_clear(&shapes);
  if (n == 0) {
    free(all);
    return has_room ? STATUS_EMPTY : STATUS_NO_MEMORY;
  }
  *modes = all;
  *n_modes = n;
  return STATUS_OK;
}

Status reduce_scene(const Scene* scene, Body* body, Reduction* reduction) {
  BodyMode* modes = NULL;
  uint32_t n_modes = 0;
  const Status status = reduce_modes(scene, &modes, &n_modes);
  if (status) {
    return status;
  }
  Reduction found = {.n_masses = scene->network->n_masses, .n_heard = n_modes};
  Body reduced = {.n_modes = least(n_modes, BODY_MAX_MODES)};
  double all = 0.0;
  double lost = 0.0;
  qsort(modes, n_modes, sizeof(BodyMode), compare_strengths);
  for (uint32_t k = n_modes; k > 0; --k) {
    all += body_strength(&modes[k - 1]);
    lost = k > reduced.n_modes ? all : lost;
  }
  found.lost = lost / all;
  memcpy(reduced.modes, modes, reduced.n_modes * sizeof(BodyMode));
  free(modes);
  body_sort(&reduced);
  body_level(&reduced);
  *body = reduced;
  if (reduction) {
    *reduction = found;
  }
  return STATUS_OK;
}
