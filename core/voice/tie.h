/**
   How one string is tied to the bridge (core/voice/bridge.h) while it is retuned, and while the
   bridge is put to it or taken away: the tie glides in straight lines, as the string's coefficients
   do.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_TIE_H
#define HOOKE_CORE_VOICE_TIE_H

#include "core/base/line.h"
#include "core/string/chain.h"
#include "core/voice/bridge.h"

#include <stdbool.h>
#include <stdint.h>

/** Zero is no tie. */
typedef struct {
  Line pull; /**< As of a BridgeTie; the three move together */
  Line spring;
  Line load;
  double weight;
  uint32_t n_masses; /**< Of the string that it was made for */
  BridgeHold hold;   /**< What it goes to was made with */
  BridgeShift shift; /**< What the bridge did to the string when it was last tuned */
} Tie;

/** Frames until it stands still. */
static inline uint32_t tie_stretch(const Tie* tie) {
  return tie->pull.n_left;
}

/** Whether the bridge and the string know of each other. */
bool tie_is_on(const Tie* tie);

/** Whether a hold is one at all. */
static inline bool tie_is_wanted(BridgeHold hold) {
  return hold.mass * hold.lever > 0.0;
}

/** The string may have other masses than the tie was made for: tie those, at once, for they moved
 * at once too. */
void tie_take_masses(Tie* tie, const Bridge* bridge, const Chain* chain);

/** The chain has set out, in `n_glide` frames, for the coefficients that suit `hold`: so does the
 * tie. */
void tie_glide(
    Tie* tie, const Bridge* bridge, const Chain* chain, BridgeHold hold, uint32_t n_glide);

/** The chain has set out for other coefficients, by a few cents: so does the tie. */
void tie_follow(Tie* tie, const Bridge* bridge, const Chain* chain);

/** Begin anew with no tie, and have it in `n_frames`. */
void tie_renew(Tie* tie, uint32_t n_frames);

/** Go on by one frame. */
static inline void tie_advance(Tie* tie) {
  (void)line_next(&tie->pull);
  (void)line_next(&tie->spring);
  (void)line_next(&tie->load);
}

#endif
