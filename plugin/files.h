/**
   The files that a player gives an instrument, two that tune it and its body: it hears what a
   player's panel says of them, has them read by the host's worker, and tells the panel what holds.

   The files are parameters that are set and asked for by messages (patch:Set, patch:Get) at the
   control port, and are told of at the notify port when they were asked for or have changed; what
   the port has no room for is told as soon as it has.  Without a worker only a session or a preset
   can set them, and a message that would is answered with what holds.

   Thread: files_new() and files_free() anywhere but the audio thread; files_work() where the host
   wants; all else is the audio thread's, and real-time safe.
*/
#ifndef HOOKE_PLUGIN_FILES_H
#define HOOKE_PLUGIN_FILES_H

#include "plugin/files_urids.h"

#include <lv2/atom/atom.h>
#include <lv2/atom/forge.h>
#include <lv2/core/lv2.h>
#include <lv2/log/log.h>
#include <lv2/worker/worker.h>

enum { FILES_MESSAGE_SIZE = FILES_PATH_SIZE + 256 /**< Room for a message [bytes] */ };

/** What the worker is asked to do, cut behind the end of the path. */
typedef struct {
  uint32_t file; /**< A FilesKind */
  char path[FILES_PATH_SIZE];
} FilesRequest;

typedef struct {
  FilesUrids urids;
  const LV2_Log_Log* log;            /**< NULL: none is offered */
  const LV2_Worker_Schedule* worker; /**< The same */
  FilesStore store;

  /* Of the audio thread */
  LV2_Atom_Forge forge;
  FilesRequest requests[FILES_COUNT];
  bool is_wanted[FILES_COUNT]; /**< Whether the request waits for the worker to have room */
  bool is_due[FILES_COUNT];    /**< Whether the panel is to be told of the file */
  bool is_change_due;          /**< Whether the host is to be told that there is more to save */
  FilesCounts counts;          /**< Of the table when it was last looked at */
  _Alignas(8) uint8_t message[FILES_MESSAGE_SIZE];
} Files;

/** @return NULL if there is no memory; else the caller's, to files_free() */
Files*
files_new(const LV2_URID_Map* map, const LV2_Feature* const* features, const FilesNames* names);

/** Free it; NULL is ignored. */
void files_free(Files* files);

/** What is new since it was last asked. */
typedef struct {
  bool has_pitches;
  bool has_body;
} FilesNews;

/** Take what is new; what the two below return holds until the next call. */
FilesNews files_take(Files* files);

/** The pitches of all keys in semitones above A4; at first equal temperament's. */
const double* files_pitches(const Files* files);

/** The body; NULL, as at first: none. */
const Body* files_body(const Files* files);

/** Hear an event of the control port; what is no message about the files is ignored. */
void files_hear(Files* files, LV2_URID type, const uint8_t* body, uint32_t n_bytes);

/** Ask the worker for what is wanted; and add what there is to tell to the sequence, an
 * LV2_Atom_Sequence with room for `room` bytes behind its atom header, or NULL. */
void files_tell(Files* files, LV2_Atom_Sequence* notify, uint32_t room);

/** Do what a FilesRequest says. */
LV2_Worker_Status files_work(Files* files, uint32_t n_bytes, const void* request);

/** Load and complain, see files_store_load().  Thread: any but the audio thread. */
void files_load(Files* files, const char* const paths[FILES_COUNT], bool is_wish);

#endif
