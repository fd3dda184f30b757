/**
   How one string is tied to the bridge (core/voice/bridge.h) while it is retuned, and while the
   bridge is put to it or taken away: the tie glides in straight lines, as the string's coefficients
   do.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_TIE_H
#define HOOKE_CORE_VOICE_TIE_H

#include "core/voice/bridge.h"
#include "core/voice/voice.h"

#include <stdbool.h>
#include <stdint.h>

/** Zero is no tie. */
typedef struct {
  BridgeTie now;
  BridgeTie change; /**< Per frame, while it glides */
  BridgeTie goal;
  uint32_t n_gliding; /**< Frames until it is there; 0 when it stands still */
  uint32_t n_masses;  /**< Of the string that it was made for */
  BridgeHold hold;    /**< What `goal` was made with */
  BridgeShift shift;  /**< What the bridge did to the string when it was last tuned */
} Tie;

/** Whether the bridge and the string know of each other. */
bool tie_is_on(const Tie* tie);

/**
   Retune a voice that is awake, as voice_retune(), such that it is in tune once it is tied with
   `hold` and the glide is over.

   @return as voice_retune(); on failure the tie is as it was
*/
bool tie_retune(Tie* tie,
                const Bridge* bridge,
                Voice* voice,
                const TuningTarget* target,
                BridgeHold hold,
                uint32_t n_glide);

/** The chain has set out for other coefficients, by a few cents: so does the tie. */
void tie_follow(Tie* tie, const Chain* chain);

/** Begin anew with no tie, and have it in `n_frames`. */
void tie_renew(Tie* tie, uint32_t n_frames);

/** Go on by one frame. */
static inline void tie_advance(Tie* tie) {
  if (tie->n_gliding > 0) {
    const BridgeTie change = tie->change;
    tie->now.pull += change.pull;
    tie->now.spring += change.spring;
    tie->now.load += change.load;
    if (--tie->n_gliding == 0) {
      tie->now = tie->goal;
    }
  }
}

#endif
