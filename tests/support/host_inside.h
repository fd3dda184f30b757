/** Looks into a host that the program has no need of. */
#ifndef HOOKE_TESTS_SUPPORT_HOST_INSIDE_H
#define HOOKE_TESTS_SUPPORT_HOST_INSIDE_H

#include "tools/host/host.h"
#include "tools/host/host_worker.h"

#include <lilv/lilv.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** @return What lilv knows of the plugin, and all it knows. */
const LilvPlugin* host_plugin(const Host* host);
LilvWorld* host_world(Host* host);

/** @return The worker: set its mode, read its counts. */
HostWorker* host_worker(Host* host);

/** @return What the plugin sent in the last run through its first atom output; NULL if there is no
 * such port. */
const LV2_Atom_Sequence* host_notify(const Host* host);

/**
   Give the atom outputs another size.

   @param capacity  Bytes that the plugin may write behind the atom header; 8192 at first. An
   allocation of its own.
   @return false when memory is out.
*/
bool host_set_notify_capacity(Host* host, uint32_t capacity);

/** @return The number of ports, and the symbol of one by index (NULL if there is none). */
uint32_t host_n_ports(const Host* host);

const char* host_port_symbol(const Host* host, uint32_t index);

/** @return true if the port is a control input. */
bool host_port_is_control_input(const Host* host, uint32_t index);

/**
   Find a plugin, instantiate it and connect every port: controls hold their defaults, the rest
   buffers of the host's.

   @param plugin_uri       For example "urn:hooke:strings"
   @param rate_hz          Sample rate [Hz], > 0
   @param max_block        Most frames a run may have [frames], > 0
   @param[out] error       One line saying why, on failure; may be NULL
   @param error_size       Room in `error` [bytes]
   @return A host, not yet active, to be freed with host_free(); NULL if the plugin is not found,
   requires a feature that is not offered, or does not instantiate, or when memory is out.
*/
Host* host_new(
    const char* plugin_uri, double rate_hz, uint32_t max_block, char* error, size_t error_size);

#endif
