/**
   An instrument's tuning by files: it hears what a player's panel says of them, has them read by
   the host's worker, and tells the panel what holds.

   The files are parameters that are set and asked for by messages (patch:Set, patch:Get) at the
   control port, and are told of at the notify port when they were asked for or have changed; what
   the port has no room for is told as soon as it has.  Without a worker only a session or a preset
   can set them, and a message that would is answered with what holds.

   Thread: tuner_new() and tuner_free() anywhere but the audio thread; tuner_work() where the host
   wants; all else is the audio thread's, and real-time safe.
*/
#ifndef HOOKE_PLUGIN_TUNER_H
#define HOOKE_PLUGIN_TUNER_H

#include "plugin/tuner_urids.h"

#include <lv2/atom/atom.h>
#include <lv2/atom/forge.h>
#include <lv2/core/lv2.h>
#include <lv2/log/log.h>
#include <lv2/worker/worker.h>

enum { TUNER_MESSAGE_SIZE = TUNER_PATH_SIZE + 256 /**< Room for a message [bytes] */ };

/** What the worker is asked to do, cut behind the end of the path. */
typedef struct {
  uint32_t file; /**< A TunerFile */
  char path[TUNER_PATH_SIZE];
} TunerRequest;

typedef struct {
  TunerUrids urids;
  const LV2_Log_Log* log;            /**< NULL: none is offered */
  const LV2_Worker_Schedule* worker; /**< The same */
  TunerStore store;

  /* Of the audio thread */
  LV2_Atom_Forge forge;
  TunerRequest requests[TUNER_N_FILES];
  bool is_wanted[TUNER_N_FILES]; /**< Whether the request waits for the worker to have room */
  bool is_due[TUNER_N_FILES];    /**< Whether the panel is to be told of the file */
  bool is_change_due;            /**< Whether the host is to be told that there is more to save */
  uint32_t n_wishes;             /**< Of the table when it was last looked at */
  _Alignas(8) uint8_t message[TUNER_MESSAGE_SIZE];
} Tuner;

/** @return NULL if there is no memory; else the caller's, to tuner_free() */
Tuner*
tuner_new(const LV2_URID_Map* map, const LV2_Feature* const* features, const TunerNames* names);

/** Free it; NULL is ignored. */
void tuner_free(Tuner* tuner);

/** The pitches of all keys in semitones above A4 if they are new since the last call, else NULL;
 * they hold until the next call. */
const double* tuner_take(Tuner* tuner);

/** Those that were taken last; at first equal temperament's. */
const double* tuner_pitches(const Tuner* tuner);

/** Hear an event of the control port; what is no message about the files is ignored. */
void tuner_hear(Tuner* tuner, LV2_URID type, const uint8_t* body, uint32_t n_bytes);

/** Ask the worker for what is wanted; and add what there is to tell to the sequence, an
 * LV2_Atom_Sequence with room for `room` bytes behind its atom header, or NULL. */
void tuner_tell(Tuner* tuner, LV2_Atom_Sequence* notify, uint32_t room);

/** Do what a TunerRequest says. */
LV2_Worker_Status tuner_work(Tuner* tuner, uint32_t n_bytes, const void* request);

/** Load and complain, see tuner_store_load().  Thread: any but the audio thread. */
void tuner_load(Tuner* tuner, const char* const paths[TUNER_N_FILES], bool is_wish);

#endif
