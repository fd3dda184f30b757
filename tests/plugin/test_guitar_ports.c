/* The ports in three places, the list below, plugin/guitar_ports.h and the Turtle, are one:
 * sessions are stored by symbol and automation by index, so this list only ever grows. */
#include "plugin/guitar_ports.h"
#include "plugin/strings_ports.h"
#include "tests/support/guitar_host.h"
#include "tests/support/host_inside.h"
#include "tests/support/pins.h"

#include <lv2/midi/midi.h>
#include <lv2/port-groups/port-groups.h>

#include <dlfcn.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* By index.  Append; never move, rename, remove or change a range. */
static const Pin pinned[] = {
    {"control", PIN_IN, PIN_ATOM, LV2_CORE__control, 0, 0, 0, 0},
    {"notify", PIN_OUT, PIN_ATOM, LV2_CORE__control, 0, 0, 0, 0},
    {"out_left", PIN_OUT, PIN_AUDIO, LV2_PORT_GROUPS__left, 0, 0, 0, 0},
    {"out_right", PIN_OUT, PIN_AUDIO, LV2_PORT_GROUPS__right, 0, 0, 0, 0},
    {"enabled", PIN_IN, PIN_VALUE, LV2_CORE__enabled, PIN_TOGGLED, 0.0f, 1.0f, 1.0f},
    {"freewheel", PIN_IN, PIN_VALUE, LV2_CORE__freeWheeling, PIN_TOGGLED | PIN_NOT_AUTOMATIC, 0.0f,
     1.0f, 0.0f},
    {"level", PIN_IN, PIN_VALUE, NULL, 0, -60.0f, 12.0f, 0.0f},
    {"damping", PIN_IN, PIN_VALUE, NULL, PIN_LOGARITHMIC, 0.02f, 200.0f, 0.6f},
    {"tracking", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.5f},
    {"loss", PIN_IN, PIN_VALUE, NULL, PIN_LOGARITHMIC, 1e-5f, 1.0f, 0.01f},
    {"stiffness", PIN_IN, PIN_VALUE, NULL, PIN_LOGARITHMIC, 1e-6f, 0.1f, 1e-6f},
    {"pickup", PIN_IN, PIN_VALUE, NULL, 0, 0.02f, 0.5f, 0.08f},
    {"pickup2", PIN_IN, PIN_VALUE, NULL, 0, 0.02f, 0.5f, 0.24f},
    {"blend", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.5f},
    {"width", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.15f},
    {"pluck", PIN_IN, PIN_VALUE, NULL, 0, 0.02f, 0.5f, 0.13f},
    {"hardness", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.6f},
    {"masses", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_EXPENSIVE | PIN_NOT_AUTOMATIC, 1.0f,
     256.0f, 80.0f},
    {"partials", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 0.0f, 2.0f, 2.0f},
    {"release", PIN_IN, PIN_VALUE, NULL, PIN_LOGARITHMIC, 0.005f, 10.0f, 0.1f},
    {"tuning", PIN_IN, PIN_VALUE, NULL, 0, 400.0f, 480.0f, 440.0f},
    {"string1", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 12.0f, 88.0f, 64.0f},
    {"string2", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 12.0f, 88.0f, 59.0f},
    {"string3", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 12.0f, 88.0f, 55.0f},
    {"string4", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 12.0f, 88.0f, 50.0f},
    {"string5", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 12.0f, 88.0f, 45.0f},
    {"string6", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 12.0f, 88.0f, 40.0f},
    {"capo", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER, 0.0f, 12.0f, 0.0f},
    {"palm", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
    {"strum", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 100.0f, 0.0f},
    {"mode", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 0.0f, 1.0f, 0.0f},
    {"legato", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER, 0.0f, 127.0f, 40.0f},
    {"harmonic", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 0.0f, 3.0f, 0.0f},
    {"course", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
    {"sounding", PIN_OUT, PIN_VALUE, NULL, PIN_INTEGER, 0.0f, 12.0f, 0.0f},
    {"mass_count", PIN_OUT, PIN_VALUE, NULL, PIN_INTEGER, 0.0f, 3072.0f, 0.0f},
    {"headroom", PIN_OUT, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 1.0f},
    {"limiter", PIN_IN, PIN_VALUE, NULL, PIN_TOGGLED, 0.0f, 1.0f, 1.0f},
    {"stability_used", PIN_OUT, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
    {"loss_tracking", PIN_IN, PIN_VALUE, NULL, 0, -2.0f, 4.0f, 0.0f},
    {"stiffness_tracking", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 4.0f, 0.0f},
    {"release_tracking", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 2.0f, 0.0f},
    {"tension", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 100.0f, 0.0f},
    {"variation", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
    {"take", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER, 1.0f, 999.0f, 1.0f},
    {"noise", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
    {"body", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 0.0f, 12.0f, 0.0f},
    {"body_mix", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.7f},
    {"body_size", PIN_IN, PIN_VALUE, NULL, 0, 0.5f, 2.0f, 1.0f},
    {"body_damping", PIN_IN, PIN_VALUE, NULL, PIN_LOGARITHMIC, 0.25f, 4.0f, 1.0f},
    {"knock", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
};

enum { N_PINNED = sizeof(pinned) / sizeof(pinned[0]) };

static void the_turtle_says_what_is_pinned(void** state) {
  (void)state;
  Host* const host = guitar_open(48000.0, 64);
  pins_check(host, pinned, N_PINNED);
  host_free(host);
}

static void the_turtle_says_what_the_code_says(void** state) {
  (void)state;
  Host* const host = guitar_open(48000.0, 64);
  assert_int_equal(host_n_ports(host), GUITAR_N_PORTS);
  uint32_t n_ports = 0;
  HostRange range;
  GUITAR_STREAM_PORTS(PIN_STREAM)
  GUITAR_CONTROL_PORTS(PIN_CONTROL)
  assert_int_equal(n_ports, GUITAR_N_PORTS);
  host_free(host);
}

/* The names of the values of an enumeration are what sessions and scripts are read by. */
static void enumerations_have_their_names(void** state) {
  static const char* const partials[] = {"Lumped", "True", "Truest"};
  static const char* const modes[] = {"One Channel", "Channel per String"};
  static const char* const harmonics[] = {"None", "Octave (1/2)", "Twelfth (1/3)",
                                          "Double octave (1/4)"};
  (void)state;
  Host* const host = guitar_open(48000.0, 64);
  pins_check_names(host, GUITAR_PORT_PARTIALS, partials, 3);
  pins_check_names(host, GUITAR_PORT_MODE, modes, 2);
  pins_check_names(host, GUITAR_PORT_HARMONIC, harmonics, 4);
  host_free(host);
}

/* The key that a note's name says, with C4 for key 60. */
static int key_of(const char* name) {
  static const int semitones[] = {
      ['A'] = 9, ['B'] = 11, ['C'] = 0, ['D'] = 2, ['E'] = 4, ['F'] = 5, ['G'] = 7};
  const bool is_sharp = name[1] == '#';
  return semitones[(unsigned char)name[0]] + is_sharp + 12 * (name[is_sharp ? 2 : 1] - '0' + 1);
}

static void open_strings_have_the_names_of_notes(void** state) {
  (void)state;
  Host* const host = guitar_open(48000.0, 64);
  for (uint32_t i = 0; i < GUITAR_PORT_STRINGS; ++i) {
    LilvScalePoints* const points = lilv_port_get_scale_points(
        host_plugin(host),
        lilv_plugin_get_port_by_index(host_plugin(host), GUITAR_PORT_STRING1 + i));
    LILV_FOREACH(scale_points, k, points) {
      const LilvScalePoint* const point = lilv_scale_points_get(points, k);
      const char* const name = lilv_node_as_string(lilv_scale_point_get_label(point));
      assert_int_equal(lilv_node_as_int(lilv_scale_point_get_value(point)), key_of(name));
    }
    lilv_scale_points_free(points);
  }
  host_free(host);
}

/* Whoever knows the one plugin knows the other. */
static void ports_of_a_name_are_alike_in_both_plugins(void** state) {
  static const char* const own[] = {"pickup", "pluck", "hardness", "masses"};
  (void)state;
  Host* const guitar = guitar_open(48000.0, 64);
  Host* const strings = strings_open(48000.0, 64);
  unsigned n_shared = 0;
  for (uint32_t i = 0; i < GUITAR_N_PORTS; ++i) {
    const char* const symbol = host_port_symbol(guitar, i);
    bool is_own = false;
    for (size_t k = 0; k < sizeof(own) / sizeof(own[0]); ++k) {
      is_own = is_own || !strcmp(symbol, own[k]);
    }
    HostRange a;
    HostRange b;
    if (!is_own && host_range(guitar, symbol, &a) && host_range(strings, symbol, &b)) {
      assert_true(a.min == b.min && a.max == b.max && a.initial == b.initial);
      assert_int_equal(a.is_integer, b.is_integer);
      ++n_shared;
    }
  }
  assert_int_equal(n_shared, 23);
  host_free(guitar);
  host_free(strings);
}

static void what_it_names_is_described(void** state) {
  (void)state;
  Host* const host = guitar_open(48000.0, 64);
  pins_check_references(host);
  host_free(host);
}

static void it_is_an_instrument_that_needs_a_map_alone(void** state) {
  (void)state;
  Host* const host = guitar_open(48000.0, 64);
  pins_check_instrument(host);
  host_free(host);
}

static void the_control_port_takes_midi_and_scripts(void** state) {
  (void)state;
  Host* const host = guitar_open(48000.0, 64);
  assert_true(pins_takes(host, LV2_MIDI__MidiEvent));
  assert_true(pins_takes(host, GUITAR_EVENT_URI));
  assert_false(pins_takes(host, LV2_ATOM__Chunk));
  host_free(host);
}

/* Hosts that remember an index find the same plugin there. */
static void the_bundle_has_two_plugins_in_their_order(void** state) {
  (void)state;
  Host* const host = guitar_open(48000.0, 64);
  const LilvNode* const uri = lilv_plugin_get_library_uri(host_plugin(host));
  char* const path = lilv_file_uri_parse(lilv_node_as_uri(uri), NULL);
  void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  assert_non_null(library);
  LV2_Descriptor_Function descriptor = NULL;
  *(void**)&descriptor = dlsym(library, "lv2_descriptor");
  assert_non_null(descriptor);
  assert_string_equal(descriptor(0)->URI, STRINGS_URI);
  assert_string_equal(descriptor(1)->URI, GUITAR_URI);
  assert_null(descriptor(2));
  assert_null(descriptor(UINT32_MAX));
  assert_int_equal(dlclose(library), 0);
  lilv_free(path);
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_turtle_says_what_is_pinned),
      cmocka_unit_test(the_turtle_says_what_the_code_says),
      cmocka_unit_test(enumerations_have_their_names),
      cmocka_unit_test(open_strings_have_the_names_of_notes),
      cmocka_unit_test(ports_of_a_name_are_alike_in_both_plugins),
      cmocka_unit_test(what_it_names_is_described),
      cmocka_unit_test(it_is_an_instrument_that_needs_a_map_alone),
      cmocka_unit_test(the_control_port_takes_midi_and_scripts),
      cmocka_unit_test(the_bundle_has_two_plugins_in_their_order),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
