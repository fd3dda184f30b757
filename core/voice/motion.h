/**
   Where the pitch of a voice is going: slides, bends and vibrato.

   Each is a line, and the pitch follows it in pieces of a few dozen frames, in each of which the
   string's coefficients move in a straight line.  A vibrato swings in frequency, f (1 + δ sin 2πφ),
   so that its mean over a whole swing is f itself; it goes
   down by an octave at most.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_MOTION_H
#define HOOKE_CORE_VOICE_MOTION_H

#include "core/base/line.h"

#include <stdbool.h>
#include <stdint.h>

/** Longest piece in which a pitch moves in a straight line [frames]. */
enum { MOTION_PIECE_FRAMES = 64 };

/** Zero is a note that stands still where it is. */
typedef struct {
  Line slide;   /**< Above the note that it is played as [semitones] */
  Line bend;    /**< And above that [semitones] */
  Line depth;   /**< Of the vibrato, to the sharp side, ≥ 0 [semitones] */
  double rate;  /**< Of the vibrato [cycles per frame] */
  double phase; /**< Of the vibrato, 0 to 1 */
} VoiceMotion;

/** Whether there is a vibrato, or one is on its way. */
bool motion_swings(const VoiceMotion* motion);

/** Whether nothing moves. */
bool motion_is_still(const VoiceMotion* motion);

/** Frames of its next piece, which ends where one of its lines does, and is no longer than
 * MOTION_PIECE_FRAMES. */
uint32_t motion_piece(const VoiceMotion* motion);

/** Go on by `n_frames`. */
void motion_go(VoiceMotion* motion, uint32_t n_frames);

/** How far the vibrato is from the middle of its swing [semitones]. */
double motion_swing(const VoiceMotion* motion);

/** How far it is bent, by the bend and the vibrato [semitones]. */
double motion_bend(const VoiceMotion* motion);

#endif
