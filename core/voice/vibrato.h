/**
   A pitch that swings about its place.

   It swings in frequency, f (1 + δ sin 2πφ), so that its mean over a whole swing is f itself.  Its
   depth moves in straight lines.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_VIBRATO_H
#define HOOKE_CORE_VOICE_VIBRATO_H

#include <stdbool.h>
#include <stdint.h>

/** Longest piece of a swing that a string may take in a straight line [frames]. */
enum { VIBRATO_PIECE_FRAMES = 64 };

/** Zero is none. */
typedef struct {
  double depth;    /**< δ now, to the sharp side [semitones] */
  double goal;     /**< Where it is going */
  uint32_t n_left; /**< Frames until it is there */
  double phase;    /**< φ, 0 to 1 */
} Vibrato;

/** Go to a depth [semitones], ≥ 0, in `n_frames`; 0: at once. */
void vibrato_to(Vibrato* vibrato, double depth, uint32_t n_frames);

/** Whether there is none. */
bool vibrato_is_still(const Vibrato* vibrato);

/** Go on by `n_frames`.  @param rate  Swings per frame */
void vibrato_go(Vibrato* vibrato, double rate, uint32_t n_frames);

/** How far from its place the pitch is [semitones]. */
double vibrato_semitones(const Vibrato* vibrato);

#endif
