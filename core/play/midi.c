#include "core/play/midi.h"

/* Status bytes without their channel. */
enum {
  NOTE_OFF = 0x80,
  NOTE_ON = 0x90,
  KEY_PRESSURE = 0xA0,
  CONTROLLER = 0xB0,
  PROGRAM = 0xC0,
  CHANNEL_PRESSURE = 0xD0,
  BEND = 0xE0
};

static const int BEND_CENTRE = 8192;

static MidiMessage read_two(uint32_t status, uint32_t channel, uint32_t data) {
  switch (status) {
  case PROGRAM:
    return (MidiMessage){.kind = MIDI_PROGRAM, .channel = channel, .number = data};
  case CHANNEL_PRESSURE:
    return (MidiMessage){.kind = MIDI_CHANNEL_PRESSURE, .channel = channel, .value = data};
  default:
    return (MidiMessage){.kind = MIDI_OTHER};
  }
}

static MidiKind kind_of_three(uint32_t status, uint32_t value) {
  switch (status) {
  case NOTE_OFF:
    return MIDI_NOTE_OFF;
  case NOTE_ON:
    return value > 0 ? MIDI_NOTE_ON : MIDI_NOTE_OFF;
  case KEY_PRESSURE:
    return MIDI_KEY_PRESSURE;
  case CONTROLLER:
    return MIDI_CONTROLLER;
  case BEND:
    return MIDI_BEND;
  default:
    return MIDI_OTHER;
  }
}

static MidiMessage read_three(uint32_t status, uint32_t channel, uint32_t lower, uint32_t upper) {
  const int wheel = (int)(upper << 7 | lower) - BEND_CENTRE;
  return (MidiMessage){
      .kind = kind_of_three(status, upper),
      .channel = channel,
      .number = lower,
      .value = upper,
      .bend = status == BEND ? (double)wheel / BEND_CENTRE : 0.0,
  };
}

MidiMessage midi_read(const uint8_t* bytes, uint32_t n_bytes) {
  const uint32_t status = n_bytes ? bytes[0] & 0xF0u : 0;
  const uint32_t channel = n_bytes ? bytes[0] & 0x0Fu : 0;
  if (n_bytes == 2 && !(bytes[1] & 0x80)) {
    return read_two(status, channel, bytes[1]);
  }
  if (n_bytes == 3 && !((bytes[1] | bytes[2]) & 0x80)) {
    return read_three(status, channel, bytes[1], bytes[2]);
  }
  return (MidiMessage){.kind = MIDI_OTHER};
}
