/**
   A whole piece through a host in one call.
*/
#ifndef HOOKE_TOOLS_HOST_HOST_RENDER_H
#define HOOKE_TOOLS_HOST_HOST_RENDER_H

#include "tools/host/host.h"

/** A MIDI message at its frame. */
typedef struct {
  uint64_t frame;       ///< From the start [frames]
  uint32_t size;        ///< [bytes]
  const uint8_t* bytes; ///< The message
} HostEvent;

/**
   Run a host for `n_frames` in blocks, with `events` on their frames.

   @param events      In order of frames; those at n_frames or later are not sent
   @param block       Frames in a run, the last may have fewer [frames], 1 … max_block of the host
   @param[out] left   n_frames of the first audio output, or NULL
   @param[out] right  n_frames of the second audio output, of the first if there is one alone, or
   NULL
   @return false if the host has no audio output, `block` is out of range, or a run fails;
   host_error() says which.
*/
bool host_render(Host* host,
                 const HostEvent* events,
                 size_t n_events,
                 uint64_t n_frames,
                 uint32_t block,
                 float* left,
                 float* right);

#endif
