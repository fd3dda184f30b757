#define _POSIX_C_SOURCE 200809L

#include "tools/host/host_impl.h"

#include "tools/formats/escape.h"

#include <errno.h>
#include <lv2/atom/atom.h>
#include <lv2/buf-size/buf-size.h>
#include <lv2/parameters/parameters.h>
#include <lv2/state/state.h>
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

/* URIs as small numbers */

static char** uris_of(const Host* host, uint32_t* n_uris) {
  *n_uris = (uint32_t)(host->uris.size / sizeof(char*));
  return (char**)(void*)host->uris.data;
}

static LV2_URID on_map(LV2_URID_Map_Handle handle, const char* uri) {
  Host* const host = (Host*)handle;
  uint32_t n_uris = 0;
  char** const uris = uris_of(host, &n_uris);
  for (uint32_t i = 0; i < n_uris; ++i) {
    if (!strcmp(uris[i], uri)) {
      return i + 1;
    }
  }
  char* const copy = strdup(uri);
  if (!copy || !bytes_append(&host->uris, (const void*)&copy, sizeof(copy))) {
    free(copy);
    return 0;
  }
  return n_uris + 1;
}

static const char* on_unmap(LV2_URID_Unmap_Handle handle, LV2_URID urid) {
  uint32_t n_uris = 0;
  char** const uris = uris_of((const Host*)handle, &n_uris);
  return urid > 0 && urid <= n_uris ? uris[urid - 1] : NULL;
}

static void clear_uris(Host* host) {
  uint32_t n_uris = 0;
  char** const uris = uris_of(host, &n_uris);
  for (uint32_t i = 0; i < n_uris; ++i) {
    free(uris[i]);
  }
  bytes_clear(&host->uris);
}

/* Features */

enum { LOG_SIZE = 4096 };

LV2_LOG_FUNC(3, 0)
static int on_vprintf(LV2_Log_Handle handle, LV2_URID type, const char* format, va_list args) {
  (void)type;
  char message[LOG_SIZE];
  if (((const Host*)handle)->is_silent) {
    return 0;
  }
  (void)vsnprintf(message, sizeof(message), format, args);
  const size_t length = strlen(message);
  const bool is_line = length > 0 && message[length - 1] == '\n';
  message[length - is_line] = '\0';
  escape_print(stderr, message);
  (void)fputs(is_line ? "\n" : "", stderr);
  return (int)length;
}

LV2_LOG_FUNC(3, 4)
static int on_printf(LV2_Log_Handle handle, LV2_URID type, const char* format, ...) {
  va_list args;
  va_start(args, format);
  const int n_printed = on_vprintf(handle, type, format, args);
  va_end(args);
  return n_printed;
}

static LV2_Options_Option option(Host* host, const char* key, const char* type, const void* value) {
  return (LV2_Options_Option){.context = LV2_OPTIONS_INSTANCE,
                              .key = host_map(host, key),
                              .size = 4,
                              .type = host_map(host, type),
                              .value = value};
}

static bool init_options(Host* host) {
  const LV2_Options_Option options[HOST_N_OPTIONS - 1] = {
      option(host, LV2_PARAMETERS__sampleRate, LV2_ATOM__Float, &host->rate_hz),
      option(host, LV2_BUF_SIZE__minBlockLength, LV2_ATOM__Int, &host->min_block),
      option(host, LV2_BUF_SIZE__maxBlockLength, LV2_ATOM__Int, &host->max_block),
      option(host, LV2_BUF_SIZE__nominalBlockLength, LV2_ATOM__Int, &host->max_block)};
  memcpy(host->options, options, sizeof(options));
  bool is_ok = true;
  for (unsigned i = 0; i < HOST_N_OPTIONS - 1; ++i) {
    is_ok = is_ok && options[i].key && options[i].type;
  }
  return is_ok;
}

/* The first of them is all that a bare host offers; the first three, in this order, are what
 * host_restore() knows. */
static bool init_features(Host* host, const HostConfig* config) {
  host->rate_hz = (float)config->rate_hz;
  host->max_block = config->max_block < INT32_MAX ? (int32_t)config->max_block : INT32_MAX;
  host->is_silent = config->is_silent;
  host->map = (LV2_URID_Map){host, on_map};
  host->unmap = (LV2_URID_Unmap){host, on_unmap};
  host->log = (LV2_Log_Log){host, on_printf, on_vprintf};
  host->schedule = (LV2_Worker_Schedule){&host->worker, host_worker_schedule};
  const LV2_Feature features[HOST_N_FEATURES] = {{LV2_URID__map, &host->map},
                                                 {LV2_STATE__threadSafeRestore, NULL},
                                                 {LV2_WORKER__schedule, &host->schedule},
                                                 {LV2_URID__unmap, &host->unmap},
                                                 {LV2_LOG__log, &host->log},
                                                 {LV2_OPTIONS__options, host->options},
                                                 {LV2_BUF_SIZE__boundedBlockLength, NULL}};
  memcpy(host->features, features, sizeof(features));
  for (unsigned i = 0; i < (config->is_bare ? 1 : HOST_N_FEATURES); ++i) {
    host->offered[i] = &host->features[i];
  }
  host->sequence_type = host_map(host, LV2_ATOM__Sequence);
  host->chunk_type = host_map(host, LV2_ATOM__Chunk);
  return init_options(host) && host->sequence_type && host->chunk_type;
}

static bool offers(const Host* host, const char* uri) {
  for (unsigned i = 0; host->offered[i]; ++i) {
    if (!strcmp(host->offered[i]->URI, uri)) {
      return true;
    }
  }
  return !strcmp(uri, LV2_CORE__isLive);
}

/* Life cycle */

enum { WORLD_SIZE = 4 << 20 }; /* Of memory that lilv may take [bytes] */

static bool make_world(Host* host, const char* lv2_path) {
  host->world = bytes_are_free(WORLD_SIZE) ? lilv_world_new() : NULL;
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
    return host_fail(host, "plugin '%s': found no URI, expected one, as urn:hooke:guitar",
                     plugin_uri);
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
    if (is_ok && !offers(host, uri)) {
      is_ok = host_fail(host, "plugin requires the feature <%s>, which is not offered", uri);
    }
  }
  lilv_nodes_free(required);
  return is_ok;
}

static bool instantiate(Host* host, double rate_hz) {
  errno = 0;
  host->instance = lilv_plugin_instantiate(host->plugin, rate_hz, host->offered);
  if (!host->instance) {
    return host_fail(host, "plugin does not instantiate at %g Hz%s", rate_hz,
                     errno == ENOMEM ? ": out of memory" : "");
  }
  host->worker.handle = lilv_instance_get_handle(host->instance);
  host->worker.interface = (const LV2_Worker_Interface*)lilv_instance_get_extension_data(
      host->instance, LV2_WORKER__interface);
  host_reconnect(host);
  return true;
}

static bool init(Host* host, const char* plugin_uri, const HostConfig* config) {
  if (!(config->rate_hz > 0) || config->max_block == 0) {
    return host_fail(host, "rate and block must be above 0");
  }
  if (!init_features(host, config)) {
    return host_fail(host, "out of memory");
  }
  if (!make_world(host, config->lv2_path) || !find_plugin(host, plugin_uri, config) ||
      !check_required(host)) {
    return false;
  }
  if (!host_make_ports(host)) {
    return host_fail(host, "plugin <%s>: ports unreadable, or out of memory", plugin_uri);
  }
  return instantiate(host, config->rate_hz);
}

Host* host_new_with(const char* plugin_uri,
                    const HostConfig* config,
                    char* error,
                    size_t error_size) {
  Host* const host = calloc(1, sizeof(Host));
  if (host && init(host, plugin_uri, config)) {
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
  bytes_clear(&host->queue);
  bytes_clear(&host->bodies);
  host_clear_ports(host);
  host_worker_clear(&host->worker);
  clear_uris(host);
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
  return on_map(host, uri);
}

LilvInstance* host_instance(Host* host) {
  return host->instance;
}

const LV2_Feature* const* host_features(const Host* host) {
  return host->offered;
}

void host_connect(Host* host, uint32_t port_index, void* data) {
  lilv_instance_connect_port(host->instance, port_index, data);
}

void host_reconnect(Host* host) {
  for (uint32_t i = 0; i < host->n_ports; ++i) {
    HostPort* const port = &host->ports[i];
    host_connect(host, i,
                 port->type == HOST_PORT_CONTROL ? (void*)&port->value
                 : port->type == HOST_PORT_ATOM  ? (void*)port->atom
                                                 : (void*)port->frames);
  }
}
