/* What the Turtle tells a host that draws a panel by itself: names, groups and their order read
 * well.  Hosts that draw ports by their index cannot be helped, for that never changes. */
#include "tests/support/host_inside.h"
#include "tests/support/panel.h"
#include "tests/support/plugins.h"

#include <lv2/core/lv2.h>
#include <lv2/port-groups/port-groups.h>
#include <lv2/port-props/port-props.h>

#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { LONGEST_SHORT_NAME = 16, LONGEST_NAME = 24 };

/* A control, its group, in the order in which a player looks for them. */
typedef struct {
  const char* symbol;
  const char* group;
} Shown;

static const Shown of_strings[] = {
    {"level", "level"},
    {"exciter", "touch"},
    {"damping", "string"},
    {"hardness", "touch"},
    {"loss", "string"},
    {"pluck", "touch"},
    {"pickup", "pickups"},
    {"sense", "pickups"},
    {"body", "body"},
    {"body_mix", "body"},
    {"stiffness", "string"},
    {"tension", "string"},
    {"resonance", "string"},
    {"release", "touch"},
    {"tracking", "string"},
    {"loss_tracking", "string"},
    {"stiffness_tracking", "string"},
    {"spread", "pickups"},
    {"release_tracking", "touch"},
    {"knock", "body"},
    {"partials", "string"},
    {"masses", "string"},
    {"noise", "touch"},
    {"vibrato_rate", "touch"},
    {"variation", "touch"},
    {"take", "touch"},
    {"tuning", "string"},
    {"unisons", "unison"},
    {"unison_detune", "unison"},
    {"second", "unison"},
    {"second_detune", "unison"},
    {"second_decay", "unison"},
    {"limiter", "level"},
    {"body_size", "body"},
    {"body_damping", "body"},
};

static const Shown of_guitar[] = {
    {"level", "level"},
    {"damping", "string"},
    {"hardness", "touch"},
    {"loss", "string"},
    {"palm", "touch"},
    {"pluck", "touch"},
    {"pickup", "pickups"},
    {"blend", "pickups"},
    {"pickup2", "pickups"},
    {"body", "body"},
    {"body_mix", "body"},
    {"stiffness", "string"},
    {"tension", "string"},
    {"harmonic", "touch"},
    {"strum", "player"},
    {"release", "touch"},
    {"tracking", "string"},
    {"loss_tracking", "string"},
    {"legato", "player"},
    {"stiffness_tracking", "string"},
    {"mode", "player"},
    {"width", "level"},
    {"release_tracking", "touch"},
    {"noise", "touch"},
    {"course", "string"},
    {"knock", "body"},
    {"partials", "string"},
    {"masses", "string"},
    {"capo", "neck"},
    {"string1", "neck"},
    {"string2", "neck"},
    {"string3", "neck"},
    {"string4", "neck"},
    {"string5", "neck"},
    {"string6", "neck"},
    {"tuning", "string"},
    {"variation", "touch"},
    {"take", "touch"},
    {"limiter", "level"},
    {"body_size", "body"},
    {"body_damping", "body"},
};

static const char* const of_meters[] = {"sounding", "mass_count", "headroom", "stability_used"};
static const char* const of_host[] = {"control", "notify", "enabled", "freewheel"};

static bool is_small_word(const char* word) {
  return !strncmp(word, "of ", 3) || !strncmp(word, "per ", 4) || !strncmp(word, "and ", 4);
}

static void check_title(const char* name, size_t longest) {
  print_message("%s\n", name);
  assert_in_range(strlen(name), 1, longest);
  for (size_t i = 0; name[i]; ++i) {
    if (i == 0 || name[i - 1] == ' ') {
      assert_true(isupper((unsigned char)name[i]) || isdigit((unsigned char)name[i]) ||
                  is_small_word(name + i));
    }
  }
}

static void check_names(Host* host, uint32_t port) {
  static const char* const predicates[] = {LV2_CORE__name, LV2_CORE_PREFIX "shortName"};
  for (int k = 0; k < 2; ++k) {
    LilvNode* const name = panel_get(host, port, predicates[k]);
    assert_non_null(name);
    check_title(lilv_node_as_string(name), k ? LONGEST_SHORT_NAME : LONGEST_NAME);
    for (uint32_t i = 0; i < port; ++i) {
      LilvNode* const other = panel_get(host, i, predicates[k]);
      assert_false(lilv_node_equals(name, other));
      lilv_node_free(other);
    }
    lilv_node_free(name);
  }
}

static void names_are_titles_and_short_ones_short(void** state) {
  (void)state;
  panel_check_all(check_names);
}

static void check_comment(Host* host, uint32_t port) {
  LilvNode* const comment = panel_get(host, port, LILV_NS_RDFS "comment");
  print_message("%s\n", host_port_symbol(host, port));
  assert_non_null(comment);
  const char* const text = lilv_node_as_string(comment);
  assert_true(isupper((unsigned char)text[0]) && text[strlen(text) - 1] == '.');
  lilv_node_free(comment);
}

/* What a player would have to look up. */
static void check_plain(Host* host, uint32_t port) {
  static const char* const hard[] = {"1/e", "fundamental", "nharmonic", "partial k", "coefficient"};
  LilvNode* const comment = panel_get(host, port, LILV_NS_RDFS "comment");
  print_message("%s\n", host_port_symbol(host, port));
  for (size_t i = 0; i < sizeof(hard) / sizeof(hard[0]); ++i) {
    assert_null(strstr(lilv_node_as_string(comment), hard[i]));
  }
  lilv_node_free(comment);
}

static void what_a_panel_says_is_said_in_plain_words(void** state) {
  (void)state;
  panel_check_all(check_plain);
}

/* Not only those that a panel shows. */
static void each_says_what_it_does_and_where_it_belongs(void** state) {
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    Host* const host = plugins_open(plugin);
    for (uint32_t i = 0; i < host_n_ports(host); ++i) {
      LilvNode* const group = panel_get(host, i, LV2_PORT_GROUPS__group);
      check_comment(host, i);
      assert_true(lilv_node_is_uri(group));
      lilv_node_free(group);
    }
    host_free(host);
  }
}

static void check_group(Host* host, uint32_t port, const char* wanted) {
  LilvNode* const group = panel_get(host, port, LV2_PORT_GROUPS__group);
  assert_non_null(group);
  LilvNode* const symbol = panel_of(host, group, LV2_CORE__symbol);
  LilvNode* const name = panel_of(host, group, LV2_CORE__name);
  LilvNode* const label = panel_of(host, group, LILV_NS_RDFS "label");
  assert_string_equal(lilv_node_as_string(symbol), wanted);
  check_title(lilv_node_as_string(name), LONGEST_SHORT_NAME);
  assert_null(label); /* It is no preset of the same name. */
  lilv_node_free(symbol);
  lilv_node_free(name);
  lilv_node_free(group);
}

static void check_groups(Host* host, const char* const symbols[], size_t n, const char* wanted) {
  for (size_t i = 0; i < n; ++i) {
    check_group(host, host_port_index(host, symbols[i]), wanted);
  }
}

static int priority_of(Host* host, uint32_t port) {
  LilvNode* const priority = panel_get(host, port, LV2_PORT_PROPS__displayPriority);
  const int value = priority ? lilv_node_as_int(priority) : -1;
  lilv_node_free(priority);
  return value;
}

static void check_order(int plugin, const Shown shown[], uint32_t n_shown) {
  Host* const host = plugins_open(plugin);
  int before = 101;
  uint32_t n_inputs = 0;
  for (uint32_t k = 0; k < host_n_presets(host); ++k) {
    LilvNode* const preset = lilv_new_uri(host_world(host), host_preset_uri(host, k));
    (void)lilv_world_load_resource(host_world(host), preset);
    lilv_node_free(preset);
  }
  for (uint32_t i = 0; i < n_shown; ++i) {
    const uint32_t port = host_port_index(host, shown[i].symbol);
    print_message("%s\n", shown[i].symbol);
    assert_true(panel_shows(host, port));
    assert_true(priority_of(host, port) < before);
    before = priority_of(host, port);
    check_group(host, port, shown[i].group);
  }
  for (uint32_t i = 0; i < host_n_ports(host); ++i) {
    n_inputs += host_port_is_control_input(host, i) && panel_shows(host, i);
  }
  assert_true(before >= 0);
  assert_int_equal(n_inputs, n_shown);
  check_groups(host, of_meters, sizeof(of_meters) / sizeof(of_meters[0]), "meters");
  check_groups(host, of_host, sizeof(of_host) / sizeof(of_host[0]), "host");
  host_free(host);
}

static void controls_are_in_groups_and_in_order(void** state) {
  (void)state;
  check_order(0, of_strings, sizeof(of_strings) / sizeof(of_strings[0]));
  check_order(1, of_guitar, sizeof(of_guitar) / sizeof(of_guitar[0]));
}

/* A meter that is full and red has to be bad news. */
static void what_is_used_is_shown_and_not_what_is_left(void** state) {
  (void)state;
  for (int plugin = 0; plugin < N_PLUGINS; ++plugin) {
    Host* const host = plugins_open(plugin);
    assert_true(panel_shows(host, host_port_index(host, "stability_used")));
    assert_false(panel_shows(host, host_port_index(host, "headroom")));
    host_free(host);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(names_are_titles_and_short_ones_short),
      cmocka_unit_test(each_says_what_it_does_and_where_it_belongs),
      cmocka_unit_test(what_a_panel_says_is_said_in_plain_words),
      cmocka_unit_test(controls_are_in_groups_and_in_order),
      cmocka_unit_test(what_is_used_is_shown_and_not_what_is_left),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
