#include "plugin/instrument.h"

#include "core/base/limiter.h"
#include "core/play/channels.h"
#include "plugin/denormals.h"
#include "plugin/events.h"
#include "plugin/files.h"
#include "plugin/files_state.h"
#include "plugin/outputs.h"

#include <lv2/core/lv2_util.h>
#include <lv2/log/log.h>
#include <lv2/midi/midi.h>

#include <stdlib.h>
#include <string.h>

/* The shortest time in which a port's change takes effect [s]; else it takes the block. */
static const double SHORTEST_GLIDE_S = 0.005;

/* Frames are counted in 32 bits: some four seconds of them, and nothing here counts as many [Hz].
 */
static const double MOST_RATE_HZ = 1e9;

typedef struct {
  LV2_URID atom_Sequence;
  LV2_URID midi_MidiEvent;
  LV2_URID own; /* The kind's own events, if there are any */
} Urids;

typedef struct {
  const InstrumentKind* kind;
  double rate_hz;
  uint32_t n_shortest; /* Frames of the shortest glide */

  /* Features */
  Urids urids;

  /* Ports */
  void* ports[PORTS_MAX];

  /* State */
  void* player;
  Channels channels; /* What MIDI has said to it */
  Files* files;
  Controls controls;
  bool is_fresh; /* Whether no frame has been run since activation: there is nothing to glide
                    from */
  bool is_muted;
  Limiter limiter;
  float left[INSTRUMENT_FRAMES];
  float right[INSTRUMENT_FRAMES];
} Instrument;

static Urids map_urids(const LV2_URID_Map* map, const InstrumentKind* kind) {
  return (Urids){
      .atom_Sequence = map->map(map->handle, LV2_ATOM__Sequence),
      .midi_MidiEvent = map->map(map->handle, LV2_MIDI__MidiEvent),
      .own = kind->event_uri ? map->map(map->handle, kind->event_uri) : 0,
  };
}

static Controls read_controls(const Instrument* self) {
  Controls controls = self->kind->read(self->ports);
  controls.value[PORT_FREEWHEEL] = 0.0f; /* It sounds the same. */
  return controls;
}

static void set_controls(Instrument* self, const Controls* controls, uint32_t n_glide) {
  const uint32_t n = self->is_fresh ? 0 : n_glide;
  self->kind->set(self->player, controls, n);
  const bool is_muted = controls->value[PORT_ENABLED] < 0.5f;
  if (is_muted && !self->is_muted) {
    channels_silence(&self->channels);
  }
  self->is_muted = is_muted;
  limiter_turn(&self->limiter, controls->value[self->kind->limiter] >= 0.5f, n);
  self->controls = *controls;
}

/* A port that changed takes the whole block to get there, so that a host's stairs become slopes;
 * and so does a body that is new. */
static void take_controls(Instrument* self, bool is_new_body, uint32_t n_frames) {
  const Controls controls = read_controls(self);
  if (self->is_fresh || is_new_body || !ports_are_same(&controls, &self->controls)) {
    set_controls(self, &controls, n_frames > self->n_shortest ? n_frames : self->n_shortest);
  }
}

/* Run from frame `from` to frame `to` of the block. */
static void render(Instrument* self, uint32_t from, uint32_t to) {
  float* const left = self->ports[PORT_OUT_LEFT];
  float* const right = self->ports[PORT_OUT_RIGHT];
  while (from < to) {
    const uint32_t n = to - from < INSTRUMENT_FRAMES ? to - from : INSTRUMENT_FRAMES;
    self->kind->run(self->player, n, self->left, self->right);
    limiter_run(&self->limiter, n, self->left, self->right);
    outputs_write(left, right, from, n, self->left, self->right);
    from += n;
  }
}

static void write_value(Instrument* self, uint32_t port, double value) {
  float* const out = self->ports[port];
  if (out) {
    *out = (float)value;
  }
}

static void write_report(Instrument* self) {
  const VoiceReport report = self->kind->report(self->player);
  write_value(self, self->kind->meters, report.n_strings);
  write_value(self, self->kind->meters + 1, report.n_masses);
  write_value(self, self->kind->meters + 2, report.headroom);
  write_value(self, self->kind->stability_used, 1.0 - report.headroom);
}

static void play_midi(Instrument* self, const Event* event) {
  channels_play(&self->channels, event->body, event->size, self->is_muted);
}

static void play_own(Instrument* self, const Event* event) {
  self->kind->play_event(self->player, event->body, event->size, self->is_muted);
}

/* Events split the block. */
static void play_block(Instrument* self, const void* control, uint32_t n_frames) {
  uint32_t done = 0;
  uint32_t offset = 0;
  Event event;
  while (events_next(control, self->urids.atom_Sequence, &offset, &event)) {
    const bool is_midi = event.type == self->urids.midi_MidiEvent;
    const bool is_own = self->kind->play_event && event.type == self->urids.own;
    if (is_midi || is_own) {
      const uint32_t frame = events_frame(&event, done, n_frames);
      render(self, done, frame);
      done = frame;
      (is_midi ? play_midi : play_own)(self, &event);
    } else {
      files_hear(self->files, event.type, event.body, event.size);
    }
  }
  render(self, done, n_frames);
}

static void free_instrument(Instrument* self) {
  if (self->player) {
    self->kind->free(self->player);
  }
  files_free(self->files);
  free(self);
}

/* What files say takes effect at the start of a block; which, is the worker's affair.  Whether
 * there is a new body. */
static bool take_files(Instrument* self) {
  const FilesNews news = files_take(self->files);
  if (news.has_pitches) {
    channels_set_scale(&self->channels, files_pitches(self->files));
  }
  if (news.has_body) {
    self->kind->set_body(self->player, files_body(self->files));
  }
  return news.has_body;
}

static LV2_Worker_Status work(LV2_Handle handle,
                              LV2_Worker_Respond_Function respond,
                              LV2_Worker_Respond_Handle respond_handle,
                              uint32_t size,
                              const void* data) {
  const Instrument* const self = handle;
  (void)respond;
  (void)respond_handle;
  return files_work(self->files, size, data);
}

/* There is nothing to respond; but a host might not ask whether there is someone to. */
static LV2_Worker_Status work_response(LV2_Handle handle, uint32_t size, const void* body) {
  (void)handle;
  (void)size;
  (void)body;
  return LV2_WORKER_SUCCESS;
}

static LV2_State_Status save(LV2_Handle handle,
                             LV2_State_Store_Function store,
                             LV2_State_Handle state,
                             uint32_t flags,
                             const LV2_Feature* const* features) {
  Instrument* const self = handle;
  (void)flags;
  return files_state_save(self->files, store, state, features);
}

static LV2_State_Status restore(LV2_Handle handle,
                                LV2_State_Retrieve_Function retrieve,
                                LV2_State_Handle state,
                                uint32_t flags,
                                const LV2_Feature* const* features) {
  Instrument* const self = handle;
  (void)flags;
  return files_state_restore(self->files, retrieve, state, features);
}

static bool takes_rate(double rate_hz, const LV2_URID_Map* map, const LV2_Log_Log* log) {
  const bool is_taken = rate_hz > 0.0 && rate_hz <= MOST_RATE_HZ;
  if (!is_taken && log) {
    (void)log->printf(log->handle, map->map(map->handle, LV2_LOG__Error),
                      "hooke: found a rate of %g Hz, expected one above 0 and up to %g Hz\n",
                      rate_hz, MOST_RATE_HZ);
  }
  return is_taken;
}

LV2_Handle
instrument_new(const InstrumentKind* kind, double rate_hz, const LV2_Feature* const* features) {
  const LV2_URID_Map* const map = lv2_features_data(features, LV2_URID__map);
  const bool is_possible =
      map && takes_rate(rate_hz, map, lv2_features_data(features, LV2_LOG__log));
  Instrument* const self = is_possible ? calloc(1, sizeof(Instrument)) : NULL;
  if (!self) {
    return NULL;
  }
  self->kind = kind;
  self->rate_hz = rate_hz;
  limiter_init(&self->limiter, rate_hz);
  self->urids = map_urids(map, kind);
  self->player = kind->new (rate_hz);
  self->files = files_new(map, features, &kind->files);
  if (!self->player || !self->files) {
    free_instrument(self);
    return NULL;
  }
  self->channels.to = kind->perform(self->player);
  channels_reset(&self->channels);
  self->n_shortest = (uint32_t)(SHORTEST_GLIDE_S * rate_hz) + 1;
  return self;
}

void instrument_connect_port(LV2_Handle handle, uint32_t index, void* data) {
  Instrument* const self = handle;
  if (index < self->kind->n_ports) {
    self->ports[index] = data;
  }
}

void instrument_activate(LV2_Handle handle) {
  Instrument* const self = handle;
  self->kind->reset(self->player);
  channels_reset(&self->channels);
  channels_set_scale(&self->channels, files_pitches(self->files));
  limiter_init(&self->limiter, self->rate_hz);
  self->is_fresh = true;
}

void instrument_run(LV2_Handle handle, uint32_t n_frames) {
  Instrument* const self = handle;
  const uint64_t denormals = denormals_flush();
  LV2_Atom_Sequence* const notify = self->ports[PORT_NOTIFY];
  const uint32_t room = events_write_none(notify, self->urids.atom_Sequence);
  const bool is_new_body = take_files(self);
  take_controls(self, is_new_body, n_frames);
  play_block(self, self->ports[PORT_CONTROL], n_frames);
  self->is_fresh = self->is_fresh && n_frames == 0;
  write_report(self);
  files_tell(self->files, notify, room);
  denormals_restore(denormals);
}

void instrument_cleanup(LV2_Handle handle) {
  free_instrument(handle);
}

const void* instrument_extension(const char* uri) {
  static const LV2_State_Interface state = {.save = save, .restore = restore};
  static const LV2_Worker_Interface worker = {.work = work, .work_response = work_response};
  if (!strcmp(uri, LV2_STATE__interface)) {
    return &state;
  }
  return strcmp(uri, LV2_WORKER__interface) ? NULL : &worker;
}
