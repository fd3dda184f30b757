/* What a strict linter of LV2 asks of a plugin's Turtle, beside its ports, their words and their
 * syntax, which have tests of their own. */
#include "tests/support/guitar_host.h"
#include "tests/support/host_inside.h"
#include "tests/support/panel.h"
#include "tests/support/plugins.h"

#include <lv2/atom/atom.h>
#include <lv2/core/lv2.h>
#include <lv2/midi/midi.h>
#include <lv2/patch/patch.h>
#include <lv2/port-groups/port-groups.h>
#include <lv2/resize-port/resize-port.h>
#include <lv2/state/state.h>
#include <lv2/worker/worker.h>

#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define DOAP "http://usefulinc.com/ns/doap#"
#define FOAF "http://xmlns.com/foaf/0.1/"

static void check_both(void (*check)(Host* host)) {
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    check(host);
    host_free(host);
  }
}

static LilvNode* of_plugin(Host* host, const char* predicate) {
  return panel_of(host, lilv_plugin_get_uri(host_plugin(host)), predicate);
}

static bool says(Host* host, const char* predicate, const char* object) {
  LilvNode* const key = lilv_new_uri(host_world(host), predicate);
  LilvNode* const value = lilv_new_uri(host_world(host), object);
  const bool answer =
      lilv_world_ask(host_world(host), lilv_plugin_get_uri(host_plugin(host)), key, value);
  lilv_node_free(key);
  lilv_node_free(value);
  return answer;
}

/* Odd numbers, and a minor version of 0, are those of a plugin that is not yet released. */
static void check_version(Host* host) {
  LilvNode* const minor = of_plugin(host, LV2_CORE__minorVersion);
  LilvNode* const micro = of_plugin(host, LV2_CORE__microVersion);
  assert_true(lilv_node_is_int(minor) && lilv_node_is_int(micro));
  print_message("%d.%d\n", lilv_node_as_int(minor), lilv_node_as_int(micro));
  assert_true(lilv_node_as_int(minor) > 0 && lilv_node_as_int(minor) % 2 == 0);
  assert_true(lilv_node_as_int(micro) >= 0 && lilv_node_as_int(micro) % 2 == 0);
  lilv_node_free(minor);
  lilv_node_free(micro);
}

static void versions_are_those_of_a_release(void** state) {
  (void)state;
  check_both(check_version);
}

static void check_uri_of(Host* host, const LilvNode* subject, const char* predicate) {
  LilvNode* const found = panel_of(host, subject, predicate);
  print_message("%s\n", predicate);
  assert_true(lilv_node_is_uri(found));
  lilv_node_free(found);
}

static void check_text_of(Host* host, const LilvNode* subject, const char* predicate) {
  LilvNode* const found = panel_of(host, subject, predicate);
  print_message("%s\n", predicate);
  assert_true(lilv_node_is_string(found) && strlen(lilv_node_as_string(found)) > 2);
  lilv_node_free(found);
}

static void check_makers(Host* host) {
  const LilvNode* const plugin = lilv_plugin_get_uri(host_plugin(host));
  LilvNode* const project = of_plugin(host, LV2_CORE__project);
  assert_non_null(project);
  LilvNode* const maker = panel_of(host, project, DOAP "maintainer");
  assert_non_null(maker);
  check_uri_of(host, plugin, DOAP "license");
  check_text_of(host, plugin, DOAP "name");
  check_text_of(host, plugin, DOAP "shortdesc");
  check_text_of(host, plugin, LILV_NS_RDFS "comment");
  check_text_of(host, project, DOAP "name");
  check_uri_of(host, project, DOAP "license");
  check_text_of(host, maker, FOAF "name");
  check_uri_of(host, maker, FOAF "mbox");
  check_uri_of(host, maker, FOAF "homepage");
  lilv_node_free(maker);
  lilv_node_free(project);
}

static void it_says_what_it_is_whose_and_under_which_license(void** state) {
  (void)state;
  check_both(check_makers);
}

/* What the library answers to is said, and what is said is there. */
static void check_extensions(Host* host) {
  static const char* const uris[] = {LV2_STATE__interface, LV2_WORKER__interface,
                                     "http://lv2plug.in/ns/ext/options#interface",
                                     "http://ardour.org/lv2/midnam#interface",
                                     "http://lv2plug.in/ns/lv2ext/inline-display#interface"};
  const LV2_Descriptor* const descriptor = lilv_instance_get_descriptor(host_instance(host));
  for (size_t i = 0; i < sizeof(uris) / sizeof(uris[0]); ++i) {
    print_message("%s\n", uris[i]);
    const bool is_there = descriptor->extension_data && descriptor->extension_data(uris[i]);
    assert_int_equal(says(host, LV2_CORE__extensionData, uris[i]), is_there);
  }
  assert_int_equal(says(host, LV2_CORE__extensionData, LV2_WORKER__interface),
                   says(host, LV2_CORE__optionalFeature, LV2_WORKER__schedule));
  assert_true(!descriptor->extension_data || !descriptor->extension_data("urn:hooke:nothing"));
}

static void extensions_are_those_of_the_library(void** state) {
  (void)state;
  check_both(check_extensions);
}

static void check_features(Host* host) {
  assert_true(says(host, LV2_CORE__optionalFeature, LV2_CORE__hardRTCapable));
  assert_true(says(host, LV2_CORE__optionalFeature, LV2_CORE__isLive));
  assert_int_equal(says(host, LV2_CORE__optionalFeature, LV2_STATE__threadSafeRestore),
                   says(host, LV2_CORE__extensionData, LV2_STATE__interface));
  assert_false(says(host, LV2_CORE__optionalFeature, LV2_CORE__inPlaceBroken));
  assert_false(says(host, LV2_CORE__requiredFeature, LV2_CORE__inPlaceBroken));
}

static void it_is_live_and_fit_for_real_time(void** state) {
  (void)state;
  check_both(check_features);
}

/* One stereo group, which both sides and no other port are in. */
static void check_outputs(Host* host) {
  LilvNode* const group = of_plugin(host, LV2_PORT_GROUPS__mainOutput);
  LilvNode* const type = lilv_new_uri(host_world(host), LILV_NS_RDF "type");
  LilvNode* const stereo = lilv_new_uri(host_world(host), LV2_PORT_GROUPS__StereoGroup);
  assert_true(group && lilv_world_ask(host_world(host), group, type, stereo));
  for (uint32_t i = 0; i < host_n_ports(host); ++i) {
    LilvNode* const of_port = panel_get(host, i, LV2_PORT_GROUPS__group);
    const bool is_out = !strncmp(host_port_symbol(host, i), "out_", 4);
    assert_int_equal(of_port && lilv_node_equals(of_port, group), is_out);
    lilv_node_free(of_port);
  }
  lilv_node_free(stereo);
  lilv_node_free(type);
  lilv_node_free(group);
}

static void the_main_output_is_left_and_right(void** state) {
  (void)state;
  check_both(check_outputs);
}

static void check_symbols(Host* host) {
  for (uint32_t i = 0; i < host_n_ports(host); ++i) {
    const char* const symbol = host_port_symbol(host, i);
    assert_true(islower((unsigned char)symbol[0]));
    for (size_t k = 0; symbol[k]; ++k) {
      assert_true(islower((unsigned char)symbol[k]) || isdigit((unsigned char)symbol[k]) ||
                  symbol[k] == '_');
    }
    assert_int_equal(host_port_index(host, symbol), i);
  }
}

static void symbols_are_names_in_c_each_of_one_port(void** state) {
  (void)state;
  check_both(check_symbols);
}

/* Notes of many keys in one block, and two paths on the way back from a plugin that has files. */
static void check_events(Host* host) {
  const uint32_t control = host_port_index(host, "control");
  const uint32_t notify = host_port_index(host, "notify");
  const bool is_strings = host_port_index(host, "capo") == UINT32_MAX;
  for (uint32_t port = control; port <= notify; ++port) {
    LilvNode* const size = panel_get(host, port, LV2_RESIZE_PORT__minimumSize);
    assert_true(size || (port == notify && !is_strings));
    assert_true(!size || lilv_node_as_int(size) >= 8192);
    lilv_node_free(size);
  }
  assert_true(panel_has(host, notify, LV2_CORE_PREFIX "connectionOptional"));
}

static void ports_of_events_say_how_large_they_are(void** state) {
  (void)state;
  check_both(check_events);
}

/* Volume is the channels', which a host that moved a level for it would take away. */
static void check_bindings(Host* host) {
  for (uint32_t i = 0; i < host_n_ports(host); ++i) {
    LilvNode* const binding = panel_get(host, i, LV2_MIDI__binding);
    assert_null(binding);
  }
}

static void no_controller_moves_a_port(void** state) {
  (void)state;
  check_both(check_bindings);
}

/* A file that is read is a path which a host shows, and is told apart by a label. */
static void check_parameters(Host* host) {
  LilvNode* const key = lilv_new_uri(host_world(host), LV2_PATCH__writable);
  LilvNodes* const found =
      lilv_world_find_nodes(host_world(host), lilv_plugin_get_uri(host_plugin(host)), key, NULL);
  assert_int_equal(lilv_nodes_size(found), 3);
  LILV_FOREACH(nodes, i, found) {
    const LilvNode* const parameter = lilv_nodes_get(found, i);
    LilvNode* const range = panel_of(host, parameter, LILV_NS_RDFS "range");
    assert_string_equal(lilv_node_as_uri(range), LV2_ATOM__Path);
    check_text_of(host, parameter, LILV_NS_RDFS "label");
    check_text_of(host, parameter, LILV_NS_RDFS "comment");
    lilv_node_free(range);
  }
  lilv_nodes_free(found);
  lilv_node_free(key);
}

static void files_are_paths_with_labels(void** state) {
  (void)state;
  check_both(check_parameters);
}

/* Some hosts look for presets nowhere else. */
static void check_presets(Host* host) {
  const char* const bundle = lilv_node_as_uri(lilv_plugin_get_bundle_uri(host_plugin(host)));
  assert_true(host_n_presets(host) > 9);
  for (uint32_t k = 0; k < host_n_presets(host); ++k) {
    LilvNode* const preset = lilv_new_uri(host_world(host), host_preset_uri(host, k));
    LilvNode* const file = panel_of(host, preset, LILV_NS_RDFS "seeAlso");
    print_message("%s\n", host_preset_label(host, k));
    assert_true(lilv_node_is_uri(file));
    assert_int_equal(strncmp(lilv_node_as_uri(file), bundle, strlen(bundle)), 0);
    check_text_of(host, preset, LILV_NS_RDFS "label");
    check_text_of(host, preset, LILV_NS_RDFS "comment");
    lilv_node_free(file);
    lilv_node_free(preset);
  }
}

static void presets_lie_in_the_bundle(void** state) {
  (void)state;
  check_both(check_presets);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(versions_are_those_of_a_release),
      cmocka_unit_test(it_says_what_it_is_whose_and_under_which_license),
      cmocka_unit_test(extensions_are_those_of_the_library),
      cmocka_unit_test(it_is_live_and_fit_for_real_time),
      cmocka_unit_test(the_main_output_is_left_and_right),
      cmocka_unit_test(symbols_are_names_in_c_each_of_one_port),
      cmocka_unit_test(ports_of_events_say_how_large_they_are),
      cmocka_unit_test(no_controller_moves_a_port),
      cmocka_unit_test(files_are_paths_with_labels),
      cmocka_unit_test(presets_lie_in_the_bundle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
