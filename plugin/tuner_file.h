/**
   Scala's files, read: what is wrong with one is said in a line for a person.

   Thread: any but the audio thread.
*/
#ifndef HOOKE_PLUGIN_TUNER_FILE_H
#define HOOKE_PLUGIN_TUNER_FILE_H

#include "core/scale/scale.h"

#include <stdbool.h>

enum {
  TUNER_PATH_SIZE = 4096,                  /**< Room for a path and its end [bytes] */
  TUNER_FAULT_SIZE = TUNER_PATH_SIZE + 256 /**< Room for a line about it [bytes] */
};

/** "PATH:LINE: found WHAT, expected WHAT", without an end of line. */
typedef struct {
  char line[TUNER_FAULT_SIZE];
} TunerFault;

/**
   Read a .scl file.

   @param[out] scale  Untouched on failure
   @param[out] fault  Written on failure only
   @return false if there is no such file, it cannot be read, or it is no scale
*/
bool tuner_file_scale(const char* path, Scale* scale, TunerFault* fault);

/** The same of a .kbm file. */
bool tuner_file_map(const char* path, ScaleMap* map, TunerFault* fault);

#endif
