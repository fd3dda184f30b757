/**
   The LV2 feature by which a plugin asks its host to move the plugin's own control inputs, as
   KXStudio's extension has it.  A host that offers it may still decline, for it may automate the
   port.

   Thread: the request is made within run().
*/
#ifndef HOOKE_PLUGIN_PORT_REQUEST_H
#define HOOKE_PLUGIN_PORT_REQUEST_H

#include <stdint.h>

#define PORT_REQUEST_URI "http://kx.studio/ns/lv2ext/control-input-port-change-request"

/** What a host answers. */
typedef enum {
  PORT_REQUEST_SUCCESS = 0,
  PORT_REQUEST_UNKNOWN = 1,
  PORT_REQUEST_BAD_INDEX = 2,
} PortRequestStatus;

/** The feature's data. */
typedef struct {
  void* handle; /**< The host's, and the first argument */
  PortRequestStatus (*request_change)(void* handle, uint32_t port, float value);
} PortRequest;

/**
   Ask the host to move those ports that are elsewhere.

   @param request  NULL: it offers nothing, and nothing is asked
   @param ports    What all ports are connected to
   @param indices  `n_ports` control inputs
   @param values   And where they are to go
*/
void port_request_move(const PortRequest* request,
                       void* const ports[],
                       uint32_t n_ports,
                       const uint32_t indices[],
                       const float values[]);

#endif
