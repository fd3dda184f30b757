/**
   The inside of a host, for the host_*.c files alone.
*/
#ifndef HOOKE_TOOLS_HOST_HOST_IMPL_H
#define HOOKE_TOOLS_HOST_HOST_IMPL_H

#include "tools/host/host.h"
#include "tools/host/host_events.h"
#include "tools/host/host_features.h"
#include "tools/host/host_ports.h"
#include "tools/host/host_worker.h"

/** A preset as found in the world. */
typedef struct {
  char* uri;
  char* label;
} HostPreset;

struct Host {
  /* The plugin */
  LilvWorld* world;
  const LilvPlugin* plugin;
  LilvInstance* instance;
  bool is_active;
  uint32_t max_block;

  /* What it is given */
  HostFeatures features;
  HostWorker worker;
  HostPorts ports;
  HostEvents events;
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

/** @return A port by symbol if it is of that type, or NULL. */
HostPort* host_find_port(const Host* host, const char* symbol, HostPortType type);

/** Free what host_presets.c has read. */
void host_clear_presets(Host* host);

#endif
