/**
   The words of a score: numbers in their ranges, notes, times and lengths.

   Part of tools/formats/score.  Whatever returns a bool here returns false after a message.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCORE_WORDS_H
#define HOOKE_TOOLS_FORMATS_SCORE_WORDS_H

#include "tools/formats/score_reader.h"

#include <stdbool.h>

/** What a number is. */
typedef enum {
  SCORE_NOTHING, ///< No number at all
  SCORE_STRING,
  SCORE_FRET,
  SCORE_CAPO,
  SCORE_SEMITONES,
  SCORE_DEPTH,
  SCORE_NODE,
  SCORE_WEIGHT,
  SCORE_FORCE,
  SCORE_PLACE,
  SCORE_HARDNESS,
  SCORE_WIDTH,
  SCORE_RATE,
  SCORE_BEATS_A_MINUTE
} ScoreNumber;

/** Take the next word as a number. */
bool score_words_number(SceneText* text, ScoreNumber what, double* number);

/** Take the next word as a fret of a chord: NAN for x. */
bool score_words_chord_fret(SceneText* text, uint32_t string, double* fret);

/** Take the next word as a note, by its name or MIDI number. */
bool score_words_note(SceneText* text, double* note);

/** Take the next word as a length of time, in seconds or beats. */
bool score_words_length(SceneText* text, ScoreSpan* length);

/** Take the next word as a meter, in beats a bar. */
bool score_words_meter(SceneText* text, double* meter);

/** Read `word` as a time. */
bool score_words_moment(ScoreReader* reader, char* word, ScoreMoment* moment);

/** @return Whether the line has no more words */
bool score_words_end(SceneText* text);

#endif
