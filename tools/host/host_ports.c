#define _POSIX_C_SOURCE 200809L

#include "tools/host/host_impl.h"

#include <lv2/midi/midi.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ATOM_CAPACITY = 8192 };

/* A question about a port that lilv answers by a node. */
static bool ask(Host* host,
                const LilvPort* port,
                const char* uri,
                bool (*question)(const LilvPlugin*, const LilvPort*, const LilvNode*)) {
  LilvNode* const node = lilv_new_uri(host->world, uri);
  const bool answer = node && question(host->plugin, port, node);
  lilv_node_free(node);
  return answer;
}

static HostPortType port_type(Host* host, const LilvPort* port) {
  static const struct {
    const char* uri;
    HostPortType type;
  } classes[] = {{LV2_CORE__ControlPort, HOST_PORT_CONTROL},
                 {LV2_CORE__AudioPort, HOST_PORT_AUDIO},
                 {LV2_CORE__CVPort, HOST_PORT_CV},
                 {LV2_ATOM__AtomPort, HOST_PORT_ATOM}};
  for (unsigned i = 0; i < sizeof(classes) / sizeof(classes[0]); ++i) {
    if (ask(host, port, classes[i].uri, lilv_port_is_a)) {
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

static HostRange port_range(Host* host, const LilvPort* port) {
  LilvNode* initial = NULL;
  LilvNode* min = NULL;
  LilvNode* max = NULL;
  lilv_port_get_range(host->plugin, port, &initial, &min, &max);
  HostRange range = {
      .min = node_value(min), .max = node_value(max), .initial = node_value(initial)};
  range.is_choice = ask(host, port, LV2_CORE__enumeration, lilv_port_has_property);
  range.is_toggle = ask(host, port, LV2_CORE__toggled, lilv_port_has_property);
  range.is_integer = range.is_choice || range.is_toggle ||
                     ask(host, port, LV2_CORE__integer, lilv_port_has_property);
  if (!isfinite(range.initial)) {
    range.initial = fmaxf(fminf(0.0F, range.max), range.min);
  }
  return range;
}

static bool allocate(Host* host, HostPort* port) {
  if (port->type == HOST_PORT_AUDIO || port->type == HOST_PORT_CV) {
    port->frames = calloc((size_t)host->max_block + HOST_GUARD_FRAMES, sizeof(float));
    return port->frames;
  }
  return port->type != HOST_PORT_ATOM || host_resize_port(port, ATOM_CAPACITY);
}

static bool init_port(Host* host, HostPort* self, const LilvPort* port) {
  self->type = port_type(host, port);
  self->is_input = ask(host, port, LV2_CORE__InputPort, lilv_port_is_a);
  self->symbol = strdup(lilv_node_as_string(lilv_port_get_symbol(host->plugin, port)));
  if (self->type == HOST_PORT_CONTROL) {
    self->range = port_range(host, port);
    self->value = self->range.initial;
    if (!host_read_choices(host, self, port)) {
      return false;
    }
  }
  self->takes_midi = self->type == HOST_PORT_ATOM &&
                     ask(host, port, LV2_MIDI__MidiEvent, lilv_port_supports_event);
  return self->symbol && allocate(host, self);
}

static uint32_t find_atom(const Host* host, bool is_input, bool takes_midi) {
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    const HostPort* const port = &host->ports[i];
    if (port->type == HOST_PORT_ATOM && port->is_input == is_input &&
        (port->takes_midi || !takes_midi)) {
      return i;
    }
  }
  return UINT32_MAX;
}

bool host_make_ports(Host* host) {
  const uint32_t n_ports = lilv_plugin_get_num_ports(host->plugin);
  host->ports = calloc(n_ports + 1, sizeof(HostPort));
  host->n_ports = host->ports ? n_ports : 0;
  bool is_ok = host->ports;
  for (uint32_t i = 0; is_ok && i < n_ports; ++i) {
    const LilvPort* const port = lilv_plugin_get_port_by_index(host->plugin, i);
    is_ok = port && init_port(host, &host->ports[i], port);
  }
  host->events_in = find_atom(host, true, true);
  host->notify = find_atom(host, false, false);
  return is_ok;
}

bool host_resize_port(HostPort* port, uint32_t capacity) {
  LV2_Atom* const atom = calloc(1, sizeof(LV2_Atom) + capacity);
  if (!atom) {
    return false;
  }
  free(port->atom);
  port->atom = atom;
  port->capacity = capacity;
  return true;
}

void host_clear_ports(Host* host) {
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    host_clear_choices(&host->ports[i]);
    free(host->ports[i].symbol);
    free(host->ports[i].frames);
    free(host->ports[i].atom);
  }
  free(host->ports);
}

HostPort* host_find_port(const Host* host, const char* symbol, HostPortType type) {
  const uint32_t i = host_port_index(host, symbol);
  return i != UINT32_MAX && host->ports[i].type == type ? &host->ports[i] : NULL;
}

uint32_t host_port_index(const Host* host, const char* symbol) {
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    if (!strcmp(host->ports[i].symbol, symbol)) {
      return i;
    }
  }
  return UINT32_MAX;
}

bool host_set(Host* host, const char* symbol, float value) {
  HostPort* const port = host_find_port(host, symbol, HOST_PORT_CONTROL);
  if (!port) {
    return host_fail(host, "no control port of symbol '%s'", symbol);
  }
  port->value = value;
  return true;
}

float host_get(const Host* host, const char* symbol) {
  const HostPort* const port = host_find_port(host, symbol, HOST_PORT_CONTROL);
  return port ? port->value : NAN;
}

bool host_range(const Host* host, const char* symbol, HostRange* range) {
  const HostPort* const port = host_find_port(host, symbol, HOST_PORT_CONTROL);
  if (!port || !port->is_input) {
    return false;
  }
  *range = port->range;
  return true;
}

const char* host_symbol(const Host* host, uint32_t i) {
  return i < host->n_ports ? host->ports[i].symbol : NULL;
}

bool host_set_freewheel(Host* host, bool is_freewheeling) {
  LilvNode* const input = lilv_new_uri(host->world, LV2_CORE__InputPort);
  LilvNode* const node = lilv_new_uri(host->world, LV2_CORE__freeWheeling);
  const LilvPort* const port = lilv_plugin_get_port_by_designation(host->plugin, input, node);
  lilv_node_free(node);
  lilv_node_free(input);
  if (!port) {
    return host_fail(host, "plugin has no freewheeling port");
  }
  host->ports[lilv_port_get_index(host->plugin, port)].value = is_freewheeling ? 1.0F : 0.0F;
  return true;
}

bool host_takes(Host* host, const char* type_uri) {
  bool is_taken = false;
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    const LilvPort* const port = lilv_plugin_get_port_by_index(host->plugin, i);
    is_taken = is_taken || ask(host, port, type_uri, lilv_port_supports_event);
  }
  return is_taken;
}

const float* host_output(const Host* host, uint32_t k) {
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    const HostPort* const port = &host->ports[i];
    if (port->type == HOST_PORT_AUDIO && !port->is_input && k-- == 0) {
      return port->frames;
    }
  }
  return NULL;
}
