#define _POSIX_C_SOURCE 200809L

#include "core/analysis/modes.h"
#include "core/bank/bodies.h"
#include "plugin/files_read.h"
#include "tools/bench/bench_clock.h"
#include "tools/commands/args.h"
#include "tools/commands/commands.h"
#include "tools/commands/near_miss.h"
#include "tools/commands/settings.h"
#include "tools/commands/sound_out.h"
#include "tools/formats/outfile.h"
#include "tools/formats/scene_player.h"
#include "tools/formats/score.h"
#include "tools/formats/smf.h"
#include "tools/formats/soundfile.h"
#include "tools/host/host.h"
#include "tools/host/locate.h"
#include "tools/host/play.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

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
    "  --gain DB           make it so many dB louder, below 0 softer\n"
    "  --normalize [DB]    make it as loud as brings its peak to DB, by default -1 dBFS\n"
    "  --quiet             write nothing to the terminal but errors\n"
    "\n"
    "For a MIDI file or a score:\n"
    "  --preset NAME       start from a preset, by its name or URI; a score's own is not loaded\n"
    "  --set SYMBOL=VALUE  set a control, by a number or a name such as bow or off, after the\n"
    "                      preset and what a score sets; may be repeated\n"
    "  --scale FILE        tune the keys to a Scala file (.scl); of hooke's own plugins\n"
    "  --mapping FILE      map them by a Scala file (.kbm)\n"
    "  --body FILE         hear the body that a table of modes says (.body), unless --set "
    "body=NAME\n"
    "                      chooses another\n"
    "  --block N           frames in a block, 256 by default\n"
    "  --tail S            seconds after the end; auto, the default: until it has died away by\n"
    "                      80 dB, at most a minute\n"
    "  --plugin URI        the plugin, by default urn:hooke:strings for a MIDI file and\n"
    "                      urn:hooke:guitar for a score\n"
    "  --list-presets      write the names of the presets, and no sound\n"
    "  --list-controls     write symbol, range, default and unit or names of the controls\n"
    "\n"
    "For a scene:\n"
    "  --anyway            render it even if it is unstable, as long as its numbers are finite\n"
    "\n"
    "Returns 0 when the sound is written, 3 for a scene that is unstable, and 1 or 2 otherwise.\n";

#define STRINGS_PLUGIN "urn:hooke:strings"
#define GUITAR_PLUGIN "urn:hooke:guitar"

enum {
  ERROR_SIZE = 4608,
  PATH_SIZE = 4096,
  HINT_SIZE = 256,
  SCENE_BLOCK = 256,        /* Frames between two looks at the whole */
  MAX_MASSES_TO_NAME = 1000 /* Above this the mode that grows is not sought */
};

static const double USUAL_RATE_HZ = 48000.0;

/* A judgement that takes longer is shown. */
static const double PATIENCE_S = 1.0;

typedef enum { KIND_SONG, KIND_SCORE, KIND_SCENE } Kind;

typedef struct {
  Args args;
  const char* in;
  const char* out;
  Kind kind;                      /* Of `in` */
  const char* preset;             /* NULL: none */
  const char* plugin;             /* Its URI */
  const char* files[FILES_COUNT]; /* NULL: none */
  const char** sets;              /* In the order given */
  size_t n_sets;
  long rate_hz;            /* 0: the usual one */
  long block;              /* [frames] */
  long bits;               /* 0: the usual ones */
  double gain_db;          /* [dB] */
  double peak_db;          /* What --normalize makes of the peak [dBFS] */
  double tail_s;           /* Below 0: until silent */
  const char* song_option; /* One that was given and is not for scenes */
  bool normalizes;
  bool lists_presets;
  bool lists_controls;
  bool is_quiet;
  bool is_anyway; /* Whether a scene that is unstable is rendered too */
} Render;

/* The command line */

enum {
  PRESET = ARGS_OPTION,
  SET,
  RATE,
  BLOCK,
  TAIL,
  BITS,
  PLUGIN,
  LIST_PRESETS,
  LIST_CONTROLS,
  QUIET,
  ANYWAY,
  GAIN,
  NORMALIZE,
  SCALE,
  MAPPING,
  BODY
};

static const struct option options[] = {{"preset", required_argument, NULL, PRESET},
                                        {"set", required_argument, NULL, SET},
                                        {"rate", required_argument, NULL, RATE},
                                        {"block", required_argument, NULL, BLOCK},
                                        {"tail", required_argument, NULL, TAIL},
                                        {"bits", required_argument, NULL, BITS},
                                        {"plugin", required_argument, NULL, PLUGIN},
                                        {"list-presets", no_argument, NULL, LIST_PRESETS},
                                        {"list-controls", no_argument, NULL, LIST_CONTROLS},
                                        {"quiet", no_argument, NULL, QUIET},
                                        {"anyway", no_argument, NULL, ANYWAY},
                                        {"gain", required_argument, NULL, GAIN},
                                        {"normalize", optional_argument, NULL, NORMALIZE},
                                        {"scale", required_argument, NULL, SCALE},
                                        {"mapping", required_argument, NULL, MAPPING},
                                        {"body", required_argument, NULL, BODY},
                                        {0}};

static bool has_ending(const char* path, const char* ending) {
  const char* const dot = strrchr(path, '.');
  return dot && !strcasecmp(dot, ending);
}

static bool take_operand(Render* self, const char* value) {
  if (self->in && self->out) {
    return args_fail(&self->args, false, "found '%s' too, expected one input and one output",
                     value);
  }
  if (self->in) {
    self->out = value;
    return true;
  }
  self->in = value;
  self->kind = has_ending(value, ".scene")   ? KIND_SCENE
               : has_ending(value, ".score") ? KIND_SCORE
                                             : KIND_SONG;
  return true;
}

static bool take_bits(Render* self, const char* value) {
  static const char* const depths[] = {"16", "24", "32"};
  for (size_t i = 0; i < sizeof(depths) / sizeof(depths[0]); ++i) {
    if (!strcmp(value, depths[i])) {
      self->bits = strtol(value, NULL, 10);
      return true;
    }
  }
  return args_fail(&self->args, false, "--bits: found '%s', expected 16, 24 or 32", value);
}

/* Its value may be left out, so that getopt_long() does not take the next word for it. */
static const char* next_number(const Args* args) {
  const char* const next = args->argv[optind];
  char* end = NULL;
  const bool is_number = next && (strtod(next, &end), end != next && !*end);
  optind += is_number;
  return is_number ? next : NULL;
}

/* What a decoder rounds stays below full scale, usually. */
static bool take_normalize(Render* self) {
  const Args* const args = &self->args;
  const char* const value = args->value ? args->value : next_number(args);
  self->normalizes = true;
  self->peak_db = -1.0;
  return !value || args_number(args, "--normalize", value, -100.0, 0.0, &self->peak_db);
}

static bool take_tail(Render* self, const char* value) {
  self->tail_s = -1.0;
  return !strcmp(value, "auto") ||
         args_number_or(&self->args, "--tail", value, 0.0, 3600.0, "auto", &self->tail_s);
}

static bool take_option(Render* self, int found) {
  const Args* const args = &self->args;
  const char* const value = args->value;
  switch (found) {
  case RATE:
    return args_whole(args, "--rate", value, 4000, 768000, &self->rate_hz);
  case BITS:
    return take_bits(self, value);
  case GAIN:
    return args_number(args, "--gain", value, -200.0, 200.0, &self->gain_db);
  case NORMALIZE:
    return take_normalize(self);
  case QUIET:
    return self->is_quiet = true;
  case ANYWAY:
    return self->is_anyway = true;
  case ARGS_OPERAND:
    return take_operand(self, value);
  case ARGS_ERROR:
    return false;
  default:
    break;
  }
  self->song_option = options[found - ARGS_OPTION].name;
  switch (found) {
  case PRESET:
    self->preset = value;
    return true;
  case SET:
    self->sets[self->n_sets++] = value;
    return true;
  case BLOCK:
    return args_whole(args, "--block", value, 1, 65536, &self->block);
  case TAIL:
    return take_tail(self, value);
  case PLUGIN:
    self->plugin = value;
    return true;
  case LIST_CONTROLS:
    return self->lists_controls = true;
  case SCALE:
    self->files[FILES_SCALE] = value;
    return true;
  case MAPPING:
    self->files[FILES_MAPPING] = value;
    return true;
  case BODY:
    self->files[FILES_BODY] = value;
    return true;
  default:
    return self->lists_presets = true;
  }
}

static bool lists(const Render* self) {
  return self->lists_presets || self->lists_controls;
}

static bool check_rate(const Render* self, double rate_hz) {
  const char* const rates = soundfile_refuse_rate(self->out, rate_hz);
  return !rates || args_fail(&self->args, false, "%s: found a rate of %.12g Hz, expected %s",
                             self->out, rate_hz, rates);
}

/* An option that would do nothing is a mistake. */
static bool check(const Render* self) {
  const Args* const args = &self->args;
  if (self->kind == KIND_SCENE && self->song_option) {
    return args_fail(args, false,
                     "found --%s for a scene, expected it for a MIDI file or a score only",
                     self->song_option);
  }
  if (self->kind != KIND_SCENE && self->is_anyway) {
    return args_fail(args, false, "found --anyway for a %s, expected it for a scene only",
                     self->kind == KIND_SCORE ? "score" : "MIDI file");
  }
  if (self->normalizes && self->gain_db != 0.0) {
    return args_fail(args, false, "found --gain and --normalize, expected one of them");
  }
  if (lists(self)) {
    return true;
  }
  if (!self->in || !self->out) {
    return args_fail(args, false, "found no %s, expected IN.mid and OUT.wav; try hooke help render",
                     self->in ? "output" : "input");
  }
  if (outfile_is_same(self->out, self->in)) {
    return args_fail(args, false, "%s: found the input itself, expected another file", self->out);
  }
  const char* const refusal = soundfile_refuse(self->out, (unsigned)self->bits);
  if (refusal) {
    return args_fail(args, false, "%s: %s", self->out, refusal);
  }
  return check_rate(self, (double)self->rate_hz);
}

static bool parse(Render* self) {
  for (int found = args_next(&self->args); found != ARGS_END; found = args_next(&self->args)) {
    if (!take_option(self, found)) {
      return false;
    }
  }
  if (!self->plugin) {
    self->plugin = self->kind == KIND_SCORE ? GUITAR_PLUGIN : STRINGS_PLUGIN;
  }
  return check(self);
}

static int write_sound(const Render* self, PlaySource source) {
  const SoundOut out = {.args = &self->args,
                        .path = self->out,
                        .bits = (unsigned)self->bits,
                        .gain_db = self->gain_db,
                        .normalizes = self->normalizes,
                        .peak_db = self->peak_db,
                        .is_quiet = self->is_quiet};
  return sound_out_write(&out, source);
}

/* Songs and scores, with a host */

/* One that is not found may be nearly one of ours. */
static const char* hint_at_plugin(const char* uri, char hint[HINT_SIZE]) {
  static const char* const ours[] = {STRINGS_PLUGIN, GUITAR_PLUGIN};
  NearMiss miss = near_miss_of(uri);
  *hint = '\0';
  for (size_t i = 0; i < sizeof(ours) / sizeof(ours[0]); ++i) {
    if (!strcmp(uri, ours[i])) {
      return hint;
    }
    near_miss_try(&miss, ours[i]);
  }
  return near_miss_hint(&miss, hint, HINT_SIZE);
}

static Host* make_host(const Render* self, double rate_hz) {
  char bundle[PATH_SIZE];
  char hint[HINT_SIZE];
  char error[256] = "";
  const HostConfig config = {.rate_hz = rate_hz,
                             .max_block = (uint32_t)self->block,
                             .bundle = locate_bundle(bundle, sizeof(bundle)) ? bundle : NULL,
                             .is_silent = self->is_quiet};
  Host* const host = host_new_with(self->plugin, &config, error, sizeof(error));
  if (!host) {
    args_fail(&self->args, ARGS_FAILURE, "%s%s", error, hint_at_plugin(self->plugin, hint));
  }
  return host;
}

/* Messages begin with where in the score it stands, as those of its reader do. */
static Args args_at(const Render* self, uint32_t line, char place[ERROR_SIZE]) {
  (void)snprintf(place, ERROR_SIZE, "%s: %s:%lu", self->args.command, self->in,
                 (unsigned long)line);
  return (Args){.command = place};
}

static bool set_as_score_says(const Render* self, const Score* score, Host* host) {
  for (size_t i = 0; i < score->n_settings; ++i) {
    const ScoreSetting* const setting = &score->settings[i];
    char place[ERROR_SIZE];
    char number[32];
    const Args args = args_at(self, setting->line, place);
    (void)snprintf(number, sizeof(number), "%.9g", setting->value);
    if (!settings_set(&args, host, setting->symbol, setting->text ? setting->text : number)) {
      return false;
    }
  }
  return true;
}

/* It may be another plugin's, or nearly one of this. */
static const char* hint_at_preset(Host* host, const char* name, char hint[HINT_SIZE]) {
  const char* const owner = host_preset_owner(host, name);
  NearMiss miss = near_miss_of(name);
  for (uint32_t i = 0; i < host_n_presets(host); ++i) {
    near_miss_try(&miss, host_preset_label(host, i));
  }
  if (owner) {
    (void)snprintf(hint, HINT_SIZE, "; this one is of --plugin %s", owner);
    return hint;
  }
  return near_miss_hint(&miss, hint, HINT_SIZE);
}

/* The command line has the last word. */
static int load_preset(const Render* self, const Score* score, Host* host) {
  char place[ERROR_SIZE];
  const char* const name = self->preset ? self->preset : score ? score->preset : NULL;
  if (!name || host_preset(host, name)) {
    return ARGS_OK;
  }
  const Args args = self->preset ? self->args : args_at(self, score->preset_line, place);
  char hint[HINT_SIZE];
  return args_fail(&args, self->preset ? ARGS_USAGE : ARGS_FAILURE,
                   "%s; --list-presets names them%s", host_error(host),
                   hint_at_preset(host, name, hint));
}

/* The plugin plays on without a file that is not as it should be; who asked for it is to know. */
static bool is_good_file(const Render* self, FilesKind file) {
  FilesContent content;
  FilesFault fault;
  files_read(self->files[file], file, true, &content, &fault);
  scale_free(&content.scale);
  scale_map_free(&content.map);
  return content.is_good || args_fail(&self->args, false, "%s", fault.line);
}

/* What --set says is set later. */
static void choose_body(const Render* self, Host* host) {
  if (self->files[FILES_BODY]) {
    (void)host_set(host, "body", BODIES_FILE);
  }
}

static int load_files(const Render* self, Host* host) {
  static const char* const names[FILES_COUNT] = {"scale", "mapping", "body"};
  for (int f = 0; f < FILES_COUNT; ++f) {
    char parameter[256];
    if (!self->files[f]) {
      continue;
    }
    if (!is_good_file(self, (FilesKind)f)) {
      return ARGS_FAILURE;
    }
    (void)snprintf(parameter, sizeof(parameter), "%s#%s", self->plugin, names[f]);
    if (!host_set_file(host, parameter, self->files[f])) {
      return args_fail(&self->args, ARGS_USAGE, "--%s: %s", names[f], host_error(host));
    }
  }
  return ARGS_OK;
}

static int prepare(const Render* self, const Score* score, Host* host) {
  if (score && !host_takes(host, GUITAR_EVENT_URI)) {
    return args_fail(&self->args, ARGS_USAGE,
                     "found <%s>, expected a plugin that plays scores, as <" GUITAR_PLUGIN ">",
                     self->plugin);
  }
  const int code = load_preset(self, score, host);
  if (code) {
    return code;
  }
  (void)host_set_freewheel(host, true);
  if (score && !set_as_score_says(self, score, host)) {
    return ARGS_FAILURE;
  }
  choose_body(self, host);
  const Args args = {.command = "hooke render: --set"};
  for (size_t i = 0; i < self->n_sets; ++i) {
    if (!settings_apply(&args, host, self->sets[i])) {
      return ARGS_USAGE;
    }
  }
  return load_files(self, host);
}

static int play_with_host(const Render* self, PlaySong song, const Score* score) {
  song.rate_hz = self->rate_hz ? (double)self->rate_hz : USUAL_RATE_HZ;
  song.host = make_host(self, song.rate_hz);
  if (!song.host) {
    return ARGS_FAILURE;
  }
  int code = prepare(self, score, song.host);
  code = code ? code : write_sound(self, play_song(&song, (uint32_t)self->block, self->tail_s));
  host_free(song.host);
  return code;
}

static int list(const Render* self) {
  Host* const host = make_host(self, USUAL_RATE_HZ);
  if (host && self->lists_controls) {
    settings_list(host);
  }
  for (uint32_t i = 0; host && self->lists_presets && i < host_n_presets(host); ++i) {
    puts(host_preset_label(host, i));
  }
  host_free(host);
  return host ? ARGS_OK : ARGS_FAILURE;
}

/* What is no MIDI file was perhaps not meant as one. */
static const char* hint_at_ending(const char* path, const char* error) {
  if (!strstr(error, "found no MThd")) {
    return "";
  }
  static const char* const songs[] = {".mid", ".midi", ".smf", ".kar", ".rmi"};
  for (size_t i = 0; i < sizeof(songs) / sizeof(songs[0]); ++i) {
    if (has_ending(path, songs[i])) {
      return "";
    }
  }
  return "; a score's name ends in .score, a scene's in .scene";
}

static int render_song(const Render* self) {
  char error[ERROR_SIZE] = "";
  Smf* const smf = smf_new(self->in, error, sizeof(error));
  if (!smf) {
    return args_fail(&self->args, ARGS_FAILURE, "%s%s", error, hint_at_ending(self->in, error));
  }
  for (unsigned i = 0; !self->is_quiet && i < SMF_N_NOTES; ++i) {
    if (*smf->note[i]) {
      args_fail(&self->args, ARGS_OK, "%s: %s", self->in, smf->note[i]);
    }
  }
  const int code = play_with_host(self, play_smf(smf), NULL);
  smf_free(smf);
  return code;
}

static PlayEvent score_event(const void* events, size_t i) {
  const ScoreEvent* const event = (const ScoreEvent*)events + i;
  return (PlayEvent){event->time_s, &event->event, sizeof(event->event)};
}

static int render_score(const Render* self) {
  char error[ERROR_SIZE] = "";
  Score* const score = score_new(self->in, error, sizeof(error));
  if (!score) {
    return args_fail(&self->args, ARGS_FAILURE, "%s", error);
  }
  const PlaySong song = {.type_uri = GUITAR_EVENT_URI,
                         .events = score->events,
                         .n_events = score->n_events,
                         .event = score_event,
                         .duration_s = score->duration_s};
  const int code = play_with_host(self, song, score);
  score_free(score);
  return code;
}

/* Scenes: judged first, then simulated in double, the same on both sides */

typedef struct {
  ScenePlayer* player;
  double rate_hz;
} Scenery;

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

static int refuse(const Render* self, const Scene* scene, double rate_hz, double step_s) {
  char which[128] = "a mode grows";
  Mode growing = {0};
  const uint32_t mode = find_growing(scene, rate_hz, &growing);
  if (mode) {
    (void)snprintf(which, sizeof(which), "mode %lu of %lu grows %.3g-fold a step",
                   (unsigned long)mode, (unsigned long)scene->network->n_masses, growing.radius);
  }
  return args_fail(
      &self->args, ARGS_UNSTABLE,
      "%s: found it unstable at %.12g Hz, where %s, expected a rate of %.0f Hz or more; "
      "--anyway renders it as it is",
      self->in, rate_hz, which, sufficient_rate(step_s));
}

/* A judgement that takes its time. */
typedef struct {
  double start_s;
  bool is_shown;
} Judging;

static const char JUDGING[] = "judging whether it is stable; --anyway renders it unjudged: ";

static void show_judging(void* self, double share) {
  Judging* const judging = self;
  if (bench_clock_wall_s() - judging->start_s > PATIENCE_S) {
    (void)fprintf(stderr, "\r%s%3d %%", JUDGING, (int)(100.0 * share));
    judging->is_shown = true;
  }
}

static Status find_largest_step(const Render* self, const Scene* scene, double* step_s) {
  Judging judging = {.start_s = bench_clock_wall_s()};
  const ModesWatch watch = {show_judging, &judging};
  const bool is_watched = !self->is_quiet && isatty(STDERR_FILENO);
  const Status status = modes_largest_step(scene->network, is_watched ? &watch : NULL, step_s);
  if (judging.is_shown) {
    (void)fprintf(stderr, "\r%*s\r", (int)sizeof(JUDGING) + 5, "");
  }
  return status;
}

static int judge(const Render* self, const Scene* scene, double rate_hz) {
  double step_s = 0.0;
  Status status = find_largest_step(self, scene, &step_s);
  status = !status && !(step_s > 0.0) ? STATUS_ILL_SCALED : status;
  if (status) {
    return args_fail(&self->args, ARGS_FAILURE,
                     "%s: could not judge whether it is stable: %s; --anyway renders it unjudged",
                     self->in, status_text(status));
  }
  return 1.0 / rate_hz <= step_s ? ARGS_OK : refuse(self, scene, rate_hz, step_s);
}

static bool
run_scene(void* self, uint64_t at, uint32_t n, float* frames, char error[PLAY_ERROR_SIZE]) {
  Scenery* const scenery = (Scenery*)self;
  double out[SCENE_BLOCK];
  scene_player_run(scenery->player, out, n);
  uint32_t i = 0;
  for (; i < n && isfinite((float)out[i]); ++i) {
    frames[2 * (size_t)i] = frames[2 * (size_t)i + 1] = (float)out[i];
  }
  if (i == n && scene_player_settle(scenery->player)) {
    return true;
  }
  (void)snprintf(error, PLAY_ERROR_SIZE,
                 "found a number that is not finite at %.6f s, expected a scene that is stable or "
                 "ends before",
                 (double)(at + i) / scenery->rate_hz);
  return false;
}

static int play_scene(const Render* self, Scene* scene, double rate_hz) {
  if (rate_hz != floor(rate_hz)) {
    return args_fail(&self->args, ARGS_FAILURE,
                     "%s: found a rate of %.12g Hz, expected a whole number for a sound file; "
                     "--rate sets one",
                     self->in, rate_hz);
  }
  if (!check_rate(self, rate_hz)) {
    return ARGS_FAILURE;
  }
  int code = self->is_anyway ? ARGS_OK : judge(self, scene, rate_hz);
  if (code) {
    return code;
  }
  Scenery scenery = {scene_player_new(scene, rate_hz), rate_hz};
  if (!scenery.player) {
    return args_fail(&self->args, ARGS_FAILURE, "%s: out of memory", self->out);
  }
  code = write_sound(self, (PlaySource){.self = &scenery,
                                        .run = run_scene,
                                        .rate_hz = rate_hz,
                                        .block = SCENE_BLOCK,
                                        .n_frames = scene_player_length(scenery.player)});
  scene_player_free(scenery.player);
  return code;
}

static int render_scene(const Render* self) {
  char error[SCENE_ERROR_SIZE] = "";
  Scene* const scene = scene_new(self->in, SCENE_FOR_SOUND, error, sizeof(error));
  if (!scene) {
    return args_fail(&self->args, ARGS_FAILURE, "%s", error);
  }
  const int code = play_scene(self, scene, self->rate_hz ? (double)self->rate_hz : scene->rate_hz);
  scene_free(scene);
  return code;
}

static int render(Render* self) {
  static int (*const kinds[])(const Render*) = {
      [KIND_SONG] = render_song, [KIND_SCORE] = render_score, [KIND_SCENE] = render_scene};
  if (!self->sets) {
    return args_fail(&self->args, ARGS_FAILURE, "out of memory");
  }
  if (!parse(self)) {
    return ARGS_USAGE;
  }
  return lists(self) ? list(self) : kinds[self->kind](self);
}

int render_main(int argc, char** argv) {
  Render self = {
      .args = {.command = "hooke render", .argc = argc, .argv = argv, .options = options},
      .sets = calloc((size_t)argc + 1, sizeof(*self.sets)),
      .block = 256,
      .tail_s = -1.0};
  const int code = render(&self);
  free((void*)self.sets);
  return code;
}
