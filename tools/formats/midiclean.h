/**
   A Standard MIDI File checked and written again in its plainest form.

   libsmf trusts its input: a system exclusive message in pieces ends the process by an assertion, a
   text of more than 127 bytes or a chunk of another kind loses the notes behind it. So it only ever
   sees files that came through here.
*/
#ifndef HOOKE_TOOLS_FORMATS_MIDICLEAN_H
#define HOOKE_TOOLS_FORMATS_MIDICLEAN_H

#include "tools/formats/bytes.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/**
   Check a file of type 0 or 1 and write what an instrument and the clock need of it.

   Every length must stay inside its chunk, every message be complete, every track end with End of
   Track. Kept are channel messages, each with its status byte, complete system exclusive messages,
   and tempo changes. Dropped are other meta events, parts of a system exclusive message sent in
   pieces, chunks of other kinds, and what follows the last track announced.

   @param data        The file
   @param size        [bytes]
   @param[out] out    The file written again is added here
   @param[out] error  "track T, byte B: found …, expected …", without a track in the header;
   untouched on success
   @param error_size  Room in `error` [bytes]
   @return false if the file is broken, of another kind, or memory is out.
*/
bool midiclean(const uint8_t* data, size_t size, Bytes* out, char* error, size_t error_size);

#endif
