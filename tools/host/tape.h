/**
   Sound that is kept until its peak is known.

   One thread.
*/
#ifndef HOOKE_TOOLS_HOST_TAPE_H
#define HOOKE_TOOLS_HOST_TAPE_H

#include "tools/host/play.h"

#include <stdbool.h>
#include <stdio.h>

/** A tape; all zero is none. */
typedef struct {
  FILE* file;      /**< Without a name, gone when it is closed */
  uint64_t frames; /**< On it */
} Tape;

/** Begin an empty tape. @return false, with a reason in `error`, if there is no room for one. */
bool tape_init(Tape* tape, char error[PLAY_ERROR_SIZE]);

void tape_clear(Tape* tape);

/** @return Where to play to, so as to have it on the tape */
PlaySink tape_sink(Tape* tape);

/** Rewind. @return What is on the tape, to be played with the rate and the block of what it was */
PlaySource tape_source(Tape* tape, const PlaySource* played);

#endif
