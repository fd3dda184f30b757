/** `hooke bench --host URI`: what any LV2 instrument costs, in our offline host. */
#ifndef HOOKE_TOOLS_BENCH_BENCH_HOST_H
#define HOOKE_TOOLS_BENCH_BENCH_HOST_H

#include "tools/host/host.h"

#include <stdbool.h>
#include <stddef.h>

/** host_new() for blocks of 256 frames, with the bundle that belongs to this program first. */
Host* bench_host_open(const char* plugin_uri, double rate_hz, char* error, size_t error_size);

/**
   Hold some notes, more and more of them, and print what a frame costs.

   @param[out] error  One line, on failure
   @return false if there is no such plugin, or it takes no MIDI, or fails
*/
bool bench_host(const char* plugin_uri, bool is_csv, char* error, size_t error_size);

#endif
