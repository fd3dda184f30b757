#include "core/base/line.h"

void line_set(Line* line, double value) {
  *line = (Line){.value = value, .goal = value};
}

void line_to(Line* line, double goal, uint32_t n_frames) {
  if (n_frames == 0) {
    line_set(line, goal);
    return;
  }
  line->goal = goal;
  line->change = (goal - line->value) / n_frames;
  line->n_left = n_frames;
}

void line_skip(Line* line, uint32_t n_frames) {
  if (n_frames < line->n_left) {
    line->value += (line->goal - line->value) * n_frames / line->n_left;
    line->n_left -= n_frames;
  } else {
    line->value = line->goal;
    line->n_left = 0;
  }
}

void line_fill(Line* line, uint32_t n_frames, float* out) {
  uint32_t n = 0;
  for (; n < n_frames && line->n_left > 0; ++n) {
    out[n] = (float)line_next(line);
  }
  const float still = (float)line->value;
  for (; n < n_frames; ++n) {
    out[n] = still;
  }
}
