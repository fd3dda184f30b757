/**
   A stereo sound file that is there when it is whole, and not before.
*/
#ifndef HOOKE_TOOLS_FORMATS_SOUNDFILE_H
#define HOOKE_TOOLS_FORMATS_SOUNDFILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** A file being written, under a temporary name beside its own; see outfile.h. */
typedef struct SoundFile SoundFile;

/** @return Why a file of that name and depth cannot be written, or NULL if it can. */
const char* soundfile_refuse(const char* path, unsigned bits);

/** @return The rates that such a file can have if this is none of them; NULL if it is one. */
const char* soundfile_refuse_rate(const char* path, double rate_hz);

/**
   Begin a file; its kind is by the ending of `path`, in small or capital letters, or WAV where that
   is a pipe or a device without one.

   .wav is 32-bit float unless `bits` is 16 or 24; .flac is of 24 bits, or 16; .ogg is Vorbis of
   quality 0.8.
   @param rate_hz     Sample rate [Hz], > 0
   @param bits        16, 24 or 32, if the kind has it; 0 for its usual one
   @param[out] error  One line, on failure
   @param error_size  Room in `error` [bytes]
   @return A file to be finished with soundfile_finish() or soundfile_free(); NULL on failure, and
   nothing is left behind.
*/
SoundFile*
soundfile_new(const char* path, int rate_hz, unsigned bits, char* error, size_t error_size);

/** @return Whether such a file holds whole numbers, which end at full scale. */
bool soundfile_clips(const char* path, unsigned bits);

/** @return Whether so many frames can still be written: a WAV file is at most of 4 GiB. */
bool soundfile_has_room(const SoundFile* file, uint64_t n_frames);

/**
   Add frames; whole numbers are clipped to full scale, floats are not.

   @param frames  2 × n_frames, left and right in turn
   @return false when it cannot be written, or there is no room: soundfile_error() says which.
*/
bool soundfile_write(SoundFile* file, const float* frames, uint32_t n_frames);

/** @return Why soundfile_write() failed, one line */
const char* soundfile_error(const SoundFile* file);

/**
   Close a file, give it its name, and free it.

   @return 0, or the reason as errno has it; the file is gone then, and one of that name from before
   is as it was.
*/
int soundfile_finish(SoundFile* file);

/** Give a file up: remove what there is of it, and free it. NULL is fine. */
void soundfile_free(SoundFile* file);

#endif
