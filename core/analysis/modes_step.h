/**
   The largest stable time step of a network: the least positive h at which  4 I − 2h Ẑ − h² K̂  is
   singular (core/analysis/modes.h), by trying steps until nothing lies between a stable one and an
   unstable one.

   Part of core/analysis/modes.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_STEP_H
#define HOOKE_CORE_ANALYSIS_MODES_STEP_H

#include "core/analysis/modes_frame.h"
#include "core/analysis/modes_watch.h"
#include "core/base/status.h"

/**
   @param watch        Told of each step that was tried; NULL: nobody
   @param[out] step_s  [s]; INFINITY where nothing is linked to anything; untouched on failure
   @return STATUS_OK or STATUS_NO_MEMORY
*/
Status step_find(const Frame* frame, const ModesWatch* watch, double* step_s);

#endif
