/**
   MIDI messages of a channel, read.

   Thread: any; real-time safe.
*/
#ifndef HOOKE_CORE_PLAY_MIDI_H
#define HOOKE_CORE_PLAY_MIDI_H

#include <stdint.h>

/** What a message is. */
typedef enum {
  MIDI_OTHER, /**< Unknown, cut short or out of range: to be ignored */
  MIDI_NOTE_OFF,
  MIDI_NOTE_ON,
  MIDI_KEY_PRESSURE, /**< Of one key */
  MIDI_CONTROLLER,
  MIDI_PROGRAM,
  MIDI_CHANNEL_PRESSURE, /**< Of all keys of a channel */
  MIDI_BEND,
} MidiKind;

/** Controllers. */
enum {
  MIDI_VIBRATO = 1,
  MIDI_BREATH = 2,
  MIDI_DATA_UPPER = 6, /**< Data entry, upper seven bits */
  MIDI_VOLUME = 7,
  MIDI_EXPRESSION = 11,
  MIDI_DATA_LOWER = 38, /**< And lower seven */
  MIDI_PEDAL = 64,
  MIDI_SOSTENUTO = 66,
  MIDI_SOFT_PEDAL = 67,
  MIDI_BRIGHTNESS = 74,
  MIDI_DATA_INCREMENT = 96,
  MIDI_DATA_DECREMENT = 97,
  MIDI_NRPN_LOWER = 98, /**< Which parameter data entry is for: a maker's own */
  MIDI_NRPN_UPPER = 99,
  MIDI_RPN_LOWER = 100, /**< Or a registered one */
  MIDI_RPN_UPPER = 101,
  MIDI_ALL_SOUND_OFF = 120,
  MIDI_RESET_CONTROLLERS = 121,
  MIDI_ALL_NOTES_OFF = 123, /**< And the mode messages after it */
};

/** Least value of a pedal that is down. */
enum { MIDI_DOWN = 64 };

/** A message. */
typedef struct {
  MidiKind kind;
  uint32_t channel; /**< From 0 */
  uint32_t number;  /**< Of the key, the controller or the program, 0 to 127 */
  uint32_t value;   /**< Of the key's velocity, 1 to 127 if it goes down, of a pressure, or of the
                       controller, 0 to 127 */
  double bend;      /**< Of the wheel, −1 to 8191/8192; 0 of other kinds */
} MidiMessage;

/** Read one complete message of `n_bytes`, neither more nor fewer than its kind has.  Note on of
 * velocity nought is note off. */
MidiMessage midi_read(const uint8_t* bytes, uint32_t n_bytes);

#endif
