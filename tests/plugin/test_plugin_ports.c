/* The ports in three places, the list below, plugin/strings_ports.h and the Turtle, are one:
 * sessions are stored by symbol and automation by index, so this list only ever grows. */
#include "plugin/strings_ports.h"
#include "tests/support/host_inside.h"
#include "tests/support/pins.h"
#include "tests/support/strings_host.h"

#include <lv2/midi/midi.h>
#include <lv2/port-groups/port-groups.h>

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* By index.  Append; never move, rename, remove or change a range, but that of a meter. */
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
    {"pickup", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.2f},
    {"spread", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 0.5f, 0.1f},
    {"pluck", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.13f},
    {"hardness", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.5f},
    {"masses", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_EXPENSIVE | PIN_NOT_AUTOMATIC, 1.0f,
     1024.0f, 128.0f},
    {"release", PIN_IN, PIN_VALUE, NULL, PIN_LOGARITHMIC, 0.005f, 10.0f, 0.1f},
    {"tuning", PIN_IN, PIN_VALUE, NULL, 0, 400.0f, 480.0f, 440.0f},
    {"sounding", PIN_OUT, PIN_VALUE, NULL, PIN_INTEGER, 0.0f, 960.0f, 0.0f},
    {"mass_count", PIN_OUT, PIN_VALUE, NULL, PIN_INTEGER, 0.0f, 368640.0f, 0.0f},
    {"headroom", PIN_OUT, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 1.0f},
    {"partials", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 0.0f, 2.0f, 2.0f},
    {"exciter", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 0.0f, 2.0f, 0.0f},
    {"sense", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 0.0f, 2.0f, 1.0f},
    {"limiter", PIN_IN, PIN_VALUE, NULL, PIN_TOGGLED, 0.0f, 1.0f, 1.0f},
    {"resonance", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
    {"vibrato_rate", PIN_IN, PIN_VALUE, NULL, PIN_LOGARITHMIC, 0.5f, 12.0f, 5.5f},
    {"stability_used", PIN_OUT, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
    {"loss_tracking", PIN_IN, PIN_VALUE, NULL, 0, -2.0f, 4.0f, 0.0f},
    {"stiffness_tracking", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 4.0f, 0.0f},
    {"release_tracking", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 2.0f, 0.0f},
    {"tension", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 100.0f, 0.0f},
    {"variation", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
    {"take", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER, 1.0f, 999.0f, 1.0f},
    {"noise", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
    {"unisons", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_EXPENSIVE, 1.0f, 3.0f, 1.0f},
    {"unison_detune", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 20.0f, 2.0f},
    {"second", PIN_IN, PIN_VALUE, NULL, PIN_EXPENSIVE, 0.0f, 1.0f, 0.0f},
    {"second_detune", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 30.0f, 5.0f},
    {"second_decay", PIN_IN, PIN_VALUE, NULL, PIN_LOGARITHMIC, 0.25f, 4.0f, 1.0f},
    {"body", PIN_IN, PIN_VALUE, NULL, PIN_INTEGER | PIN_ENUMERATION, 0.0f, 12.0f, 0.0f},
    {"body_mix", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.7f},
    {"body_size", PIN_IN, PIN_VALUE, NULL, 0, 0.5f, 2.0f, 1.0f},
    {"body_damping", PIN_IN, PIN_VALUE, NULL, PIN_LOGARITHMIC, 0.25f, 4.0f, 1.0f},
    {"knock", PIN_IN, PIN_VALUE, NULL, 0, 0.0f, 1.0f, 0.0f},
};

enum { N_PINNED = sizeof(pinned) / sizeof(pinned[0]) };

static void the_turtle_says_what_is_pinned(void** state) {
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  pins_check(host, pinned, N_PINNED);
  host_free(host);
}

/* The names of the values of an enumeration are what sessions and scripts are read by. */
static void values_have_their_names(void** state) {
  static const char* const partials[] = {"Lumped", "True", "Truest"};
  static const char* const exciters[] = {"Pluck", "Strike", "Bow"};
  static const char* const pickup_types[] = {"Displacement", "Velocity", "Bridge Force"};
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  pins_check_names(host, STRINGS_PORT_PARTIALS, partials, 3);
  pins_check_names(host, STRINGS_PORT_EXCITER, exciters, 3);
  pins_check_names(host, STRINGS_PORT_SENSE, pickup_types, 3);
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
  STRINGS_STREAM_PORTS(PIN_STREAM)
  STRINGS_CONTROL_PORTS(PIN_CONTROL)
  assert_int_equal(n_ports, STRINGS_N_PORTS);
  host_free(host);
}

static void what_it_names_is_described(void** state) {
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  pins_check_references(host);
  host_free(host);
}

static void it_is_an_instrument_that_needs_a_map_alone(void** state) {
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  pins_check_instrument(host);
  host_free(host);
}

static void the_control_port_takes_midi(void** state) {
  (void)state;
  Host* const host = strings_open(48000.0, 64);
  assert_true(pins_takes(host, LV2_MIDI__MidiEvent));
  host_free(host);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_turtle_says_what_is_pinned),
      cmocka_unit_test(values_have_their_names),
      cmocka_unit_test(the_turtle_says_what_the_code_says),
      cmocka_unit_test(what_it_names_is_described),
      cmocka_unit_test(it_is_an_instrument_that_needs_a_map_alone),
      cmocka_unit_test(the_control_port_takes_midi),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
