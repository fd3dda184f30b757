/**
   A small offline LV2 host: one instance of one plugin, run block by block.

   `hooke render` is built on it, and so are the tests of the plugins.
   One thread at a time for everything here. What fails says so by its value, and host_error() has
   one line for a person. Strings and buffers handed out belong to the host unless said otherwise.
*/
#ifndef HOOKE_TOOLS_HOST_HOST_H
#define HOOKE_TOOLS_HOST_HOST_H

#include "tools/host/host_worker.h"

#include <lilv/lilv.h>
#include <lv2/atom/atom.h>
#include <lv2/urid/urid.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** A host with its plugin. */
typedef struct Host Host;

/** What a host is made with; fields left zero take the default named. */
typedef struct {
  double rate_hz;       /**< Sample rate [Hz], > 0 */
  uint32_t max_block;   /**< Most frames a run may have [frames], > 0 */
  const char* bundle;   /**< Looked in first, and nowhere else if the plugin is there; or NULL */
  const char* lv2_path; /**< Where to look; NULL for LV2_PATH, or LV2's usual places */
  bool is_bare;         /**< Offer urid:map alone, as the poorest host would */
  bool is_silent;       /**< Drop what the plugin logs instead of writing it to stderr */
} HostConfig;

/** What the Turtle says of a control port. */
typedef struct {
  float min;       /**< NAN if not said */
  float max;       /**< NAN if not said */
  float initial;   /**< The default; if not said, what is nearest 0 in the range */
  bool is_integer; /**< lv2:integer, lv2:enumeration or lv2:toggled */
  bool is_choice;  /**< lv2:enumeration */
  bool is_toggle;  /**< lv2:toggled */
} HostRange;

/** A value that has a name: a scale point. */
typedef struct {
  char* label; /**< The host's */
  float value;
} HostChoice;

/* Life cycle */

/** host_new() with every choice. */
Host* host_new_with(const char* plugin_uri,
                    const HostConfig* config,
                    char* error,
                    size_t error_size);

/** Deactivate the plugin if it is active, and free all. NULL is fine. */
void host_free(Host* host);

/** Call the plugin's activate(), unless it is active. */
void host_activate(Host* host);

/** Call the plugin's deactivate(), if it is active. */
void host_deactivate(Host* host);

/**
   Run the plugin, activating it first if need be; queued events are sent, then the worker is
   served.

   Before the run every audio output holds NaN, so that a frame not written shows.
   @param n_frames  [frames], 0 … max_block; more is a failure and nothing is run
   @return false when memory is out, n_frames is too large, or the plugin wrote past an output's
   end.
*/
bool host_run(Host* host, uint32_t n_frames);

/** @return Why the last failing call failed, one line without a newline; empty if none did. */
const char* host_error(const Host* host);

/* Ports, by symbol */

/** @return The port's index, or UINT32_MAX if there is none of that symbol. */
uint32_t host_port_index(const Host* host, const char* symbol);

/** Set a control port, whatever its range. @return false if there is none of that symbol. */
bool host_set(Host* host, const char* symbol, float value);

/** @return What a control port holds, input or output; NAN if there is none of that symbol. */
float host_get(const Host* host, const char* symbol);

/** @return false, and `range` untouched, if `symbol` is not a control input. */
bool host_range(const Host* host, const char* symbol, HostRange* range);

/** @return The symbol of the i-th port; NULL if there are no so many. */
const char* host_symbol(const Host* host, uint32_t i);

/** @return What a control's numbers count, as "Hz"; "" if that is not said. */
const char* host_unit(const Host* host, const char* symbol);

/** @return The values of a control that have names, the least first, and how many they are. */
const HostChoice* host_choices(const Host* host, const char* symbol, uint32_t* n_choices);

/** Set the port designated lv2:freeWheeling. @return false if there is none. */
bool host_set_freewheel(Host* host, bool is_freewheeling);

/** @return Whether a port takes events of that type. */
bool host_takes(Host* host, const char* type_uri);

/** @return What the k-th audio output got in the last run, max_block frames long; NULL if there is
 * none. */
const float* host_output(const Host* host, uint32_t k);

/* Events */

/**
   Queue a MIDI message; the bytes are copied.

   @param frame  From the start of the next run [frames]; one beyond the end of that run stays for a
   later one.
   @return false when memory is out or no port takes MIDI.
*/
bool host_midi(Host* host, uint32_t frame, const uint8_t* bytes, uint32_t size);

/** host_midi() without care: sent last in the next run, at any frame, before the last event or past
 * the block. */
bool host_midi_raw(Host* host, int64_t frame, const uint8_t* bytes, uint32_t size);

/** Queue any atom, as host_midi() does; `body` has `size` bytes of the type `type_uri`. */
bool host_atom(Host* host, uint32_t frame, const char* type_uri, const void* body, uint32_t size);

/**
   Give a parameter of the plugin's that is a file another path, and run no frame, so that the
   worker has read it when the next run begins.

   @return false if the plugin has no such parameter, the path is too long, or memory is out.
*/
bool host_set_file(Host* host, const char* parameter_uri, const char* path);

/** @return The number of a URI; 0 when memory is out. */
LV2_URID host_map(Host* host, const char* uri);

/* Presets */

/** @return How many presets the plugin has; the first call reads them. */
uint32_t host_n_presets(Host* host);

/** @return Label or URI of the k-th preset in order of labels; NULL if there is none. */
const char* host_preset_label(Host* host, uint32_t k);
const char* host_preset_uri(Host* host, uint32_t k);

/**
   Load a preset: port values and state, the worker offered, as hosts do between runs.

   @param name  Its URI or its label; letter case matters only if two labels differ in nothing else.
   @return false if there is none; host_error() says so.
*/
bool host_preset(Host* host, const char* name);

/** @return Whose preset of that name it is, if not this plugin's: the URI of another one, good
 * until the next call; or NULL. */
const char* host_preset_owner(Host* host, const char* name);

/**
   Put a state back between runs: port values and what the plugin keeps.

   @param has_worker  Whether the worker is offered, as when a preset is chosen, or not, as when a
   session is loaded
*/
void host_restore(Host* host, const LilvState* state, bool has_worker);

/* Close to the plugin, for tests that mean harm */

/** @return The instance: lilv_instance_get_handle() and lilv_instance_get_descriptor() lead to the
 * plugin itself. */
LilvInstance* host_instance(Host* host);

/** @return The features that the plugin was instantiated with, NULL-terminated. */
const LV2_Feature* const* host_features(const Host* host);

/** Connect a port to memory of the caller's, or to NULL. */
void host_connect(Host* host, uint32_t port_index, void* data);

/** Connect every port to the host's own memory again. */
void host_reconnect(Host* host);

#endif
