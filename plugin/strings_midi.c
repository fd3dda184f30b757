#include "plugin/strings_midi.h"

#include "core/play/midi.h"
#include "core/play/rpn.h"

#include <math.h>

/* The middle of brightness, and how far it is to its upper end. */
static const double BRIGHTNESS_CENTRE = 64.0;
static const double BRIGHTNESS_REACH = 63.0;

static double share(uint32_t value) {
  return value / 127.0;
}

static double gain(uint32_t value) {
  return share(value) * share(value);
}

static void swell(const StringsMidi* midi) {
  for (uint32_t channel = 0; channel < HARP_CHANNELS; ++channel) {
    harp_set_gain(midi->hands.harp, channel, midi->volume * midi->expression);
  }
}

static void reset_controllers(StringsMidi* midi, uint32_t hand) {
  for (uint32_t channel = 0; channel < ZONES_CHANNELS; ++channel) {
    if (strings_hands_follows(&midi->hands, zones_hand(&midi->hands.zones, channel), hand)) {
      midi->parameters[channel] = RPN_NONE;
    }
  }
  strings_hands_reset_controllers(&midi->hands, hand);
  midi->expression = 1.0;
  swell(midi);
}

/* Only a leader's channel has zones, whoever is on it now. */
static void enter_zone(StringsMidi* midi, const MidiMessage* message) {
  const bool can_lead = message->channel == ZONES_LOWER || message->channel == ZONES_UPPER;
  if (can_lead && message->number == MIDI_DATA_UPPER && message->value <= ZONES_MOST_MEMBERS) {
    strings_hands_set_zone(&midi->hands, message->channel, message->value);
  }
}

static void enter_data(StringsMidi* midi, uint32_t hand, const MidiMessage* message) {
  const uint32_t parameter = midi->parameters[message->channel];
  switch (parameter) {
  case RPN_BEND_RANGE:
  case RPN_FINE:
  case RPN_COARSE:
    strings_hands_enter(&midi->hands, hand, parameter, message->number, message->value);
    break;
  case RPN_ZONE:
    enter_zone(midi, message);
    break;
  default:
    break;
  }
}

/* What a leader says, or a hand that follows none. */
static void play_leader(StringsMidi* midi, uint32_t hand, uint32_t controller, uint32_t value) {
  StringsHands* const hands = &midi->hands;
  switch (controller) {
  case MIDI_VIBRATO:
    strings_hands_vibrate(hands, hand, STRINGS_MIDI_VIBRATO * share(value));
    break;
  case MIDI_BREATH:
    strings_hands_breathe(hands, hand, share(value));
    break;
  case MIDI_VOLUME:
    midi->volume = gain(value);
    swell(midi);
    break;
  case MIDI_EXPRESSION:
    midi->expression = gain(value);
    swell(midi);
    break;
  case MIDI_PEDAL:
    strings_hands_lift(hands, hand, fmin((double)value / MIDI_DOWN, 1.0));
    break;
  case MIDI_SOSTENUTO:
    strings_hands_sostenuto(hands, hand, value >= MIDI_DOWN);
    break;
  case MIDI_SOFT_PEDAL:
    strings_hands_soften(hands, hand, share(value));
    break;
  case MIDI_ALL_SOUND_OFF:
    strings_hands_silence(hands);
    break;
  case MIDI_RESET_CONTROLLERS:
    reset_controllers(midi, hand);
    break;
  default:
    if (controller >= MIDI_ALL_NOTES_OFF) {
      strings_hands_all_notes_off(hands, hand);
    }
    break;
  }
}

static void play_controller(StringsMidi* midi, uint32_t hand, const MidiMessage* message) {
  uint32_t* const chosen = &midi->parameters[message->channel];
  if (rpn_is_choice(message->number)) {
    *chosen = rpn_choose(*chosen, message->number, message->value);
  } else if (rpn_is_entry(message->number)) {
    enter_data(midi, hand, message);
  } else if (message->number == MIDI_BRIGHTNESS) {
    const double brightness = (message->value - BRIGHTNESS_CENTRE) / BRIGHTNESS_REACH;
    strings_hands_brighten(&midi->hands, hand, fmax(brightness, -1.0));
  } else if (!strings_hands_is_member(&midi->hands, hand)) {
    play_leader(midi, hand, message->number, message->value);
  }
}

void strings_midi_reset(StringsMidi* midi) {
  strings_hands_reset(&midi->hands);
  for (uint32_t channel = 0; channel < ZONES_CHANNELS; ++channel) {
    midi->parameters[channel] = RPN_NONE;
  }
  midi->volume = 1.0;
  midi->expression = 1.0;
}

void strings_midi_silence(StringsMidi* midi) {
  strings_hands_silence(&midi->hands);
}

void strings_midi_play(StringsMidi* midi, const uint8_t* bytes, uint32_t n_bytes, bool is_muted) {
  const MidiMessage message = midi_read(bytes, n_bytes);
  StringsHands* const hands = &midi->hands;
  const uint32_t hand = zones_hand(&hands->zones, message.channel);
  switch (message.kind) {
  case MIDI_NOTE_ON:
    if (!is_muted) {
      strings_hands_note_on(hands, hand, message.number, message.value);
    }
    break;
  case MIDI_NOTE_OFF:
    strings_hands_note_off(hands, hand, message.number);
    break;
  case MIDI_KEY_PRESSURE:
    if (!strings_hands_is_member(hands, hand)) {
      strings_hands_press_key(hands, hand, message.number, share(message.value));
    }
    break;
  case MIDI_CONTROLLER:
    play_controller(midi, hand, &message);
    break;
  case MIDI_CHANNEL_PRESSURE:
    strings_hands_press(hands, hand, share(message.value));
    break;
  case MIDI_BEND:
    strings_hands_turn_wheel(hands, hand, message.bend);
    break;
  case MIDI_PROGRAM:
  case MIDI_OTHER:
    break;
  }
}
