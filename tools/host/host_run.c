#include "tools/host/host_impl.h"

#include <lv2/atom/util.h>
#include <lv2/midi/midi.h>
#include <string.h>

/* Events on their way: a queue in order of frames, written block by block as an atom sequence */

static HostQueued* queue_of(const Host* host, size_t* n_queued) {
  *n_queued = host->queue.size / sizeof(HostQueued);
  return (HostQueued*)(void*)host->queue.data;
}

/* A raw event is sent with the next run though its frame be negative, unordered or too late. */
static bool is_due(const HostQueued* event, uint32_t n_frames) {
  return event->is_raw || event->frame < (int64_t)n_frames;
}

/* Behind all that are not later, but never behind a raw one; those stay last. */
bool host_queue(
    Host* host, int64_t frame, LV2_URID type, const void* body, uint32_t size, bool is_raw) {
  const HostQueued event = {frame, type, size, host->bodies.size, is_raw};
  if (host->events_in == UINT32_MAX) {
    return host_fail(host, "plugin has no port for MIDI");
  }
  if (!type || !bytes_append(&host->bodies, body, size) ||
      !bytes_append(&host->queue, NULL, sizeof(event))) {
    return host_fail(host, "out of memory");
  }
  size_t i = 0;
  HostQueued* const queue = queue_of(host, &i);
  for (--i; !is_raw && i > 0 && (queue[i - 1].is_raw || queue[i - 1].frame > frame); --i) {
    queue[i] = queue[i - 1];
  }
  queue[i] = event;
  return true;
}

/* The size of the sequence that a run takes, without its atom header. */
static size_t size_of_events(const Host* host, uint32_t n_frames) {
  size_t n_queued = 0;
  const HostQueued* const queue = queue_of(host, &n_queued);
  size_t size = sizeof(LV2_Atom_Sequence_Body);
  for (size_t i = 0; i < n_queued; ++i) {
    size +=
        is_due(&queue[i], n_frames) ? sizeof(LV2_Atom_Event) + lv2_atom_pad_size(queue[i].size) : 0;
  }
  return size;
}

static uint8_t* write_event(const Host* host, const HostQueued* event, uint8_t* out) {
  const LV2_Atom_Event head = {{event->frame}, {event->size, event->type}};
  memcpy(out, &head, sizeof(head));
  out += sizeof(head);
  memset(out, 0, lv2_atom_pad_size(event->size));
  if (event->size > 0) {
    memcpy(out, host->bodies.data + event->body_at, event->size);
  }
  return out + lv2_atom_pad_size(event->size);
}

/* Write the events of a run to a port, and keep the others, which are nearer then. */
static bool send_events(Host* host, HostPort* port, uint32_t n_frames) {
  const size_t size = size_of_events(host, n_frames);
  if (size > port->capacity) {
    if (size > UINT32_MAX / 2 || !host_resize_port(port, (uint32_t)(2 * size))) {
      return host_fail(host, "out of memory for %zu bytes of events", size);
    }
    host_connect(host, (uint32_t)(port - host->ports), port->atom);
  }
  LV2_Atom_Sequence* const sequence = (LV2_Atom_Sequence*)port->atom;
  *sequence = (LV2_Atom_Sequence){{(uint32_t)size, host->sequence_type}, {0, 0}};
  uint8_t* out = (uint8_t*)(sequence + 1);
  size_t n_queued = 0;
  size_t n_kept = 0;
  HostQueued* const queue = queue_of(host, &n_queued);
  for (size_t i = 0; i < n_queued; ++i) {
    if (is_due(&queue[i], n_frames)) {
      out = write_event(host, &queue[i], out);
    } else {
      queue[n_kept] = queue[i];
      queue[n_kept++].frame -= n_frames;
    }
  }
  host->queue.size = n_kept * sizeof(HostQueued);
  host->bodies.size = n_kept ? host->bodies.size : 0;
  return true;
}

/* Runs */

static bool is_frames(const HostPort* port) {
  return port->type == HOST_PORT_AUDIO || port->type == HOST_PORT_CV;
}

/* All bits set is a NaN: a frame that the plugin leaves out is seen, and a guard that it writes to
 * as well. */
static void poison(HostPort* port, uint32_t n_frames) {
  memset(port->frames, 0xFF, ((size_t)n_frames + HOST_GUARD_FRAMES) * sizeof(float));
}

static bool is_guard_whole(const HostPort* port, uint32_t n_frames) {
  uint8_t guard[HOST_GUARD_FRAMES * sizeof(float)];
  memcpy(guard, port->frames + n_frames, sizeof(guard));
  bool is_whole = true;
  for (size_t i = 0; i < sizeof(guard); ++i) {
    is_whole = is_whole && guard[i] == 0xFF;
  }
  return is_whole;
}

static bool prepare_port(Host* host, uint32_t index, uint32_t n_frames) {
  HostPort* const port = &host->ports[index];
  if (is_frames(port) && !port->is_input) {
    poison(port, n_frames);
  } else if (port->type == HOST_PORT_ATOM && port->is_input) {
    if (index == host->events_in) {
      return send_events(host, port, n_frames);
    }
    *(LV2_Atom_Sequence*)port->atom =
        (LV2_Atom_Sequence){{sizeof(LV2_Atom_Sequence_Body), host->sequence_type}, {0, 0}};
  } else if (port->type == HOST_PORT_ATOM) {
    *port->atom = (LV2_Atom){port->capacity, host->chunk_type};
  }
  return true;
}

static bool check_port(Host* host, const HostPort* port, uint32_t n_frames) {
  if (port->is_input) {
    return true;
  }
  if (is_frames(port) && !is_guard_whole(port, n_frames)) {
    return host_fail(host, "port %s: written past frame %u", port->symbol, n_frames);
  }
  if (port->type == HOST_PORT_ATOM && port->atom->size > port->capacity) {
    return host_fail(host, "port %s: %u bytes written, room for %u", port->symbol, port->atom->size,
                     port->capacity);
  }
  return true;
}

bool host_run(Host* host, uint32_t n_frames) {
  if (n_frames > (uint32_t)host->max_block) {
    return host_fail(host, "run of %u frames, expected at most %d", n_frames, host->max_block);
  }
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    if (!prepare_port(host, i, n_frames)) {
      return false;
    }
  }
  host_activate(host);
  host->worker.is_running = true;
  lilv_instance_run(host->instance, n_frames);
  host->worker.is_running = false;
  host_worker_finish_run(&host->worker);
  bool is_ok = true;
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    is_ok = check_port(host, &host->ports[i], n_frames) && is_ok;
  }
  return is_ok;
}

bool host_midi(Host* host, uint32_t frame, const uint8_t* bytes, uint32_t size) {
  return host_queue(host, frame, host_map(host, LV2_MIDI__MidiEvent), bytes, size, false);
}

bool host_midi_raw(Host* host, int64_t frame, const uint8_t* bytes, uint32_t size) {
  return host_queue(host, frame, host_map(host, LV2_MIDI__MidiEvent), bytes, size, true);
}

bool host_atom(Host* host, uint32_t frame, const char* type_uri, const void* body, uint32_t size) {
  return host_queue(host, frame, host_map(host, type_uri), body, size, false);
}
