/**
   The events of a score at their times, once its tempo is known everywhere.

   Part of tools/formats/score.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCORE_TIMELINE_H
#define HOOKE_TOOLS_FORMATS_SCORE_TIMELINE_H

#include "tools/formats/score_reader.h"

#include <stdbool.h>

/**
   Find the time of every event, and sort them.

   @param[out] score  Its events and its duration; untouched on failure
   @return false after a message
*/
bool score_timeline_make(ScoreReader* reader, Score* score);

#endif
