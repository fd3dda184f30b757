#include "plugin/midi.h"

/* Status bytes without their channel. */
enum { NOTE_OFF = 0x80, NOTE_ON = 0x90, CONTROLLER = 0xB0, BEND = 0xE0 };

static const int BEND_CENTRE = 8192;

static MidiKind kind_of(const uint8_t bytes[3]) {
  switch (bytes[0] & 0xF0) {
  case NOTE_OFF:
    return MIDI_NOTE_OFF;
  case NOTE_ON:
    return bytes[2] > 0 ? MIDI_NOTE_ON : MIDI_NOTE_OFF;
  case CONTROLLER:
    return MIDI_CONTROLLER;
  case BEND:
    return MIDI_BEND;
  default:
    return MIDI_OTHER;
  }
}

MidiMessage midi_read(const uint8_t* bytes, uint32_t n_bytes) {
  if (n_bytes != 3 || (bytes[1] | bytes[2]) & 0x80) {
    return (MidiMessage){.kind = MIDI_OTHER};
  }
  return (MidiMessage){
      .kind = kind_of(bytes),
      .channel = bytes[0] & 0x0Fu,
      .number = bytes[1],
      .value = bytes[2],
      .bend = (double)((bytes[2] << 7 | bytes[1]) - BEND_CENTRE) / BEND_CENTRE,
  };
}
