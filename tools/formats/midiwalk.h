/**
   Events of a Standard MIDI File's track, one by one, trusting nothing.
*/
#ifndef HOOKE_TOOLS_FORMATS_MIDIWALK_H
#define HOOKE_TOOLS_FORMATS_MIDIWALK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MIDI_SYSEX = 0xF0, MIDI_ESCAPE = 0xF7, MIDI_META = 0xFF };
enum { MIDI_META_END_OF_TRACK = 0x2F, MIDI_META_TEMPO = 0x51 };

/** A place in a file, and the track that must not be left. */
typedef struct {
  const uint8_t* data; ///< The file
  size_t at;           ///< Where the next event begins
  size_t end;          ///< Where the track ends
  unsigned track;      ///< From 1, for messages; 0 in the header
  unsigned status;     ///< Running status, 0 for none
  uint64_t tick;       ///< Of the event read last, from the start of the track
  char* error;         ///< One line on failure
  size_t error_size;   ///< Room in `error` [bytes]
} MidiWalk;

/** An event; its body lies in the file. */
typedef struct {
  unsigned status; ///< 0x80 … 0xEF, MIDI_SYSEX, MIDI_ESCAPE or MIDI_META
  unsigned meta;   ///< Type of a meta event
  size_t at;       ///< First byte of the body: data bytes, without status, type and length
  size_t size;     ///< Bytes of the body
} MidiMessage;

/** Write "track T, byte `at`: found …" into the walk's error, without a track in the header.
 * @return false */
__attribute__((format(printf, 3, 4))) bool
midiwalk_fail(const MidiWalk* walk, size_t at, const char* format, ...);

/** @return An unsigned number of `n_bytes` bytes, 1 … 4, the highest first. */
uint32_t midiwalk_big_endian(const uint8_t* data, unsigned n_bytes);

/**
   Read the event at `walk->at` and move behind it.

   @return false and a message if it is broken, leaves the track, or is later than 2^31 − 1 ticks.
*/
bool midiwalk_next(MidiWalk* walk, MidiMessage* message);

#endif
