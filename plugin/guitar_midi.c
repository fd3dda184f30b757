#include "plugin/guitar_midi.h"

#include "core/play/midi.h"
#include "core/play/rpn.h"

#include <math.h>

enum { USUAL_SEMITONES = 2 };

static const double VIBRATO_SEMITONES = 0.5;

static void bend(const GuitarMidi* midi, uint32_t channel) {
  const GuitarChannel* const c = &midi->channels[channel];
  const double range = fmin(c->semitones + c->cents / 100.0, GUITAR_MIDI_MOST_BEND);
  guitarist_bend(midi->guitarist, channel, range * c->wheel);
}

static void set_wheel(GuitarMidi* midi, uint32_t channel, double wheel) {
  midi->channels[channel].wheel = wheel;
  bend(midi, channel);
}

/* As for every pair of controllers, the upper one brings the lower one to nought.  A wheel that is
 * turned stays where it is, and bends by the new range. */
static void enter_data(GuitarMidi* midi, uint32_t channel, uint32_t controller, uint32_t value) {
  GuitarChannel* const c = &midi->channels[channel];
  if (c->parameter == RPN_BEND_RANGE) {
    const bool is_upper = controller == MIDI_DATA_UPPER;
    c->semitones = is_upper ? value : c->semitones;
    c->cents = is_upper ? 0 : value;
    bend(midi, channel);
  }
}

static void reset_controllers(GuitarMidi* midi, uint32_t channel) {
  guitarist_pedal(midi->guitarist, channel, false);
  guitarist_vibrato(midi->guitarist, channel, 0.0);
  guitar_palm(midi->guitar, 0.0);
  midi->channels[channel].parameter = RPN_NONE;
  set_wheel(midi, channel, 0.0);
}

static void play_controller(GuitarMidi* midi, const MidiMessage* message) {
  const uint32_t channel = message->channel;
  uint32_t* const chosen = &midi->channels[channel].parameter;
  switch (message->number) {
  case MIDI_VIBRATO:
    guitarist_vibrato(midi->guitarist, channel, VIBRATO_SEMITONES * message->value / 127.0);
    break;
  case MIDI_DATA_UPPER:
  case MIDI_DATA_LOWER:
    enter_data(midi, channel, message->number, message->value);
    break;
  case MIDI_PEDAL:
    guitarist_pedal(midi->guitarist, channel, message->value >= MIDI_DOWN);
    break;
  case MIDI_SOFT_PEDAL:
    guitar_palm(midi->guitar, message->value / 127.0);
    break;
  case MIDI_NRPN_LOWER:
  case MIDI_NRPN_UPPER:
  case MIDI_RPN_LOWER:
  case MIDI_RPN_UPPER:
    *chosen = rpn_choose(*chosen, message->number, message->value);
    break;
  case MIDI_ALL_SOUND_OFF:
    guitarist_all_sound_off(midi->guitarist);
    break;
  case MIDI_RESET_CONTROLLERS:
    reset_controllers(midi, channel);
    break;
  default:
    if (message->number >= MIDI_ALL_NOTES_OFF) {
      guitarist_all_notes_off(midi->guitarist, channel);
    }
    break;
  }
}

void guitar_midi_reset(GuitarMidi* midi) {
  for (uint32_t i = 0; i < GUITARIST_CHANNELS; ++i) {
    midi->channels[i] = (GuitarChannel){.semitones = USUAL_SEMITONES, .parameter = RPN_NONE};
  }
}

void guitar_midi_centre(GuitarMidi* midi) {
  for (uint32_t i = 0; i < GUITARIST_CHANNELS; ++i) {
    midi->channels[i].wheel = 0.0;
  }
}

void guitar_midi_play(GuitarMidi* midi, const uint8_t* bytes, uint32_t n_bytes, bool is_muted) {
  const MidiMessage message = midi_read(bytes, n_bytes);
  switch (message.kind) {
  case MIDI_NOTE_ON:
    if (!is_muted) {
      guitarist_note_on(midi->guitarist, message.channel, message.number, message.value);
    }
    break;
  case MIDI_NOTE_OFF:
    guitarist_note_off(midi->guitarist, message.channel, message.number);
    break;
  case MIDI_CONTROLLER:
    play_controller(midi, &message);
    break;
  case MIDI_BEND:
    set_wheel(midi, message.channel, message.bend);
    break;
  case MIDI_KEY_PRESSURE:
  case MIDI_PROGRAM:
  case MIDI_CHANNEL_PRESSURE:
  case MIDI_OTHER:
    break;
  }
}
