/* What MOD's hosts are told in their own words: a pedal whose parts are all there and whose knobs
 * are ports, names that fit, and kinds of files. */
#include "tests/support/host_inside.h"
#include "tests/support/panel.h"
#include "tests/support/plugins.h"

#include <lv2/atom/atom.h>
#include <lv2/core/lv2.h>
#include <lv2/patch/patch.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#define MOD "http://moddevices.com/ns/mod#"
#define MODGUI "http://moddevices.com/ns/modgui#"

enum { LONGEST_BRAND = 11, LONGEST_LABEL = 16, WIDEST_SMALL = 256, HIGHEST_SMALL = 64 };

static LilvNode* of_plugin(Host* host, const char* predicate) {
  return panel_of(host, lilv_plugin_get_uri(host_plugin(host)), predicate);
}

static void check_length(Host* host, const char* predicate, size_t longest) {
  LilvNode* const text = of_plugin(host, predicate);
  assert_true(lilv_node_is_string(text));
  assert_in_range(strlen(lilv_node_as_string(text)), 1, longest);
  lilv_node_free(text);
}

static void brand_and_label_fit_the_display(void** state) {
  (void)state;
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    check_length(host, MOD "brand", LONGEST_BRAND);
    check_length(host, MOD "label", LONGEST_LABEL);
    host_free(host);
  }
}

/* The path of a part of the pedal, to be freed with lilv_free(). */
static char* part_path(Host* host, const char* predicate) {
  LilvNode* const gui = of_plugin(host, MODGUI "gui");
  LilvNode* const part = panel_of(host, gui, predicate);
  print_message("%s\n", predicate);
  assert_true(gui && lilv_node_is_uri(part));
  char* const path = lilv_file_uri_parse(lilv_node_as_uri(part), NULL);
  assert_non_null(path);
  lilv_node_free(part);
  lilv_node_free(gui);
  return path;
}

/* A file's bytes with a 0 behind them, for free(). */
static char* read_part(Host* host, const char* predicate) {
  char* const path = part_path(host, predicate);
  FILE* const file = fopen(path, "rb");
  assert_non_null(file);
  assert_int_equal(fseek(file, 0, SEEK_END), 0);
  const long size = ftell(file);
  rewind(file);
  assert_true(size > 0);
  char* const bytes = calloc(1, (size_t)size + 1);
  assert_non_null(bytes);
  assert_int_equal(fread(bytes, 1, (size_t)size, file), size);
  (void)fclose(file);
  lilv_free(path);
  return bytes;
}

/* A browser is given what is in the directory, and nothing else. */
static void check_parts(Host* host) {
  static const char* const parts[] = {MODGUI "iconTemplate", MODGUI "stylesheet",
                                      MODGUI "screenshot", MODGUI "thumbnail"};
  struct stat status;
  char* const directory = part_path(host, MODGUI "resourcesDirectory");
  assert_int_equal(stat(directory, &status), 0);
  assert_true(S_ISDIR(status.st_mode));
  for (size_t i = 0; i < sizeof(parts) / sizeof(parts[0]); ++i) {
    char* const path = part_path(host, parts[i]);
    assert_int_equal(strncmp(path, directory, strlen(directory)), 0);
    assert_int_equal(stat(path, &status), 0);
    assert_true(S_ISREG(status.st_mode) && status.st_size < 16384);
    lilv_free(path);
  }
  lilv_free(directory);
}

static void all_parts_of_the_pedal_are_there(void** state) {
  (void)state;
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    check_parts(host);
    host_free(host);
  }
}

/* A PNG begins with eight bytes of its own and the length and name of its header. */
static unsigned png_number(const char* bytes, size_t at) {
  const unsigned char* const b = (const unsigned char*)bytes + at;
  return (unsigned)b[0] << 24 | (unsigned)b[1] << 16 | (unsigned)b[2] << 8 | b[3];
}

static void the_small_picture_is_small(void** state) {
  (void)state;
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    char* const small = read_part(host, MODGUI "thumbnail");
    assert_memory_equal(small + 12, "IHDR", 4);
    assert_in_range(png_number(small, 16), 1, WIDEST_SMALL);
    assert_in_range(png_number(small, 20), 1, HIGHEST_SMALL);
    free(small);
    host_free(host);
  }
}

static void check_knob(Host* host, const LilvNode* knob) {
  LilvNode* const symbol = panel_of(host, knob, LV2_CORE__symbol);
  LilvNode* const name = panel_of(host, knob, LV2_CORE__name);
  LilvNode* const index = panel_of(host, knob, LV2_CORE__index);
  assert_true(symbol && name && lilv_node_is_int(index));
  print_message("%s\n", lilv_node_as_string(symbol));
  const uint32_t port = host_port_index(host, lilv_node_as_string(symbol));
  assert_true(port < host_n_ports(host));
  assert_true(host_port_is_control_input(host, port) && panel_shows(host, port));
  LilvNode* const short_name = panel_get(host, port, LV2_CORE_PREFIX "shortName");
  assert_true(lilv_node_equals(short_name, name));
  lilv_node_free(short_name);
  lilv_node_free(index);
  lilv_node_free(name);
  lilv_node_free(symbol);
}

static void each_knob_is_a_port(void** state) {
  (void)state;
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    LilvNode* const gui = of_plugin(host, MODGUI "gui");
    LilvNode* const key = lilv_new_uri(host_world(host), MODGUI "port");
    LilvNodes* const knobs = lilv_world_find_nodes(host_world(host), gui, key, NULL);
    assert_int_equal(lilv_nodes_size(knobs), 8);
    LILV_FOREACH(nodes, k, knobs) {
      check_knob(host, lilv_nodes_get(knobs, k));
    }
    lilv_nodes_free(knobs);
    lilv_node_free(key);
    lilv_node_free(gui);
    host_free(host);
  }
}

/* The template names no port of its own: all come from the list of knobs and from the Turtle. */
static void check_icon(const char* icon) {
  static const char* const roles[] = {
      "drag-handle",         "bypass",          "bypass-light",     "input-control-port",
      "input-control-value", "input-midi-port", "output-audio-port"};
  static const char* const sections[] = {"controls", "effect.ports.midi.input",
                                         "effect.ports.audio.output"};
  char text[64];
  for (size_t i = 0; i < sizeof(roles) / sizeof(roles[0]); ++i) {
    (void)snprintf(text, sizeof(text), "mod-role=\"%s\"", roles[i]);
    print_message("%s\n", text);
    assert_non_null(strstr(icon, text));
  }
  for (size_t i = 0; i < sizeof(sections) / sizeof(sections[0]); ++i) {
    (void)snprintf(text, sizeof(text), "{{#%s}}", sections[i]);
    const char* const begin = strstr(icon, text);
    (void)snprintf(text, sizeof(text), "{{/%s}}", sections[i]);
    const char* const end = strstr(icon, text);
    assert_true(begin && end && begin < end);
  }
  for (const char* at = icon; (at = strstr(at, "mod-port-symbol=\"")); ++at) {
    assert_int_equal(strncmp(at, "mod-port-symbol=\"{{symbol}}\"", 28), 0);
  }
}

/* Every class that the icon has of ours looks like something, and no rule is another plugin's. */
static void check_style(const char* icon, const char* style) {
  char wanted[80];
  for (const char* at = icon; (at = strstr(at, "hooke-")); ++at) {
    const size_t length = strcspn(at, "\" ");
    (void)snprintf(wanted, sizeof(wanted), ".hooke{{{cns}}} .%.*s", (int)length, at);
    print_message("%s\n", wanted);
    assert_non_null(strstr(style, wanted));
  }
  for (const char* line = style; line; line = strchr(line, '\n')) {
    line += *line == '\n';
    if (*line == '.') {
      assert_int_equal(strncmp(line, ".hooke{{{cns}}}", 15), 0);
    }
  }
}

static void the_icon_has_all_roles_and_a_style(void** state) {
  (void)state;
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    char* const icon = read_part(host, MODGUI "iconTemplate");
    char* const style = read_part(host, MODGUI "stylesheet");
    check_icon(icon);
    check_style(icon, style);
    free(style);
    free(icon);
    host_free(host);
  }
}

/* What has none is not shown at all.  Blanks would be taken for a part of a kind's name. */
static void each_file_has_its_kinds(void** state) {
  (void)state;
  for (int i = 0; i < N_PLUGINS; ++i) {
    Host* const host = plugins_open(i);
    LilvNode* const key = lilv_new_uri(host_world(host), LV2_PATCH__writable);
    LilvNodes* const files =
        lilv_world_find_nodes(host_world(host), lilv_plugin_get_uri(host_plugin(host)), key, NULL);
    LILV_FOREACH(nodes, k, files) {
      LilvNode* const kinds = panel_of(host, lilv_nodes_get(files, k), MOD "fileTypes");
      print_message("%s\n", lilv_node_as_uri(lilv_nodes_get(files, k)));
      assert_true(lilv_node_is_string(kinds));
      assert_string_equal(lilv_node_as_string(kinds), "scl,kbm,body");
      lilv_node_free(kinds);
    }
    assert_int_equal(lilv_nodes_size(files), 3);
    lilv_nodes_free(files);
    lilv_node_free(key);
    host_free(host);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(brand_and_label_fit_the_display),
      cmocka_unit_test(all_parts_of_the_pedal_are_there),
      cmocka_unit_test(the_small_picture_is_small),
      cmocka_unit_test(each_knob_is_a_port),
      cmocka_unit_test(the_icon_has_all_roles_and_a_style),
      cmocka_unit_test(each_file_has_its_kinds),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
