#include "tools/host/host_events.h"

#include <lv2/atom/util.h>
#include <stdlib.h>
#include <string.h>

static bool is_due(const HostQueued* event, uint32_t n_frames) {
  return event->is_raw || event->frame < (int64_t)n_frames;
}

static bool events_reserve(HostEvents* events) {
  if (events->n_queued < events->capacity) {
    return true;
  }
  const size_t capacity = events->capacity ? 2 * events->capacity : 64;
  HostQueued* const queued = realloc(events->queued, capacity * sizeof(*queued));
  if (!queued) {
    return false;
  }
  events->queued = queued;
  events->capacity = capacity;
  return true;
}

/* Where an event goes: behind all that are not later, but never behind a raw one, which stays last.
 */
static size_t events_place(const HostEvents* events, int64_t frame, bool is_raw) {
  size_t i = events->n_queued;
  while (!is_raw && i > 0 &&
         (events->queued[i - 1].is_raw || events->queued[i - 1].frame > frame)) {
    --i;
  }
  return i;
}

bool host_events_push(HostEvents* events,
                      int64_t frame,
                      LV2_URID type,
                      const void* body,
                      uint32_t size,
                      bool is_raw) {
  const size_t body_at = events->bodies.size;
  if (!events_reserve(events) || !bytes_append(&events->bodies, body, size)) {
    return false;
  }
  const size_t i = events_place(events, frame, is_raw);
  HostQueued* const place = events->queued + i;
  memmove(place + 1, place, (events->n_queued - i) * sizeof(*place));
  *place = (HostQueued){frame, type, size, body_at, is_raw};
  ++events->n_queued;
  return true;
}

size_t host_events_size(const HostEvents* events, uint32_t n_frames) {
  size_t size = sizeof(LV2_Atom_Sequence);
  for (size_t i = 0; i < events->n_queued; ++i) {
    if (is_due(&events->queued[i], n_frames)) {
      size += sizeof(LV2_Atom_Event) + lv2_atom_pad_size(events->queued[i].size);
    }
  }
  return size;
}

void host_events_write(const HostEvents* events,
                       uint32_t n_frames,
                       LV2_URID type,
                       LV2_Atom_Sequence* sequence) {
  uint8_t* out = (uint8_t*)(sequence + 1);
  for (size_t i = 0; i < events->n_queued; ++i) {
    const HostQueued* const queued = &events->queued[i];
    if (is_due(queued, n_frames)) {
      const LV2_Atom_Event head = {{queued->frame}, {queued->size, queued->type}};
      memcpy(out, &head, sizeof(head));
      memset(out + sizeof(head), 0, lv2_atom_pad_size(queued->size));
      if (queued->size > 0) {
        memcpy(out + sizeof(head), events->bodies.data + queued->body_at, queued->size);
      }
      out += sizeof(head) + lv2_atom_pad_size(queued->size);
    }
  }
  const size_t size = (size_t)(out - (uint8_t*)&sequence->body);
  *sequence = (LV2_Atom_Sequence){{(uint32_t)size, type}, {0, 0}};
}

void host_events_advance(HostEvents* events, uint32_t n_frames) {
  size_t n_kept = 0;
  for (size_t i = 0; i < events->n_queued; ++i) {
    if (!is_due(&events->queued[i], n_frames)) {
      events->queued[n_kept] = events->queued[i];
      events->queued[n_kept++].frame -= n_frames;
    }
  }
  events->n_queued = n_kept;
  if (n_kept == 0) {
    events->bodies.size = 0;
  }
}

void host_events_clear(HostEvents* events) {
  free(events->queued);
  bytes_clear(&events->bodies);
  *events = (HostEvents){0};
}
