#include "tests/support/pins.h"
#include "tests/support/host_inside.h"

#include <lv2/port-groups/port-groups.h>
#include <lv2/port-props/port-props.h>
#include <lv2/units/units.h>
#include <lv2/urid/urid.h>

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static const char* const property_uris[] = {
    LV2_PORT_PROPS__logarithmic,
    LV2_CORE__integer,
    LV2_CORE__toggled,
    LV2_PORT_PROPS__expensive,
    LV2_PORT_PROPS__notAutomatic,
    LV2_CORE__enumeration,
};

static bool is_a(Host* host, const LilvPort* port, const char* class_uri) {
  LilvNode* const node = lilv_new_uri(host_world(host), class_uri);
  const bool answer = lilv_port_is_a(host_plugin(host), port, node);
  lilv_node_free(node);
  return answer;
}

static unsigned properties_of(Host* host, const LilvPort* port) {
  unsigned found = 0;
  for (unsigned i = 0; i < sizeof(property_uris) / sizeof(property_uris[0]); ++i) {
    LilvNode* const node = lilv_new_uri(host_world(host), property_uris[i]);
    found |= lilv_port_has_property(host_plugin(host), port, node) ? 1u << i : 0u;
    lilv_node_free(node);
  }
  return found;
}

static void check_designation(Host* host, const LilvPort* port, const char* wanted) {
  LilvNode* const predicate = lilv_new_uri(host_world(host), LV2_CORE__designation);
  LilvNode* const found = lilv_port_get(host_plugin(host), port, predicate);
  assert_int_equal(found != NULL, wanted != NULL);
  if (found && wanted) {
    assert_string_equal(lilv_node_as_uri(found), wanted);
  }
  lilv_node_free(found);
  lilv_node_free(predicate);
}

static float take_number(LilvNode* node) {
  assert_non_null(node);
  const float value = lilv_node_as_float(node);
  lilv_node_free(node);
  return value;
}

static void check_range(Host* host, const LilvPort* port, const Pin* wanted) {
  LilvNode* initial = NULL;
  LilvNode* minimum = NULL;
  LilvNode* maximum = NULL;
  lilv_port_get_range(host_plugin(host), port, &initial, &minimum, &maximum);
  assert_true(take_number(minimum) == wanted->minimum);
  assert_true(take_number(maximum) == wanted->maximum);
  assert_true(take_number(initial) == wanted->initial);
}

static bool has_feature(Host* host, const LilvNodes* features, const char* uri) {
  LilvNode* const node = lilv_new_uri(host_world(host), uri);
  const bool answer = lilv_nodes_contains(features, node);
  lilv_node_free(node);
  return answer;
}

void pins_check(Host* host, const Pin pins[], uint32_t n_pins) {
  assert_true(lilv_plugin_get_num_ports(host_plugin(host)) >= n_pins);
  for (uint32_t i = 0; i < n_pins; ++i) {
    const Pin* const pin = &pins[i];
    const LilvPort* const port = lilv_plugin_get_port_by_index(host_plugin(host), i);
    print_message("%s\n", pin->symbol);
    assert_string_equal(lilv_node_as_string(lilv_port_get_symbol(host_plugin(host), port)),
                        pin->symbol);
    assert_true(is_a(host, port, pin->direction));
    assert_false(is_a(host, port, !strcmp(pin->direction, PIN_IN) ? PIN_OUT : PIN_IN));
    assert_true(is_a(host, port, pin->type));
    assert_int_equal(properties_of(host, port), pin->properties);
    check_designation(host, port, pin->designation);
    if (!strcmp(pin->type, PIN_VALUE)) {
      check_range(host, port, pin);
    }
  }
}

void pins_check_names(Host* host, uint32_t port, const char* const names[], uint32_t n_names) {
  LilvScalePoints* const points = lilv_port_get_scale_points(
      host_plugin(host), lilv_plugin_get_port_by_index(host_plugin(host), port));
  unsigned seen = 0;
  LILV_FOREACH(scale_points, i, points) {
    const LilvScalePoint* const point = lilv_scale_points_get(points, i);
    const float value = lilv_node_as_float(lilv_scale_point_get_value(point));
    const uint32_t whole = (uint32_t)value;
    assert_true(value >= 0.0f && (float)whole == value && whole < n_names);
    assert_string_equal(lilv_node_as_string(lilv_scale_point_get_label(point)), names[whole]);
    seen += 1u << whole;
  }
  assert_int_equal(seen, (1u << n_names) - 1);
  lilv_scale_points_free(points);
}

void pins_check_instrument(Host* host) {
  const LilvPlugin* const plugin = host_plugin(host);
  const LilvPluginClass* const kind = lilv_plugin_get_class(plugin);
  assert_string_equal(lilv_node_as_uri(lilv_plugin_class_get_uri(kind)),
                      LV2_CORE__InstrumentPlugin);
  LilvNodes* const required = lilv_plugin_get_required_features(plugin);
  LilvNodes* const optional = lilv_plugin_get_optional_features(plugin);
  assert_int_equal(lilv_nodes_size(required), 1);
  assert_true(has_feature(host, required, LV2_URID__map));
  assert_true(has_feature(host, optional, LV2_CORE__hardRTCapable));
  lilv_nodes_free(required);
  lilv_nodes_free(optional);
  assert_false(lilv_plugin_has_latency(plugin));
  assert_int_equal(host_port_index(host, "latency"), UINT32_MAX);
}

/* What a port names by `predicate`, if anything, has a `property`. */
static void
check_reference(Host* host, const LilvPort* port, const char* predicate, const char* property) {
  LilvNode* const key = lilv_new_uri(host_world(host), predicate);
  LilvNode* const wanted = lilv_new_uri(host_world(host), property);
  LilvNode* const named = lilv_port_get(host_plugin(host), port, key);
  if (named) {
    assert_true(lilv_world_ask(host_world(host), named, wanted, NULL));
  }
  lilv_node_free(named);
  lilv_node_free(wanted);
  lilv_node_free(key);
}

void pins_check_references(Host* host) {
  LilvNode* const author = lilv_plugin_get_author_name(host_plugin(host));
  assert_non_null(author);
  lilv_node_free(author);
  for (uint32_t i = 0; i < host_n_ports(host); ++i) {
    const LilvPort* const port = lilv_plugin_get_port_by_index(host_plugin(host), i);
    check_reference(host, port, LV2_UNITS__unit, LV2_UNITS__render);
    check_reference(host, port, LV2_PORT_GROUPS__group, LV2_CORE__name);
  }
}

bool pins_takes(Host* host, const char* type_uri) {
  LilvNode* const type = lilv_new_uri(host_world(host), type_uri);
  const LilvPort* const port = lilv_plugin_get_port_by_index(host_plugin(host), 0);
  const bool answer = lilv_port_supports_event(host_plugin(host), port, type);
  lilv_node_free(type);
  return answer;
}
