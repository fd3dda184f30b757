/**
   A score: what a guitarist's hands do, and when.

   A score file is text, an event a line; `hooke help score` (score_help) describes it in full.

       # a comment
       tempo 96                                 beats a minute, from the start
       meter 3/4                                beats a bar
       9:1 tempo 80                             from there on
       tuning E4 B3 G3 D3 A2 E2                 what is set before the start
       capo 2
       set level -6
       preset NAME
       T pluck S …  fret S F  hammer S F  pull S F  lift S  slide S F for T  bend S SEMITONES
       T vibrato S DEPTH  damp S  ring S  touch S at P for T  harmonic S N  palm W  mute
       T strum down|up F F F F F F

   T is in seconds, BAR:BEAT from 1:1 on, or +T after the line above that has a time; lengths are in
   seconds, or in beats behind which there is a b.  S counts from 1, the highest string.

   Thread: any, one at a time for each score.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCORE_H
#define HOOKE_TOOLS_FORMATS_SCORE_H

#include "core/guitar/guitar_event.h"
#include "tools/formats/bytes.h"

#include <stddef.h>
#include <stdint.h>

enum {
  SCORE_STRINGS = 6,          /**< Of the plugin, with the control ports string1 to string6 */
  SCORE_MAX_EVENTS = 1000000, /**< A strum being up to twelve */
  SCORE_MAX_LINE = 65536,     /**< [bytes] */
  SCORE_ERROR_SIZE = 4608     /**< Room for any message about a path of usual length [bytes] */
};

/** The latest time, and the longest length of time [s]. */
#define SCORE_MAX_TIME_S 3600.0

/** What `hooke help score` says. */
extern const char score_help[];

typedef struct {
  double time_s;     /**< ≥ 0 [s] */
  uint32_t line;     /**< Of the file, from 1 */
  GuitarEvent event; /**< In range for a guitar of SCORE_STRINGS strings */
} ScoreEvent;

/** A control port to be set before the start. */
typedef struct {
  const char* symbol;
  const char* text; /**< What is to stand behind "SYMBOL="; NULL: `value` is meant */
  double value;
  uint32_t line; /**< Of the file */
} ScoreSetting;

typedef struct {
  ScoreEvent*
      events;      /**< By time; at one time in the order of lines; a strum's as they are played */
  size_t n_events; /**< ≥ 1 */
  ScoreSetting* settings; /**< In the order of lines */
  size_t n_settings;
  const char* preset;   /**< To be loaded before the settings; NULL: none */
  uint32_t preset_line; /**< Of the file */
  double duration_s;    /**< Time of the last event [s] */
  Bytes text;           /**< Which symbols and names are in */
} Score;

/**
   Read a score file, in n log n.

   @param[out] error  On failure one line, without its end: "PATH:LINE: found …, expected …"
   @param error_size  Room in `error` [bytes]
   @return The score, to be given to score_free(), or NULL on failure
*/
Score* score_new(const char* path, char* error, size_t error_size);

/** Free a score; NULL is fine. */
void score_free(Score* score);

#endif
