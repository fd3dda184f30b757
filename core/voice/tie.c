#include "core/voice/tie.h"

bool tie_is_on(const Tie* tie) {
  return tie->pull.value > 0.0 || tie->pull.n_left > 0;
}

static void glide(Tie* tie, BridgeTie goal, uint32_t n_frames) {
  line_to(&tie->pull, goal.pull, n_frames);
  line_to(&tie->spring, goal.spring, n_frames);
  line_to(&tie->load, goal.load, n_frames);
  tie->weight = goal.weight;
}

void tie_take_masses(Tie* tie, const Bridge* bridge, const Chain* chain) {
  if (tie->n_masses != chain->n_masses && tie_is_on(tie)) {
    glide(tie, bridge_tie(bridge, chain->now, chain->n_masses, tie->hold), 0);
  }
  tie->n_masses = chain->n_masses;
}

void tie_glide(
    Tie* tie, const Bridge* bridge, const Chain* chain, BridgeHold hold, uint32_t n_glide) {
  glide(tie,
        tie_is_wanted(hold) ? bridge_tie(bridge, chain->goal, chain->n_masses, hold)
                            : (BridgeTie){.weight = tie->weight},
        n_glide);
  tie->hold = hold;
}

void tie_renew(Tie* tie, uint32_t n_frames) {
  const BridgeTie goal = {.pull = tie->pull.goal,
                          .spring = tie->spring.goal,
                          .load = tie->load.goal,
                          .weight = tie->weight};
  glide(tie, (BridgeTie){0}, 0);
  glide(tie, goal, n_frames);
}

void tie_follow(Tie* tie, const Bridge* bridge, const Chain* chain) {
  if (tie_is_on(tie) && tie_is_wanted(tie->hold)) {
    glide(tie, bridge_tie(bridge, chain->goal, chain->n_masses, tie->hold), chain->n_gliding);
  }
}
