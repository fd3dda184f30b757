/* Hooke Strings, the LV2 plugin: a harp behind ports and MIDI, and no physics. */
#include "core/harp/harp.h"
#include "plugin/bundle.h"
#include "plugin/instrument.h"
#include "plugin/strings_midi.h"
#include "plugin/strings_ports.h"

#include <stddef.h>
#include <stdlib.h>

#define STRINGS_URI "urn:hooke:strings"

/* A harp, and who tells it what MIDI says. */
typedef struct {
  Harp* harp;
  StringsMidi midi;
} Player;

static void free_player(void* player) {
  Player* const self = player;
  harp_free(self->harp);
  free(self);
}

static void* new_player(double rate_hz) {
  Player* const self = calloc(1, sizeof(Player));
  if (!self) {
    return NULL;
  }
  self->harp = harp_new(rate_hz);
  if (!self->harp) {
    free_player(self);
    return NULL;
  }
  self->midi.hands.harp = self->harp;
  strings_midi_reset(&self->midi);
  return self;
}

static void reset(void* player) {
  Player* const self = player;
  harp_reset(self->harp);
  strings_midi_reset(&self->midi);
}

static void set(void* player, const Controls* controls, uint32_t n_frames) {
  const Player* const self = player;
  const HarpPatch patch = strings_ports_patch(controls);
  harp_set_patch(self->harp, &patch, n_frames);
}

static void silence(void* player) {
  Player* const self = player;
  strings_midi_silence(&self->midi);
}

static void play_midi(void* player, const uint8_t* bytes, uint32_t n_bytes, bool is_muted) {
  Player* const self = player;
  strings_midi_play(&self->midi, bytes, n_bytes, is_muted);
}

static void run(void* player, uint32_t n_frames, float* left, float* right) {
  const Player* const self = player;
  harp_run(self->harp, n_frames, left, right);
}

static void set_scale(void* player, const double semitones[SCALE_KEYS]) {
  const Player* const self = player;
  harp_set_scale(self->harp, semitones);
}

static InstrumentReport report(const void* player) {
  const Player* const self = player;
  const HarpReport harp = harp_report(self->harp);
  return (InstrumentReport){harp.n_strings, harp.n_masses, harp.headroom};
}

static const TunerNames tuner = {
    .plugin = STRINGS_URI,
    .files = {STRINGS_URI "#scale", STRINGS_URI "#mapping"},
};

static const InstrumentKind kind = {
    .n_ports = STRINGS_N_PORTS,
    .meters = STRINGS_PORT_SOUNDING,
    .limiter = STRINGS_PORT_LIMITER,
    .new = new_player,
    .free = free_player,
    .reset = reset,
    .read = strings_ports_read,
    .set = set,
    .silence = silence,
    .play_midi = play_midi,
    .run = run,
    .report = report,
    .tuner = &tuner,
    .set_scale = set_scale,
};

static LV2_Handle instantiate(const LV2_Descriptor* descriptor,
                              double rate,
                              const char* bundle_path,
                              const LV2_Feature* const* features) {
  (void)descriptor;
  (void)bundle_path;
  return instrument_new(&kind, rate, features);
}

const LV2_Descriptor strings_descriptor = {
    .URI = STRINGS_URI,
    .instantiate = instantiate,
    .connect_port = instrument_connect_port,
    .activate = instrument_activate,
    .run = instrument_run,
    .cleanup = instrument_cleanup,
    .extension_data = instrument_extension,
};
