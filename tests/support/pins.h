/** The ports of a plugin held against a list of what they are to be.  What differs fails the test.
 */
#ifndef HOOKE_TESTS_SUPPORT_PINS_H
#define HOOKE_TESTS_SUPPORT_PINS_H

#include "tools/host/host.h"

#include <lv2/atom/atom.h>
#include <lv2/core/lv2.h>

#include <stdint.h>

#define PIN_IN LV2_CORE__InputPort
#define PIN_OUT LV2_CORE__OutputPort
#define PIN_ATOM LV2_ATOM__AtomPort
#define PIN_AUDIO LV2_CORE__AudioPort
#define PIN_VALUE LV2_CORE__ControlPort

/** Properties of which a port must have exactly those named. */
enum {
  PIN_LOGARITHMIC = 1,
  PIN_INTEGER = 2,
  PIN_TOGGLED = 4,
  PIN_EXPENSIVE = 8,
  PIN_NOT_AUTOMATIC = 16,
  PIN_ENUMERATION = 32
};

/** What a port is to be. */
typedef struct {
  const char* symbol;
  const char* direction;
  const char* type;
  const char* designation; /**< NULL: none */
  unsigned properties;
  float minimum, maximum, initial; /**< Of a control port */
} Pin;

/** Hold the first `n_pins` ports of the Turtle against `pins`, by index. */
void pins_check(Host* host, const Pin pins[], uint32_t n_pins);

/** The port's scale points are `n_names` values from 0, of these names. */
void pins_check_names(Host* host, uint32_t port, const char* const names[], uint32_t n_names);

/** It is an instrument that requires urid:map alone, is fit for real time and has no latency. */
void pins_check_instrument(Host* host);

/** It says who made it, and whatever group or unit it names is described too. */
void pins_check_references(Host* host);

/** Whether its control port takes events of a type. */
bool pins_takes(Host* host, const char* type_uri);

/** For a list of ports as in plugin/ports.h: the Turtle has it, with that index, and no range or
 * this one; `n_ports` counts them. */
#define PIN_STREAM(name, symbol, index)                                                            \
  assert_int_equal(host_port_index(host, #symbol), index);                                         \
  assert_false(host_range(host, #symbol, &range));                                                 \
  ++n_ports;
#define PIN_CONTROL(name, symbol, index, minimum, maximum, default_value)                          \
  assert_int_equal(host_port_index(host, #symbol), index);                                         \
  assert_true(host_range(host, #symbol, &range));                                                  \
  assert_true(range.min == (minimum) && range.max == (maximum));                                   \
  assert_true(range.initial == (default_value));                                                   \
  ++n_ports;

#endif
