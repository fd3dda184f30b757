/* Banks of presets as hosts find them that ask a plugin for what is related to it, and read no more
 * than the manifest before they show them. */
#include <lilv/lilv.h>
#include <lv2/presets/presets.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_BANKS = 8 };

typedef struct {
  const char* plugin;
  const char* labels[MOST_BANKS]; /* The rest is NULL */
} Banks;

static const Banks wanted[] = {
    {"urn:hooke:strings",
     {"Guitars", "Basses", "Harps and Lutes", "Keyboards", "Mallets and Bars", "Bowed",
      "Bells and Metal", "Experimental"}},
    {"urn:hooke:guitar", {"Electric", "Acoustic", "Basses", "Experimental"}},
};

/* Nothing is loaded but the bundle's manifest. */
static LilvWorld* open_manifest(void) {
  char path[4096];
  LilvWorld* const world = lilv_world_new();
  const char* const bundle = getenv("HOOKE_BUNDLE");
  assert_true(world && bundle);
  (void)snprintf(path, sizeof(path), "%s/", bundle);
  LilvNode* const uri = lilv_new_file_uri(world, NULL, path);
  lilv_world_load_bundle(world, uri);
  lilv_node_free(uri);
  return world;
}

static LilvNodes* related(LilvWorld* world, const char* plugin_uri, const char* type_uri) {
  LilvNode* const uri = lilv_new_uri(world, plugin_uri);
  LilvNode* const type = lilv_new_uri(world, type_uri);
  const LilvPlugin* const plugin = lilv_plugins_get_by_uri(lilv_world_get_all_plugins(world), uri);
  assert_non_null(plugin);
  LilvNodes* const found = lilv_plugin_get_related(plugin, type);
  lilv_node_free(type);
  lilv_node_free(uri);
  return found;
}

static LilvNode* of(LilvWorld* world, const LilvNode* subject, const char* predicate) {
  LilvNode* const key = lilv_new_uri(world, predicate);
  LilvNode* const found = lilv_world_get(world, subject, key, NULL);
  lilv_node_free(key);
  return found;
}

static bool has_label(LilvWorld* world, const LilvNodes* banks, const char* label) {
  bool is_found = false;
  LILV_FOREACH(nodes, i, banks) {
    LilvNode* const found = of(world, lilv_nodes_get(banks, i), LILV_NS_RDFS "label");
    assert_true(lilv_node_is_string(found));
    is_found = is_found || !strcmp(lilv_node_as_string(found), label);
    lilv_node_free(found);
  }
  return is_found;
}

static void a_plugin_leads_to_its_banks_and_their_labels(void** state) {
  (void)state;
  LilvWorld* const world = open_manifest();
  for (size_t p = 0; p < sizeof(wanted) / sizeof(wanted[0]); ++p) {
    LilvNodes* const banks = related(world, wanted[p].plugin, LV2_PRESETS__Bank);
    unsigned n = 0;
    for (; n < MOST_BANKS && wanted[p].labels[n]; ++n) {
      print_message("%s: %s\n", wanted[p].plugin, wanted[p].labels[n]);
      assert_true(has_label(world, banks, wanted[p].labels[n]));
    }
    assert_int_equal(lilv_nodes_size(banks), n);
    lilv_nodes_free(banks);
  }
  lilv_world_free(world);
}

static bool holds_a_preset(LilvWorld* world, const LilvNodes* presets, const LilvNode* bank) {
  bool is_found = false;
  LILV_FOREACH(nodes, i, presets) {
    LilvNode* const of_preset = of(world, lilv_nodes_get(presets, i), LV2_PRESETS__bank);
    is_found = is_found || lilv_node_equals(of_preset, bank);
    lilv_node_free(of_preset);
  }
  return is_found;
}

static void each_preset_is_in_one_of_them_and_none_is_empty(void** state) {
  (void)state;
  LilvWorld* const world = open_manifest();
  for (size_t p = 0; p < sizeof(wanted) / sizeof(wanted[0]); ++p) {
    LilvNodes* const banks = related(world, wanted[p].plugin, LV2_PRESETS__Bank);
    LilvNodes* const presets = related(world, wanted[p].plugin, LV2_PRESETS__Preset);
    assert_true(lilv_nodes_size(presets) > 9);
    LILV_FOREACH(nodes, i, presets) {
      assert_true(lilv_world_load_resource(world, lilv_nodes_get(presets, i)) >= 0);
      LilvNode* const bank = of(world, lilv_nodes_get(presets, i), LV2_PRESETS__bank);
      print_message("%s\n", lilv_node_as_uri(lilv_nodes_get(presets, i)));
      assert_true(bank && lilv_nodes_contains(banks, bank));
      lilv_node_free(bank);
    }
    LILV_FOREACH(nodes, i, banks) {
      assert_true(holds_a_preset(world, presets, lilv_nodes_get(banks, i)));
    }
    lilv_nodes_free(presets);
    lilv_nodes_free(banks);
  }
  lilv_world_free(world);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_plugin_leads_to_its_banks_and_their_labels),
      cmocka_unit_test(each_preset_is_in_one_of_them_and_none_is_empty),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
