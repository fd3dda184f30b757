#define _POSIX_C_SOURCE 200809L

#include "tools/commands/scene_render.h"

#include "core/analysis/modes.h"
#include "tools/formats/scene_player.h"

#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <time.h>

enum {
  BLOCK = 256,              // Frames between two looks at the whole
  MAX_MASSES_TO_NAME = 1000 // Above this the mode that grows is not sought
};

typedef struct {
  ScenePlayer* player;
  double rate_hz;
  SoundFile* sound;
  PlayResult* result;
  char* error;
  size_t error_size;
  double out[BLOCK];
  float frames[2 * BLOCK];
} Playing;

__attribute__((format(printf, 2, 3))) static bool
fail(const Playing* playing, const char* format, ...) {
  va_list args;
  va_start(args, format);
  (void)vsnprintf(playing->error, playing->error_size, format, args);
  va_end(args);
  return false;
}

static double now_s(void) {
  struct timespec now = {0};
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool is_interrupted(void) {
  sigset_t pending;
  return !sigpending(&pending) &&
         (sigismember(&pending, SIGINT) == 1 || sigismember(&pending, SIGTERM) == 1);
}

static bool fail_at(const Playing* playing, uint64_t frame) {
  return fail(playing,
              "found a number that is not finite at %.6f s, expected a scene that is stable "
              "or ends before",
              (double)frame / playing->rate_hz);
}

static bool run(Playing* playing, uint32_t n) {
  const double start_s = now_s();
  scene_player_run(playing->player, playing->out, n);
  playing->result->run_s += now_s() - start_s;
  for (uint32_t i = 0; i < n; ++i) {
    const float sample = (float)playing->out[i];
    if (!isfinite(sample)) {
      return fail_at(playing, playing->result->n_frames + i);
    }
    playing->frames[2 * i] = playing->frames[2 * i + 1] = sample;
    playing->result->peak = fmaxf(playing->result->peak, fabsf(sample));
  }
  playing->result->n_frames += n;
  return scene_player_settle(playing->player) || fail_at(playing, playing->result->n_frames);
}

static void show_progress(uint64_t at, uint64_t length, int* shown) {
  const int percent = (int)(100.0 * (double)at / (double)length);
  if (percent != *shown) {
    (void)fprintf(stderr, "\r%3d %%", percent);
    *shown = percent;
  }
}

static bool play_all(Playing* playing, bool shows_progress) {
  const uint64_t length = scene_player_length(playing->player);
  int shown = -1;
  bool is_ok = true;
  while (is_ok && playing->result->n_frames < length) {
    const uint64_t left = length - playing->result->n_frames;
    const uint32_t n = left < BLOCK ? (uint32_t)left : BLOCK;
    is_ok = is_interrupted() ? fail(playing, "interrupted") : run(playing, n);
    if (is_ok && !soundfile_write(playing->sound, playing->frames, n)) {
      is_ok = fail(playing, "sound not written: the disk is full, or a WAV file would pass 4 GiB");
    }
    if (shows_progress) {
      show_progress(playing->result->n_frames, length, &shown);
    }
  }
  if (shown >= 0) {
    (void)fprintf(stderr, "\r     \r");
  }
  return is_ok;
}

bool scene_render_is_scene(const char* path) {
  const char* const ending = strrchr(path, '.');
  return ending && !strcasecmp(ending, ".scene");
}

/* The mode that grows most, from 1; 0 if it was not found. */
static uint32_t find_growing(const Scene* scene, double rate_hz, Mode* growing) {
  Modes* modes = NULL;
  uint32_t found = 0;
  if (scene->network->n_masses > MAX_MASSES_TO_NAME ||
      modes_solve(scene->network, rate_hz, 0, &modes)) {
    return 0;
  }
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    if (!found || modes->mode[k].radius > growing->radius) {
      found = k + 1;
      *growing = modes->mode[k];
    }
  }
  modes_free(modes);
  return found;
}

/* The least whole rate that is stable [Hz]. */
static double sufficient_rate(double largest_step_s) {
  const double rate_hz = ceil(1.0 / largest_step_s);
  return 1.0 / rate_hz <= largest_step_s ? rate_hz : rate_hz + 1.0;
}

static int
refuse(const Args* args, const char* path, const Scene* scene, double rate_hz, double step_s) {
  char which[128] = "a mode grows";
  Mode growing = {0};
  const uint32_t mode = find_growing(scene, rate_hz, &growing);
  if (mode) {
    (void)snprintf(which, sizeof(which), "mode %lu of %lu grows %.3g-fold a step",
                   (unsigned long)mode, (unsigned long)scene->network->n_masses, growing.radius);
  }
  return args_fail(
      args, SCENE_UNSTABLE,
      "%s: found it unstable at %.12g Hz, where %s, expected a rate of %.0f Hz or more; "
      "--anyway renders it as it is",
      path, rate_hz, which, sufficient_rate(step_s));
}

int scene_render_judge(const Args* args, const char* path, const Scene* scene, double rate_hz) {
  double step_s = 0.0;
  Status status = modes_largest_step(scene->network, &step_s);
  status = !status && !(step_s > 0.0) ? STATUS_ILL_SCALED : status;
  if (status) {
    return args_fail(args, ARGS_FAILURE,
                     "%s: could not judge whether it is stable: %s; --anyway renders it unjudged",
                     path, status_text(status));
  }
  return 1.0 / rate_hz <= step_s ? ARGS_OK : refuse(args, path, scene, rate_hz, step_s);
}

bool scene_render_play(Scene* scene,
                       double rate_hz,
                       bool shows_progress,
                       SoundFile* sound,
                       PlayResult* result,
                       char* error,
                       size_t error_size) {
  *result = (PlayResult){0};
  Playing playing = {.player = scene_player_new(scene, rate_hz),
                     .rate_hz = rate_hz,
                     .sound = sound,
                     .result = result,
                     .error = error,
                     .error_size = error_size};
  if (!playing.player) {
    return fail(&playing, "out of memory");
  }
  const bool is_ok = play_all(&playing, shows_progress);
  scene_player_free(playing.player);
  return is_ok;
}
