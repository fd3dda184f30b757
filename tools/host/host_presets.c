#define _POSIX_C_SOURCE 200809L

#include "tools/host/host_impl.h"

#include <lv2/atom/atom.h>
#include <lv2/presets/presets.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static int compare_presets(const void* a, const void* b) {
  const HostPreset* const left = (const HostPreset*)a;
  const HostPreset* const right = (const HostPreset*)b;
  const int by_label = strcmp(left->label, right->label);
  return by_label ? by_label : strcmp(left->uri, right->uri);
}

static char* copy_string(const LilvNode* node) {
  const char* const string = lilv_node_as_string(node);
  return string ? strdup(string) : NULL;
}

/* A preset without a label is known by its URI. */
static char* read_label(Host* host, const LilvNode* preset) {
  (void)lilv_world_load_resource(host->world, preset);
  LilvNode* const predicate = lilv_new_uri(host->world, LILV_NS_RDFS "label");
  LilvNode* const label = lilv_world_get(host->world, preset, predicate, NULL);
  char* const copy = copy_string(label ? label : preset);
  lilv_node_free(label);
  lilv_node_free(predicate);
  return copy;
}

static LilvNodes* presets_of(Host* host, const LilvPlugin* plugin) {
  LilvNode* const type = lilv_new_uri(host->world, LV2_PRESETS__Preset);
  LilvNodes* const found = lilv_plugin_get_related(plugin, type);
  lilv_node_free(type);
  return found;
}

static void read_presets(Host* host) {
  LilvNodes* const found = presets_of(host, host->plugin);
  host->has_presets = true;
  host->n_presets = 0;
  host->presets = calloc(lilv_nodes_size(found) + 1, sizeof(HostPreset));
  LILV_FOREACH(nodes, i, found) {
    const LilvNode* const node = lilv_nodes_get(found, i);
    HostPreset preset = {copy_string(node), read_label(host, node)};
    if (host->presets && preset.uri && preset.label) {
      host->presets[host->n_presets++] = preset;
    } else {
      free(preset.uri);
      free(preset.label);
    }
  }
  lilv_nodes_free(found);
  if (host->presets && host->n_presets > 1) {
    qsort(host->presets, host->n_presets, sizeof(HostPreset), compare_presets);
  }
}

static const HostPreset* find_preset(Host* host, const char* name) {
  const uint32_t n_presets = host_n_presets(host);
  for (uint32_t i = 0; i < n_presets; ++i) {
    if (!strcmp(host->presets[i].uri, name) || !strcmp(host->presets[i].label, name)) {
      return &host->presets[i];
    }
  }
  for (uint32_t i = 0; i < n_presets; ++i) {
    if (!strcasecmp(host->presets[i].label, name)) {
      return &host->presets[i];
    }
  }
  return NULL;
}

static bool
read_number(Host* host, const void* value, uint32_t size, uint32_t type, float* number) {
  double d = 0.0;
  int64_t l = 0;
  int32_t i = 0;
  if (type == host_map(host, LV2_ATOM__Float) && size == sizeof(*number)) {
    memcpy(number, value, size);
  } else if (type == host_map(host, LV2_ATOM__Double) && size == sizeof(d)) {
    memcpy(&d, value, size);
    *number = (float)d;
  } else if (type == host_map(host, LV2_ATOM__Long) && size == sizeof(l)) {
    memcpy(&l, value, size);
    *number = (float)l;
  } else if ((type == host_map(host, LV2_ATOM__Int) || type == host_map(host, LV2_ATOM__Bool)) &&
             size == sizeof(i)) {
    memcpy(&i, value, size);
    *number = (float)i;
  } else {
    return false;
  }
  return true;
}

static void
set_value(const char* symbol, void* user_data, const void* value, uint32_t size, uint32_t type) {
  Host* const host = (Host*)user_data;
  HostPort* const port = host_find_port(host, symbol, HOST_PORT_CONTROL);
  float number = 0.0F;
  if (port && port->is_input && read_number(host, value, size, type, &number)) {
    port->value = number;
  }
}

uint32_t host_n_presets(Host* host) {
  if (!host->has_presets) {
    read_presets(host);
  }
  return host->n_presets;
}

const char* host_preset_label(Host* host, uint32_t k) {
  return k < host_n_presets(host) ? host->presets[k].label : NULL;
}

const char* host_preset_uri(Host* host, uint32_t k) {
  return k < host_n_presets(host) ? host->presets[k].uri : NULL;
}

void host_restore(Host* host, const LilvState* state, bool has_worker) {
  const LV2_Feature* const features[] = {&host->features[0], &host->features[1],
                                         has_worker ? &host->features[2] : NULL, NULL};
  lilv_state_restore(state, host->instance, set_value, host, 0, features);
}

bool host_preset(Host* host, const char* name) {
  const HostPreset* const preset = find_preset(host, name);
  if (!preset) {
    return host_fail(host, "no preset named '%s' among %u", name, host_n_presets(host));
  }
  LilvNode* const uri = lilv_new_uri(host->world, preset->uri);
  LilvState* const state = lilv_state_new_from_world(host->world, &host->map, uri);
  lilv_node_free(uri);
  if (!state) {
    return host_fail(host, "preset '%s': unreadable", name);
  }
  host_restore(host, state, true);
  lilv_state_free(state);
  return true;
}

static bool has_preset(Host* host, const LilvPlugin* plugin, const char* name) {
  LilvNodes* const found = presets_of(host, plugin);
  bool has_it = false;
  LILV_FOREACH(nodes, i, found) {
    const LilvNode* const node = lilv_nodes_get(found, i);
    char* const label = has_it ? NULL : read_label(host, node);
    has_it =
        has_it || !strcmp(lilv_node_as_string(node), name) || (label && !strcasecmp(label, name));
    free(label);
  }
  lilv_nodes_free(found);
  return has_it;
}

const char* host_preset_owner(Host* host, const char* name) {
  const LilvPlugins* const plugins = lilv_world_get_all_plugins(host->world);
  LILV_FOREACH(plugins, i, plugins) {
    const LilvPlugin* const plugin = lilv_plugins_get(plugins, i);
    if (plugin != host->plugin && has_preset(host, plugin, name)) {
      return lilv_node_as_uri(lilv_plugin_get_uri(plugin));
    }
  }
  return NULL;
}

void host_clear_presets(Host* host) {
  for (uint32_t i = 0; i < host->n_presets; ++i) {
    free(host->presets[i].uri);
    free(host->presets[i].label);
  }
  free(host->presets);
}
