#include "tools/host/host_impl.h"

#include <math.h>
#include <string.h>

HostPort* host_find_port(const Host* host, const char* symbol, HostPortType type) {
  const uint32_t i = host_port_index(host, symbol);
  return i != UINT32_MAX && host->ports.ports[i].type == type ? &host->ports.ports[i] : NULL;
}

uint32_t host_port_index(const Host* host, const char* symbol) {
  for (uint32_t i = 0; i < host->ports.n_ports; ++i) {
    if (!strcmp(host->ports.ports[i].symbol, symbol)) {
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

bool host_set_freewheel(Host* host, bool is_freewheeling) {
  const uint32_t i = host->ports.freewheel;
  if (i == UINT32_MAX) {
    return host_fail(host, "plugin has no freewheeling port");
  }
  host->ports.ports[i].value = is_freewheeling ? 1.0F : 0.0F;
  return true;
}

uint32_t host_n_ports(const Host* host) {
  return host->ports.n_ports;
}

const char* host_port_symbol(const Host* host, uint32_t index) {
  return index < host->ports.n_ports ? host->ports.ports[index].symbol : NULL;
}

bool host_port_is_control_input(const Host* host, uint32_t index) {
  return index < host->ports.n_ports && host->ports.ports[index].type == HOST_PORT_CONTROL &&
         host->ports.ports[index].is_input;
}

uint32_t host_n_outputs(const Host* host) {
  uint32_t n = 0;
  while (host_output(host, n)) {
    ++n;
  }
  return n;
}

const float* host_output(const Host* host, uint32_t k) {
  const HostPort* const port = host_ports_nth(&host->ports, HOST_PORT_AUDIO, false, k);
  return port ? port->frames : NULL;
}

const float* host_output_named(const Host* host, const char* symbol) {
  const HostPort* const port = host_find_port(host, symbol, HOST_PORT_AUDIO);
  return port && !port->is_input ? port->frames : NULL;
}

float* host_input(Host* host, uint32_t k) {
  const HostPort* const port = host_ports_nth(&host->ports, HOST_PORT_AUDIO, true, k);
  return port ? port->frames : NULL;
}
