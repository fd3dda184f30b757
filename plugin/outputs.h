/**
   Where the host wants both sides of what was heard.

   Thread: audio; real-time safe.
*/
#ifndef HOOKE_PLUGIN_OUTPUTS_H
#define HOOKE_PLUGIN_OUTPUTS_H

#include <stdint.h>

/**
   Copy `n_frames` to what the host has connected, from its frame `at` on.  It may have connected
   neither side, or one buffer to both, which then has their mean.

   @param to_left, to_right  The host's; may be NULL
   @param left, right        What was heard
*/
void outputs_write(float* to_left,
                   float* to_right,
                   uint32_t at,
                   uint32_t n_frames,
                   const float* left,
                   const float* right);

#endif
