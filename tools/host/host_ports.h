/**
   The ports of a hosted plugin and the memory behind them.
*/
#ifndef HOOKE_TOOLS_HOST_HOST_PORTS_H
#define HOOKE_TOOLS_HOST_HOST_PORTS_H

#include "tools/host/host.h"

enum { HOST_GUARD_FRAMES = 8 };

/** What a port carries; CV is audio to the host, but for its place in the count. */
typedef enum {
  HOST_PORT_OTHER,
  HOST_PORT_CONTROL,
  HOST_PORT_AUDIO,
  HOST_PORT_CV,
  HOST_PORT_ATOM
} HostPortType;

/** One port. */
typedef struct {
  HostPortType type;
  bool is_input;
  bool takes_midi;   ///< An atom port for midi:MidiEvent
  char* symbol;      ///< From malloc
  HostRange range;   ///< Of a control port
  float value;       ///< Of a control port: what the plugin is connected to
  float* frames;     ///< Of an audio or CV port: max_block + HOST_GUARD_FRAMES
  LV2_Atom* atom;    ///< Of an atom port
  uint32_t capacity; ///< Of an atom port: bytes behind the atom header
} HostPort;

/** All ports; all zero is a valid, empty set. */
typedef struct {
  HostPort* ports;
  uint32_t n_ports;
  uint32_t freewheel; ///< Index of that port, UINT32_MAX for none
  uint32_t events_in; ///< The atom input that events go to, the same
  uint32_t notify;    ///< The first atom output, the same
} HostPorts;

/** Read the ports of a plugin and allocate for them. @return false when memory is out. */
bool host_ports_init(HostPorts* ports,
                     LilvWorld* world,
                     const LilvPlugin* plugin,
                     uint32_t max_block);

/** @return The memory a port is to be connected to, NULL for a port of unknown kind. */
void* host_port_data(HostPort* port);

/** Make an atom port's buffer `capacity` bytes behind its header. @return false when memory is out,
 * nothing changed. */
bool host_port_resize(HostPort* port, uint32_t capacity);

/** @return The k-th port of that type and direction, or NULL. */
HostPort* host_ports_nth(const HostPorts* ports, HostPortType type, bool is_input, uint32_t k);

/** Free all. */
void host_ports_clear(HostPorts* ports);

#endif
