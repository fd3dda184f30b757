/**
   Where the pitch of a fretted string is going: slides, bends and vibrato.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_GUITAR_GUITAR_MOTION_H
#define HOOKE_CORE_GUITAR_GUITAR_MOTION_H

#include <stdbool.h>
#include <stdint.h>

/** Longest piece in which a pitch moves in a straight line [frames]. */
enum { GUITAR_PIECE_FRAMES = 64 };

/** A value on its way; zero stands still at 0. */
typedef struct {
  double value;
  double goal;
  uint32_t n_left; /**< Frames until it is there */
} GuitarLine;

/** Zero is an open string that nobody bends. */
typedef struct {
  GuitarLine fret;  /**< Where it is stopped, from the capo */
  GuitarLine bend;  /**< [semitones] */
  GuitarLine depth; /**< Of the vibrato, to either side [semitones] */
  double rate;      /**< Of the vibrato [cycles per frame] */
  double phase;     /**< Of the vibrato, 0 to 1 */
} GuitarMotion;

/** Go to `goal` in `n_frames`; 0: at once. */
void guitar_line_to(GuitarLine* line, double goal, uint32_t n_frames);

/** Whether it stands still. */
bool guitar_motion_is_still(const GuitarMotion* motion);

/** Frames of its next piece, which ends where one of its lines does, and is no longer than
 * GUITAR_PIECE_FRAMES. */
uint32_t guitar_motion_piece(const GuitarMotion* motion);

/** Go on by `n_frames`, at most a piece. */
void guitar_motion_go(GuitarMotion* motion, uint32_t n_frames);

/** How far it is bent, by hand and by vibrato [semitones]. */
double guitar_motion_bend(const GuitarMotion* motion);

#endif
