#include "plugin/port_request.h"

#include <stddef.h>

void port_request_move(const PortRequest* request,
                       void* const ports[],
                       uint32_t n_ports,
                       const uint32_t indices[],
                       const float values[]) {
  for (uint32_t i = 0; request && i < n_ports; ++i) {
    const float* const held = ports[indices[i]];
    if (held && *held != values[i]) {
      (void)request->request_change(request->handle, indices[i], values[i]);
    }
  }
}
