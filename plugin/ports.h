/** Ports: those that every instrument has, and how those of any are read. */
#ifndef HOOKE_PLUGIN_PORTS_H
#define HOOKE_PLUGIN_PORTS_H

#include <stdbool.h>
#include <stdint.h>

/** X(NAME, symbol, index): ports of every instrument that are not control inputs. */
#define COMMON_STREAM_PORTS(X)                                                                     \
  X(CONTROL, control, 0)                                                                           \
  X(NOTIFY, notify, 1)                                                                             \
  X(OUT_LEFT, out_left, 2)                                                                         \
  X(OUT_RIGHT, out_right, 3)

/** X(NAME, symbol, index, minimum, maximum, default): control inputs of every instrument. */
#define COMMON_CONTROL_PORTS(X)                                                                    \
  X(ENABLED, enabled, 4, 0.0f, 1.0f, 1.0f)                                                         \
  X(FREEWHEEL, freewheel, 5, 0.0f, 1.0f, 0.0f)

#define STREAM_ENUM(name, symbol, index) PORT_##name = (index),
#define CONTROL_ENUM(name, symbol, index, minimum, maximum, default_value) PORT_##name = (index),
enum { COMMON_STREAM_PORTS(STREAM_ENUM) COMMON_CONTROL_PORTS(CONTROL_ENUM) };
#undef STREAM_ENUM
#undef CONTROL_ENUM

enum { PORTS_MAX = 64 /**< Most ports of an instrument */ };

/** What a control input may hold. */
typedef struct {
  uint32_t index;
  float minimum, maximum, default_value;
} PortRange;

/** An entry of a list of control inputs as a PortRange. */
#define PORT_RANGE(name, symbol, index, minimum, maximum, default_value)                           \
  {index, minimum, maximum, default_value},

/** Values of the control inputs by port index; those of other ports are 0. */
typedef struct {
  float value[PORTS_MAX];
} Controls;

/** Read `n_ranges` control inputs: what is out of range is clamped; what is no number or not
 * connected is the default. */
Controls ports_read(void* const ports[PORTS_MAX], const PortRange ranges[], uint32_t n_ranges);

/** Whether two readings are alike. */
bool ports_are_same(const Controls* a, const Controls* b);

/* What a value says */

/** A level in dB as a gain. */
double ports_gain(float level_db);

/** 0 at its minimum: what is not there is not computed. */
double ports_above(float value, float minimum);

/** The nearest whole number of a value ≥ 0. */
uint32_t ports_whole(float value);

#endif
