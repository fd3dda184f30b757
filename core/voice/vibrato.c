#include "core/voice/vibrato.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

void vibrato_to(Vibrato* vibrato, double depth, uint32_t n_frames) {
  vibrato->goal = depth;
  vibrato->n_left = n_frames;
  if (n_frames == 0) {
    vibrato->depth = depth;
  }
}

bool vibrato_is_still(const Vibrato* vibrato) {
  return vibrato->depth == 0.0 && vibrato->n_left == 0;
}

void vibrato_go(Vibrato* vibrato, double rate, uint32_t n_frames) {
  if (n_frames < vibrato->n_left) {
    vibrato->depth += (vibrato->goal - vibrato->depth) * n_frames / vibrato->n_left;
    vibrato->n_left -= n_frames;
  } else {
    vibrato->depth = vibrato->goal;
    vibrato->n_left = 0;
  }
  vibrato->phase += rate * n_frames;
  vibrato->phase = vibrato_is_still(vibrato) ? 0.0 : vibrato->phase - floor(vibrato->phase);
}

double vibrato_semitones(const Vibrato* vibrato) {
  const double share = exp2(vibrato->depth / 12.0) - 1.0;
  return 12.0 * log2(1.0 + share * sin(2.0 * PI * vibrato->phase));
}
