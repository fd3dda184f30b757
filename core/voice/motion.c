#include "core/voice/motion.h"

#include "core/base/maths.h"

/* Of the frequency, that the widest swing leaves. */
static const double LEAST_SHARE = 0.5;

static uint32_t sooner(uint32_t n, const Line* line) {
  return line->n_left > 0 ? least(n, line->n_left) : n;
}

bool motion_swings(const VoiceMotion* motion) {
  return motion->depth.value != 0.0 || motion->depth.n_left > 0;
}

bool motion_is_still(const VoiceMotion* motion) {
  return motion->slide.n_left == 0 && motion->bend.n_left == 0 && !motion_swings(motion);
}

uint32_t motion_piece(const VoiceMotion* motion) {
  return sooner(sooner(sooner(MOTION_PIECE_FRAMES, &motion->slide), &motion->bend), &motion->depth);
}

void motion_go(VoiceMotion* motion, uint32_t n_frames) {
  line_skip(&motion->slide, n_frames);
  line_skip(&motion->bend, n_frames);
  line_skip(&motion->depth, n_frames);
  motion->phase += motion->rate * n_frames;
  motion->phase = motion_swings(motion) ? motion->phase - floor(motion->phase) : 0.0;
}

double motion_swing(const VoiceMotion* motion) {
  const double share = exp2(motion->depth.value / 12.0) - 1.0;
  return 12.0 * log2(fmax(LEAST_SHARE, 1.0 + share * sin(2.0 * PI * motion->phase)));
}

double motion_bend(const VoiceMotion* motion) {
  return motion->bend.value + motion_swing(motion);
}
