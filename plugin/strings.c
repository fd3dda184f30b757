/* Hooke Strings, the LV2 plugin: ports and events in, samples out, and no physics. */
#include "core/harp.h"
#include "plugin/denormals.h"
#include "plugin/midi.h"
#include "plugin/ports.h"

#include <lv2/atom/atom.h>
#include <lv2/core/lv2.h>
#include <lv2/midi/midi.h>
#include <lv2/urid/urid.h>

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define STRINGS_URI "urn:hooke:strings"

/* The shortest time in which a port's change takes effect [s]; else it takes the block. */
static const double SHORTEST_GLIDE_S = 0.005;

typedef struct {
  LV2_URID atom_Sequence;
  LV2_URID midi_MidiEvent;
} Urids;

typedef struct {
  /* Features */
  Urids urids;

  /* Ports */
  void* ports[N_PORTS];

  /* State */
  Harp* harp;
  Controls controls;
  bool is_fresh; /* Whether nothing has been played since activation: there is nothing to glide from
                  */
  bool is_muted;
  float left[HARP_MIX_FRAMES];
  float right[HARP_MIX_FRAMES];
} Strings;

/* An event of the control port, copied out, for a host may align it to four bytes. */
typedef struct {
  int64_t frame;
  uint32_t type;
  uint32_t size;
  const uint8_t* body;
} Event;

static const LV2_URID_Map* find_map(const LV2_Feature* const* features) {
  for (; features && *features; ++features) {
    if (!strcmp((*features)->URI, LV2_URID__map)) {
      return (const LV2_URID_Map*)(*features)->data;
    }
  }
  return NULL;
}

static LV2_Handle instantiate(const LV2_Descriptor* descriptor,
                              double rate,
                              const char* bundle_path,
                              const LV2_Feature* const* features) {
  (void)descriptor;
  (void)bundle_path;
  const LV2_URID_Map* const map = find_map(features);
  Strings* const self = map ? calloc(1, sizeof(Strings)) : NULL;
  if (!self) {
    return NULL;
  }
  self->urids.atom_Sequence = map->map(map->handle, LV2_ATOM__Sequence);
  self->urids.midi_MidiEvent = map->map(map->handle, LV2_MIDI__MidiEvent);
  self->harp = harp_new(rate);
  if (!self->harp) {
    free(self);
    return NULL;
  }
  return self;
}

static void connect_port(LV2_Handle handle, uint32_t index, void* data) {
  Strings* const self = handle;
  if (index < N_PORTS) {
    self->ports[index] = data;
  }
}

static void activate(LV2_Handle handle) {
  Strings* const self = handle;
  harp_reset(self->harp);
  self->is_fresh = true;
}

/* A port that changed takes the whole block to get there, so that a host's stairs become slopes. */
static void take_controls(Strings* self, uint32_t n_frames) {
  Controls controls = ports_read(self->ports);
  controls.value[PORT_FREEWHEEL] = 0.0f; /* It sounds the same. */
  if (!self->is_fresh && ports_are_same(&controls, &self->controls)) {
    return;
  }
  const uint32_t n_shortest = (uint32_t)(SHORTEST_GLIDE_S * self->harp->rate_hz) + 1;
  const uint32_t n_glide = n_frames > n_shortest ? n_frames : n_shortest;
  const Patch patch = ports_patch(&controls);
  harp_set_patch(self->harp, &patch, self->is_fresh ? 0 : n_glide);
  const bool is_muted = controls.value[PORT_ENABLED] < 0.5f;
  if (is_muted && !self->is_muted) {
    harp_all_sound_off(self->harp);
  }
  self->is_muted = is_muted;
  self->controls = controls;
  self->is_fresh = false;
}

static void write_frames(float* out, const float* from, uint32_t n_frames) {
  if (out) {
    memcpy(out, from, n_frames * sizeof(float));
  }
}

/* Run from frame `from` to frame `to` of the block.  A host may connect neither side, or one buffer
 * to both. */
static void render(Strings* self, uint32_t from, uint32_t to) {
  float* const left = self->ports[PORT_OUT_LEFT];
  float* const right = self->ports[PORT_OUT_RIGHT];
  while (from < to) {
    const uint32_t n = to - from < HARP_MIX_FRAMES ? to - from : HARP_MIX_FRAMES;
    harp_run(self->harp, n, self->left, self->right);
    if (left && left == right) {
      for (uint32_t i = 0; i < n; ++i) {
        self->left[i] = self->right[i] = 0.5f * (self->left[i] + self->right[i]);
      }
    }
    write_frames(left ? left + from : NULL, self->left, n);
    write_frames(right ? right + from : NULL, self->right, n);
    from += n;
  }
}

/* The event `*offset` bytes into a sequence's events, and the offset of the next; false when they
 * are over. */
static bool
next_event(const Strings* self, const LV2_Atom_Sequence* sequence, uint32_t* offset, Event* event) {
  if (!sequence || sequence->atom.type != self->urids.atom_Sequence ||
      sequence->atom.size < sizeof(LV2_Atom_Sequence_Body)) {
    return false;
  }
  const uint32_t n_bytes = sequence->atom.size - (uint32_t)sizeof(LV2_Atom_Sequence_Body);
  const uint8_t* const bytes = (const uint8_t*)(sequence + 1) + *offset;
  LV2_Atom_Event head;
  if (*offset + sizeof(head) > n_bytes) {
    return false;
  }
  memcpy(&head, bytes, sizeof(head));
  if (head.body.size > n_bytes - *offset - sizeof(head)) {
    return false;
  }
  *event = (Event){
      .frame = head.time.frames,
      .type = head.body.type,
      .size = head.body.size,
      .body = bytes + sizeof(head),
  };
  const uint32_t padded = (head.body.size + 7u) & ~7u;
  *offset += (uint32_t)sizeof(head) + padded;
  return true;
}

/* There is nothing to notify of yet; the host's word on the port's room must give way to an empty
 * sequence. */
static void write_notify(Strings* self) {
  LV2_Atom_Sequence* const notify = self->ports[PORT_NOTIFY];
  if (notify && notify->atom.size >= sizeof(LV2_Atom_Sequence_Body)) {
    notify->body.unit = 0;
    notify->body.pad = 0;
    notify->atom.size = sizeof(LV2_Atom_Sequence_Body);
    notify->atom.type = self->urids.atom_Sequence;
  } else if (notify) {
    notify->atom.size = 0;
    notify->atom.type = 0;
  }
}

static void write_value(Strings* self, uint32_t port, double value) {
  float* const out = self->ports[port];
  if (out) {
    *out = (float)value;
  }
}

static void write_report(Strings* self) {
  const HarpReport report = harp_report(self->harp);
  write_value(self, PORT_SOUNDING, report.n_strings);
  write_value(self, PORT_MASS_COUNT, report.n_masses);
  write_value(self, PORT_HEADROOM, report.headroom);
}

/* An event that comes late or out of order is played at once, one past the end at the end. */
static uint32_t frame_of(const Event* event, uint32_t done, uint32_t n_frames) {
  if (event->frame <= (int64_t)done) {
    return done;
  }
  return event->frame < (int64_t)n_frames ? (uint32_t)event->frame : n_frames;
}

/* Events split the block. */
static void play_block(Strings* self, const LV2_Atom_Sequence* control, uint32_t n_frames) {
  uint32_t done = 0;
  uint32_t offset = 0;
  Event event;
  while (next_event(self, control, &offset, &event)) {
    if (event.type == self->urids.midi_MidiEvent) {
      const uint32_t frame = frame_of(&event, done, n_frames);
      render(self, done, frame);
      done = frame;
      midi_play(self->harp, event.body, event.size, self->is_muted);
    }
  }
  render(self, done, n_frames);
}

static void run(LV2_Handle handle, uint32_t n_frames) {
  Strings* const self = handle;
  const uint64_t denormals = denormals_flush();
  take_controls(self, n_frames);
  play_block(self, self->ports[PORT_CONTROL], n_frames);
  write_report(self);
  write_notify(self);
  denormals_restore(denormals);
}

static void cleanup(LV2_Handle handle) {
  Strings* const self = handle;
  harp_free(self->harp);
  free(self);
}

static const LV2_Descriptor descriptor = {STRINGS_URI, instantiate, connect_port, activate,
                                          run,         NULL,        cleanup,      NULL};

LV2_SYMBOL_EXPORT const LV2_Descriptor* lv2_descriptor(uint32_t index) {
  return index == 0 ? &descriptor : NULL;
}
