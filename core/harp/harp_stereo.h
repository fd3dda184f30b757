/**
   Left and right from what one pickup reads.

   Two pickups at two places hear partials in antiphase, which are gone when both are added, and the
   fundamental louder on one side.  So both sides hear one pickup, and what tells them apart is at a
   right angle to it: with m what was read, d half a millisecond in frames, and s the spread,

       left, right = m(n − d) ± ½ s (m(n) − m(n − 2d)),

   that is m(n − d) times 1 ± i s sin ωd.  So every partial is as loud on the left as on the right,
   leads on one side or on the other by turns of 1/(2d) Hz, and the mean of both is what was read, a
   little later: it has lost 10 log (1 + s² sin² ωd) dB, at most 0.97 dB at s = ½.

   Without spread nothing is late, and nothing is done but to keep what was read.

   Thread: one at a time; real-time safe but for harp_stereo_new() and harp_stereo_free().
*/
#ifndef HOOKE_CORE_HARP_HARP_STEREO_H
#define HOOKE_CORE_HARP_HARP_STEREO_H

#include "core/base/line.h"

#include <stdbool.h>
#include <stdint.h>

/** d [s]. */
#define HARP_STEREO_S 0.0005

enum { HARP_STEREO_FRAMES = 256 /**< Most at a time */ };

typedef struct {
  float* past;      /**< The last 2d frames, and room for those of a run; owned */
  uint32_t n_delay; /**< d [frames] */
  Line spread;      /**< s, 0 to 0.5 */
  Line late;        /**< Share of what is heard that is late: 0 without spread, else 1 */
} HarpStereo;

/** False if there is no memory. */
bool harp_stereo_new(HarpStereo* stereo, double rate_hz);

/** Free what it owns. */
void harp_stereo_free(HarpStereo* stereo);

/** Forget what was read. */
void harp_stereo_reset(HarpStereo* stereo);

/** Bring it to a spread in `n_frames`; 0: at once. */
void harp_stereo_set(HarpStereo* stereo, double spread, uint32_t n_frames);

/** @param read  n_frames ≤ HARP_STEREO_FRAMES of what was read; may be `left` */
void harp_stereo_run(
    HarpStereo* stereo, const float* read, uint32_t n_frames, float* left, float* right);

#endif
