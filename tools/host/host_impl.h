/**
   The inside of a host, for the host*.c files alone.
*/
#ifndef HOOKE_TOOLS_HOST_HOST_IMPL_H
#define HOOKE_TOOLS_HOST_HOST_IMPL_H

#include "tools/formats/bytes.h"
#include "tools/host/host.h"
#include "tools/host/host_worker.h"

#include <lv2/core/lv2.h>
#include <lv2/log/log.h>
#include <lv2/options/options.h>

enum { HOST_N_FEATURES = 7, HOST_N_OPTIONS = 5, HOST_GUARD_FRAMES = 8 };

/** What a port carries; CV is audio to the host, but for its place in the count. */
typedef enum {
  HOST_PORT_OTHER,
  HOST_PORT_CONTROL,
  HOST_PORT_AUDIO,
  HOST_PORT_CV,
  HOST_PORT_ATOM
} HostPortType;

typedef struct {
  HostPortType type;
  bool is_input;
  bool takes_midi;     /**< An atom port for midi:MidiEvent */
  char* symbol;        /**< From malloc */
  HostRange range;     /**< Of a control port */
  char* unit;          /**< Of a control port, from malloc; NULL: none */
  HostChoice* choices; /**< Of a control port, labels from malloc */
  uint32_t n_choices;
  float value;       /**< Of a control port: what the plugin is connected to */
  float* frames;     /**< Of an audio or CV port: max_block + HOST_GUARD_FRAMES */
  LV2_Atom* atom;    /**< Of an atom port */
  uint32_t capacity; /**< Of an atom port: bytes behind the atom header */
} HostPort;

/** A waiting event. */
typedef struct {
  int64_t frame;  /**< From the start of the next run */
  LV2_URID type;  /**< What the body is */
  uint32_t size;  /**< Bytes of body */
  size_t body_at; /**< Where the body is in Host.bodies */
  bool is_raw;    /**< Goes out with the next run, whatever its frame */
} HostQueued;

/** A preset as found in the world. */
typedef struct {
  char* uri;
  char* label;
} HostPreset;

/** It must not move: features point into it. */
struct Host {
  /* The plugin */
  LilvWorld* world;
  const LilvPlugin* plugin;
  LilvInstance* instance;
  bool is_active;
  int32_t min_block;
  int32_t max_block;
  float rate_hz;

  /* What it is offered */
  Bytes uris; /**< char* each: the URI numbered 1, 2, … */
  bool is_silent;
  HostWorker worker;
  LV2_URID_Map map;
  LV2_URID_Unmap unmap;
  LV2_Log_Log log;
  LV2_Worker_Schedule schedule;
  LV2_Options_Option options[HOST_N_OPTIONS]; /**< The last is all zero, as the extension wants */
  LV2_Feature features[HOST_N_FEATURES];
  const LV2_Feature* offered[HOST_N_FEATURES + 1]; /**< At instantiate(), NULL-terminated */
  /* Its ports and what goes through them */
  HostPort* ports;
  uint32_t n_ports;
  uint32_t events_in; /**< Index of the atom input that events go to, UINT32_MAX for none */
  uint32_t notify;    /**< The first atom output, the same */
  Bytes queue;        /**< HostQueued each, in order of frames, raw ones last */
  Bytes bodies;       /**< Of the events */
  LV2_URID sequence_type;
  LV2_URID chunk_type;

  /* What is known of its presets */
  HostPreset* presets;
  uint32_t n_presets;
  bool has_presets;

  char error[256];
};

/** Set host_error(). @return false, so that a caller may return it. */
__attribute__((format(printf, 2, 3))) bool host_fail(Host* host, const char* format, ...);

/** Queue an event; a raw one goes out with the next run, of no frames too.  @return false when
 * memory is out or no port takes events. */
bool host_queue(
    Host* host, int64_t frame, LV2_URID type, const void* body, uint32_t size, bool is_raw);

/** Read the plugin's ports and allocate for them. @return false when memory is out. */
bool host_make_ports(Host* host);

/** Read the unit and the choices of a control port. @return false when memory is out. */
bool host_read_choices(Host* host, HostPort* self, const LilvPort* port);

/** Free them. */
void host_clear_choices(HostPort* self);

/** @return A port by symbol if it is of that type, or NULL. */
HostPort* host_find_port(const Host* host, const char* symbol, HostPortType type);

/** Make an atom port's buffer `capacity` bytes behind its header. @return false when memory is out,
 * nothing changed. */
bool host_resize_port(HostPort* port, uint32_t capacity);

/** Free the ports. */
void host_clear_ports(Host* host);

/** Free what host_presets.c has read. */
void host_clear_presets(Host* host);

#endif
