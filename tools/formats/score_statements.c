#include "tools/formats/score_statements.h"

#include "tools/formats/score_verbs.h"
#include "tools/formats/score_words.h"

#include <string.h>

typedef struct {
  const char* word;
  bool (*take)(ScoreReader* reader);
} Statement;

static bool fail_memory(ScoreReader* reader) {
  return scene_text_fail_at(&reader->text, reader->text.line, "out of memory");
}

static bool is_first(ScoreReader* reader, const char* word, uint32_t* line) {
  if (*line) {
    return scene_text_fail_at(&reader->text, reader->text.line,
                              "found a second '%s', expected the one in line %lu only", word,
                              (unsigned long)*line);
  }
  *line = reader->text.line;
  return true;
}

static bool change_tempo(ScoreReader* reader, ScoreSpan from) {
  double beats_a_minute = 0.0;
  return score_words_number(&reader->text, SCORE_BEATS_A_MINUTE, &beats_a_minute) &&
         score_words_end(&reader->text) &&
         (score_tempo_add(&reader->tempo, from, beats_a_minute) || fail_memory(reader));
}

static bool take_tempo(ScoreReader* reader) {
  return is_first(reader, "tempo", &reader->tempo_line) && change_tempo(reader, (ScoreSpan){0});
}

static bool take_meter(ScoreReader* reader) {
  if (reader->bars_line) {
    return scene_text_fail_at(&reader->text, reader->text.line,
                              "found 'meter' after bars in line %lu, expected it before",
                              (unsigned long)reader->bars_line);
  }
  return is_first(reader, "meter", &reader->meter_line) &&
         score_words_meter(&reader->text, &reader->meter) && score_words_end(&reader->text);
}

static bool add_setting(ScoreReader* reader, ScoreSetting setting) {
  setting.line = reader->text.line;
  return bytes_append(&reader->settings, &setting, sizeof(setting)) || fail_memory(reader);
}

static bool take_tuning(ScoreReader* reader) {
  static const char* const symbols[SCORE_STRINGS] = {"string1", "string2", "string3",
                                                     "string4", "string5", "string6"};
  if (!is_first(reader, "tuning", &reader->tuning_line)) {
    return false;
  }
  for (uint32_t i = 0; i < SCORE_STRINGS; ++i) {
    ScoreSetting setting = {.symbol = symbols[i]};
    if (!score_words_note(&reader->text, &setting.value) || !add_setting(reader, setting)) {
      return false;
    }
  }
  return score_words_end(&reader->text);
}

static bool take_capo(ScoreReader* reader) {
  ScoreSetting setting = {.symbol = "capo"};
  return is_first(reader, "capo", &reader->capo_line) &&
         score_words_number(&reader->text, SCORE_CAPO, &setting.value) &&
         score_words_end(&reader->text) && add_setting(reader, setting);
}

/* The range is the port's, which is not known here. */
static bool take_set(ScoreReader* reader) {
  ScoreSetting setting = {.symbol = scene_text_next_word(&reader->text)};
  if (!setting.symbol) {
    return scene_text_fail(&reader->text, NULL, "the symbol of a control");
  }
  setting.text = scene_text_next_word(&reader->text);
  if (!setting.text) {
    return scene_text_fail(&reader->text, NULL, "a value");
  }
  return score_words_end(&reader->text) && add_setting(reader, setting);
}

/* A name may be of several words: they are drawn together, one blank between two. */
static bool take_preset(ScoreReader* reader) {
  if (!is_first(reader, "preset", &reader->preset_line)) {
    return false;
  }
  reader->preset = scene_text_next_word(&reader->text);
  if (!reader->preset) {
    return scene_text_fail(&reader->text, NULL, "the name of a preset");
  }
  char* end = reader->preset + strlen(reader->preset);
  for (char* word = scene_text_next_word(&reader->text); word;
       word = scene_text_next_word(&reader->text)) {
    const size_t length = strlen(word);
    *end++ = ' ';
    memmove(end, word, length + 1);
    end += length;
  }
  return true;
}

static const Statement statements[] = {
    {"tempo", take_tempo}, {"meter", take_meter}, {"tuning", take_tuning},
    {"capo", take_capo},   {"set", take_set},     {"preset", take_preset},
};

enum { N_STATEMENTS = sizeof(statements) / sizeof(statements[0]) };

static bool read_setting(ScoreReader* reader, const char* word) {
  for (unsigned i = 0; i < N_STATEMENTS; ++i) {
    if (!strcmp(statements[i].word, word)) {
      return statements[i].take(reader);
    }
  }
  return scene_text_fail(&reader->text, word,
                         "a time, or tempo, meter, tuning, capo, set or preset");
}

/* A change of tempo has no use for a time that may depend on it. */
static bool read_change(ScoreReader* reader, char* time, const ScoreMoment* moment) {
  if (moment->is_relative) {
    return scene_text_fail(&reader->text, time, "seconds or BAR:BEAT, for a tempo");
  }
  return (bytes_append(&reader->moments, moment, sizeof(*moment)) || fail_memory(reader)) &&
         change_tempo(reader, moment->at);
}

static bool read_event(ScoreReader* reader, char* time) {
  ScoreMoment moment;
  if (!score_words_moment(reader, time, &moment)) {
    return false;
  }
  const char* const verb = scene_text_next_word(&reader->text);
  return verb && !strcmp(verb, "tempo") ? read_change(reader, time, &moment)
                                        : score_verbs_read(reader, verb, &moment);
}

bool score_statements_read(ScoreReader* reader) {
  SceneText* const text = &reader->text;
  if (text->length > SCORE_MAX_LINE) {
    return scene_text_fail_at(text, text->line, "found a line of %zu bytes, expected at most %d",
                              text->length, SCORE_MAX_LINE);
  }
  if (!scene_text_is_sound(text)) {
    return false;
  }
  char* const word = scene_text_next_word(text);
  if (!word) {
    return true;
  }
  return strchr("+-.0123456789", *word) ? read_event(reader, word) : read_setting(reader, word);
}
