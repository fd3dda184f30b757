#include "tests/support/presets.h"
#include "tests/support/host_inside.h"

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

/* The only object of a statement, to be freed. */
static LilvNode* only(Host* host, const LilvNode* subject, const char* predicate) {
  LilvNode* const key = lilv_new_uri(host_world(host), predicate);
  LilvNodes* const found = lilv_world_find_nodes(host_world(host), subject, key, NULL);
  assert_int_equal(lilv_nodes_size(found), 1);
  LilvNode* const node = lilv_node_duplicate(lilv_nodes_get_first(found));
  lilv_nodes_free(found);
  lilv_node_free(key);
  return node;
}

static LilvNode* bank_of(Host* host, uint32_t k) {
  LilvNode* const preset = lilv_new_uri(host_world(host), host_preset_uri(host, k));
  LilvNode* const bank = only(host, preset, LV2_PRESETS__bank);
  lilv_node_free(preset);
  return bank;
}

/* Two presets are in one bank if its labels are one. */
static void check_banks_labels(Host* host, uint32_t i, uint32_t k) {
  LilvNode* const banks[] = {bank_of(host, i), bank_of(host, k)};
  LilvNode* const labels[] = {only(host, banks[0], RDFS "label"),
                              only(host, banks[1], RDFS "label")};
  assert_int_equal(lilv_node_equals(labels[0], labels[1]), lilv_node_equals(banks[0], banks[1]));
  for (int b = 0; b < 2; ++b) {
    lilv_node_free(labels[b]);
    lilv_node_free(banks[b]);
  }
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
  const unsigned n_set = (unsigned)__builtin_popcountll(set);
  assert_true(strcmp(label, "Default") ? n_default < n_set : n_default == n_set);
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

void presets_check_banks(Host* host) {
  for (uint32_t k = 0; k < host_n_presets(host); ++k) {
    for (uint32_t i = 0; i <= k; ++i) {
      check_banks_labels(host, i, k);
    }
  }
}
