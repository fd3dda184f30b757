/**
   A Standard MIDI File as a list of messages at their times.

   Read is what the standard of 1996 describes: files of type 0, 1 and 2, ticks per quarter note
   with any tempo map or per SMPTE frame, headers longer than theirs, chunks of other kinds, split
   system exclusive messages; and the same wrapped in a RIFF file of kind RMID.  Files that break
   the standard in ways that leave no doubt about what is meant are read as well, with a note on it.
*/
#ifndef HOOKE_TOOLS_FORMATS_SMF_H
#define HOOKE_TOOLS_FORMATS_SMF_H

#include <stddef.h>
#include <stdint.h>

/** The latest end of a song [s]: a day. */
#define SMF_MAX_LENGTH_S 86400.0

/** What may be said of a file that is read all the same, each once. */
typedef enum {
  SMF_LEADING,   /**< Up to 128 bytes of other data before the header: skipped */
  SMF_TRACKS,    /**< Another number of tracks than the header says: all are read */
  SMF_TYPE_0,    /**< Several tracks in a file of type 0: read as if of type 1 */
  SMF_PATTERNS,  /**< Type 2: its patterns come one after the other */
  SMF_CUT,       /**< A track longer than the file: read to End of Track, or the last whole event */
  SMF_NO_END,    /**< A track without End of Track: it ends with its last event */
  SMF_RUNNING,   /**< Running status after a meta event or sysex: that before it */
  SMF_DATA,      /**< A data byte over 0x7f: taken for 0x7f */
  SMF_REAL_TIME, /**< A real-time byte, as an event or in a message: left out */
  SMF_SYSEX,     /**< A system exclusive message without its end, or none at all: left out */
  SMF_N_NOTES
} SmfNote;

/** Room for a note [bytes]. */
enum { SMF_NOTE_SIZE = 160 };

/** One message. */
typedef struct {
  double time_s;        /**< From the start of the song [s], >= 0 */
  uint32_t size;        /**< [bytes], > 0 */
  const uint8_t* bytes; /**< With its status byte, as on the wire; in Smf.bytes */
} SmfEvent;

/** A song. */
typedef struct {
  SmfEvent* events; /**< In order of time; at the same time in order of tracks, then of the file */
  size_t n_events;
  double duration_s; /**< To the latest End of Track [s], not before the last event */
  uint8_t* bytes;    /**< Of all events */
  char note[SMF_N_NOTES][SMF_NOTE_SIZE]; /**< "track T, byte B: found …", one line, or empty */
} Smf;

/**
   Read a file, in n log n.

   Kept are channel messages and system exclusive messages, the latter whole, without real-time
   bytes and at the time of their last packet.  Meta events are dropped, and so is what else there
   may be in F7 events.

   @param path        The file
   @param[out] error  "PATH: found …, expected …" with track and byte, or why it cannot be opened;
   one line
   @param error_size  Room in `error` [bytes]
   @return A song, to be freed with smf_free(); NULL on failure: no such file, not such a file,
   broken, longer than a day, larger than 16 MiB, or memory is out.
*/
Smf* smf_new(const char* path, char* error, size_t error_size);

/** Free a song; NULL is fine. */
void smf_free(Smf* smf);

#endif
