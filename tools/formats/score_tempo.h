/**
   From beats to seconds and back, through all changes of tempo.

   Part of tools/formats/score.  Beats count from 0 at the start; the tempo is constant from one
   change to the next.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCORE_TEMPO_H
#define HOOKE_TOOLS_FORMATS_SCORE_TEMPO_H

#include "tools/formats/bytes.h"

#include <stdbool.h>

/** The tempo of a score that names none [beats a minute]. */
#define SCORE_USUAL_TEMPO 120.0

/** A moment, or a length of time. */
typedef struct {
  double value; /**< Seconds or beats, ≥ 0 */
  bool is_beats;
} ScoreSpan;

/** A map in the making; all zero is a valid one, without changes. */
typedef struct {
  Bytes changes; /**< As they were added */
  Bytes pieces;  /**< Of constant tempo, in order of time */
} ScoreTempo;

/** Change the tempo [beats a minute, > 0] from a moment on; of two changes at one moment the one
    added later holds. @return false: out of memory */
bool score_tempo_add(ScoreTempo* tempo, ScoreSpan from, double beats_per_minute);

/** Make the map, in n log n; call it once, before those below. @return false: out of memory */
bool score_tempo_finish(ScoreTempo* tempo);

/** @return When a beat is [s] */
double score_tempo_time_s(const ScoreTempo* tempo, double beats);

/** @return Which beat is at a time [s] */
double score_tempo_beats(const ScoreTempo* tempo, double time_s);

void score_tempo_clear(ScoreTempo* tempo);

#endif
