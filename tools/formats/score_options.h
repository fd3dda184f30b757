/**
   What may follow in a line of a score, in any order: each option a word, and most a value.

   Part of tools/formats/score.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCORE_OPTIONS_H
#define HOOKE_TOOLS_FORMATS_SCORE_OPTIONS_H

#include "tools/formats/score_words.h"

#include <stdbool.h>

/** Sets of options. */
enum {
  SCORE_OPTION_FORCE = 1,
  SCORE_OPTION_AT = 2,
  SCORE_OPTION_HARDNESS = 4,
  SCORE_OPTION_WIDTH = 8,
  SCORE_OPTION_DOWN = 16,
  SCORE_OPTION_UP = 32,
  SCORE_OPTION_RATE = 64,
  SCORE_OPTION_FOR = 128,
  SCORE_OPTION_SPREAD = 256,
  SCORE_OPTION_STROKE = SCORE_OPTION_DOWN | SCORE_OPTION_UP,
  SCORE_OPTION_FINGER = SCORE_OPTION_HARDNESS | SCORE_OPTION_WIDTH
};

/** What was found; a value is meant where its option is in `given`. */
typedef struct {
  unsigned given;
  double force;
  double place;
  double hardness; ///< Of SCORE_OPTION_WIDTH too
  double rate_hz;
  ScoreSpan length;
  ScoreSpan spread;
} ScoreOptions;

/**
   Read the rest of the line.

   @param allowed   The options that there may be
   @param required  Those of them that there must be
   @return false after a message
*/
bool score_options_read(SceneText* text, unsigned allowed, unsigned required, ScoreOptions* out);

#endif
