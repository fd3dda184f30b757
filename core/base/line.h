/**
   The number that moves: in a straight line to its goal, so that no change is heard as a step.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_BASE_LINE_H
#define HOOKE_CORE_BASE_LINE_H

#include <stdint.h>

/** Zero stands still at 0. */
typedef struct {
  double value;    /**< Now */
  double goal;     /**< Where it ends, exactly */
  double change;   /**< Per frame, while it moves */
  uint32_t n_left; /**< Frames until it is there; 0 when it stands still */
} Line;

/** Stand still at `value`. */
void line_set(Line* line, double value);

/** Move to `goal` in `n_frames`, from wherever it is; 0: at once. */
void line_to(Line* line, double goal, uint32_t n_frames);

/** Go one frame on.  @return Where it is then */
static inline double line_next(Line* line) {
  if (line->n_left > 0) {
    line->value = --line->n_left > 0 ? line->value + line->change : line->goal;
  }
  return line->value;
}

/** Go `n_frames` on at once: as by as many line_next(), but for rounding. */
void line_skip(Line* line, uint32_t n_frames);

/** Its next `n_frames` values. */
void line_fill(Line* line, uint32_t n_frames, float* out);

#endif
