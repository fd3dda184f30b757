#define _POSIX_C_SOURCE 200809L

#include "tools/host/host_ports.h"

#include <lv2/core/lv2.h>
#include <lv2/midi/midi.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ATOM_CAPACITY = 8192 };

static bool
port_is(LilvWorld* world, const LilvPlugin* plugin, const LilvPort* port, const char* class_uri) {
  LilvNode* const node = lilv_new_uri(world, class_uri);
  const bool answer = lilv_port_is_a(plugin, port, node);
  lilv_node_free(node);
  return answer;
}

static bool
port_has(LilvWorld* world, const LilvPlugin* plugin, const LilvPort* port, const char* property) {
  LilvNode* const node = lilv_new_uri(world, property);
  const bool answer = lilv_port_has_property(plugin, port, node);
  lilv_node_free(node);
  return answer;
}

static bool port_takes_midi(LilvWorld* world, const LilvPlugin* plugin, const LilvPort* port) {
  LilvNode* const node = lilv_new_uri(world, LV2_MIDI__MidiEvent);
  const bool answer = lilv_port_supports_event(plugin, port, node);
  lilv_node_free(node);
  return answer;
}

static HostPortType port_type(LilvWorld* world, const LilvPlugin* plugin, const LilvPort* port) {
  static const struct {
    const char* uri;
    HostPortType type;
  } classes[] = {{LV2_CORE__ControlPort, HOST_PORT_CONTROL},
                 {LV2_CORE__AudioPort, HOST_PORT_AUDIO},
                 {LV2_CORE__CVPort, HOST_PORT_CV},
                 {LV2_ATOM__AtomPort, HOST_PORT_ATOM}};
  for (unsigned i = 0; i < sizeof(classes) / sizeof(classes[0]); ++i) {
    if (port_is(world, plugin, port, classes[i].uri)) {
      return classes[i].type;
    }
  }
  return HOST_PORT_OTHER;
}

static float node_value(LilvNode* node) {
  const bool is_number = node && (lilv_node_is_float(node) || lilv_node_is_int(node));
  const float value = is_number                         ? lilv_node_as_float(node)
                      : node && lilv_node_is_bool(node) ? (float)lilv_node_as_bool(node)
                                                        : NAN;
  lilv_node_free(node);
  return value;
}

static HostRange port_range(LilvWorld* world, const LilvPlugin* plugin, const LilvPort* port) {
  LilvNode* initial = NULL;
  LilvNode* min = NULL;
  LilvNode* max = NULL;
  lilv_port_get_range(plugin, port, &initial, &min, &max);
  HostRange range = {node_value(min), node_value(max), node_value(initial), false};
  range.is_integer = port_has(world, plugin, port, LV2_CORE__integer) ||
                     port_has(world, plugin, port, LV2_CORE__enumeration) ||
                     port_has(world, plugin, port, LV2_CORE__toggled);
  if (!isfinite(range.initial)) {
    range.initial = fmaxf(fminf(0.0F, range.max), range.min);
  }
  return range;
}

static bool port_allocate(HostPort* port, uint32_t max_block) {
  if (port->type == HOST_PORT_AUDIO || port->type == HOST_PORT_CV) {
    port->frames = calloc((size_t)max_block + HOST_GUARD_FRAMES, sizeof(float));
    return port->frames;
  }
  return port->type != HOST_PORT_ATOM || host_port_resize(port, ATOM_CAPACITY);
}

static bool port_init(HostPort* self,
                      LilvWorld* world,
                      const LilvPlugin* plugin,
                      const LilvPort* port,
                      uint32_t max_block) {
  self->type = port_type(world, plugin, port);
  self->is_input = port_is(world, plugin, port, LV2_CORE__InputPort);
  self->symbol = strdup(lilv_node_as_string(lilv_port_get_symbol(plugin, port)));
  if (self->type == HOST_PORT_CONTROL) {
    self->range = port_range(world, plugin, port);
    self->value = self->range.initial;
  }
  self->takes_midi = self->type == HOST_PORT_ATOM && port_takes_midi(world, plugin, port);
  return self->symbol && port_allocate(self, max_block);
}

static uint32_t
find_designated(LilvWorld* world, const LilvPlugin* plugin, const char* designation) {
  LilvNode* const class_node = lilv_new_uri(world, LV2_CORE__InputPort);
  LilvNode* const node = lilv_new_uri(world, designation);
  const LilvPort* const port = lilv_plugin_get_port_by_designation(plugin, class_node, node);
  lilv_node_free(node);
  lilv_node_free(class_node);
  return port ? lilv_port_get_index(plugin, port) : UINT32_MAX;
}

static uint32_t find_atom(const HostPorts* ports, bool is_input, bool takes_midi) {
  for (uint32_t i = 0; i < ports->n_ports; ++i) {
    const HostPort* const port = &ports->ports[i];
    if (port->type == HOST_PORT_ATOM && port->is_input == is_input &&
        (port->takes_midi || !takes_midi)) {
      return i;
    }
  }
  return UINT32_MAX;
}

bool host_ports_init(HostPorts* ports,
                     LilvWorld* world,
                     const LilvPlugin* plugin,
                     uint32_t max_block) {
  const uint32_t n_ports = lilv_plugin_get_num_ports(plugin);
  ports->ports = calloc(n_ports ? n_ports : 1, sizeof(HostPort));
  if (!ports->ports) {
    return false;
  }
  ports->n_ports = n_ports;
  for (uint32_t i = 0; i < n_ports; ++i) {
    const LilvPort* const port = lilv_plugin_get_port_by_index(plugin, i);
    if (!port || !port_init(&ports->ports[i], world, plugin, port, max_block)) {
      return false;
    }
  }
  ports->freewheel = find_designated(world, plugin, LV2_CORE__freeWheeling);
  ports->events_in = find_atom(ports, true, true);
  ports->notify = find_atom(ports, false, false);
  return true;
}

void* host_port_data(HostPort* port) {
  switch (port->type) {
  case HOST_PORT_CONTROL:
    return &port->value;
  case HOST_PORT_AUDIO:
  case HOST_PORT_CV:
    return port->frames;
  case HOST_PORT_ATOM:
    return port->atom;
  case HOST_PORT_OTHER:
    break;
  }
  return NULL;
}

bool host_port_resize(HostPort* port, uint32_t capacity) {
  LV2_Atom* const atom = calloc(1, sizeof(LV2_Atom) + capacity);
  if (!atom) {
    return false;
  }
  free(port->atom);
  port->atom = atom;
  port->capacity = capacity;
  return true;
}

HostPort* host_ports_nth(const HostPorts* ports, HostPortType type, bool is_input, uint32_t k) {
  for (uint32_t i = 0; i < ports->n_ports; ++i) {
    HostPort* const port = &ports->ports[i];
    if (port->type == type && port->is_input == is_input && k-- == 0) {
      return port;
    }
  }
  return NULL;
}

void host_ports_clear(HostPorts* ports) {
  for (uint32_t i = 0; i < ports->n_ports; ++i) {
    free(ports->ports[i].symbol);
    free(ports->ports[i].frames);
    free(ports->ports[i].atom);
  }
  free(ports->ports);
  *ports = (HostPorts){0};
}
