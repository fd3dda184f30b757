#include "plugin/hand.h"

#include "core/play/rpn.h"

#include <math.h>

static double clamp(double value, double low, double high) {
  return fmin(fmax(value, low), high);
}

void hand_reset(Hand* hand, uint32_t range_cents) {
  *hand = (Hand){
      .range_cents = range_cents,
      .fine = RPN_CENTRE,
      .coarse = RPN_CENTRE,
      .breath = 1.0,
  };
}

void hand_reset_controllers(Hand* hand) {
  hand->wheel = 0.0;
  hand->pressure = 0.0;
  hand->vibrato = 0.0;
  hand->breath = 1.0;
  hand->lift = 0.0;
  hand->softness = 0.0;
  hand->is_sostenuto = false;
}

void hand_enter(Hand* hand, uint32_t parameter, uint32_t controller, uint32_t value) {
  if (parameter == RPN_BEND_RANGE) {
    hand->range_cents = rpn_enter(parameter, hand->range_cents, controller, value);
  } else if (parameter == RPN_FINE) {
    hand->fine = rpn_enter(parameter, hand->fine, controller, value);
  } else if (parameter == RPN_COARSE) {
    hand->coarse = rpn_enter(parameter, hand->coarse, controller, value);
  }
}

static double bent(const Hand* hand) {
  return hand->wheel * hand->range_cents / 100.0;
}

static double tuned(const Hand* hand) {
  const int fine = (int)hand->fine - RPN_CENTRE;
  const int coarse = (int)(hand->coarse >> 7) - (RPN_CENTRE >> 7);
  return coarse + (double)fine / RPN_CENTRE;
}

double hand_bend(const Hand* leader, const Hand* hand) {
  return tuned(leader) + bent(leader) + (hand != leader ? bent(hand) : 0.0);
}

double hand_pressure(const Hand* leader, const Hand* hand) {
  return fmax(leader->pressure, hand->pressure);
}

double hand_brightness(const Hand* leader, const Hand* hand) {
  const double own = hand != leader ? hand->brightness : 0.0;
  return clamp(leader->brightness + own, -1.0, 1.0);
}

void hand_keys_put(HandKeys* keys, uint32_t key, bool is_in) {
  const uint64_t bit = UINT64_C(1) << (key & 63);
  uint64_t* const half = &keys->half[key >> 6];
  *half = is_in ? *half | bit : *half & ~bit;
}

bool hand_keys_have(const HandKeys* keys, uint32_t key) {
  return keys->half[key >> 6] >> (key & 63) & 1;
}

bool hand_keys_are_none(const HandKeys* keys) {
  return !(keys->half[0] | keys->half[1]);
}
