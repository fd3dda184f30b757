/**
   What has been read of a score.

   Part of tools/formats/score.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCORE_READER_H
#define HOOKE_TOOLS_FORMATS_SCORE_READER_H

#include "tools/formats/bytes.h"
#include "tools/formats/scene_text.h"
#include "tools/formats/score.h"
#include "tools/formats/score_tempo.h"

#include <stdbool.h>
#include <stdint.h>

/** When a line acts. */
typedef struct {
  ScoreSpan at;     ///< From the start or the moment before
  bool is_relative; ///< To the moment before
  uint32_t line;    ///< Of the file
} ScoreMoment;

/** Which value of an event is a length of time that has to wait for the tempo. */
enum { SCORE_NO_LENGTH = -1 };

/** An event whose time is not known yet. */
typedef struct {
  GuitarEvent event;
  uint32_t moment;  ///< Its place in ScoreReader.moments
  ScoreSpan after;  ///< How long after that moment it acts
  ScoreSpan length; ///< Goes into a value of the event
  int length_at;    ///< Which one, or SCORE_NO_LENGTH
  bool is_stop;     ///< Of a vibrato; void if another one of the string began since
} ScorePending;

typedef struct {
  SceneText text;
  ScoreTempo tempo;
  Bytes moments;       ///< ScoreMoment each, in the order of lines
  Bytes pending;       ///< ScorePending each, in the order of lines
  Bytes settings;      ///< ScoreSetting each
  char* preset;        ///< In the text; NULL: none
  double meter;        ///< Beats a bar
  uint32_t bars_line;  ///< Where a time was first in bars; 0: nowhere yet
  uint32_t tempo_line; ///< Where each was said; 0: not yet
  uint32_t meter_line;
  uint32_t tuning_line;
  uint32_t capo_line;
  uint32_t preset_line;
} ScoreReader;

#endif
