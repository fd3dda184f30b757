/** The ports of Hooke Strings, in one list.  ttl/strings.ttl says the same, and a test holds it to
 * that. */
#ifndef HOOKE_PLUGIN_STRINGS_PORTS_H
#define HOOKE_PLUGIN_STRINGS_PORTS_H

#include "core/harp/harp_patch.h"
#include "plugin/ports.h"

/**
   X(NAME, symbol, index): ports that are not control inputs.  Hosts store automation by index and
   values by symbol: ports are appended, never moved, renamed or removed.
*/
#define STRINGS_STREAM_PORTS(X)                                                                    \
  COMMON_STREAM_PORTS(X)                                                                           \
  X(SOUNDING, sounding, 18)                                                                        \
  X(MASS_COUNT, mass_count, 19)                                                                    \
  X(HEADROOM, headroom, 20)                                                                        \
  X(STABILITY_USED, stability_used, 27)

/** X(NAME, symbol, index, minimum, maximum, default): control inputs. */
#define STRINGS_CONTROL_PORTS(X)                                                                   \
  COMMON_CONTROL_PORTS(X)                                                                          \
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
  X(PARTIALS, partials, 21, 0.0f, 2.0f, 2.0f)                                                      \
  X(EXCITER, exciter, 22, 0.0f, 2.0f, 0.0f)                                                        \
  X(SENSE, sense, 23, 0.0f, 2.0f, 1.0f)                                                            \
  X(LIMITER, limiter, 24, 0.0f, 1.0f, 1.0f)                                                        \
  X(RESONANCE, resonance, 25, 0.0f, 1.0f, 0.0f)                                                    \
  X(VIBRATO_RATE, vibrato_rate, 26, 0.5f, 12.0f, 5.5f)                                             \
  X(LOSS_TRACKING, loss_tracking, 28, -2.0f, 4.0f, 0.0f)                                           \
  X(STIFFNESS_TRACKING, stiffness_tracking, 29, 0.0f, 4.0f, 0.0f)                                  \
  X(RELEASE_TRACKING, release_tracking, 30, 0.0f, 2.0f, 0.0f)                                      \
  X(TENSION, tension, 31, 0.0f, 100.0f, 0.0f)                                                      \
  X(VARIATION, variation, 32, 0.0f, 1.0f, 0.0f)                                                    \
  X(TAKE, take, 33, 1.0f, 999.0f, 1.0f)                                                            \
  X(NOISE, noise, 34, 0.0f, 1.0f, 0.0f)                                                            \
  X(UNISONS, unisons, 35, 1.0f, 3.0f, 1.0f)                                                        \
  X(UNISON_DETUNE, unison_detune, 36, 0.0f, 20.0f, 2.0f)                                           \
  X(SECOND, second, 37, 0.0f, 1.0f, 0.0f)                                                          \
  X(SECOND_DETUNE, second_detune, 38, 0.0f, 30.0f, 5.0f)                                           \
  X(SECOND_DECAY, second_decay, 39, 0.25f, 4.0f, 1.0f)                                             \
  X(BODY, body, 40, 0.0f, 12.0f, 0.0f)                                                             \
  X(BODY_MIX, body_mix, 41, 0.0f, 1.0f, 0.7f)                                                      \
  X(BODY_SIZE, body_size, 42, 0.5f, 2.0f, 1.0f)                                                    \
  X(BODY_DAMPING, body_damping, 43, 0.25f, 4.0f, 1.0f)                                             \
  X(KNOCK, knock, 44, 0.0f, 1.0f, 0.0f)

#define STREAM_ENUM(name, symbol, index) STRINGS_PORT_##name = (index),
#define CONTROL_ENUM(name, symbol, index, minimum, maximum, default_value)                         \
  STRINGS_PORT_##name = (index),
enum { STRINGS_STREAM_PORTS(STREAM_ENUM) STRINGS_CONTROL_PORTS(CONTROL_ENUM) STRINGS_N_PORTS = 45 };
#undef STREAM_ENUM
#undef CONTROL_ENUM

/** Read the control inputs, see ports_read(). */
Controls strings_ports_read(void* const ports[PORTS_MAX]);

/** What the controls say, as a patch for the harp. */
HarpPatch strings_ports_patch(const Controls* controls);

/** The patch of the ports as they come: the one place where its numbers are. */
HarpPatch strings_ports_usual(void);

#endif
