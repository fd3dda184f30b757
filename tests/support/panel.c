#include "tests/support/panel.h"

#include "tests/support/host_inside.h"
#include "tests/support/plugins.h"

#include <lv2/core/lv2.h>
#include <lv2/port-props/port-props.h>

LilvNode* panel_get(Host* host, uint32_t port, const char* predicate) {
  LilvNode* const key = lilv_new_uri(host_world(host), predicate);
  LilvNode* const node =
      lilv_port_get(host_plugin(host), lilv_plugin_get_port_by_index(host_plugin(host), port), key);
  lilv_node_free(key);
  return node;
}

LilvNode* panel_of(Host* host, const LilvNode* subject, const char* predicate) {
  LilvNode* const key = lilv_new_uri(host_world(host), predicate);
  LilvNode* const node = lilv_world_get(host_world(host), subject, key, NULL);
  lilv_node_free(key);
  return node;
}

bool panel_has(Host* host, uint32_t port, const char* property) {
  LilvNode* const node = lilv_new_uri(host_world(host), property);
  const bool answer = lilv_port_has_property(
      host_plugin(host), lilv_plugin_get_port_by_index(host_plugin(host), port), node);
  lilv_node_free(node);
  return answer;
}

bool panel_shows(Host* host, uint32_t port) {
  LilvNode* const type = lilv_new_uri(host_world(host), LV2_CORE__ControlPort);
  const bool is_control = lilv_port_is_a(
      host_plugin(host), lilv_plugin_get_port_by_index(host_plugin(host), port), type);
  lilv_node_free(type);
  return is_control && !panel_has(host, port, LV2_PORT_PROPS__notOnGUI);
}

void panel_check_all(void (*check)(Host* host, uint32_t port)) {
  for (int p = 0; p < N_PLUGINS; ++p) {
    Host* const host = plugins_open(p);
    for (uint32_t i = 0; i < host_n_ports(host); ++i) {
      if (panel_shows(host, i)) {
        check(host, i);
      }
    }
    host_free(host);
  }
}
