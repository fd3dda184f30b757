#include "tools/host/host_impl.h"

#include <lv2/atom/atom.h>
#include <lv2/worker/worker.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool host_fail(Host* host, const char* format, ...) {
  va_list args;
  va_start(args, format);
  (void)vsnprintf(host->error, sizeof(host->error), format, args);
  va_end(args);
  return false;
}

static bool make_world(Host* host, const char* lv2_path) {
  host->world = lilv_world_new();
  if (!host->world) {
    return host_fail(host, "out of memory");
  }
  if (lv2_path) {
    LilvNode* const path = lilv_new_string(host->world, lv2_path);
    lilv_world_set_option(host->world, LILV_OPTION_LV2_PATH, path);
    lilv_node_free(path);
  }
  return true;
}

/* lilv wants a bundle's URI to end in a slash. */
static void load_bundle(Host* host, const char* bundle) {
  char path[4096];
  const int length = snprintf(path, sizeof(path), "%s/", bundle);
  if (length > 0 && (size_t)length < sizeof(path)) {
    LilvNode* const uri = lilv_new_file_uri(host->world, NULL, path);
    lilv_world_load_bundle(host->world, uri);
    lilv_node_free(uri);
  }
}

static bool find_plugin(Host* host, const char* plugin_uri, const HostConfig* config) {
  const char* const colon = strchr(plugin_uri, ':');
  LilvNode* const uri = colon ? lilv_new_uri(host->world, plugin_uri) : NULL;
  if (!uri) {
    return host_fail(host, "plugin '%s': found no URI, expected one", plugin_uri);
  }
  if (config->bundle) {
    load_bundle(host, config->bundle);
    host->plugin = lilv_plugins_get_by_uri(lilv_world_get_all_plugins(host->world), uri);
  }
  if (!host->plugin) {
    lilv_world_load_all(host->world);
    host->plugin = lilv_plugins_get_by_uri(lilv_world_get_all_plugins(host->world), uri);
  }
  lilv_node_free(uri);
  if (!host->plugin) {
    const char* const env = getenv("LV2_PATH");
    const char* const path = config->lv2_path ? config->lv2_path : env;
    return host_fail(host, "plugin <%s>: not found in %s", plugin_uri,
                     path ? path : "LV2's usual directories");
  }
  return true;
}

static bool check_required(Host* host) {
  bool is_ok = true;
  LilvNodes* const required = lilv_plugin_get_required_features(host->plugin);
  LILV_FOREACH(nodes, i, required) {
    const char* const uri = lilv_node_as_string(lilv_nodes_get(required, i));
    if (is_ok && !host_features_offer(&host->features, uri)) {
      is_ok = host_fail(host, "plugin requires the feature <%s>, which is not offered", uri);
    }
  }
  lilv_nodes_free(required);
  return is_ok;
}

static bool instantiate(Host* host, double rate_hz) {
  host->instance = lilv_plugin_instantiate(host->plugin, rate_hz, host->features.offered);
  if (!host->instance) {
    return host_fail(host, "plugin does not instantiate at %g Hz", rate_hz);
  }
  host->worker.handle = lilv_instance_get_handle(host->instance);
  host->worker.interface = (const LV2_Worker_Interface*)lilv_instance_get_extension_data(
      host->instance, LV2_WORKER__interface);
  host_reconnect(host);
  return true;
}

static bool host_init(Host* host, const char* plugin_uri, const HostConfig* config) {
  if (!(config->rate_hz > 0) || config->max_block == 0) {
    return host_fail(host, "rate and block must be above 0");
  }
  host->max_block = config->max_block;
  if (!host_features_init(&host->features, &host->worker, config->rate_hz, config->max_block,
                          config->is_bare, config->is_silent)) {
    return host_fail(host, "out of memory");
  }
  host->sequence_type = host_map(host, LV2_ATOM__Sequence);
  host->chunk_type = host_map(host, LV2_ATOM__Chunk);
  if (!make_world(host, config->lv2_path) || !find_plugin(host, plugin_uri, config) ||
      !check_required(host)) {
    return false;
  }
  if (!host_ports_init(&host->ports, host->world, host->plugin, config->max_block)) {
    return host_fail(host, "plugin <%s>: ports unreadable, or out of memory", plugin_uri);
  }
  return instantiate(host, config->rate_hz);
}

Host* host_new(
    const char* plugin_uri, double rate_hz, uint32_t max_block, char* error, size_t error_size) {
  const HostConfig config = {.rate_hz = rate_hz, .max_block = max_block};
  return host_new_with(plugin_uri, &config, error, error_size);
}

Host* host_new_with(const char* plugin_uri,
                    const HostConfig* config,
                    char* error,
                    size_t error_size) {
  Host* const host = calloc(1, sizeof(Host));
  if (host && host_init(host, plugin_uri, config)) {
    return host;
  }
  if (error && error_size > 0) {
    (void)snprintf(error, error_size, "%s", host ? host->error : "out of memory");
  }
  host_free(host);
  return NULL;
}

void host_free(Host* host) {
  if (!host) {
    return;
  }
  if (host->instance) {
    host_deactivate(host);
    lilv_instance_free(host->instance);
  }
  host_clear_presets(host);
  host_events_clear(&host->events);
  host_ports_clear(&host->ports);
  host_worker_clear(&host->worker);
  host_features_clear(&host->features);
  lilv_world_free(host->world);
  free(host);
}

void host_activate(Host* host) {
  if (!host->is_active) {
    lilv_instance_activate(host->instance);
    host->is_active = true;
  }
}

void host_deactivate(Host* host) {
  if (host->is_active) {
    lilv_instance_deactivate(host->instance);
    host->is_active = false;
  }
}

const char* host_error(const Host* host) {
  return host->error;
}

LV2_URID
host_map(Host* host, const char* uri) {
  return urids_map(&host->features.urids, uri);
}

const char* host_unmap(const Host* host, LV2_URID urid) {
  return urids_unmap(&host->features.urids, urid);
}

LilvInstance* host_instance(Host* host) {
  return host->instance;
}

const LilvPlugin* host_plugin(const Host* host) {
  return host->plugin;
}

LilvWorld* host_world(Host* host) {
  return host->world;
}

const LV2_Feature* const* host_features(const Host* host) {
  return host->features.offered;
}

HostWorker* host_worker(Host* host) {
  return &host->worker;
}

void host_connect(Host* host, uint32_t port_index, void* data) {
  lilv_instance_connect_port(host->instance, port_index, data);
}

void host_reconnect(Host* host) {
  for (uint32_t i = 0; i < host->ports.n_ports; ++i) {
    host_connect(host, i, host_port_data(&host->ports.ports[i]));
  }
}
