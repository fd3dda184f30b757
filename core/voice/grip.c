#include "core/voice/grip.h"

bool grip_is_on(const Grip* grip) {
  return grip->now.pull > 0.0 || grip->n_gliding > 0;
}

static bool is_none(BridgeHold hold) {
  return !(hold.mass * hold.lever > 0.0);
}

/* The string has other masses than the tie was made for: tie those, at once, for they moved at once
 * too. */
static void take_masses(Grip* grip, const Chain* chain) {
  if (grip->n_masses != chain->n_masses && grip_is_on(grip)) {
    grip->now = bridge_tie(chain->now, chain->n_masses, grip->hold);
    grip->n_gliding = 0;
  }
  grip->n_masses = chain->n_masses;
}

static void glide(Grip* grip, BridgeTie goal, uint32_t n_frames) {
  grip->goal = goal;
  grip->now.weight = goal.weight;
  grip->n_gliding = n_frames;
  if (n_frames == 0) {
    grip->now = goal;
    return;
  }
  const double share = 1.0 / n_frames;
  grip->change = (BridgeTie){
      .pull = (goal.pull - grip->now.pull) * share,
      .spring = (goal.spring - grip->now.spring) * share,
      .load = (goal.load - grip->now.load) * share,
  };
}

/* Its masses are known once it has been retuned; so where that changes them, once more. */
static bool retune(Grip* grip,
                   const Bridge* bridge,
                   Wire* wire,
                   const TuningTarget* target,
                   BridgeHold hold,
                   uint32_t n_glide) {
  uint32_t n_masses = 0;
  do {
    n_masses = wire->chain.n_masses;
    const TuningTarget own = bridge_correct(bridge, *target, n_masses, hold, &grip->shift);
    if (!wire_retune(wire, &own, n_glide)) {
      return false;
    }
  } while (wire->chain.n_masses < n_masses);
  return true;
}

bool grip_retune(Grip* grip,
                 const Bridge* bridge,
                 Wire* wire,
                 const TuningTarget* target,
                 BridgeHold hold,
                 uint32_t n_glide) {
  const Chain* const chain = &wire->chain;
  take_masses(grip, chain);
  if (is_none(hold) && !grip_is_on(grip)) {
    return wire_retune(wire, target, n_glide);
  }
  if (!retune(grip, bridge, wire, target, hold, n_glide)) {
    return false;
  }
  take_masses(grip, chain);
  glide(grip,
        is_none(hold) ? (BridgeTie){.weight = grip->now.weight}
                      : bridge_tie(chain->goal, chain->n_masses, hold),
        n_glide);
  grip->hold = hold;
  return true;
}

void grip_renew(Grip* grip, uint32_t n_frames) {
  grip->now = (BridgeTie){0};
  glide(grip, grip->goal, n_frames);
}

void grip_follow(Grip* grip, const Chain* chain) {
  if (grip_is_on(grip) && !is_none(grip->hold)) {
    glide(grip, bridge_tie(chain->goal, chain->n_masses, grip->hold), chain->n_gliding);
  }
}
