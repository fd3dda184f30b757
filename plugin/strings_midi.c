#include "plugin/strings_midi.h"

#include "plugin/midi.h"

static const double BEND_SEMITONES = 2.0;

static void play_controller(Harp* harp, uint32_t controller, uint32_t value) {
  if (controller == MIDI_PEDAL) {
    harp_pedal(harp, 0, value >= MIDI_DOWN ? 1.0 : 0.0);
  } else if (controller == MIDI_ALL_SOUND_OFF) {
    harp_all_sound_off(harp);
  } else if (controller == MIDI_RESET_CONTROLLERS) {
    harp_pedal(harp, 0, 0.0);
    harp_bend(harp, 0, 0.0);
  } else if (controller >= MIDI_ALL_NOTES_OFF) {
    harp_all_notes_off(harp, 0);
  }
}

void strings_midi_play(Harp* harp, const uint8_t* bytes, uint32_t n_bytes, bool is_muted) {
  const MidiMessage message = midi_read(bytes, n_bytes);
  switch (message.kind) {
  case MIDI_NOTE_ON:
    if (!is_muted) {
      harp_note_on(harp, 0, message.number, message.value);
    }
    break;
  case MIDI_NOTE_OFF:
    harp_note_off(harp, 0, message.number);
    break;
  case MIDI_CONTROLLER:
    play_controller(harp, message.number, message.value);
    break;
  case MIDI_BEND:
    harp_bend(harp, 0, BEND_SEMITONES * message.bend);
    break;
  case MIDI_KEY_PRESSURE:
  case MIDI_PROGRAM:
  case MIDI_CHANNEL_PRESSURE:
  case MIDI_OTHER:
    break;
  }
}
