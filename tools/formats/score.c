#include "tools/formats/score.h"

#include "tools/formats/score_statements.h"
#include "tools/formats/score_timeline.h"

#include <stdlib.h>

static const double USUAL_METER = 4.0;

static bool read_lines(ScoreReader* reader) {
  while (scene_text_next_line(&reader->text)) {
    if (!score_statements_read(reader)) {
      return false;
    }
  }
  const uint32_t line = reader->text.line;
  return reader->pending.size > 0 ||
         scene_text_fail_at(&reader->text, line ? line : 1,
                            "found the end of the file, expected an event");
}

/* What the reader has goes over to the score. */
static void fill(ScoreReader* reader, Score* score) {
  score->n_settings = reader->settings.size / sizeof(ScoreSetting);
  score->settings = (ScoreSetting*)(void*)reader->settings.data;
  score->preset = reader->preset;
  score->preset_line = reader->preset_line;
  score->text = reader->text.bytes;
  reader->settings = reader->text.bytes = (Bytes){0};
}

static Score* make_score(ScoreReader* reader) {
  Score* const score = calloc(1, sizeof(*score));
  if (!score) {
    (void)scene_text_fail_at(&reader->text, reader->text.line, "out of memory");
    return NULL;
  }
  if (!score_timeline_make(reader, score)) {
    free(score);
    return NULL;
  }
  fill(reader, score);
  return score;
}

Score* score_new(const char* path, char* error, size_t error_size) {
  ScoreReader reader = {.meter = USUAL_METER};
  Score* score = NULL;
  if (scene_text_init(&reader.text, path, error, error_size)) {
    reader.text.is_comment_apart = true;
    score = read_lines(&reader) ? make_score(&reader) : NULL;
  }
  scene_text_clear(&reader.text);
  score_tempo_clear(&reader.tempo);
  bytes_clear(&reader.moments);
  bytes_clear(&reader.pending);
  bytes_clear(&reader.settings);
  return score;
}

void score_free(Score* score) {
  if (score) {
    free(score->events);
    free(score->settings);
    bytes_clear(&score->text);
    free(score);
  }
}
