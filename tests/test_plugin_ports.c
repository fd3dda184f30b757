/* The ports in three places, the list below, plugin/strings_ports.h and the Turtle, are one:
 * sessions are stored by symbol and automation by index, so this list only ever grows. */
#include "plugin/strings_ports.h"
#include "tests/strings_host.h"

#include <lv2/atom/atom.h>
#include <lv2/core/lv2.h>
#include <lv2/midi/midi.h>
#include <lv2/port-groups/port-groups.h>
#include <lv2/port-props/port-props.h>
#include <lv2/urid/urid.h>

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define IN LV2_CORE__InputPort
#define OUT LV2_CORE__OutputPort
#define ATOM LV2_ATOM__AtomPort
#define AUDIO LV2_CORE__AudioPort
#define VALUE LV2_CORE__ControlPort

/* Properties of which a port must have exactly those named. */
enum {
  LOGARITHMIC = 1,
  INTEGER = 2,
  TOGGLED = 4,
  EXPENSIVE = 8,
  NOT_AUTOMATIC = 16,
  ENUMERATION = 32
};

static const char* const property_uris[] = {
    LV2_PORT_PROPS__logarithmic,
    LV2_CORE__integer,
    LV2_CORE__toggled,
    LV2_PORT_PROPS__expensive,
    LV2_PORT_PROPS__notAutomatic,
    LV2_CORE__enumeration,
};

typedef struct {
  const char* symbol;
  const char* direction;
  const char* type;
  const char* designation;
  unsigned properties;
  float minimum, maximum, initial;
} Port;

/* By index.  Append; never move, rename, remove or change a range. */
static const Port pinned[] = {
    {"control", IN, ATOM, LV2_CORE__control, 0, 0, 0, 0},
    {"notify", OUT, ATOM, LV2_CORE__control, 0, 0, 0, 0},
    {"out_left", OUT, AUDIO, LV2_PORT_GROUPS__left, 0, 0, 0, 0},
    {"out_right", OUT, AUDIO, LV2_PORT_GROUPS__right, 0, 0, 0, 0},
    {"enabled", IN, VALUE, LV2_CORE__enabled, TOGGLED, 0.0f, 1.0f, 1.0f},
    {"freewheel", IN, VALUE, LV2_CORE__freeWheeling, TOGGLED | NOT_AUTOMATIC, 0.0f, 1.0f, 0.0f},
    {"level", IN, VALUE, NULL, 0, -60.0f, 12.0f, 0.0f},
    {"damping", IN, VALUE, NULL, LOGARITHMIC, 0.02f, 200.0f, 0.6f},
    {"tracking", IN, VALUE, NULL, 0, 0.0f, 1.0f, 0.5f},
    {"loss", IN, VALUE, NULL, LOGARITHMIC, 1e-5f, 1.0f, 0.01f},
    {"stiffness", IN, VALUE, NULL, LOGARITHMIC, 1e-6f, 0.1f, 1e-6f},
    {"pickup", IN, VALUE, NULL, 0, 0.0f, 1.0f, 0.2f},
    {"spread", IN, VALUE, NULL, 0, 0.0f, 0.5f, 0.1f},
    {"pluck", IN, VALUE, NULL, 0, 0.0f, 1.0f, 0.13f},
    {"hardness", IN, VALUE, NULL, 0, 0.0f, 1.0f, 0.5f},
    {"masses", IN, VALUE, NULL, INTEGER | EXPENSIVE | NOT_AUTOMATIC, 1.0f, 1024.0f, 128.0f},
    {"release", IN, VALUE, NULL, LOGARITHMIC, 0.005f, 10.0f, 0.1f},
    {"tuning", IN, VALUE, NULL, 0, 400.0f, 480.0f, 440.0f},
    {"sounding", OUT, VALUE, NULL, INTEGER, 0.0f, 128.0f, 0.0f},
    {"mass_count", OUT, VALUE, NULL, INTEGER, 0.0f, 131072.0f, 0.0f},
    {"headroom", OUT, VALUE, NULL, 0, 0.0f, 1.0f, 1.0f},
    {"partials", IN, VALUE, NULL, INTEGER | ENUMERATION, 0.0f, 2.0f, 2.0f},
};

enum { N_PINNED = sizeof(pinned) / sizeof(pinned[0]) };

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

static void check_range(Host* host, const LilvPort* port, const Port* wanted) {
  LilvNode* initial = NULL;
  LilvNode* minimum = NULL;
  LilvNode* maximum = NULL;
  lilv_port_get_range(host_plugin(host), port, &initial, &minimum, &maximum);
  assert_true(take_number(minimum) == wanted->minimum);
  assert_true(take_number(maximum) == wanted->maximum);
  assert_true(take_number(initial) == wanted->initial);
}

static void the_turtle_says_what_is_pinned(void** state) {
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  assert_true(lilv_plugin_get_num_ports(host_plugin(host)) >= N_PINNED);
  for (uint32_t i = 0; i < N_PINNED; ++i) {
    const LilvPort* const port = lilv_plugin_get_port_by_index(host_plugin(host), i);
    print_message("%s\n", pinned[i].symbol);
    assert_string_equal(lilv_node_as_string(lilv_port_get_symbol(host_plugin(host), port)),
                        pinned[i].symbol);
    assert_true(is_a(host, port, pinned[i].direction));
    assert_false(is_a(host, port, !strcmp(pinned[i].direction, IN) ? OUT : IN));
    assert_true(is_a(host, port, pinned[i].type));
    assert_int_equal(properties_of(host, port), pinned[i].properties);
    check_designation(host, port, pinned[i].designation);
    if (!strcmp(pinned[i].type, VALUE)) {
      check_range(host, port, &pinned[i]);
    }
  }
  host_free(host);
}

/* The names of the values of an enumeration are what sessions and scripts are read by. */
static void the_partials_have_their_names(void** state) {
  static const char* const names[] = {"Lumped", "True", "Truest"};
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  const LilvPort* const port =
      lilv_plugin_get_port_by_index(host_plugin(host), STRINGS_PORT_PARTIALS);
  LilvScalePoints* const points = lilv_port_get_scale_points(host_plugin(host), port);
  unsigned seen = 0;
  LILV_FOREACH(scale_points, i, points) {
    const LilvScalePoint* const point = lilv_scale_points_get(points, i);
    const float value = lilv_node_as_float(lilv_scale_point_get_value(point));
    assert_true(value == 0.0f || value == 1.0f || value == 2.0f);
    assert_string_equal(lilv_node_as_string(lilv_scale_point_get_label(point)), names[(int)value]);
    seen += 1u << (int)value;
  }
  assert_int_equal(seen, 7);
  lilv_scale_points_free(points);
  host_free(host);
}

/* Every port of strings_ports.h, new ones too, is in the Turtle with the same index and range; and
 * none is in the Turtle alone. */
static void the_turtle_says_what_the_code_says(void** state) {
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  assert_int_equal(host_n_ports(host), STRINGS_N_PORTS);
  uint32_t n_ports = 0;
  HostRange range;
#define STREAM_CHECK(name, symbol, index)                                                          \
  assert_int_equal(host_port_index(host, #symbol), index);                                         \
  assert_false(host_range(host, #symbol, &range));                                                 \
  ++n_ports;
#define CONTROL_CHECK(name, symbol, index, minimum, maximum, default_value)                        \
  assert_int_equal(host_port_index(host, #symbol), index);                                         \
  assert_true(host_range(host, #symbol, &range));                                                  \
  assert_true(range.min == (minimum) && range.max == (maximum));                                   \
  assert_true(range.initial == (default_value));                                                   \
  ++n_ports;
  STRINGS_STREAM_PORTS(STREAM_CHECK)
  STRINGS_CONTROL_PORTS(CONTROL_CHECK)
#undef STREAM_CHECK
#undef CONTROL_CHECK
  assert_int_equal(n_ports, STRINGS_N_PORTS);
  host_free(host);
}

/* While there is no latency, a port that reports it does harm. */
static void no_latency_is_reported(void** state) {
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  assert_false(lilv_plugin_has_latency(host_plugin(host)));
  assert_int_equal(host_port_index(host, "latency"), UINT32_MAX);
  host_free(host);
}

static bool has_feature(Host* host, const LilvNodes* features, const char* uri) {
  LilvNode* const node = lilv_new_uri(host_world(host), uri);
  const bool answer = lilv_nodes_contains(features, node);
  lilv_node_free(node);
  return answer;
}

static void it_is_an_instrument_that_needs_a_map_alone(void** state) {
  (void)state;
  Host* const host = strings_open(48000.0, 64);
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
  host_free(host);
}

static void the_control_port_takes_midi(void** state) {
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  LilvNode* const midi = lilv_new_uri(host_world(host), LV2_MIDI__MidiEvent);
  const LilvPort* const port = lilv_plugin_get_port_by_index(host_plugin(host), 0);
  assert_true(lilv_port_supports_event(host_plugin(host), port, midi));
  lilv_node_free(midi);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_turtle_says_what_is_pinned),
      cmocka_unit_test(the_partials_have_their_names),
      cmocka_unit_test(the_turtle_says_what_the_code_says),
      cmocka_unit_test(no_latency_is_reported),
      cmocka_unit_test(it_is_an_instrument_that_needs_a_map_alone),
      cmocka_unit_test(the_control_port_takes_midi),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
