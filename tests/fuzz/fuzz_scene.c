/* Any bytes are a scene that can be played, or are refused with a word on which line and why. */
#include "tests/fuzz/fuzz.h"
#include "tools/formats/scene_player.h"

#include <math.h>
#include <stdlib.h>

enum { N_FRAMES = 256, MOST_FRAMES = 20000 };

/* Points and links stepped, after which it is enough. */
static const double MOST_WORK = 1e6;

static void claim_scene(const Scene* scene, ScenePurpose purpose) {
  const uint32_t n_points = scene->network->n_points;
  FUZZ_CLAIM(scene->rate_hz > 0.0 && isfinite(scene->rate_hz));
  FUZZ_CLAIM(isfinite(scene->end_s) && scene->end_s >= 0.0);
  FUZZ_CLAIM(purpose != SCENE_FOR_SOUND || (scene->end_s > 0.0 && scene->n_pickups > 0));
  FUZZ_CLAIM(purpose != SCENE_FOR_BODY ||
             (scene->n_bridge > 0 && scene->n_radiators > 0 && scene->n_losses > 0));
  for (size_t i = 0; i < scene->n_pickups; ++i) {
    FUZZ_CLAIM(scene->pickups[i].point < n_points && isfinite(scene->pickups[i].gain));
  }
  for (size_t i = 0; i < scene->n_events; ++i) {
    const SceneEvent* const event = &scene->events[i];
    FUZZ_CLAIM(event->point < n_points && event->line >= 1 && isfinite(event->value));
    FUZZ_CLAIM(event->time_s >= 0.0 && (!(scene->end_s > 0.0) || event->time_s < scene->end_s));
    FUZZ_CLAIM(event->action != SCENE_PUSH || event->duration_s > 0.0);
  }
}

/* What is unstable may well explode; that it is finite is no claim of the player's. */
static void play(Scene* scene) {
  double out[N_FRAMES];
  ScenePlayer* const player = scene_player_new(scene, scene->rate_hz);
  if (player) {
    const Network* const network = scene->network;
    const uint64_t length = scene_player_length(player);
    const double size = (double)network->n_points + network->springs.n + network->dampers.n +
                        network->levers.n_terms;
    FUZZ_CLAIM(length >= 1);
    for (double at = 0.0; at < fmin((double)length, MOST_FRAMES) && at * size <= MOST_WORK;
         at += N_FRAMES) {
      scene_player_run(player, out, N_FRAMES);
      (void)scene_player_settle(player);
    }
    scene_player_free(player);
  }
}

static bool read_for(const char* path, ScenePurpose purpose, const uint8_t* bytes, size_t n_bytes) {
  char* const error = malloc(SCENE_ERROR_SIZE);
  Scene* const scene = scene_new(path, purpose, error, SCENE_ERROR_SIZE);
  const bool is_read = scene;
  if (!scene) {
    fuzz_claim_message(error, path, true, bytes, n_bytes);
  } else {
    claim_scene(scene, purpose);
    if (purpose == SCENE_FOR_SOUND) {
      play(scene);
    }
  }
  scene_free(scene);
  free(error);
  return is_read;
}

/* What can be heard, or is a body, has modes. */
void fuzz_one(const uint8_t* bytes, size_t n_bytes) {
  const char* const path = fuzz_file(bytes, n_bytes);
  const bool has_modes = read_for(path, SCENE_FOR_MODES, bytes, n_bytes);
  FUZZ_CLAIM(!read_for(path, SCENE_FOR_SOUND, bytes, n_bytes) || has_modes);
  FUZZ_CLAIM(!read_for(path, SCENE_FOR_BODY, bytes, n_bytes) || has_modes);
}
