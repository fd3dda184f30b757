/**
   Where bytes go: a file that is there when it is whole, and not before; or a pipe or a device,
   which get them when all are there.

   One at a time in a process.  One thread.
*/
#ifndef HOOKE_TOOLS_FORMATS_OUTFILE_H
#define HOOKE_TOOLS_FORMATS_OUTFILE_H

#include <stdbool.h>
#include <stddef.h>

/** Room for a path, with its NUL [bytes]. */
enum { OUTFILE_PATH_SIZE = 4096 };

/** One that is open. */
typedef struct {
  int fd;         /**< To write to, and to go back in */
  bool is_stream; /**< A pipe, a device, or what stdout is: `fd` is a file without a name */
  char path[OUTFILE_PATH_SIZE]; /**< Where it goes: no link, unless it is a stream */
} Outfile;

/** @return Whether there is something of that name which is no file: a pipe, a device */
bool outfile_is_stream(const char* path);

/** @return Whether that is where stdout goes */
bool outfile_is_stdout(const char* path);

/** @return Whether both names are of one file, be it by a link. */
bool outfile_is_same(const char* path, const char* other);

/**
   Begin: beside the file, or beside that to which a link leads, under a name that ends in
   ".PID.part". A file that is there keeps its mode, and must be one that may be written.

   @param[out] error  One line, on failure
   @param error_size  Room in `error` [bytes]
   @return false on failure, and nothing is left behind.
*/
bool outfile_open(Outfile* file, const char* path, char* error, size_t error_size);

/** Give the file its name, or the stream its bytes. @return 0, or the reason as errno has it:
 * then there is nothing of it, and a file of that name from before is as it was */
int outfile_finish(Outfile* file);

/** Give it up. */
void outfile_drop(Outfile* file);

#endif
