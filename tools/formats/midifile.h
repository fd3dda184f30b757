/**
   A Standard MIDI File as a list of messages at their times.
*/
#ifndef HOOKE_TOOLS_FORMATS_MIDIFILE_H
#define HOOKE_TOOLS_FORMATS_MIDIFILE_H

#include <stddef.h>
#include <stdint.h>

/** One message. */
typedef struct {
  double time_s;        ///< From the start of the song [s], >= 0
  uint32_t size;        ///< [bytes], > 0
  const uint8_t* bytes; ///< With its status byte, as on the voice; in MidiFile.bytes
} MidiEvent;

/** A song. */
typedef struct {
  MidiEvent* events; ///< In order of time; at the same time in order of tracks, then of the file
  size_t n_events;
  uint8_t* bytes; ///< Of all events
} MidiFile;

/**
   Read a file of type 0 or 1 with ticks per quarter note; tempo changes are honoured.

   Channel messages are kept, and complete system exclusive messages too, since an instrument may
   know some of them. Meta events are dropped, and so are parts of a system exclusive message sent
   in pieces, which nothing here puts together.

   @param path        The file
   @param[out] error  "PATH: found …, expected …" with track and byte, or why it cannot be opened;
   one line
   @param error_size  Room in `error` [bytes]
   @return A song, to be freed with midifile_free(); NULL on failure: no such file, not such a file,
   broken, longer than an hour, larger than 16 MiB, or memory is out. One thread at a time: the
   library's messages are silenced meanwhile for the whole process.
*/
MidiFile* midifile_new(const char* path, char* error, size_t error_size);

/** Free a song; NULL is fine. */
void midifile_free(MidiFile* file);

#endif
