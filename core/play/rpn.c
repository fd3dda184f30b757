#include "core/play/rpn.h"

#include "core/base/maths.h"
#include "core/play/midi.h"

/* How the value of a parameter is counted. */
typedef struct {
  uint32_t upper; /* One of the upper half */
  uint32_t step;
  uint32_t most;
} Scale;

static const Scale scales[] = {
    [RPN_BEND_RANGE] = {100, 1, RPN_MOST_BEND_CENTS},
    [RPN_FINE] = {128, 1, 0x3FFF},
    [RPN_COARSE] = {128, 128, 0x3FFF},
};

bool rpn_is_choice(uint32_t controller) {
  return controller >= MIDI_NRPN_LOWER && controller <= MIDI_RPN_UPPER;
}

bool rpn_is_entry(uint32_t controller) {
  return controller == MIDI_DATA_UPPER || controller == MIDI_DATA_LOWER ||
         controller == MIDI_DATA_INCREMENT || controller == MIDI_DATA_DECREMENT;
}

uint32_t rpn_choose(uint32_t chosen, uint32_t controller, uint32_t value) {
  switch (controller) {
  case MIDI_RPN_UPPER:
    return value << 7 | (chosen & 0x7F);
  case MIDI_RPN_LOWER:
    return (chosen & ~0x7Fu) | value;
  case MIDI_NRPN_UPPER:
  case MIDI_NRPN_LOWER:
    return RPN_NONE; /* Data entry is for one that we do not know. */
  default:
    return chosen;
  }
}

uint32_t rpn_enter(uint32_t parameter, uint32_t old, uint32_t controller, uint32_t value) {
  const Scale scale = scales[parameter];
  switch (controller) {
  case MIDI_DATA_UPPER:
    return least(value * scale.upper, scale.most);
  case MIDI_DATA_LOWER:
    return least(old - old % scale.upper + least(value, scale.upper - 1), scale.most);
  case MIDI_DATA_INCREMENT:
    return least(old + scale.step, scale.most);
  case MIDI_DATA_DECREMENT:
    return old > scale.step ? old - scale.step : 0;
  default:
    return old;
  }
}
