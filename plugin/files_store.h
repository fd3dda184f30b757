/**
   The files that a player gives an instrument, two that tune it and its body, and the table that
   they make.

   Who loads and who plays share three tables: one is written, one is read, and the third, the last
   that was finished, lies between them and changes hands in one exchange.  So the audio thread
   neither waits nor frees anything, and a table that it did not come to take is written over.

   A file that is missing or broken counts as none, so that what is heard follows from the paths
   and what lies there, and from nothing that was before; its path is kept.
*/
#ifndef HOOKE_PLUGIN_FILES_STORE_H
#define HOOKE_PLUGIN_FILES_STORE_H

#include "plugin/files_read.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

/** An empty one is no file. */
typedef struct {
  char path[FILES_COUNT][FILES_PATH_SIZE];
} FilesPaths;

/** What there was so far. */
typedef struct {
  uint32_t n_wishes;  /**< Loads that a player asked for */
  uint32_t n_tunings; /**< Those of a scale or a mapping, or of none */
  uint32_t n_bodies;  /**< Bodies, each unlike the one before */
} FilesCounts;

/** What they make. */
typedef struct {
  double semitones[SCALE_KEYS]; /**< Of every key above A4; NAN: it has no pitch */
  Body body;                    /**< Without modes: none */
  FilesPaths paths;
  FilesCounts counts;
} FilesTable;

typedef struct {
  /* Of those who load, one at a time */
  pthread_mutex_t lock;
  Scale scale;
  ScaleMap map;
  Body body;
  FilesPaths paths;
  FilesCounts counts;
  uint32_t written; /**< Index of the table that is written */

  /* Of both */
  atomic_uint between; /**< Index of the table between them, and whether it is a new one */

  /* Of the audio thread */
  uint32_t played; /**< Index of the table that is read */

  FilesTable tables[3];
} FilesStore;

/** Without files: equal temperament, and no body.  @return false if it cannot be had */
bool files_store_init(FilesStore* store);

void files_store_clear(FilesStore* store);

/** What is wrong with each file; an empty line: nothing. */
typedef struct {
  FilesFault fault[FILES_COUNT];
} FilesFaults;

/**
   Read files, or forget them, and hand the table that results to the audio thread.  A file is kept
   as what it is, whichever it was given as.

   Thread: any, several at a time; takes memory, waits and reads files, so never the audio thread
   but where a host has the work done there.

   @param paths     Of less than FILES_PATH_SIZE bytes, others are cut; empty: no file; NULL: as it
   was, and not read again
   @param is_wish   Whether a player asked for it, and not a session, which may come from anywhere:
   then no word of what stands in the file is told
   @param[out] faults  What is wrong with those that were read
*/
void files_store_load(FilesStore* store,
                      const char* const paths[FILES_COUNT],
                      bool is_wish,
                      FilesFaults* faults);

/** Copy the paths.  Thread: as for files_store_load(). */
void files_store_paths(FilesStore* store, FilesPaths* paths);

/** Take a new table if there is one.  Thread: audio; real-time safe. */
bool files_store_take(FilesStore* store);

/** The table that was taken last; at first that of no files.  Thread: audio; real-time safe. */
const FilesTable* files_store_table(const FilesStore* store);

#endif
