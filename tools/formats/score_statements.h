/**
   The lines of a score: each adds to what was read before.

   Part of tools/formats/score.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCORE_STATEMENTS_H
#define HOOKE_TOOLS_FORMATS_SCORE_STATEMENTS_H

#include "tools/formats/score_reader.h"

#include <stdbool.h>

/** Read the line that the text is at. @return false after a message */
bool score_statements_read(ScoreReader* reader);

#endif
