/**
   Who is told how far a long computation has come.

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_WATCH_H
#define HOOKE_CORE_ANALYSIS_MODES_WATCH_H

/** Somebody to be told, now and then, how much is done: `share` from 0 to 1. */
typedef struct {
  void (*tell)(void* self, double share);
  void* self;
} ModesWatch;

#endif
