#include "plugin/midi.h"

/* Status bytes without their channel, and the controllers that we know. */
enum {
  NOTE_OFF = 0x80,
  NOTE_ON = 0x90,
  CONTROLLER = 0xB0,
  BEND = 0xE0,
  PEDAL = 64,
  ALL_SOUND_OFF = 120,
  RESET_CONTROLLERS = 121,
  ALL_NOTES_OFF = 123,
};

static const double BEND_SEMITONES = 2.0;
static const int BEND_CENTRE = 8192;

static void play_controller(Harp* harp, uint8_t controller, uint8_t value) {
  if (controller == PEDAL) {
    harp_pedal(harp, value >= 64);
  } else if (controller == ALL_SOUND_OFF) {
    harp_all_sound_off(harp);
  } else if (controller == RESET_CONTROLLERS) {
    harp_pedal(harp, false);
    harp_bend(harp, 0.0);
  } else if (controller >= ALL_NOTES_OFF) {
    harp_all_notes_off(harp);
  }
}

static void play_bend(Harp* harp, uint8_t low, uint8_t high) {
  const int bend = (high << 7 | low) - BEND_CENTRE;
  harp_bend(harp, BEND_SEMITONES * bend / BEND_CENTRE);
}

void midi_play(Harp* harp, const uint8_t* bytes, uint32_t n_bytes, bool is_muted) {
  if (n_bytes != 3 || (bytes[1] | bytes[2]) & 0x80) {
    return;
  }
  switch (bytes[0] & 0xF0) {
  case NOTE_ON:
    if (bytes[2] > 0 && !is_muted) {
      harp_note_on(harp, bytes[1], bytes[2]);
    } else if (bytes[2] == 0) {
      harp_note_off(harp, bytes[1]);
    }
    break;
  case NOTE_OFF:
    harp_note_off(harp, bytes[1]);
    break;
  case CONTROLLER:
    play_controller(harp, bytes[1], bytes[2]);
    break;
  case BEND:
    play_bend(harp, bytes[1], bytes[2]);
    break;
  default:
    break;
  }
}
