#include "tests/support/host_inside.h"

#include "tools/host/host_impl.h"

LilvWorld* host_world(Host* host) {
  return host->world;
}

const LilvPlugin* host_plugin(const Host* host) {
  return host->plugin;
}

HostWorker* host_worker(Host* host) {
  return &host->worker;
}

const LV2_Atom_Sequence* host_notify(const Host* host) {
  const uint32_t i = host->notify;
  return i == UINT32_MAX ? NULL : (const LV2_Atom_Sequence*)host->ports[i].atom;
}

bool host_set_notify_capacity(Host* host, uint32_t capacity) {
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    HostPort* const port = &host->ports[i];
    if (port->type == HOST_PORT_ATOM && !port->is_input) {
      if (!host_resize_port(port, capacity)) {
        return host_fail(host, "out of memory");
      }
      host_connect(host, i, port->atom);
    }
  }
  return true;
}

uint32_t host_n_ports(const Host* host) {
  return host->n_ports;
}

const char* host_port_symbol(const Host* host, uint32_t index) {
  return index < host->n_ports ? host->ports[index].symbol : NULL;
}

bool host_port_is_control_input(const Host* host, uint32_t index) {
  return index < host->n_ports && host->ports[index].type == HOST_PORT_CONTROL &&
         host->ports[index].is_input;
}

Host* host_new(
    const char* plugin_uri, double rate_hz, uint32_t max_block, char* error, size_t error_size) {
  const HostConfig config = {.rate_hz = rate_hz, .max_block = max_block};
  return host_new_with(plugin_uri, &config, error, error_size);
}
