/**
   A directory that is filled whole or not at all: files are made in a hidden directory inside it
   and moved up when all are there.

   Life: report_place_open(), files, then report_place_keep() or report_place_drop().
   Thread: any; one at a time.
*/
#ifndef HOOKE_TOOLS_REPORT_REPORT_PLACE_H
#define HOOKE_TOOLS_REPORT_REPORT_PLACE_H

#include <stdbool.h>
#include <stdio.h>

/** All but `part_fd` is the place's own. */
typedef struct {
  const char* path; /**< As given; kept by the caller */
  char name[48];    /**< Of the hidden directory */
  int fd;
  int part_fd;  /**< The hidden directory */
  bool is_made; /**< Whether the directory is ours to remove */
} ReportPlace;

/**
   Make the directory if need be, but not one above it, and the hidden one in it.

   @return false, with errno set and nothing made, if that cannot be
*/
bool report_place_open(ReportPlace* place, const char* path);

/** Open a new file. @return NULL with errno set if that cannot be; to be given to
 * report_place_close() */
FILE* report_place_file(const ReportPlace* place, const char* name);

/** @return Whether all that was written is in the file */
bool report_place_close(FILE* file);

/** Read a whole file. @return Its bytes, for free(), with a zero after them; or NULL with errno */
char* report_place_read(const ReportPlace* place, const char* name, size_t* n_bytes);

/** Move all files up, over those of the same names. @return false with errno set, as if dropped */
bool report_place_keep(ReportPlace* place);

/** Remove all that was made.  errno is kept. */
void report_place_drop(ReportPlace* place);

#endif
