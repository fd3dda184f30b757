#include "tools/host/host_impl.h"

#include <lv2/midi/midi.h>
#include <string.h>

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

static bool write_events(Host* host, HostPort* port, uint32_t n_frames, bool has_events) {
  static const HostEvents no_events = {0};
  const HostEvents* const events = has_events ? &host->events : &no_events;
  const size_t size = host_events_size(events, n_frames) - sizeof(LV2_Atom);
  if (size > port->capacity) {
    if (size > UINT32_MAX / 2 || !host_port_resize(port, (uint32_t)(2 * size))) {
      return host_fail(host, "out of memory for %zu bytes of events", size);
    }
    host_connect(host, (uint32_t)(port - host->ports.ports), port->atom);
  }
  host_events_write(events, n_frames, host->sequence_type, (LV2_Atom_Sequence*)port->atom);
  return true;
}

static bool prepare_port(Host* host, uint32_t index, uint32_t n_frames) {
  HostPort* const port = &host->ports.ports[index];
  if (is_frames(port) && !port->is_input) {
    poison(port, n_frames);
  } else if (port->type == HOST_PORT_ATOM && port->is_input) {
    return write_events(host, port, n_frames, index == host->ports.events_in);
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
  if (n_frames > host->max_block) {
    return host_fail(host, "run of %u frames, expected at most %u", n_frames, host->max_block);
  }
  for (uint32_t i = 0; i < host->ports.n_ports; ++i) {
    if (!prepare_port(host, i, n_frames)) {
      return false;
    }
  }
  host_activate(host);
  host->worker.is_running = true;
  lilv_instance_run(host->instance, n_frames);
  host->worker.is_running = false;
  host_worker_finish_run(&host->worker);
  host_events_advance(&host->events, n_frames);
  bool is_ok = true;
  for (uint32_t i = 0; i < host->ports.n_ports; ++i) {
    is_ok = check_port(host, &host->ports.ports[i], n_frames) && is_ok;
  }
  return is_ok;
}

static bool queue_event(
    Host* host, int64_t frame, LV2_URID type, const void* body, uint32_t size, bool is_raw) {
  if (host->ports.events_in == UINT32_MAX) {
    return host_fail(host, "plugin has no port for MIDI");
  }
  if (!type || !host_events_push(&host->events, frame, type, body, size, is_raw)) {
    return host_fail(host, "out of memory");
  }
  return true;
}

bool host_midi(Host* host, uint32_t frame, const uint8_t* bytes, uint32_t size) {
  return queue_event(host, frame, host_map(host, LV2_MIDI__MidiEvent), bytes, size, false);
}

bool host_midi_raw(Host* host, int64_t frame, const uint8_t* bytes, uint32_t size) {
  return queue_event(host, frame, host_map(host, LV2_MIDI__MidiEvent), bytes, size, true);
}

bool host_atom(Host* host, uint32_t frame, const char* type_uri, const void* body, uint32_t size) {
  return queue_event(host, frame, host_map(host, type_uri), body, size, false);
}

const LV2_Atom_Sequence* host_notify(const Host* host) {
  const uint32_t i = host->ports.notify;
  return i == UINT32_MAX ? NULL : (const LV2_Atom_Sequence*)host->ports.ports[i].atom;
}

bool host_set_notify_capacity(Host* host, uint32_t capacity) {
  for (uint32_t i = 0; i < host->ports.n_ports; ++i) {
    HostPort* const port = &host->ports.ports[i];
    if (port->type == HOST_PORT_ATOM && !port->is_input) {
      if (!host_port_resize(port, capacity)) {
        return host_fail(host, "out of memory");
      }
      host_connect(host, i, port->atom);
    }
  }
  return true;
}
