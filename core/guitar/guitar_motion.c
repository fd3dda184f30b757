#include "core/guitar/guitar_motion.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

static uint32_t sooner(uint32_t n, const GuitarLine* line) {
  return line->n_left > 0 && line->n_left < n ? line->n_left : n;
}

static void line_go(GuitarLine* line, uint32_t n_frames) {
  if (n_frames < line->n_left) {
    line->value += (line->goal - line->value) * n_frames / line->n_left;
    line->n_left -= n_frames;
  } else {
    line->value = line->goal;
    line->n_left = 0;
  }
}

void guitar_line_to(GuitarLine* line, double goal, uint32_t n_frames) {
  line->goal = goal;
  line->n_left = n_frames;
  if (n_frames == 0) {
    line->value = goal;
  }
}

static bool has_vibrato(const GuitarMotion* motion) {
  return motion->depth.value != 0.0 || motion->depth.n_left > 0;
}

bool guitar_motion_is_still(const GuitarMotion* motion) {
  return motion->fret.n_left == 0 && motion->bend.n_left == 0 && !has_vibrato(motion);
}

uint32_t guitar_motion_piece(const GuitarMotion* motion) {
  return sooner(sooner(sooner(GUITAR_PIECE_FRAMES, &motion->fret), &motion->bend), &motion->depth);
}

void guitar_motion_go(GuitarMotion* motion, uint32_t n_frames) {
  line_go(&motion->fret, n_frames);
  line_go(&motion->bend, n_frames);
  line_go(&motion->depth, n_frames);
  motion->phase += motion->rate * n_frames;
  motion->phase = has_vibrato(motion) ? motion->phase - floor(motion->phase) : 0.0;
}

double guitar_motion_bend(const GuitarMotion* motion) {
  return motion->bend.value + motion->depth.value * sin(2.0 * PI * motion->phase);
}
