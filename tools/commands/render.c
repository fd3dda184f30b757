#define _POSIX_C_SOURCE 200809L

#include "tools/commands/render.h"

#include "tools/commands/render_options.h"
#include "tools/commands/scene_render.h"
#include "tools/commands/score_render.h"
#include "tools/formats/smf.h"
#include "tools/formats/soundfile.h"
#include "tools/host/host.h"
#include "tools/host/locate.h"
#include "tools/host/play.h"
#include "tools/host/setting.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

enum { ERROR_SIZE = 4608 };

static const double USUAL_RATE_HZ = 48000.0;

/* What sounds: a host that plays a song or score, or a scene. */
typedef struct {
  Host* host;
  PlaySong song;
  Scene* scene;
  double rate_hz;
} Source;

static Host* make_host(const RenderOptions* self, double rate_hz) {
  char bundle[4096];
  char error[256] = "";
  const HostConfig config = {.rate_hz = rate_hz,
                             .max_block = (uint32_t)self->block,
                             .bundle = locate_bundle(bundle, sizeof(bundle)) ? bundle : NULL,
                             .is_silent = self->is_quiet};
  Host* const host = host_new_with(self->plugin, &config, error, sizeof(error));
  if (!host) {
    args_fail(&self->args, 0, "%s", error);
  }
  return host;
}

static int load_preset(const RenderOptions* self, const Score* score, Host* host) {
  if (self->preset) {
    return host_preset(host, self->preset)
               ? ARGS_OK
               : args_fail(&self->args, ARGS_USAGE, "%s; --list-presets names them",
                           host_error(host));
  }
  return !score || score_render_load_preset(&self->args, self->in, score, host) ? ARGS_OK
                                                                                : ARGS_FAILURE;
}

/* The command line has the last word. */
static int prepare(const RenderOptions* self, const Score* score, Host* host) {
  if (score && !score_render_is_playable(&self->args, host)) {
    return ARGS_USAGE;
  }
  const int code = load_preset(self, score, host);
  if (code) {
    return code;
  }
  (void)host_set_freewheel(host, true);
  if (score && !score_render_set(&self->args, self->in, score, host)) {
    return ARGS_FAILURE;
  }
  for (size_t i = 0; i < self->n_sets; ++i) {
    if (!setting_apply(&self->args, host, self->sets[i])) {
      return ARGS_USAGE;
    }
  }
  return ARGS_OK;
}

static void report(const RenderOptions* self, const Source* source, const PlayResult* result) {
  const double duration_s = (double)result->n_frames / source->rate_hz;
  char peak[32] = "silent";
  if (result->peak > 0) {
    (void)snprintf(peak, sizeof(peak), "peak %.1f dBFS", 20.0 * log10((double)result->peak));
  }
  if (!self->is_quiet) {
    printf("%s: %.2f s, %s, %.1f times as fast as real time\n", self->out, duration_s, peak,
           duration_s / fmax(result->run_s, 1e-9));
  }
}

static bool play_source(const RenderOptions* self,
                        const Source* source,
                        SoundFile* sound,
                        PlayResult* result,
                        char* error,
                        size_t error_size) {
  const bool shows_progress = !self->is_quiet && isatty(STDERR_FILENO);
  if (source->scene) {
    return scene_render_play(source->scene, source->rate_hz, shows_progress, sound, result, error,
                             error_size);
  }
  const PlayHow how = {source->rate_hz, (uint32_t)self->block, self->tail_s, shows_progress};
  return play(source->host, &source->song, &how, sound, result, error, error_size);
}

static int play_to_file(const RenderOptions* self, const Source* source) {
  char error[512] = "";
  PlayResult result = {0};
  SoundFile* const sound =
      soundfile_new(self->out, (int)source->rate_hz, (unsigned)self->bits, error, sizeof(error));
  if (!sound) {
    return args_fail(&self->args, ARGS_FAILURE, "%s", error);
  }
  if (!play_source(self, source, sound, &result, error, sizeof(error))) {
    soundfile_free(sound);
    return args_fail(&self->args, ARGS_FAILURE, "%s: %s", self->out, error);
  }
  if (!soundfile_finish(sound)) {
    return args_fail(&self->args, ARGS_FAILURE, "%s: not written", self->out);
  }
  report(self, source, &result);
  return ARGS_OK;
}

/* Signals wait until the unfinished file is gone: then they do what they do. */
static int play_uninterrupted(const RenderOptions* self, const Source* source) {
  sigset_t signals;
  sigset_t old_signals;
  (void)sigemptyset(&signals);
  (void)sigaddset(&signals, SIGINT);
  (void)sigaddset(&signals, SIGTERM);
  (void)sigprocmask(SIG_BLOCK, &signals, &old_signals);
  const int code = play_to_file(self, source);
  (void)sigprocmask(SIG_SETMASK, &old_signals, NULL);
  return code;
}

static int list_presets(Host* host) {
  for (uint32_t i = 0; i < host_n_presets(host); ++i) {
    puts(host_preset_label(host, i));
  }
  return ARGS_OK;
}

static int render_with_host(const RenderOptions* self, PlaySong song, const Score* score) {
  Source source = {.song = song, .rate_hz = self->rate_hz ? (double)self->rate_hz : USUAL_RATE_HZ};
  source.host = make_host(self, source.rate_hz);
  if (!source.host) {
    return ARGS_FAILURE;
  }
  int code = ARGS_OK;
  if (self->lists_presets) {
    code = list_presets(source.host);
  } else {
    code = prepare(self, score, source.host);
    code = code ? code : play_uninterrupted(self, &source);
  }
  host_free(source.host);
  return code;
}

static void say_notes(const RenderOptions* self, const Smf* file) {
  for (unsigned i = 0; !self->is_quiet && i < SMF_N_NOTES; ++i) {
    if (*file->note[i]) {
      args_fail(&self->args, 0, "%s: %s", self->in, file->note[i]);
    }
  }
}

static int render_midi(const RenderOptions* self) {
  char error[ERROR_SIZE] = "";
  Smf* const file = smf_new(self->in, error, sizeof(error));
  if (file) {
    say_notes(self, file);
  }
  const int code = file ? render_with_host(self, play_midi(file), NULL)
                        : args_fail(&self->args, ARGS_FAILURE, "%s", error);
  smf_free(file);
  return code;
}

static int render_score(const RenderOptions* self) {
  char error[SCORE_ERROR_SIZE] = "";
  Score* const score = score_new(self->in, error, sizeof(error));
  const int code = score ? render_with_host(self, score_render_song(score), score)
                         : args_fail(&self->args, ARGS_FAILURE, "%s", error);
  score_free(score);
  return code;
}

static int render_song(const RenderOptions* self) {
  if (self->lists_presets) {
    return render_with_host(self, (PlaySong){0}, NULL);
  }
  return score_render_is_score(self->in) ? render_score(self) : render_midi(self);
}

static int play_scene(const RenderOptions* self, const Source* source) {
  if (source->rate_hz != floor(source->rate_hz)) {
    return args_fail(&self->args, ARGS_FAILURE,
                     "%s: found a rate of %.12g Hz, expected a whole number for a sound file; "
                     "--rate sets one",
                     self->in, source->rate_hz);
  }
  const int code = self->is_anyway
                       ? ARGS_OK
                       : scene_render_judge(&self->args, self->in, source->scene, source->rate_hz);
  return code ? code : play_uninterrupted(self, source);
}

static int render_scene(const RenderOptions* self) {
  char error[SCENE_ERROR_SIZE] = "";
  Source source = {.scene = scene_new(self->in, SCENE_FOR_SOUND, error, sizeof(error))};
  if (!source.scene) {
    return args_fail(&self->args, ARGS_FAILURE, "%s", error);
  }
  source.rate_hz = self->rate_hz ? (double)self->rate_hz : source.scene->rate_hz;
  const int code = play_scene(self, &source);
  scene_free(source.scene);
  return code;
}

static int render(const RenderOptions* self) {
  return self->in && scene_render_is_scene(self->in) ? render_scene(self) : render_song(self);
}

int render_main(int argc, char** argv) {
  RenderOptions options;
  const int code = render_options_read(&options, argc, argv) ? render(&options) : ARGS_USAGE;
  render_options_clear(&options);
  return code;
}
