#include "plugin/outputs.h"

#include <stddef.h>
#include <string.h>

static void write_side(float* to, const float* from, uint32_t n_frames) {
  if (to) {
    memcpy(to, from, n_frames * sizeof(float));
  }
}

void outputs_write(float* to_left,
                   float* to_right,
                   uint32_t at,
                   uint32_t n_frames,
                   const float* left,
                   const float* right) {
  if (to_left && to_left == to_right) {
    for (uint32_t i = 0; i < n_frames; ++i) {
      to_left[at + i] = 0.5f * (left[i] + right[i]);
    }
    return;
  }
  write_side(to_left ? to_left + at : NULL, left, n_frames);
  write_side(to_right ? to_right + at : NULL, right, n_frames);
}
