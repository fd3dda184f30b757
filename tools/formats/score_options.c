#include "tools/formats/score_options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LIST_SIZE = 160 };

/* Half the width of the softest finger and of the hardest pick, as in core/excite/pluck.c. */
static const double SOFTEST = 0.3;
static const double HARDEST = 0.005;

typedef struct {
  const char* word;
  unsigned bit;
  unsigned alone; // Of these there is one at most
} Option;

static const Option options[] = {
    {"force", SCORE_OPTION_FORCE, SCORE_OPTION_FORCE},
    {"at", SCORE_OPTION_AT, SCORE_OPTION_AT},
    {"hardness", SCORE_OPTION_HARDNESS, SCORE_OPTION_FINGER},
    {"width", SCORE_OPTION_WIDTH, SCORE_OPTION_FINGER},
    {"down", SCORE_OPTION_DOWN, SCORE_OPTION_STROKE},
    {"up", SCORE_OPTION_UP, SCORE_OPTION_STROKE},
    {"rate", SCORE_OPTION_RATE, SCORE_OPTION_RATE},
    {"for", SCORE_OPTION_FOR, SCORE_OPTION_FOR},
    {"spread", SCORE_OPTION_SPREAD, SCORE_OPTION_SPREAD},
};

enum { N_OPTIONS = sizeof(options) / sizeof(options[0]) };

/* The exciter makes a finger of hardness q half as wide as 0.3 (0.005 / 0.3)^q, all of it twice
 * that. */
static double hardness_of(double width) {
  return fmin(fmax(log(width / 2.0 / SOFTEST) / log(HARDEST / SOFTEST), 0.0), 1.0);
}

static const Option* find(const char* word, unsigned allowed) {
  for (unsigned i = 0; i < N_OPTIONS; ++i) {
    if ((options[i].bit & allowed) && !strcmp(options[i].word, word)) {
      return &options[i];
    }
  }
  return NULL;
}

/* What could stand there: the options left and the end of the line. */
static bool refuse(SceneText* text, const char* word, unsigned allowed, unsigned given) {
  char list[LIST_SIZE] = "";
  int n = 0;
  for (unsigned i = 0; i < N_OPTIONS; ++i) {
    if ((options[i].bit & allowed) && !(options[i].alone & given)) {
      n += snprintf(list + n, sizeof(list) - (size_t)n, n ? ", %s" : "%s", options[i].word);
    }
  }
  (void)snprintf(list + n, sizeof(list) - (size_t)n, "%sthe end of the line", n ? " or " : "");
  return scene_text_fail(text, word, list);
}

static bool refuse_second(SceneText* text, const Option* option, unsigned given) {
  const Option* other = options;
  while (!(other->bit & given & option->alone)) {
    ++other;
  }
  return scene_text_fail_at(text, text->line, "found '%s' after '%s', expected one of them only",
                            option->word, other->word);
}

static bool take(SceneText* text, unsigned bit, ScoreOptions* out) {
  double width = 0.0;
  switch (bit) {
  case SCORE_OPTION_FORCE:
    return score_words_number(text, SCORE_FORCE, &out->force);
  case SCORE_OPTION_AT:
    return score_words_number(text, SCORE_PLACE, &out->place);
  case SCORE_OPTION_HARDNESS:
    return score_words_number(text, SCORE_HARDNESS, &out->hardness);
  case SCORE_OPTION_WIDTH:
    if (!score_words_number(text, SCORE_WIDTH, &width)) {
      return false;
    }
    out->hardness = hardness_of(width);
    return true;
  case SCORE_OPTION_RATE:
    return score_words_number(text, SCORE_RATE, &out->rate_hz);
  case SCORE_OPTION_FOR:
    return score_words_length(text, &out->length);
  case SCORE_OPTION_SPREAD:
    return score_words_length(text, &out->spread);
  default:
    return true;
  }
}

static bool has_all(SceneText* text, unsigned missing) {
  const Option* option = options;
  char expected[LIST_SIZE];
  if (!missing) {
    return true;
  }
  while (!(option->bit & missing)) {
    ++option;
  }
  (void)snprintf(expected, sizeof(expected), "'%s'", option->word);
  return scene_text_fail(text, NULL, expected);
}

bool score_options_read(SceneText* text, unsigned allowed, unsigned required, ScoreOptions* out) {
  *out = (ScoreOptions){0};
  for (const char* word = scene_text_next_word(text); word; word = scene_text_next_word(text)) {
    const Option* const option = find(word, allowed);
    if (!option) {
      return refuse(text, word, allowed, out->given);
    }
    if (out->given & option->alone) {
      return refuse_second(text, option, out->given);
    }
    if (!take(text, option->bit, out)) {
      return false;
    }
    out->given |= option->bit;
  }
  return has_all(text, required & ~out->given);
}
