/**
   How one string is tied to the bridge (core/voice/bridge.h) while it is retuned, and while the
   bridge is put to it or taken away: the tie glides in straight lines, as the string's coefficients
   do.

   Thread: one at a time; real-time safe.
*/
#ifndef HOOKE_CORE_VOICE_GRIP_H
#define HOOKE_CORE_VOICE_GRIP_H

#include "core/voice/bridge.h"
#include "core/voice/wire.h"

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
} Grip;

/** Whether the bridge and the string know of each other. */
bool grip_is_on(const Grip* grip);

/**
   Retune a wire that is awake, as wire_retune(), such that it is in tune once it is tied with
   `hold` and the glide is over.

   @return as wire_retune(); on failure the tie is as it was
*/
bool grip_retune(Grip* grip,
                 const Bridge* bridge,
                 Wire* wire,
                 const TuningTarget* target,
                 BridgeHold hold,
                 uint32_t n_glide);

/** The chain has set out for other coefficients, by a few cents: so does the tie. */
void grip_follow(Grip* grip, const Chain* chain);

/** Begin anew with no tie, and have it in `n_frames`. */
void grip_renew(Grip* grip, uint32_t n_frames);

/** Go on by one frame. */
static inline void grip_advance(Grip* grip) {
  if (grip->n_gliding > 0) {
    const BridgeTie change = grip->change;
    grip->now.pull += change.pull;
    grip->now.spring += change.spring;
    grip->now.load += change.load;
    if (--grip->n_gliding == 0) {
      grip->now = grip->goal;
    }
  }
}

#endif
