#include "tools/host/host_render.h"

#include "tools/host/host_impl.h"

#include <string.h>

static bool queue_block(
    Host* host, const HostEvent* events, size_t n_events, uint64_t from, uint64_t to, size_t* i) {
  for (; *i < n_events && events[*i].frame < to; ++*i) {
    const HostEvent* const event = &events[*i];
    const uint64_t frame = event->frame > from ? event->frame - from : 0;
    if (!host_midi(host, (uint32_t)frame, event->bytes, event->size)) {
      return false;
    }
  }
  return true;
}

bool host_render(Host* host,
                 const HostEvent* events,
                 size_t n_events,
                 uint64_t n_frames,
                 uint32_t block,
                 float* left,
                 float* right) {
  const uint32_t n_outputs = host_n_outputs(host);
  if (block == 0 || block > host->max_block || n_outputs == 0) {
    return host_fail(host, "block of %u frames, %u audio outputs: expected 1 to %u, and 1 or more",
                     block, n_outputs, host->max_block);
  }
  size_t i = 0;
  for (uint64_t at = 0; at < n_frames;) {
    const uint64_t left_over = n_frames - at;
    const uint32_t n = left_over < block ? (uint32_t)left_over : block;
    if (!queue_block(host, events, n_events, at, at + n, &i) || !host_run(host, n)) {
      return false;
    }
    if (left) {
      memcpy(left + at, host_output(host, 0), n * sizeof(float));
    }
    if (right) {
      memcpy(right + at, host_output(host, n_outputs > 1 ? 1 : 0), n * sizeof(float));
    }
    at += n;
  }
  return true;
}
