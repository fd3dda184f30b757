/**
   The files that a player gives an instrument, read: Scala's two, and bodies.  What is wrong with
   one is said in a line for a person.

   Plain files only are read, and nobody is waited for.

   Thread: any but the audio thread.
*/
#ifndef HOOKE_PLUGIN_FILES_READ_H
#define HOOKE_PLUGIN_FILES_READ_H

#include "core/bank/body.h"
#include "core/scale/scale.h"

#include <stdbool.h>

enum {
  FILES_PATH_SIZE = 4096,                  /**< Room for a path and its end [bytes] */
  FILES_FAULT_SIZE = FILES_PATH_SIZE + 256 /**< Room for a line about it [bytes] */
};

/** What a file is. */
typedef enum { FILES_SCALE, FILES_MAPPING, FILES_BODY, FILES_COUNT } FilesKind;

/** "PATH:LINE: found WHAT, expected WHAT", printable and without an end of line. */
typedef struct {
  char line[FILES_FAULT_SIZE];
} FilesFault;

/** What a file says. */
typedef struct {
  FilesKind file;
  bool is_good; /**< false: nothing was read */
  Scale scale;  /**< If it is a good scale; the caller's, to scale_free() */
  ScaleMap map; /**< If it is a good mapping; the caller's, to scale_map_free() */
  Body body;    /**< If it is a good body; else it has no modes */
} FilesContent;

/**
   Read a .scl, .ascl, .kbm or .body file.

   Its ending says what it is.  One of another ending is a mapping if it reads as one, or else a
   scale or a body.

   @param asked         What it counts as if neither its ending nor its text says
   @param may_quote     Whether the fault may tell what stands in the file
   @param[out] content  Not good if there is no such file, it cannot be read, or is not as it should
   be
   @param[out] fault    Written only then
*/
void files_read(
    const char* path, FilesKind asked, bool may_quote, FilesContent* content, FilesFault* fault);

#endif
