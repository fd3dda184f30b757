#include "tools/commands/render_options.h"

#include "tools/commands/render.h"
#include "tools/commands/scene_render.h"
#include "tools/commands/score_render.h"
#include "tools/formats/soundfile.h"

#include <stdlib.h>

const char render_help[] =
    "usage: hooke render [OPTION]... IN.mid OUT.wav\n"
    "       hooke render [OPTION]... IN.score OUT.wav\n"
    "       hooke render [OPTION]... IN.scene OUT.wav\n"
    "\n"
    "Play a Standard MIDI File or a guitarist's score with a plugin, or the masses and springs\n"
    "of a scene, and write what sounds. OUT ends in .wav, .flac or .ogg. For what a score may "
    "say,\n"
    "see hooke help score.\n"
    "\n"
    "For all:\n"
    "  --rate HZ           sample rate, 48000 or the scene's own by default\n"
    "  --bits N            16, 24 or 32 (float); by default 32 for .wav, 24 for .flac\n"
    "  --quiet             write nothing to the terminal but errors\n"
    "\n"
    "For a MIDI file or a score:\n"
    "  --preset NAME       start from a preset, by its name or URI; a score's own is not loaded\n"
    "  --set SYMBOL=VALUE  set a control, after the preset and what a score sets; may be repeated\n"
    "  --block N           frames in a block, 256 by default\n"
    "  --tail S            seconds after the end; by default until silent, at most 10\n"
    "  --plugin URI        the plugin, by default urn:hooke:strings for a MIDI file and\n"
    "                      urn:hooke:guitar for a score\n"
    "  --list-presets      write the names of the presets, and no sound\n"
    "\n"
    "For a scene:\n"
    "  --anyway            render it even if it is unstable, as long as its numbers are finite\n"
    "\n"
    "Returns 0 when the sound is written, 3 for a scene that is unstable, and 1 or 2 otherwise.\n";

static const char STRINGS_PLUGIN[] = "urn:hooke:strings";

enum { PRESET, SET, RATE, BLOCK, TAIL, BITS, PLUGIN, LIST_PRESETS, QUIET, ANYWAY };

static const ArgsOption options[] = {[PRESET] = {"--preset", true},
                                     [SET] = {"--set", true},
                                     [RATE] = {"--rate", true},
                                     [BLOCK] = {"--block", true},
                                     [TAIL] = {"--tail", true},
                                     [BITS] = {"--bits", true},
                                     [PLUGIN] = {"--plugin", true},
                                     [LIST_PRESETS] = {"--list-presets", false},
                                     [QUIET] = {"--quiet", false},
                                     [ANYWAY] = {"--anyway", false},
                                     {NULL, false}};

static bool take_operand(RenderOptions* self) {
  const char** const place = !self->in ? &self->in : !self->out ? &self->out : NULL;
  if (!place) {
    args_fail(&self->args, 0, "found '%s' too, expected one input and one output",
              self->args.value);
    return false;
  }
  *place = self->args.value;
  return true;
}

static bool take_bits(RenderOptions* self, const char* value) {
  if (!args_whole(&self->args, "--bits", value, 16, 32, &self->bits)) {
    return false;
  }
  if (self->bits != 16 && self->bits != 24 && self->bits != 32) {
    args_fail(&self->args, 0, "--bits: found '%s', expected 16, 24 or 32", value);
    return false;
  }
  return true;
}

static bool take_option(RenderOptions* self, int index) {
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
  case ANYWAY:
    return self->is_anyway = true;
  case ARGS_OPERAND:
    return take_operand(self);
  default:
    return false;
  }
}

static bool is_for_songs(int index) {
  return index == PRESET || index == SET || index == BLOCK || index == TAIL || index == PLUGIN ||
         index == LIST_PRESETS;
}

static bool is_score(const RenderOptions* self) {
  return self->in && score_render_is_score(self->in);
}

/* An option that would do nothing is a mistake. */
static bool check_kind(const RenderOptions* self, int song_option) {
  const bool is_scene = self->in && scene_render_is_scene(self->in);
  if (is_scene && song_option >= 0) {
    args_fail(&self->args, 0, "found %s for a scene, expected it for a MIDI file or a score only",
              options[song_option].name);
    return false;
  }
  if (!is_scene && self->is_anyway) {
    args_fail(&self->args, 0, "found --anyway for a %s, expected it for a scene only",
              is_score(self) ? "score" : "MIDI file");
    return false;
  }
  return true;
}

bool render_options_read(RenderOptions* self, int argc, char** argv) {
  *self =
      (RenderOptions){.args = {.command = "hooke render", .words = argv + 1, .options = options},
                      .block = 256,
                      .tail_s = -1.0};
  self->sets = calloc((size_t)argc + 1, sizeof(*self->sets));
  if (!self->sets) {
    args_fail(&self->args, 0, "out of memory");
    return false;
  }
  int song_option = -1;
  for (int i = args_next(&self->args); i != ARGS_END; i = args_next(&self->args)) {
    song_option = is_for_songs(i) ? i : song_option;
    if (!take_option(self, i)) {
      return false;
    }
  }
  if (!check_kind(self, song_option)) {
    return false;
  }
  if (!self->plugin) {
    self->plugin = is_score(self) ? SCORE_RENDER_PLUGIN : STRINGS_PLUGIN;
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

void render_options_clear(RenderOptions* self) {
  free((void*)self->sets);
}
