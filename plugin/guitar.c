/* Hooke Guitar, the LV2 plugin: a guitar and who plays it behind ports, MIDI and the events of a
 * script, and no physics. */
#include "core/guitar/guitar.h"
#include "core/guitar/guitar_event.h"
#include "core/guitar/guitarist.h"
#include "plugin/bundle.h"
#include "plugin/guitar_ports.h"
#include "plugin/instrument.h"

#include <stdlib.h>
#include <string.h>

#define GUITAR_URI "urn:hooke:guitar"

typedef struct {
  Guitar* guitar;
  Guitarist* guitarist;
  Controls controls;
  bool has_new_body; /* Which the guitar has not been set to yet */
} Player;

static void free_player(void* data) {
  Player* const player = data;
  guitarist_free(player->guitarist);
  guitar_free(player->guitar);
  free(player);
}

static void* new_player(double rate_hz) {
  Player* const player = calloc(1, sizeof(Player));
  if (!player) {
    return NULL;
  }
  player->guitar = guitar_new(rate_hz);
  player->guitarist = player->guitar ? guitarist_new(guitar_seat(player->guitar)) : NULL;
  if (!player->guitarist) {
    free_player(player);
    return NULL;
  }
  return player;
}

static void reset(void* data) {
  Player* const player = data;
  guitarist_reset(player->guitarist);
  guitar_reset(player->guitar);
}

/* How it is played from now on is no new patch to what rings. */
static void set(void* data, const Controls* controls, uint32_t n_frames) {
  Player* const player = data;
  guitarist_set_how(player->guitarist, guitar_ports_how(controls));
  if (n_frames == 0 || player->has_new_body ||
      !guitar_ports_are_same_patch(controls, &player->controls)) {
    const GuitarPatch patch = guitar_ports_patch(controls);
    guitar_set_patch(player->guitar, &patch, n_frames);
    guitarist_set_patch(player->guitarist, &patch);
  }
  player->controls = *controls;
  player->has_new_body = false;
}

static void set_body(void* data, const Body* body) {
  Player* const player = data;
  guitar_set_body(player->guitar, body);
  player->has_new_body = true;
}

static Performance perform(void* data) {
  const Player* const player = data;
  return guitarist_performance(player->guitarist);
}

static void play_event(void* data, const uint8_t* body, uint32_t n_bytes, bool is_muted) {
  const Player* const player = data;
  GuitarEvent event;
  if (n_bytes != sizeof(event)) {
    return;
  }
  memcpy(&event, body, sizeof(event));
  const bool is_heard =
      event.verb == GUITAR_PLUCK || event.verb == GUITAR_HAMMER || event.verb == GUITAR_LET_RING;
  if (!(is_muted && is_heard)) {
    (void)guitar_event_play(player->guitar, &event);
  }
}

static void run(void* data, uint32_t n_frames, float* left, float* right) {
  const Player* const player = data;
  guitarist_run(player->guitarist, n_frames, left, right);
}

static VoiceReport report(const void* data) {
  return guitar_report(((const Player*)data)->guitar);
}

static const InstrumentKind kind = {
    .n_ports = GUITAR_N_PORTS,
    .meters = GUITAR_PORT_SOUNDING,
    .stability_used = GUITAR_PORT_STABILITY_USED,
    .limiter = GUITAR_PORT_LIMITER,
    .event_uri = GUITAR_EVENT_URI,
    .new = new_player,
    .free = free_player,
    .reset = reset,
    .read = guitar_ports_read,
    .set = set,
    .set_body = set_body,
    .perform = perform,
    .play_event = play_event,
    .run = run,
    .report = report,
    .files = {GUITAR_URI, {GUITAR_URI "#scale", GUITAR_URI "#mapping", GUITAR_URI "#body"}},
};

static LV2_Handle instantiate(const LV2_Descriptor* descriptor,
                              double rate,
                              const char* bundle_path,
                              const LV2_Feature* const* features) {
  (void)descriptor;
  (void)bundle_path;
  return instrument_new(&kind, rate, features);
}

const LV2_Descriptor guitar_descriptor = {
    .URI = GUITAR_URI,
    .instantiate = instantiate,
    .connect_port = instrument_connect_port,
    .activate = instrument_activate,
    .run = instrument_run,
    .cleanup = instrument_cleanup,
    .extension_data = instrument_extension,
};
