#include "tools/formats/scene_player.h"

#include <math.h>
#include <stdlib.h>

/* Below this nothing moves: [m] and [m/s]. */
static const double STILL = 1e-200;

/* What is done to a mass, at one step. A push is two of these. */
typedef struct {
  uint64_t step;
  size_t order; /* In the file */
  double value;
  uint32_t point;
  SceneAction action;
  bool is_release; /* The end of a push */
} Change;

struct ScenePlayer {
  Network* network;
  const Scene* scene;
  Change* changes; /* In the order in which they come */
  size_t n_changes;
  size_t next;
  uint32_t* n_pushes; /* On each point at present */
  double step_s;
  uint64_t step;
  uint64_t n_frames;
};

static uint64_t nearest_step(double time_s, double rate_hz) {
  return (uint64_t)llround(time_s * rate_hz);
}

/* By step; what ends before what begins; then as in the file. */
static int compare(const void* left, const void* right) {
  const Change* const a = left;
  const Change* const b = right;
  if (a->step != b->step) {
    return a->step < b->step ? -1 : 1;
  }
  if (a->is_release != b->is_release) {
    return a->is_release ? -1 : 1;
  }
  return a->order < b->order ? -1 : a->order > b->order;
}

static void add_change(ScenePlayer* player, Change change) {
  player->changes[player->n_changes++] = change;
}

static void add_event(ScenePlayer* player, const SceneEvent* event, double rate_hz) {
  Change change = {.step = nearest_step(event->time_s, rate_hz),
                   .order = player->n_changes,
                   .value = event->value,
                   .point = event->point,
                   .action = event->action};
  add_change(player, change);
  if (event->action == SCENE_PUSH) {
    const uint64_t end = nearest_step(event->time_s + event->duration_s, rate_hz);
    change.step = end > change.step ? end : change.step + 1;
    change.is_release = true;
    add_change(player, change);
  }
}

static void plan(ScenePlayer* player, double rate_hz) {
  for (size_t i = 0; i < player->scene->n_events; ++i) {
    add_event(player, &player->scene->events[i], rate_hz);
  }
  qsort(player->changes, player->n_changes, sizeof(Change), compare);
}

/* Where nothing pushes the force is 0, and not what rounding leaves of sums. */
static void push(ScenePlayer* player, const Change* change) {
  double* const force = &player->network->force[change->point];
  uint32_t* const n_pushes = &player->n_pushes[change->point];
  *n_pushes = change->is_release ? *n_pushes - 1 : *n_pushes + 1;
  *force = *n_pushes ? *force + (change->is_release ? -change->value : change->value) : 0.0;
}

static void apply(ScenePlayer* player, const Change* change) {
  switch (change->action) {
  case SCENE_DISPLACE:
    player->network->x[change->point] += change->value;
    break;
  case SCENE_STRIKE:
    player->network->v[change->point] += change->value;
    break;
  case SCENE_PUSH:
    push(player, change);
    break;
  }
}

static double listen(const ScenePlayer* player) {
  double sum = 0.0;
  for (size_t i = 0; i < player->scene->n_pickups; ++i) {
    const ScenePickup pickup = player->scene->pickups[i];
    sum += pickup.gain * player->network->x[pickup.point];
  }
  return sum;
}

ScenePlayer* scene_player_new(Scene* scene, double rate_hz) {
  ScenePlayer* const player = calloc(1, sizeof(*player));
  if (!player) {
    return NULL;
  }
  player->scene = scene;
  player->network = scene->network;
  player->step_s = 1.0 / rate_hz;
  player->n_frames = nearest_step(scene->end_s, rate_hz);
  player->n_frames += player->n_frames == 0;
  player->changes = calloc(2 * scene->n_events + 1, sizeof(Change));
  player->n_pushes = calloc(scene->network->n_points, sizeof(uint32_t));
  if (!player->changes || !player->n_pushes) {
    scene_player_free(player);
    return NULL;
  }
  network_rest(player->network);
  plan(player, rate_hz);
  return player;
}

void scene_player_free(ScenePlayer* player) {
  if (player) {
    free(player->changes);
    free(player->n_pushes);
    free(player);
  }
}

uint64_t scene_player_length(const ScenePlayer* player) {
  return player->n_frames;
}

void scene_player_run(ScenePlayer* player, double* out, uint32_t n_frames) {
  for (uint32_t i = 0; i < n_frames; ++i) {
    while (player->next < player->n_changes && player->changes[player->next].step <= player->step) {
      apply(player, &player->changes[player->next++]);
    }
    out[i] = listen(player);
    network_step(player->network, player->step_s);
    ++player->step;
  }
}

bool scene_player_settle(ScenePlayer* player) {
  const Network* const network = player->network;
  double most = 0.0;
  for (uint32_t p = 0; p < network->n_points; ++p) {
    if (!isfinite(network->x[p]) || !isfinite(network->v[p])) {
      return false;
    }
    most = fmax(most, fmax(fabs(network->x[p]), fabs(network->v[p])));
  }
  for (uint32_t p = 0; most < STILL && p < network->n_points; ++p) {
    network->x[p] = network->v[p] = 0.0;
  }
  return true;
}
