/**
   A sound file of what a command plays: how loud, what is said of it, and what is warned of.
*/
#ifndef HOOKE_TOOLS_COMMANDS_SOUND_OUT_H
#define HOOKE_TOOLS_COMMANDS_SOUND_OUT_H

#include "tools/commands/args.h"
#include "tools/host/play.h"

#include <stdbool.h>

/** What is wanted. */
typedef struct {
  const Args* args;
  const char* path;
  unsigned bits;   /**< As soundfile_new() takes them */
  double gain_db;  /**< [dB] */
  bool normalizes; /**< Whether the gain is what takes the peak to `peak_db` */
  double peak_db;  /**< [dBFS] */
  bool is_quiet;   /**< Say nothing but errors */
} SoundOut;

/**
   Play a source into a file.

   @return ARGS_OK after a line on stdout, or on stderr if the sound goes to stdout, and one more on
   stderr for each of: samples that were clipped, a sound that is hardly heard, one that was cut
   while it rang; ARGS_FAILURE after a line on stderr, and no file is left.
*/
int sound_out_write(const SoundOut* out, PlaySource source);

#endif
