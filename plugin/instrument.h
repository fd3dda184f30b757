/**
   What every instrument of the bundle does for its host: ports, events and frames.

   An InstrumentKind says what is its own.  Events split the block: the frames until an event are
   run before it is played.  The ports are read once a block, and so are new pitches of its keys
   and a new body.

   Presets are the host's: program changes and banks are ignored.

   Thread: as LV2 has it; all but instrument_new(), instrument_cleanup() and what the extensions
   lead to is real-time safe.
*/
#ifndef HOOKE_PLUGIN_INSTRUMENT_H
#define HOOKE_PLUGIN_INSTRUMENT_H

#include "core/bank/body.h"
#include "core/play/performance.h"
#include "core/voice/voice.h"
#include "plugin/files_urids.h"
#include "plugin/ports.h"

#include <lv2/core/lv2.h>

#include <stdbool.h>
#include <stdint.h>

enum { INSTRUMENT_FRAMES = 256 /**< Most frames that are run at a time */ };

/** What an instrument does in its own way; `player` is what its `new` made. */
typedef struct {
  uint32_t n_ports; /**< At most PORTS_MAX */
  uint32_t meters;  /**< Index of the first of the three ports that report: strings sounding, their
                       masses and the headroom */
  uint32_t
      stability_used;    /**< Index of the port that reports what of the stability limit is used */
  uint32_t limiter;      /**< Index of the port that turns the limiter on */
  const char* event_uri; /**< Type of the atoms that `play_event` takes; NULL: there are none */

  /** Make a player at rest; NULL if there is no memory or the rate is no rate. */
  void* (*new)(double rate_hz);
  void (*free)(void* player);

  /** Bring it to rest, with nothing held, bent or touched, and no gesture of any channel. */
  void (*reset)(void* player);

  /** Read the control inputs. */
  Controls (*read)(void* const ports[PORTS_MAX]);

  /** Take new values, and get there in `n_frames`, 0: at once. */
  void (*set)(void* player, const Controls* controls, uint32_t n_frames);

  /** What BODIES_FILE is, from the next `set` on; NULL: no body.  It is copied. */
  void (*set_body)(void* player, const Body* body);

  /** How MIDI plays it; asked once. */
  Performance (*perform)(void* player);

  /** Play the body of an atom of type `event_uri`, of any alignment; what makes a string sound is
   * left out if the instrument is muted. */
  void (*play_event)(void* player, const uint8_t* body, uint32_t n_bytes, bool is_muted);

  /** Run at most INSTRUMENT_FRAMES frames. */
  void (*run)(void* player, uint32_t n_frames, float* left, float* right);
  VoiceReport (*report)(const void* player);

  FilesNames files; /**< What it and the files that a player gives it are called */
} InstrumentKind;

/** For instantiate(): NULL if the host offers no urid:map, or `kind` makes no player.  `kind` has
 * to outlive it. */
LV2_Handle
instrument_new(const InstrumentKind* kind, double rate_hz, const LV2_Feature* const* features);

/* The members of an LV2_Descriptor of the same name */

void instrument_connect_port(LV2_Handle handle, uint32_t index, void* data);
void instrument_activate(LV2_Handle handle);
void instrument_run(LV2_Handle handle, uint32_t n_frames);
void instrument_cleanup(LV2_Handle handle);

/** Its state and its work. */
const void* instrument_extension(const char* uri);

#endif
