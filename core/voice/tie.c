#include "core/voice/tie.h"

bool tie_is_on(const Tie* tie) {
  return tie->now.pull > 0.0 || tie->n_gliding > 0;
}

static bool is_none(BridgeHold hold) {
  return !(hold.mass * hold.lever > 0.0);
}

/* The string has other masses than the tie was made for: tie those, at once, for they moved at once
 * too. */
static void take_masses(Tie* tie, const Chain* chain) {
  if (tie->n_masses != chain->n_masses && tie_is_on(tie)) {
    tie->now = bridge_tie(chain->now, chain->n_masses, tie->hold);
    tie->n_gliding = 0;
  }
  tie->n_masses = chain->n_masses;
}

static void glide(Tie* tie, BridgeTie goal, uint32_t n_frames) {
  tie->goal = goal;
  tie->now.weight = goal.weight;
  tie->n_gliding = n_frames;
  if (n_frames == 0) {
    tie->now = goal;
    return;
  }
  const double share = 1.0 / n_frames;
  tie->change = (BridgeTie){
      .pull = (goal.pull - tie->now.pull) * share,
      .spring = (goal.spring - tie->now.spring) * share,
      .load = (goal.load - tie->now.load) * share,
  };
}

/* Its masses are known once it has been retuned; so where that changes them, once more. */
static bool retune(Tie* tie,
                   const Bridge* bridge,
                   Voice* voice,
                   const TuningTarget* target,
                   BridgeHold hold,
                   uint32_t n_glide) {
  uint32_t n_masses = 0;
  do {
    n_masses = voice->chain.n_masses;
    const TuningTarget own = bridge_correct(bridge, *target, n_masses, hold, &tie->shift);
    if (!voice_retune(voice, &own, n_glide)) {
      return false;
    }
  } while (voice->chain.n_masses < n_masses);
  return true;
}

bool tie_retune(Tie* tie,
                const Bridge* bridge,
                Voice* voice,
                const TuningTarget* target,
                BridgeHold hold,
                uint32_t n_glide) {
  const Chain* const chain = &voice->chain;
  take_masses(tie, chain);
  if (is_none(hold) && !tie_is_on(tie)) {
    return voice_retune(voice, target, n_glide);
  }
  if (!retune(tie, bridge, voice, target, hold, n_glide)) {
    return false;
  }
  take_masses(tie, chain);
  glide(tie,
        is_none(hold) ? (BridgeTie){.weight = tie->now.weight}
                      : bridge_tie(chain->goal, chain->n_masses, hold),
        n_glide);
  tie->hold = hold;
  return true;
}

void tie_renew(Tie* tie, uint32_t n_frames) {
  tie->now = (BridgeTie){0};
  glide(tie, tie->goal, n_frames);
}

void tie_follow(Tie* tie, const Chain* chain) {
  if (tie_is_on(tie) && !is_none(tie->hold)) {
    glide(tie, bridge_tie(chain->goal, chain->n_masses, tie->hold), chain->n_gliding);
  }
}
