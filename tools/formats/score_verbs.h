/**
   The events of a score: what may follow a time.

   Part of tools/formats/score.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCORE_VERBS_H
#define HOOKE_TOOLS_FORMATS_SCORE_VERBS_H

#include "tools/formats/score_reader.h"

#include <stdbool.h>

/**
   Read the rest of a line that begins with a time, and add its events.

   @param word  The verb; NULL is the end of the line
   @return false after a message
*/
bool score_verbs_read(ScoreReader* reader, const char* word, const ScoreMoment* moment);

#endif
