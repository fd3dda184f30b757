#include "core/play/channel.h"

#include "core/base/maths.h"
#include "core/play/rpn.h"

#include <math.h>

void channel_reset(Channel* channel, uint32_t range_cents) {
  *channel = (Channel){
      .range_cents = range_cents,
      .fine = RPN_CENTRE,
      .coarse = RPN_CENTRE,
      .breath = 1.0,
      .volume = 1.0,
      .expression = 1.0,
      .parameter = RPN_NONE,
  };
}

void channel_reset_controllers(Channel* channel) {
  channel->wheel = 0.0;
  channel->pressure = 0.0;
  channel->vibrato = 0.0;
  channel->breath = 1.0;
  channel->softness = 0.0;
  channel->lift = 0.0;
  channel->expression = 1.0;
  channel->is_sostenuto = false;
  channel->parameter = RPN_NONE;
}

void channel_enter(Channel* channel, uint32_t parameter, uint32_t controller, uint32_t value) {
  if (parameter == RPN_BEND_RANGE) {
    channel->range_cents = rpn_enter(parameter, channel->range_cents, controller, value);
  } else if (parameter == RPN_FINE) {
    channel->fine = rpn_enter(parameter, channel->fine, controller, value);
  } else if (parameter == RPN_COARSE) {
    channel->coarse = rpn_enter(parameter, channel->coarse, controller, value);
  }
}

static double bent(const Channel* channel) {
  return channel->wheel * channel->range_cents / 100.0;
}

static double tuned(const Channel* channel) {
  const int fine = (int)channel->fine - RPN_CENTRE;
  const int coarse = (int)(channel->coarse >> 7) - (RPN_CENTRE >> 7);
  return coarse + (double)fine / RPN_CENTRE;
}

double channel_gesture(const Channel* leader, const Channel* channel, Gesture gesture) {
  const bool is_member = channel != leader;
  switch (gesture) {
  case GESTURE_BEND:
    return tuned(leader) + bent(leader) + (is_member ? bent(channel) : 0.0);
  case GESTURE_PRESSURE:
    return fmax(leader->pressure, channel->pressure);
  case GESTURE_BRIGHTNESS:
    return clamp(leader->brightness + (is_member ? channel->brightness : 0.0), -1.0, 1.0);
  case GESTURE_VIBRATO:
    return leader->vibrato;
  case GESTURE_BREATH:
    return leader->breath;
  case GESTURE_SOFTNESS:
    return leader->softness;
  case GESTURE_SOSTENUTO:
    return leader->is_sostenuto;
  case GESTURE_DAMPER:
    return leader->lift;
  case GESTURE_GAIN:
    return leader->volume * leader->expression;
  case N_GESTURES:
    break;
  }
  return 0.0;
}
