/** The ports of Hooke Guitar, in one list.  ttl/guitar.ttl says the same, and a test holds it to
 * that. */
#ifndef HOOKE_PLUGIN_GUITAR_PORTS_H
#define HOOKE_PLUGIN_GUITAR_PORTS_H

#include "core/guitar/guitar_patch.h"
#include "core/guitar/guitarist.h"
#include "plugin/ports.h"

/**
   X(NAME, symbol, index): ports that are not control inputs.  Hosts store automation by index and
   values by symbol: ports are appended, never moved, renamed or removed.
*/
#define GUITAR_STREAM_PORTS(X)                                                                     \
  COMMON_STREAM_PORTS(X)                                                                           \
  X(SOUNDING, sounding, 34)                                                                        \
  X(MASS_COUNT, mass_count, 35)                                                                    \
  X(HEADROOM, headroom, 36)                                                                        \
  X(STABILITY_USED, stability_used, 38)

/** X(NAME, symbol, index, minimum, maximum, default): control inputs. */
#define GUITAR_CONTROL_PORTS(X)                                                                    \
  COMMON_CONTROL_PORTS(X)                                                                          \
  X(LEVEL, level, 6, -60.0f, 12.0f, 0.0f)                                                          \
  X(DAMPING, damping, 7, 0.02f, 200.0f, 0.6f)                                                      \
  X(TRACKING, tracking, 8, 0.0f, 1.0f, 0.5f)                                                       \
  X(LOSS, loss, 9, 1e-5f, 1.0f, 0.01f)                                                             \
  X(STIFFNESS, stiffness, 10, 1e-6f, 0.1f, 1e-6f)                                                  \
  X(PICKUP, pickup, 11, 0.02f, 0.5f, 0.08f)                                                        \
  X(PICKUP2, pickup2, 12, 0.02f, 0.5f, 0.24f)                                                      \
  X(BLEND, blend, 13, 0.0f, 1.0f, 0.5f)                                                            \
  X(WIDTH, width, 14, 0.0f, 1.0f, 0.15f)                                                           \
  X(PLUCK, pluck, 15, 0.02f, 0.5f, 0.13f)                                                          \
  X(HARDNESS, hardness, 16, 0.0f, 1.0f, 0.6f)                                                      \
  X(MASSES, masses, 17, 1.0f, 256.0f, 80.0f)                                                       \
  X(PARTIALS, partials, 18, 0.0f, 2.0f, 2.0f)                                                      \
  X(RELEASE, release, 19, 0.005f, 10.0f, 0.1f)                                                     \
  X(TUNING, tuning, 20, 400.0f, 480.0f, 440.0f)                                                    \
  X(STRING1, string1, 21, 12.0f, 88.0f, 64.0f)                                                     \
  X(STRING2, string2, 22, 12.0f, 88.0f, 59.0f)                                                     \
  X(STRING3, string3, 23, 12.0f, 88.0f, 55.0f)                                                     \
  X(STRING4, string4, 24, 12.0f, 88.0f, 50.0f)                                                     \
  X(STRING5, string5, 25, 12.0f, 88.0f, 45.0f)                                                     \
  X(STRING6, string6, 26, 12.0f, 88.0f, 40.0f)                                                     \
  X(CAPO, capo, 27, 0.0f, 12.0f, 0.0f)                                                             \
  X(PALM, palm, 28, 0.0f, 1.0f, 0.0f)                                                              \
  X(STRUM, strum, 29, 0.0f, 100.0f, 0.0f)                                                          \
  X(MODE, mode, 30, 0.0f, 1.0f, 0.0f)                                                              \
  X(LEGATO, legato, 31, 0.0f, 127.0f, 40.0f)                                                       \
  X(HARMONIC, harmonic, 32, 0.0f, 3.0f, 0.0f)                                                      \
  X(COURSE, course, 33, 0.0f, 1.0f, 0.0f)                                                          \
  X(LIMITER, limiter, 37, 0.0f, 1.0f, 1.0f)                                                        \
  X(LOSS_TRACKING, loss_tracking, 39, -2.0f, 4.0f, 0.0f)                                           \
  X(STIFFNESS_TRACKING, stiffness_tracking, 40, 0.0f, 4.0f, 0.0f)                                  \
  X(RELEASE_TRACKING, release_tracking, 41, 0.0f, 2.0f, 0.0f)                                      \
  X(TENSION, tension, 42, 0.0f, 100.0f, 0.0f)                                                      \
  X(VARIATION, variation, 43, 0.0f, 1.0f, 0.0f)                                                    \
  X(TAKE, take, 44, 1.0f, 999.0f, 1.0f)                                                            \
  X(NOISE, noise, 45, 0.0f, 1.0f, 0.0f)                                                            \
  X(BODY, body, 46, 0.0f, 12.0f, 0.0f)                                                             \
  X(BODY_MIX, body_mix, 47, 0.0f, 1.0f, 0.7f)                                                      \
  X(BODY_SIZE, body_size, 48, 0.5f, 2.0f, 1.0f)                                                    \
  X(BODY_DAMPING, body_damping, 49, 0.25f, 4.0f, 1.0f)                                             \
  X(KNOCK, knock, 50, 0.0f, 1.0f, 0.0f)

#define STREAM_ENUM(name, symbol, index) GUITAR_PORT_##name = (index),
#define CONTROL_ENUM(name, symbol, index, minimum, maximum, default_value)                         \
  GUITAR_PORT_##name = (index),
enum { GUITAR_STREAM_PORTS(STREAM_ENUM) GUITAR_CONTROL_PORTS(CONTROL_ENUM) GUITAR_N_PORTS = 51 };
#undef STREAM_ENUM
#undef CONTROL_ENUM

/** Strings that the ports tell the tuning of. */
enum { GUITAR_PORT_STRINGS = GUITAR_PORT_STRING6 - GUITAR_PORT_STRING1 + 1 };

/** Read the control inputs, see ports_read(). */
Controls guitar_ports_read(void* const ports[PORTS_MAX]);

/** What the controls say, as a patch for the guitar. */
GuitarPatch guitar_ports_patch(const Controls* controls);

/** The patch of the ports as they come. */
GuitarPatch guitar_ports_usual(void);

/** What they say of the guitarist. */
GuitaristHow guitar_ports_how(const Controls* controls);

/** Whether two readings make the same patch. */
bool guitar_ports_are_same_patch(const Controls* a, const Controls* b);

#endif
