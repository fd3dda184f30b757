#include "tools/formats/score_verbs.h"

#include "tools/formats/score_options.h"
#include "tools/formats/score_words.h"

#include <math.h>
#include <string.h>

static const double USUAL_FORCE = 0.7;
static const double USUAL_HAMMER = 0.5;
static const double USUAL_RATE_HZ = 5.0;
static const double USUAL_SPREAD_S = 0.02;
static const double USUAL_TOUCH_S = 0.15;

enum {
  PLUCK_OPTIONS = SCORE_OPTION_FORCE | SCORE_OPTION_AT | SCORE_OPTION_FINGER | SCORE_OPTION_STROKE,
  STRUM_OPTIONS = SCORE_OPTION_FORCE | SCORE_OPTION_AT | SCORE_OPTION_FINGER | SCORE_OPTION_SPREAD
};

/* What stands between the verb and the options. */
typedef enum { ON_ALL, ON_STRING, ON_CHORD } Object;

typedef struct {
  uint32_t string;            // Of ON_STRING
  double number;              // Unless SCORE_NOTHING
  double fret[SCORE_STRINGS]; // Of ON_CHORD, as strings count; NAN: not played
  bool is_up;                 // Of ON_CHORD
  ScoreOptions options;
} Line;

typedef struct {
  const char* word;
  Object object;
  ScoreNumber number;
  unsigned allowed;
  unsigned required;
  bool (*take)(ScoreReader* reader, const Line* line);
} Verb;

static bool is_given(const Line* line, unsigned option) {
  return (line->options.given & option) != 0;
}

static double given_or(const Line* line, unsigned option, double value, double otherwise) {
  return is_given(line, option) ? value : otherwise;
}

static ScorePending event_of(GuitarVerb verb, uint32_t string, double value) {
  return (ScorePending){.event = {(uint32_t)verb, string, {(float)value, 0.0F, 0.0F}},
                        .length_at = SCORE_NO_LENGTH};
}

static bool add(ScoreReader* reader, ScorePending pending) {
  if (reader->pending.size / sizeof(pending) >= SCORE_MAX_EVENTS) {
    return scene_text_fail_at(&reader->text, reader->text.line,
                              "found more than %d events, expected no more", SCORE_MAX_EVENTS);
  }
  pending.moment = (uint32_t)(reader->moments.size / sizeof(ScoreMoment)) - 1;
  return bytes_append(&reader->pending, &pending, sizeof(pending)) ||
         scene_text_fail_at(&reader->text, reader->text.line, "out of memory");
}

/* An event whose value `at` is as long as 'for' says. */
static bool add_long(ScoreReader* reader, const Line* line, ScorePending pending, int at) {
  pending.length = line->options.length;
  pending.length_at = at;
  return add(reader, pending);
}

static ScorePending pluck_of(const Line* line, uint32_t string, bool is_up) {
  const ScoreOptions* const options = &line->options;
  const double force = given_or(line, SCORE_OPTION_FORCE, options->force, USUAL_FORCE);
  ScorePending pluck = event_of(GUITAR_PLUCK, string, is_up ? -force : force);
  pluck.event.value[1] = (float)given_or(line, SCORE_OPTION_AT, options->place, (double)NAN);
  pluck.event.value[2] = (float)given_or(line, SCORE_OPTION_FINGER, options->hardness, (double)NAN);
  return pluck;
}

static bool take_pluck(ScoreReader* reader, const Line* line) {
  return add(reader, pluck_of(line, line->string, is_given(line, SCORE_OPTION_UP)));
}

static bool take_fret(ScoreReader* reader, const Line* line) {
  return add(reader, event_of(GUITAR_FRET, line->string, line->number));
}

static bool take_hammer(ScoreReader* reader, const Line* line) {
  ScorePending hammer = event_of(GUITAR_HAMMER, line->string, line->number);
  hammer.event.value[1] =
      (float)given_or(line, SCORE_OPTION_FORCE, line->options.force, USUAL_HAMMER);
  return add(reader, hammer);
}

static bool take_slide(ScoreReader* reader, const Line* line) {
  return add_long(reader, line, event_of(GUITAR_SLIDE, line->string, line->number), 1);
}

static bool take_bend(ScoreReader* reader, const Line* line) {
  return add_long(reader, line, event_of(GUITAR_BEND, line->string, line->number), 1);
}

static bool take_vibrato(ScoreReader* reader, const Line* line) {
  ScorePending vibrato = event_of(GUITAR_VIBRATO, line->string, line->number);
  vibrato.event.value[1] =
      (float)given_or(line, SCORE_OPTION_RATE, line->options.rate_hz, USUAL_RATE_HZ);
  if (!add(reader, vibrato)) {
    return false;
  }
  if (!is_given(line, SCORE_OPTION_FOR)) {
    return true;
  }
  vibrato.event.value[0] = 0.0F;
  vibrato.after = line->options.length;
  vibrato.is_stop = true;
  return add(reader, vibrato);
}

static bool damp(ScoreReader* reader, const Line* line, uint32_t string) {
  const ScorePending damping = event_of(GUITAR_DAMP, string, (double)INFINITY);
  return is_given(line, SCORE_OPTION_FOR) ? add_long(reader, line, damping, 0)
                                          : add(reader, damping);
}

static bool take_damp(ScoreReader* reader, const Line* line) {
  return damp(reader, line, line->string);
}

static bool take_mute(ScoreReader* reader, const Line* line) {
  for (uint32_t string = 0; string < SCORE_STRINGS; ++string) {
    if (!damp(reader, line, string)) {
      return false;
    }
  }
  return true;
}

static bool take_ring(ScoreReader* reader, const Line* line) {
  return add(reader, event_of(GUITAR_LET_RING, line->string, 0.0));
}

static bool take_touch(ScoreReader* reader, const Line* line) {
  return add_long(reader, line, event_of(GUITAR_TOUCH, line->string, line->options.place), 1);
}

static bool take_harmonic(ScoreReader* reader, const Line* line) {
  ScorePending touch = event_of(GUITAR_TOUCH, line->string, 1.0 / line->number);
  touch.length =
      is_given(line, SCORE_OPTION_FOR) ? line->options.length : (ScoreSpan){.value = USUAL_TOUCH_S};
  touch.length_at = 1;
  return add(reader, touch) && take_pluck(reader, line);
}

static bool take_palm(ScoreReader* reader, const Line* line) {
  return add(reader, event_of(GUITAR_PALM, 0, line->number));
}

static bool finger_chord(ScoreReader* reader, const Line* line) {
  bool is_ok = true;
  for (uint32_t i = SCORE_STRINGS; is_ok && i-- > 0;) {
    is_ok = add(reader, isnan(line->fret[i]) ? event_of(GUITAR_DAMP, i, (double)INFINITY)
                                             : event_of(GUITAR_FRET, i, line->fret[i]));
  }
  return is_ok;
}

/* The hand is at the first string that it plays when the line begins, and passes over the others at
 * an even pace. */
static bool take_strum(ScoreReader* reader, const Line* line) {
  const ScoreSpan usual = {.value = USUAL_SPREAD_S};
  const ScoreSpan spread = is_given(line, SCORE_OPTION_SPREAD) ? line->options.spread : usual;
  bool is_ok = finger_chord(reader, line);
  int n_passed = 0;
  for (uint32_t i = 0; is_ok && i < SCORE_STRINGS; ++i) {
    const uint32_t string = line->is_up ? i : SCORE_STRINGS - 1 - i;
    const bool is_played = !isnan(line->fret[string]);
    if (is_played) {
      ScorePending pluck = pluck_of(line, string, line->is_up);
      pluck.after = (ScoreSpan){n_passed * spread.value, spread.is_beats};
      is_ok = add(reader, pluck);
    }
    n_passed += is_played || n_passed > 0 ? 1 : 0;
  }
  return is_ok;
}

static const Verb verbs[] = {
    {"pluck", ON_STRING, SCORE_NOTHING, PLUCK_OPTIONS, 0, take_pluck},
    {"fret", ON_STRING, SCORE_FRET, 0, 0, take_fret},
    {"hammer", ON_STRING, SCORE_FRET, SCORE_OPTION_FORCE, 0, take_hammer},
    {"pull", ON_STRING, SCORE_FRET, SCORE_OPTION_FORCE, 0, take_hammer},
    {"lift", ON_STRING, SCORE_NOTHING, 0, 0, take_fret},
    {"slide", ON_STRING, SCORE_FRET, SCORE_OPTION_FOR, SCORE_OPTION_FOR, take_slide},
    {"bend", ON_STRING, SCORE_SEMITONES, SCORE_OPTION_FOR, 0, take_bend},
    {"vibrato", ON_STRING, SCORE_DEPTH, SCORE_OPTION_RATE | SCORE_OPTION_FOR, 0, take_vibrato},
    {"damp", ON_STRING, SCORE_NOTHING, SCORE_OPTION_FOR, 0, take_damp},
    {"ring", ON_STRING, SCORE_NOTHING, 0, 0, take_ring},
    {"touch", ON_STRING, SCORE_NOTHING, SCORE_OPTION_AT | SCORE_OPTION_FOR,
     SCORE_OPTION_AT | SCORE_OPTION_FOR, take_touch},
    {"harmonic", ON_STRING, SCORE_NODE, PLUCK_OPTIONS | SCORE_OPTION_FOR, 0, take_harmonic},
    {"palm", ON_ALL, SCORE_WEIGHT, 0, 0, take_palm},
    {"mute", ON_ALL, SCORE_NOTHING, SCORE_OPTION_FOR, 0, take_mute},
    {"strum", ON_CHORD, SCORE_NOTHING, STRUM_OPTIONS, 0, take_strum},
};

enum { N_VERBS = sizeof(verbs) / sizeof(verbs[0]) };

static const Verb* find(const char* word) {
  for (unsigned i = 0; word && i < N_VERBS; ++i) {
    if (!strcmp(verbs[i].word, word)) {
      return &verbs[i];
    }
  }
  return NULL;
}

/* As chord charts do: the lowest string first. */
static bool read_chord(SceneText* text, Line* line) {
  const char* const stroke = scene_text_next_word(text);
  if (!stroke || (strcmp(stroke, "down") != 0 && strcmp(stroke, "up") != 0)) {
    return scene_text_fail(text, stroke, "down or up");
  }
  line->is_up = !strcmp(stroke, "up");
  bool is_played = false;
  for (uint32_t i = SCORE_STRINGS; i-- > 0;) {
    if (!score_words_chord_fret(text, i, &line->fret[i])) {
      return false;
    }
    is_played = is_played || !isnan(line->fret[i]);
  }
  return is_played || scene_text_fail(text, "x", "a fret for one string at least");
}

static bool read_object(SceneText* text, Object object, Line* line) {
  double string = 1.0;
  const bool is_ok = object == ON_CHORD    ? read_chord(text, line)
                     : object == ON_STRING ? score_words_number(text, SCORE_STRING, &string)
                                           : true;
  line->string = is_ok ? (uint32_t)string - 1 : 0;
  return is_ok;
}

bool score_verbs_read(ScoreReader* reader, const char* word, const ScoreMoment* moment) {
  SceneText* const text = &reader->text;
  const Verb* const verb = find(word);
  Line line = {0};
  if (!verb) {
    return scene_text_fail(text, word,
                           "tempo or pluck, fret, hammer, pull, lift, slide, bend, vibrato, damp, "
                           "ring, touch, harmonic, palm, mute or strum");
  }
  if (!bytes_append(&reader->moments, moment, sizeof(*moment))) {
    return scene_text_fail_at(text, text->line, "out of memory");
  }
  return read_object(text, verb->object, &line) &&
         (!verb->number || score_words_number(text, verb->number, &line.number)) &&
         score_options_read(text, verb->allowed, verb->required, &line.options) &&
         verb->take(reader, &line);
}
