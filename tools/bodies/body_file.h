/**
   The body that a file describes: a table of modes (`.body`, core/bank/body_read.h), or a scene of
   masses and springs (`.scene`), which is reduced to its modes.

   Thread: any.  Takes memory.
*/
#ifndef HOOKE_TOOLS_BODIES_BODY_FILE_H
#define HOOKE_TOOLS_BODIES_BODY_FILE_H

#include "core/bank/body.h"
#include "tools/bodies/reduce.h"

#include <stdbool.h>
#include <stddef.h>

/** Room for any message about a path of usual length [bytes]. */
enum { BODY_FILE_ERROR_SIZE = 4608 };

/**
   Read the body of a file.

   @param path        Ends with .body or .scene
   @param[out] body   Untouched on failure
   @param[out] reduction  Of a scene; left without masses by a table; NULL if not wanted
   @param[out] error  On failure one line, without its end: "PATH:LINE: found …, expected …"
   @param error_size  Room in `error` [bytes]
   @return Whether it could be read
*/
bool body_file_read(
    const char* path, Body* body, Reduction* reduction, char* error, size_t error_size);

#endif
