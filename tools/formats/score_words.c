#include "tools/formats/score_words.h"

#include <math.h>
#include <string.h>

static const double MAX_BEATS = 1e6;
static const double MAX_BAR = 1e5;
static const double MAX_NOTE = 127.0;
static const double MAX_METER = 64.0;

typedef struct {
  const char* expected; // Completes "found …, expected …"
  double min;
  double max;
  bool is_whole;
} Rule;

static const Rule rules[] = {
    [SCORE_STRING] = {"a string from 1, the highest, to 6", 1, SCORE_STRINGS, true},
    [SCORE_FRET] = {"a fret from 0 to 24", 0, 24, false},
    [SCORE_CAPO] = {"a capo at a whole fret from 0 to 24", 0, 24, true},
    [SCORE_SEMITONES] = {"a bend from -12 to 24 semitones", -12, 24, false},
    [SCORE_DEPTH] = {"a depth from 0 to 12 semitones", 0, 12, false},
    [SCORE_NODE] = {"a whole number from 2 to 20, of the harmonic", 2, 20, true},
    [SCORE_WEIGHT] = {"a weight from 0 to 1", 0, 1, false},
    [SCORE_FORCE] = {"a force from 0 to 1", 0, 1, false},
    [SCORE_PLACE] = {"a place from 0 to 1, from the bridge", 0, 1, false},
    [SCORE_HARDNESS] = {"a hardness from 0 to 1", 0, 1, false},
    [SCORE_WIDTH] = {"a width from 0.01 to 0.6 of the string", 0.01, 0.6, false},
    [SCORE_RATE] = {"a rate from 0.1 to 20 Hz", 0.1, 20, false},
    [SCORE_BEATS_A_MINUTE] = {"a tempo from 1 to 1000 beats a minute", 1, 1000, false},
};

static const char A_LENGTH[] = "a length from 0 to 3600 s, or in beats, as 1.5b";
static const char A_TIME[] = "a time: seconds from 0 to 3600, BAR:BEAT, or +T after the line above";
static const char A_NOTE[] = "a note, as E4, F#3 or Bb2, or as a MIDI number from 0 to 127";
static const char A_METER[] = "a meter, as 4 or 3/4, of 1 to 64 beats";

static bool read_whole(const char* word, double min, double max, double* number) {
  return scene_text_number(word, min, max, number) && *number == floor(*number);
}

bool score_words_number(SceneText* text, ScoreNumber what, double* number) {
  const Rule* const rule = &rules[what];
  const char* const word = scene_text_next_word(text);
  return (word && scene_text_number(word, rule->min, rule->max, number) &&
          (!rule->is_whole || *number == floor(*number))) ||
         scene_text_fail(text, word, rule->expected);
}

bool score_words_chord_fret(SceneText* text, uint32_t string, double* fret) {
  const Rule* const rule = &rules[SCORE_FRET];
  const char* const word = scene_text_next_word(text);
  *fret = (double)NAN;
  if (word && (!strcmp(word, "x") || !strcmp(word, "X") ||
               scene_text_number(word, rule->min, rule->max, fret))) {
    return true;
  }
  char quote[SCENE_TEXT_QUOTE_SIZE];
  return scene_text_fail_at(text, text->line, "found %s, expected %s, or x, for string %u",
                            scene_text_quote(word, quote), rule->expected, string + 1);
}

/* A letter, a sharp or flat, and the octave, which begins at C. */
static bool read_named_note(const char* word, double* note) {
  static const char letters[] = "CcDdEeFfGgAaBb";
  static const int semitones[] = {0, 2, 4, 5, 7, 9, 11};
  const char* const letter = *word ? strchr(letters, *word) : NULL;
  double octave = 0.0;
  if (!letter) {
    return false;
  }
  const long key = (letter - letters) / 2;
  const int step = word[1] == '#' ? 1 : word[1] == 'b' ? -1 : 0;
  if (!read_whole(word + (step ? 2 : 1), -1.0, 9.0, &octave)) {
    return false;
  }
  *note = 12.0 * (octave + 1.0) + semitones[key] + step;
  return *note >= 0.0 && *note <= MAX_NOTE;
}

bool score_words_note(SceneText* text, double* note) {
  const char* const word = scene_text_next_word(text);
  return (word && (read_named_note(word, note) || read_whole(word, 0.0, MAX_NOTE, note))) ||
         scene_text_fail(text, word, A_NOTE);
}

/* Beats have a b behind the number, and no length has a sign. */
static bool read_length(char* word, ScoreSpan* length) {
  const size_t size = strlen(word);
  char* const last = word + (size ? size - 1 : 0);
  if (!strchr("0123456789.", *word)) {
    return false;
  }
  length->is_beats = *last == 'b';
  if (!length->is_beats) {
    return scene_text_number(word, 0.0, SCORE_MAX_TIME_S, &length->value);
  }
  *last = '\0';
  const bool is_read = scene_text_number(word, 0.0, MAX_BEATS, &length->value);
  *last = 'b';
  return is_read;
}

bool score_words_length(SceneText* text, ScoreSpan* length) {
  char* const word = scene_text_next_word(text);
  return (word && read_length(word, length)) || scene_text_fail(text, word, A_LENGTH);
}

/* What a beat is called does not matter here. */
bool score_words_meter(SceneText* text, double* meter) {
  char* const word = scene_text_next_word(text);
  char* const slash = word ? strchr(word, '/') : NULL;
  double note = 4.0;
  if (slash) {
    *slash = '\0';
  }
  const bool is_read =
      word && read_whole(word, 1.0, MAX_METER, meter) &&
      (!slash || (read_whole(slash + 1, 1.0, MAX_METER, &note) && log2(note) == floor(log2(note))));
  if (slash) {
    *slash = '/';
  }
  return is_read || scene_text_fail(text, word, A_METER);
}

/* `colon` is in `word`. */
static bool read_bars(ScoreReader* reader, char* word, char* colon, ScoreMoment* moment) {
  double bar = 0.0;
  double beat = 0.0;
  *colon = '\0';
  const bool is_read = read_whole(word, 1.0, MAX_BAR, &bar) &&
                       scene_text_number(colon + 1, 1.0, reader->meter + 1.0, &beat) &&
                       beat < reader->meter + 1.0;
  *colon = ':';
  if (!is_read) {
    char quote[SCENE_TEXT_QUOTE_SIZE];
    return scene_text_fail_at(
        &reader->text, reader->text.line,
        "found %s, expected BAR:BEAT, a bar from 1 to 100000 and a beat from 1 to below %g",
        scene_text_quote(word, quote), reader->meter + 1.0);
  }
  reader->bars_line = reader->bars_line ? reader->bars_line : reader->text.line;
  moment->at = (ScoreSpan){(bar - 1.0) * reader->meter + beat - 1.0, true};
  return true;
}

bool score_words_moment(ScoreReader* reader, char* word, ScoreMoment* moment) {
  char* const colon = strchr(word, ':');
  *moment = (ScoreMoment){.line = reader->text.line, .is_relative = *word == '+'};
  if (moment->is_relative) {
    return read_length(word + 1, &moment->at) || scene_text_fail(&reader->text, word, A_TIME);
  }
  return colon ? read_bars(reader, word, colon, moment)
               : scene_text_number(word, 0.0, SCORE_MAX_TIME_S, &moment->at.value) ||
                     scene_text_fail(&reader->text, word, A_TIME);
}

bool score_words_end(SceneText* text) {
  const char* const word = scene_text_next_word(text);
  return !word || scene_text_fail(text, word, "the end of the line");
}
