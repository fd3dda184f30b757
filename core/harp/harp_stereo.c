#include "core/harp/harp_stereo.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool harp_stereo_new(HarpStereo* stereo, double rate_hz) {
  const uint32_t n_delay = (uint32_t)fmax(1.0, round(HARP_STEREO_S * rate_hz));
  *stereo = (HarpStereo){.n_delay = n_delay};
  stereo->past = calloc(2 * n_delay + HARP_STEREO_FRAMES, sizeof(float));
  return stereo->past;
}

void harp_stereo_free(HarpStereo* stereo) {
  free(stereo->past);
  stereo->past = NULL;
}

void harp_stereo_reset(HarpStereo* stereo) {
  memset(stereo->past, 0, (2 * stereo->n_delay + HARP_STEREO_FRAMES) * sizeof(float));
}

void harp_stereo_set(HarpStereo* stereo, double spread, uint32_t n_frames) {
  line_to(&stereo->spread, spread, n_frames);
  line_to(&stereo->late, spread > 0.0 ? 1.0 : 0.0, n_frames);
}

/* What the spread is in a frame. */
typedef struct {
  float late;
  float half; /* ½ s */
} Gains;

static Gains gains_now(HarpStereo* stereo) {
  const float spread = (float)line_next(&stereo->spread);
  return (Gains){(float)line_next(&stereo->late), 0.5f * spread};
}

static void spread_frame(const HarpStereo* stereo, Gains g, uint32_t n, float* left, float* right) {
  const uint32_t d = stereo->n_delay;
  const float* const past = stereo->past + n;
  const float now = past[2 * d];
  const float middle = now + g.late * (past[d] - now);
  const float side = g.half * (now - past[0]);
  left[n] = middle + side;
  right[n] = middle - side;
}

void harp_stereo_run(
    HarpStereo* stereo, const float* read, uint32_t n_frames, float* left, float* right) {
  const uint32_t n_past = 2 * stereo->n_delay;
  memcpy(stereo->past + n_past, read, n_frames * sizeof(float));
  if (stereo->spread.n_left > 0) {
    for (uint32_t n = 0; n < n_frames; ++n) {
      spread_frame(stereo, gains_now(stereo), n, left, right);
    }
  } else if (stereo->spread.value > 0.0) {
    const Gains gains = gains_now(stereo);
    for (uint32_t n = 0; n < n_frames; ++n) {
      spread_frame(stereo, gains, n, left, right);
    }
  } else {
    memmove(left, read, n_frames * sizeof(float));
    memcpy(right, stereo->past + n_past, n_frames * sizeof(float));
  }
  memmove(stereo->past, stereo->past + n_frames, n_past * sizeof(float));
}
