/** The ports of Hooke Strings, in one list.  ttl/strings.ttl says the same, and a test holds it to
 * that. */
#ifndef HOOKE_PLUGIN_PORTS_H
#define HOOKE_PLUGIN_PORTS_H

#include "core/patch.h"

#include <stdint.h>

/**
   X(NAME, symbol, index): ports that are not control inputs.  Hosts store automation by index and
   values by symbol: ports are appended, never moved, renamed or removed.
*/
#define STREAM_PORTS(X)                                                                            \
  X(CONTROL, control, 0)                                                                           \
  X(NOTIFY, notify, 1)                                                                             \
  X(OUT_LEFT, out_left, 2)                                                                         \
  X(OUT_RIGHT, out_right, 3)                                                                       \
  X(SOUNDING, sounding, 18)                                                                        \
  X(MASS_COUNT, mass_count, 19)                                                                    \
  X(HEADROOM, headroom, 20)

/** X(NAME, symbol, index, minimum, maximum, default): control inputs. */
#define CONTROL_PORTS(X)                                                                           \
  X(ENABLED, enabled, 4, 0.0f, 1.0f, 1.0f)                                                         \
  X(FREEWHEEL, freewheel, 5, 0.0f, 1.0f, 0.0f)                                                     \
  X(LEVEL, level, 6, -60.0f, 12.0f, 0.0f)                                                          \
  X(DAMPING, damping, 7, 0.02f, 200.0f, 0.6f)                                                      \
  X(TRACKING, tracking, 8, 0.0f, 1.0f, 0.5f)                                                       \
  X(LOSS, loss, 9, 1e-5f, 1.0f, 0.01f)                                                             \
  X(STIFFNESS, stiffness, 10, 1e-6f, 0.1f, 1e-6f)                                                  \
  X(PICKUP, pickup, 11, 0.0f, 1.0f, 0.2f)                                                          \
  X(SPREAD, spread, 12, 0.0f, 0.5f, 0.1f)                                                          \
  X(PLUCK, pluck, 13, 0.0f, 1.0f, 0.13f)                                                           \
  X(HARDNESS, hardness, 14, 0.0f, 1.0f, 0.5f)                                                      \
  X(MASSES, masses, 15, 1.0f, 1024.0f, 128.0f)                                                     \
  X(RELEASE, release, 16, 0.005f, 10.0f, 0.1f)                                                     \
  X(TUNING, tuning, 17, 400.0f, 480.0f, 440.0f)                                                    \
  X(PARTIALS, partials, 21, 0.0f, 2.0f, 2.0f)

#define STREAM_ENUM(name, symbol, index) PORT_##name = (index),
#define CONTROL_ENUM(name, symbol, index, minimum, maximum, default_value) PORT_##name = (index),
enum { STREAM_PORTS(STREAM_ENUM) CONTROL_PORTS(CONTROL_ENUM) N_PORTS = 22 };
#undef STREAM_ENUM
#undef CONTROL_ENUM

/** Values of the control inputs by port index; those of other ports are unused. */
typedef struct {
  float value[N_PORTS];
} Controls;

/** Read the control inputs: what is out of range is clamped; what is no number or not connected is
 * the default. */
Controls ports_read(void* const ports[N_PORTS]);

/** Whether two readings are alike. */
_Bool ports_are_same(const Controls* a, const Controls* b);

/** What the controls say, as a patch for the harp. */
Patch ports_patch(const Controls* controls);

#endif
