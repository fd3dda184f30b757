#define _POSIX_C_SOURCE 200809L

#include "tools/render.h"

#include "tools/args.h"
#include "tools/host.h"
#include "tools/locate.h"
#include "tools/midifile.h"
#include "tools/play.h"
#include "tools/setting.h"
#include "tools/soundfile.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char render_help[] =
    "usage: hooke render [OPTION]... IN.mid OUT.wav\n"
    "\n"
    "Play a Standard MIDI File with a plugin and write what sounds.\n"
    "OUT ends in .wav, .flac or .ogg.\n"
    "\n"
    "  --preset NAME       start from a preset, by its name or URI\n"
    "  --set SYMBOL=VALUE  set a control, after the preset; may be repeated\n"
    "  --rate HZ           sample rate, 48000 by default\n"
    "  --block N           frames in a block, 256 by default\n"
    "  --tail S            seconds after the last message; by default until silent, at most 10\n"
    "  --bits N            16, 24 or 32 (float); by default 32 for .wav, 24 for .flac\n"
    "  --plugin URI        the plugin, urn:hooke:strings by default\n"
    "  --list-presets      write the names of the presets, and no sound\n"
    "  --quiet             write nothing to the terminal but errors\n";

enum { PRESET, SET, RATE, BLOCK, TAIL, BITS, PLUGIN, LIST_PRESETS, QUIET };

static const ArgsOption options[] = {
    [PRESET] = {"--preset", true}, [SET] = {"--set", true},
    [RATE] = {"--rate", true},     [BLOCK] = {"--block", true},
    [TAIL] = {"--tail", true},     [BITS] = {"--bits", true},
    [PLUGIN] = {"--plugin", true}, [LIST_PRESETS] = {"--list-presets", false},
    [QUIET] = {"--quiet", false},  {NULL, false}};

typedef struct {
  Args args;
  const char* in;
  const char* out;
  const char* preset;
  const char* plugin;
  const char** sets; // In the order given
  size_t n_sets;
  long rate_hz;
  long block;
  long bits;
  double tail_s;
  bool lists_presets;
  bool is_quiet;
} Render;

static bool take_operand(Render* self) {
  const char** const place = !self->in ? &self->in : !self->out ? &self->out : NULL;
  if (!place) {
    args_fail(&self->args, 0, "found '%s' too, expected one input and one output",
              self->args.value);
    return false;
  }
  *place = self->args.value;
  return true;
}

static bool take_bits(Render* self, const char* value) {
  if (!args_whole(&self->args, "--bits", value, 16, 32, &self->bits)) {
    return false;
  }
  if (self->bits != 16 && self->bits != 24 && self->bits != 32) {
    args_fail(&self->args, 0, "--bits: found '%s', expected 16, 24 or 32", value);
    return false;
  }
  return true;
}

static bool take_option(Render* self, int index) {
  const Args* const args = &self->args;
  const char* const value = args->value;
  switch (index) {
  case PRESET:
    self->preset = value;
    return true;
  case SET:
    self->sets[self->n_sets++] = value;
    return true;
  case RATE:
    return args_whole(args, "--rate", value, 4000, 768000, &self->rate_hz);
  case BLOCK:
    return args_whole(args, "--block", value, 1, 65536, &self->block);
  case TAIL:
    return args_number(args, "--tail", value, 0.0, 3600.0, &self->tail_s);
  case BITS:
    return take_bits(self, value);
  case PLUGIN:
    self->plugin = value;
    return true;
  case LIST_PRESETS:
    return self->lists_presets = true;
  case QUIET:
    return self->is_quiet = true;
  case ARGS_OPERAND:
    return take_operand(self);
  default:
    return false;
  }
}

static bool parse(Render* self) {
  for (int i = args_next(&self->args); i != ARGS_END; i = args_next(&self->args)) {
    if (!take_option(self, i)) {
      return false;
    }
  }
  if (self->lists_presets) {
    return true;
  }
  if (!self->in || !self->out) {
    args_fail(&self->args, 0, "found no %s, expected IN.mid and OUT.wav; try hooke help render",
              self->in ? "output" : "input");
    return false;
  }
  const char* const refusal = soundfile_refuse(self->out, (unsigned)self->bits);
  if (refusal) {
    args_fail(&self->args, 0, "%s: %s", self->out, refusal);
    return false;
  }
  return true;
}

static Host* make_host(const Render* self) {
  char bundle[4096];
  char error[256] = "";
  const HostConfig config = {.rate_hz = (double)self->rate_hz,
                             .max_block = (uint32_t)self->block,
                             .bundle = locate_bundle(bundle, sizeof(bundle)) ? bundle : NULL,
                             .is_silent = self->is_quiet};
  Host* const host = host_new_with(self->plugin, &config, error, sizeof(error));
  if (!host) {
    args_fail(&self->args, 0, "%s", error);
  }
  return host;
}

static bool prepare(const Render* self, Host* host) {
  if (self->preset && !host_preset(host, self->preset)) {
    args_fail(&self->args, 0, "%s; --list-presets names them", host_error(host));
    return false;
  }
  (void)host_set_freewheel(host, true);
  for (size_t i = 0; i < self->n_sets; ++i) {
    if (!setting_apply(&self->args, host, self->sets[i])) {
      return false;
    }
  }
  return true;
}

static void report(const Render* self, const PlayResult* result) {
  const double duration_s = (double)result->n_frames / (double)self->rate_hz;
  char peak[32] = "silent";
  if (result->peak > 0) {
    (void)snprintf(peak, sizeof(peak), "peak %.1f dBFS", 20.0 * log10((double)result->peak));
  }
  if (!self->is_quiet) {
    printf("%s: %.2f s, %s, %.1f times as fast as real time\n", self->out, duration_s, peak,
           duration_s / fmax(result->run_s, 1e-9));
  }
}

static int play_to_file(const Render* self, Host* host, const MidiFile* song) {
  char error[512] = "";
  PlayResult result = {0};
  SoundFile* const sound =
      soundfile_new(self->out, (int)self->rate_hz, (unsigned)self->bits, error, sizeof(error));
  if (!sound) {
    return args_fail(&self->args, ARGS_FAILURE, "%s", error);
  }
  const PlayHow how = {(double)self->rate_hz, (uint32_t)self->block, self->tail_s,
                       !self->is_quiet && isatty(STDERR_FILENO)};
  if (!play(host, song, &how, sound, &result, error, sizeof(error))) {
    soundfile_free(sound);
    return args_fail(&self->args, ARGS_FAILURE, "%s: %s", self->out, error);
  }
  if (!soundfile_finish(sound)) {
    return args_fail(&self->args, ARGS_FAILURE, "%s: not written", self->out);
  }
  report(self, &result);
  return ARGS_OK;
}

/* Signals wait until the unfinished file is gone: then they do what they do. */
static int play_uninterrupted(const Render* self, Host* host, const MidiFile* song) {
  sigset_t signals;
  sigset_t old_signals;
  (void)sigemptyset(&signals);
  (void)sigaddset(&signals, SIGINT);
  (void)sigaddset(&signals, SIGTERM);
  (void)sigprocmask(SIG_BLOCK, &signals, &old_signals);
  const int code = play_to_file(self, host, song);
  (void)sigprocmask(SIG_SETMASK, &old_signals, NULL);
  return code;
}

static int list_presets(Host* host) {
  for (uint32_t i = 0; i < host_n_presets(host); ++i) {
    puts(host_preset_label(host, i));
  }
  return ARGS_OK;
}

static int render(const Render* self, const MidiFile* song) {
  Host* const host = make_host(self);
  if (!host) {
    return ARGS_FAILURE;
  }
  const int code = self->lists_presets    ? list_presets(host)
                   : !prepare(self, host) ? ARGS_USAGE
                                          : play_uninterrupted(self, host, song);
  host_free(host);
  return code;
}

static int render_song(const Render* self) {
  if (self->lists_presets) {
    return render(self, NULL);
  }
  char error[512] = "";
  MidiFile* const song = midifile_new(self->in, error, sizeof(error));
  const int code = song ? render(self, song) : args_fail(&self->args, ARGS_FAILURE, "%s", error);
  midifile_free(song);
  return code;
}

int render_main(int argc, char** argv) {
  Render self = {.args = {.command = "hooke render", .words = argv + 1, .options = options},
                 .plugin = "urn:hooke:strings",
                 .rate_hz = 48000,
                 .block = 256,
                 .tail_s = -1.0};
  self.sets = calloc((size_t)argc + 1, sizeof(*self.sets));
  if (!self.sets) {
    return args_fail(&self.args, ARGS_FAILURE, "out of memory");
  }
  const int code = parse(&self) ? render_song(&self) : ARGS_USAGE;
  free((void*)self.sets);
  return code;
}
