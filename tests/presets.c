#include "tests/presets.h"

#include <lv2/core/lv2.h>
#include <lv2/presets/presets.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#define RDFS "http://www.w3.org/2000/01/rdf-schema#"

/* Each port that a preset sets is a control input, and has the value, in range, once it is loaded.
 * Those at their default are counted in `n_default`. Returns the sum of 2^index: which they are. */
static uint64_t check_ports(Host* host, const LilvNode* preset, unsigned* n_default) {
  LilvWorld* const world = host_world(host);
  LilvNode* const port_key = lilv_new_uri(world, LV2_CORE__port);
  LilvNode* const symbol_key = lilv_new_uri(world, LV2_CORE__symbol);
  LilvNode* const value_key = lilv_new_uri(world, LV2_PRESETS__value);
  LilvNodes* const ports = lilv_world_find_nodes(world, preset, port_key, NULL);
  uint64_t set = 0;
  *n_default = 0;
  LILV_FOREACH(nodes, i, ports) {
    const LilvNode* const port = lilv_nodes_get(ports, i);
    LilvNode* const symbol = lilv_world_get(world, port, symbol_key, NULL);
    LilvNode* const value = lilv_world_get(world, port, value_key, NULL);
    HostRange range;
    assert_non_null(symbol);
    assert_non_null(value);
    assert_true(host_range(host, lilv_node_as_string(symbol), &range));
    const float number = lilv_node_as_float(value);
    assert_true(number >= range.min && number <= range.max);
    assert_true(!range.is_integer || number == floorf(number));
    assert_true(host_get(host, lilv_node_as_string(symbol)) == number);
    set |= UINT64_C(1) << host_port_index(host, lilv_node_as_string(symbol));
    *n_default += number == range.initial;
    lilv_node_free(symbol);
    lilv_node_free(value);
  }
  lilv_nodes_free(ports);
  lilv_node_free(port_key);
  lilv_node_free(symbol_key);
  lilv_node_free(value_key);
  return set;
}

static void check_comment(Host* host, const LilvNode* preset) {
  LilvNode* const predicate = lilv_new_uri(host_world(host), RDFS "comment");
  LilvNode* const comment = lilv_world_get(host_world(host), preset, predicate, NULL);
  assert_non_null(comment);
  assert_true(strlen(lilv_node_as_string(comment)) > 0);
  lilv_node_free(comment);
  lilv_node_free(predicate);
}

uint64_t presets_check(Host* host, uint32_t k) {
  const char* const uri = host_preset_uri(host, k);
  const char* const label = host_preset_label(host, k);
  print_message("%s\n", label);
  assert_true(strlen(label) > 0 && strcmp(label, uri) != 0);
  for (uint32_t other = 0; other < k; ++other) {
    assert_string_not_equal(label, host_preset_label(host, other));
  }
  assert_true(host_preset(host, uri));
  LilvNode* const preset = lilv_new_uri(host_world(host), uri);
  unsigned n_default = 0;
  check_comment(host, preset);
  const uint64_t set = check_ports(host, preset, &n_default);
  assert_true(n_default < (unsigned)__builtin_popcountll(set));
  assert_true(host_get(host, "enabled") == 1.0f && host_get(host, "freewheel") == 0.0f);
  lilv_node_free(preset);
  return set;
}

void presets_check_all(Host* (*open)(void), uint32_t n) {
  uint64_t all_set = 0;
  Host* const list = open();
  const uint32_t n_presets = host_n_presets(list);
  host_free(list);
  assert_true(n_presets >= n);
  for (uint32_t k = 0; k < n_presets; ++k) {
    Host* const host = open();
    const uint64_t set = presets_check(host, k);
    assert_true(k == 0 || set == all_set);
    all_set = set;
    host_free(host);
  }
}
