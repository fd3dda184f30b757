#include "tools/formats/score.h"

#include "tools/formats/score_tempo.h"
#include "tools/formats/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const TextRange STRING = {"a string from 1, the highest, to 6", 1, SCORE_STRINGS, true};
static const TextRange FRET = {"a fret from 0 to 24", 0, 24, false};
static const TextRange CAPO = {"a capo at a whole fret from 0 to 24", 0, 24, true};
static const TextRange SEMITONES = {"a bend from -12 to 24 semitones", -12, 24, false};
static const TextRange DEPTH = {"a depth from 0 to 12 semitones", 0, 12, false};
static const TextRange NODE = {"a whole number from 2 to 20, of the harmonic", 2, 20, true};
static const TextRange WEIGHT = {"a weight from 0 to 1", 0, 1, false};
static const TextRange FORCE = {"a force from 0 to 1", 0, 1, false};
static const TextRange PLACE = {"a place from 0 to 1, from the bridge", 0, 1, false};
static const TextRange HARDNESS = {"a hardness from 0 to 1", 0, 1, false};
static const TextRange WIDTH = {"a width from 0.01 to 0.6 of the string", 0.01, 0.6, false};
static const TextRange RATE = {"a rate from 0.1 to 20 Hz", 0.1, 20, false};
static const TextRange BEATS_A_MINUTE = {"a tempo from 1 to 1000 beats a minute", 1, 1000, false};

/* Of what has several forms, each with a range of its own. */
static const TextRange SECONDS = {NULL, 0, SCORE_MAX_TIME_S, false};
static const TextRange BEATS = {NULL, 0, 1e6, false};
static const TextRange BAR = {NULL, 1, 1e5, true};
static const TextRange METER = {NULL, 1, 64, true};
static const TextRange KEY = {NULL, 0, 127, true};
static const TextRange OCTAVE = {NULL, -1, 9, true};

static const char A_LENGTH[] = "a length from 0 to 3600 s, or in beats, as 1.5b";
static const char A_TIME[] = "a time: seconds from 0 to 3600, BAR:BEAT, or +T after the line above";
static const char A_NOTE[] = "a note, as E4, F#3 or Bb2, or as a MIDI number from 0 to 127";
static const char A_METER[] = "a meter, as 4 or 3/4, of 1 to 64 beats";

static const double USUAL_METER = 4.0;
static const double USUAL_FORCE = 0.7;
static const double USUAL_HAMMER = 0.5;
static const double USUAL_RATE_HZ = 5.0;
static const double USUAL_SPREAD_S = 0.02;
static const double USUAL_TOUCH_S = 0.15;

enum { LIST_SIZE = 160, NO_LENGTH = -1 };

/* When a line acts. */
typedef struct {
  ScoreSpan at;     /* From the start or the moment before */
  bool is_relative; /* To the moment before */
  uint32_t line;    /* Of the file */
} Moment;

/* An event whose time is not known yet. */
typedef struct {
  GuitarEvent event;
  uint32_t moment;  /* Its place in Reader.moments */
  ScoreSpan after;  /* How long after that moment it acts */
  ScoreSpan length; /* Goes into a value of the event */
  int length_at;    /* Which one, or NO_LENGTH */
  bool is_stop;     /* Of a vibrato; void if another one of the string began since */
} Pending;

typedef struct {
  Text text;
  ScoreTempo tempo;
  Bytes moments;       /* Moment each, in the order of lines */
  Bytes pending;       /* Pending each, in the order of lines */
  Bytes settings;      /* ScoreSetting each */
  char* preset;        /* In the text; NULL: none */
  double meter;        /* Beats a bar */
  uint32_t bars_line;  /* Where a time was first in bars; 0: nowhere yet */
  uint32_t tempo_line; /* Where each was said; 0: not yet */
  uint32_t meter_line;
  uint32_t tuning_line;
  uint32_t capo_line;
  uint32_t preset_line;
} Reader;

/* Words */

/* A letter, a sharp or flat, and the octave, which begins at C. */
static bool is_named_note(const char* word, double* note) {
  static const char letters[] = "CcDdEeFfGgAaBb";
  static const int semitones[] = {0, 2, 4, 5, 7, 9, 11};
  const char* const letter = *word ? strchr(letters, *word) : NULL;
  double octave = 0.0;
  if (!letter) {
    return false;
  }
  const long key = (letter - letters) / 2;
  const int step = word[1] == '#' ? 1 : word[1] == 'b' ? -1 : 0;
  if (!text_is_number(word + (step ? 2 : 1), &OCTAVE, &octave)) {
    return false;
  }
  *note = 12.0 * (octave + 1.0) + semitones[key] + step;
  return *note >= KEY.min && *note <= KEY.max;
}

static bool take_note(Text* text, double* note) {
  const char* const word = text_word(text);
  return (word && (is_named_note(word, note) || text_is_number(word, &KEY, note))) ||
         text_fail(text, word, A_NOTE);
}

/* Beats have a b behind the number, and no length has a sign. */
static bool is_length(char* word, ScoreSpan* length) {
  const size_t size = strlen(word);
  char* const last = word + (size ? size - 1 : 0);
  if (!strchr("0123456789.", *word)) {
    return false;
  }
  length->is_beats = *last == 'b';
  if (!length->is_beats) {
    return text_is_number(word, &SECONDS, &length->value);
  }
  *last = '\0';
  const bool is_read = text_is_number(word, &BEATS, &length->value);
  *last = 'b';
  return is_read;
}

static bool take_length(Text* text, ScoreSpan* length) {
  char* const word = text_word(text);
  return (word && is_length(word, length)) || text_fail(text, word, A_LENGTH);
}

/* What a beat is called does not matter here. */
static bool take_beats_a_bar(Text* text, double* meter) {
  char* const word = text_word(text);
  char* const slash = word ? strchr(word, '/') : NULL;
  double note = 4.0;
  if (slash) {
    *slash = '\0';
  }
  const bool is_read =
      text_is_number(word, &METER, meter) &&
      (!slash || (text_is_number(slash + 1, &METER, &note) && log2(note) == floor(log2(note))));
  if (slash) {
    *slash = '/';
  }
  return is_read || text_fail(text, word, A_METER);
}

/* BAR:BEAT; `colon` is in `word`. */
static bool read_bars(Reader* reader, char* word, char* colon, Moment* moment) {
  Text* const text = &reader->text;
  const TextRange beats = {NULL, 1, reader->meter + 1.0, false};
  double bar = 0.0;
  double beat = 0.0;
  *colon = '\0';
  const bool is_read = text_is_number(word, &BAR, &bar) &&
                       text_is_number(colon + 1, &beats, &beat) && beat < beats.max;
  *colon = ':';
  if (!is_read) {
    char quote[TEXT_QUOTE_SIZE];
    return text_fail_at(
        text, text->line,
        "found %s, expected BAR:BEAT, a bar from 1 to 100000 and a beat from 1 to below %g",
        text_quote(word, quote), beats.max);
  }
  reader->bars_line = reader->bars_line ? reader->bars_line : text->line;
  moment->at = (ScoreSpan){(bar - 1.0) * reader->meter + beat - 1.0, true};
  return true;
}

static bool read_moment(Reader* reader, char* word, Moment* moment) {
  char* const colon = strchr(word, ':');
  *moment = (Moment){.line = reader->text.line, .is_relative = *word == '+'};
  if (colon && !moment->is_relative) {
    return read_bars(reader, word, colon, moment);
  }
  return (moment->is_relative ? is_length(word + 1, &moment->at)
                              : text_is_number(word, &SECONDS, &moment->at.value)) ||
         text_fail(&reader->text, word, A_TIME);
}

/* Options: what may follow in the line of an event, in any order */

typedef enum {
  OPTION_FORCE,
  OPTION_AT,
  OPTION_HARDNESS,
  OPTION_WIDTH,
  OPTION_DOWN,
  OPTION_UP,
  OPTION_RATE,
  OPTION_FOR,
  OPTION_SPREAD,
  N_OPTIONS
} Option;

/* Sets of options. */
enum {
  BIT_FORCE = 1 << OPTION_FORCE,
  BIT_AT = 1 << OPTION_AT,
  BIT_UP = 1 << OPTION_UP,
  BIT_RATE = 1 << OPTION_RATE,
  BIT_FOR = 1 << OPTION_FOR,
  BIT_SPREAD = 1 << OPTION_SPREAD,
  BITS_STROKE = 1 << OPTION_DOWN | BIT_UP,
  BITS_FINGER = 1 << OPTION_HARDNESS | 1 << OPTION_WIDTH,
  BITS_PLUCK = BIT_FORCE | BIT_AT | BITS_FINGER | BITS_STROKE,
  BITS_STRUM = BIT_FORCE | BIT_AT | BITS_FINGER | BIT_SPREAD
};

static const struct {
  const char* word;
  const TextRange* range; /* Of its value; NULL: a length or none */
  unsigned alone;         /* Of these there is one at most */
  bool has_length;
} options[N_OPTIONS] = {
    [OPTION_FORCE] = {"force", &FORCE, BIT_FORCE, false},
    [OPTION_AT] = {"at", &PLACE, BIT_AT, false},
    [OPTION_HARDNESS] = {"hardness", &HARDNESS, BITS_FINGER, false},
    [OPTION_WIDTH] = {"width", &WIDTH, BITS_FINGER, false},
    [OPTION_DOWN] = {"down", NULL, BITS_STROKE, false},
    [OPTION_UP] = {"up", NULL, BITS_STROKE, false},
    [OPTION_RATE] = {"rate", &RATE, BIT_RATE, false},
    [OPTION_FOR] = {"for", NULL, BIT_FOR, true},
    [OPTION_SPREAD] = {"spread", NULL, BIT_SPREAD, true},
};

/* What follows the verb of an event. */
typedef struct {
  uint32_t string;            /* Of ON_STRING */
  double number;              /* Where the verb has one */
  double fret[SCORE_STRINGS]; /* Of ON_CHORD, as strings count; NAN: not played */
  bool is_up;                 /* Of ON_CHORD */
  unsigned given;             /* Options */
  double value[N_OPTIONS];    /* Of those that are given */
  ScoreSpan length[N_OPTIONS];
} ScoreLine;

static unsigned find_option(const char* word, unsigned allowed) {
  unsigned i = 0;
  while (i < N_OPTIONS && (!(allowed >> i & 1U) || strcmp(options[i].word, word) != 0)) {
    ++i;
  }
  return i;
}

/* What could stand there: the options left and the end of the line. */
static bool refuse_option(Text* text, const char* word, unsigned allowed, unsigned given) {
  char list[LIST_SIZE] = "";
  int n = 0;
  for (unsigned i = 0; i < N_OPTIONS; ++i) {
    if ((allowed >> i & 1U) && !(options[i].alone & given)) {
      n += snprintf(list + n, sizeof(list) - (size_t)n, n ? ", %s" : "%s", options[i].word);
    }
  }
  (void)snprintf(list + n, sizeof(list) - (size_t)n, "%sthe end of the line", n ? " or " : "");
  return text_fail(text, word, list);
}

static const char* first_word(unsigned bits) {
  unsigned i = 0;
  while (!(bits >> i & 1U)) {
    ++i;
  }
  return options[i].word;
}

static bool take_option(Text* text, unsigned i, ScoreLine* line) {
  const unsigned others = line->given & options[i].alone;
  if (others) {
    return text_fail_at(text, text->line, "found '%s' after '%s', expected one of them only",
                        options[i].word, first_word(others));
  }
  line->given |= 1U << i;
  return options[i].range        ? text_number(text, options[i].range, &line->value[i])
         : options[i].has_length ? take_length(text, &line->length[i])
                                 : true;
}

static bool take_options(Text* text, unsigned allowed, unsigned required, ScoreLine* line) {
  for (const char* word = text_word(text); word; word = text_word(text)) {
    const unsigned i = find_option(word, allowed);
    if (i == N_OPTIONS) {
      return refuse_option(text, word, allowed, line->given);
    }
    if (!take_option(text, i, line)) {
      return false;
    }
  }
  char expected[TEXT_QUOTE_SIZE];
  const unsigned missing = required & ~line->given;
  return !missing || text_fail(text, NULL, text_quote(first_word(missing), expected));
}

static bool is_given(const ScoreLine* line, unsigned bits) {
  return (line->given & bits) != 0;
}

static double value_or(const ScoreLine* line, Option option, double otherwise) {
  return is_given(line, 1U << option) ? line->value[option] : otherwise;
}

/* The exciter makes a finger of hardness q half as wide as 0.3 (0.005 / 0.3)^q, all of it twice
 * that. */
static double hardness_of(double width) {
  return fmin(fmax(log(width / 2.0 / PLUCK_SOFTEST) / log(PLUCK_HARDEST / PLUCK_SOFTEST), 0.0),
              1.0);
}

/* Events */

static Pending event_of(GuitarVerb verb, uint32_t string, double value) {
  return (Pending){.event = {(uint32_t)verb, string, {(float)value, 0.0F, 0.0F}},
                   .length_at = NO_LENGTH};
}

static bool add(Reader* reader, Pending pending) {
  Text* const text = &reader->text;
  if (reader->pending.size / sizeof(pending) >= SCORE_MAX_EVENTS) {
    return text_fail_at(text, text->line, "found more than %d events, expected no more",
                        SCORE_MAX_EVENTS);
  }
  pending.moment = (uint32_t)(reader->moments.size / sizeof(Moment)) - 1;
  return bytes_append(&reader->pending, &pending, sizeof(pending)) || text_fail_memory(text);
}

/* An event whose value `at` is as long as 'for' says. */
static bool add_long(Reader* reader, const ScoreLine* line, Pending pending, int at) {
  pending.length = line->length[OPTION_FOR];
  pending.length_at = at;
  return add(reader, pending);
}

static Pending pluck_of(const ScoreLine* line, uint32_t string, bool is_up) {
  const double force = value_or(line, OPTION_FORCE, USUAL_FORCE);
  Pending pluck = event_of(GUITAR_PLUCK, string, is_up ? -force : force);
  pluck.event.value[1] = (float)value_or(line, OPTION_AT, (double)NAN);
  pluck.event.value[2] =
      (float)(is_given(line, 1U << OPTION_WIDTH) ? hardness_of(line->value[OPTION_WIDTH])
                                                 : value_or(line, OPTION_HARDNESS, (double)NAN));
  return pluck;
}

static bool take_pluck(Reader* reader, const ScoreLine* line) {
  return add(reader, pluck_of(line, line->string, is_given(line, BIT_UP)));
}

static bool take_fret(Reader* reader, const ScoreLine* line) {
  return add(reader, event_of(GUITAR_FRET, line->string, line->number));
}

static bool take_hammer(Reader* reader, const ScoreLine* line) {
  Pending hammer = event_of(GUITAR_HAMMER, line->string, line->number);
  hammer.event.value[1] = (float)value_or(line, OPTION_FORCE, USUAL_HAMMER);
  return add(reader, hammer);
}

static bool take_slide(Reader* reader, const ScoreLine* line) {
  return add_long(reader, line, event_of(GUITAR_SLIDE, line->string, line->number), 1);
}

static bool take_bend(Reader* reader, const ScoreLine* line) {
  return add_long(reader, line, event_of(GUITAR_BEND, line->string, line->number), 1);
}

static bool take_vibrato(Reader* reader, const ScoreLine* line) {
  Pending vibrato = event_of(GUITAR_VIBRATO, line->string, line->number);
  vibrato.event.value[1] = (float)value_or(line, OPTION_RATE, USUAL_RATE_HZ);
  if (!add(reader, vibrato)) {
    return false;
  }
  if (!is_given(line, BIT_FOR)) {
    return true;
  }
  vibrato.event.value[0] = 0.0F;
  vibrato.after = line->length[OPTION_FOR];
  vibrato.is_stop = true;
  return add(reader, vibrato);
}

static bool damp(Reader* reader, const ScoreLine* line, uint32_t string) {
  const Pending damping = event_of(GUITAR_DAMP, string, (double)INFINITY);
  return is_given(line, BIT_FOR) ? add_long(reader, line, damping, 0) : add(reader, damping);
}

static bool take_damp(Reader* reader, const ScoreLine* line) {
  return damp(reader, line, line->string);
}

static bool take_mute(Reader* reader, const ScoreLine* line) {
  for (uint32_t string = 0; string < SCORE_STRINGS; ++string) {
    if (!damp(reader, line, string)) {
      return false;
    }
  }
  return true;
}

static bool take_ring(Reader* reader, const ScoreLine* line) {
  return add(reader, event_of(GUITAR_LET_RING, line->string, 0.0));
}

static bool take_touch(Reader* reader, const ScoreLine* line) {
  return add_long(reader, line, event_of(GUITAR_TOUCH, line->string, line->value[OPTION_AT]), 1);
}

static bool take_harmonic(Reader* reader, const ScoreLine* line) {
  Pending touch = event_of(GUITAR_TOUCH, line->string, 1.0 / line->number);
  touch.length =
      is_given(line, BIT_FOR) ? line->length[OPTION_FOR] : (ScoreSpan){.value = USUAL_TOUCH_S};
  touch.length_at = 1;
  return add(reader, touch) && take_pluck(reader, line);
}

static bool take_palm(Reader* reader, const ScoreLine* line) {
  return add(reader, event_of(GUITAR_PALM, 0, line->number));
}

static bool finger_chord(Reader* reader, const ScoreLine* line) {
  bool is_ok = true;
  for (uint32_t i = SCORE_STRINGS; is_ok && i-- > 0;) {
    is_ok = add(reader, isnan(line->fret[i]) ? event_of(GUITAR_DAMP, i, (double)INFINITY)
                                             : event_of(GUITAR_FRET, i, line->fret[i]));
  }
  return is_ok;
}

/* The hand is at the first string that it plays when the line begins, and passes over the others at
 * an even pace. */
static bool take_strum(Reader* reader, const ScoreLine* line) {
  const ScoreSpan usual = {.value = USUAL_SPREAD_S};
  const ScoreSpan spread = is_given(line, BIT_SPREAD) ? line->length[OPTION_SPREAD] : usual;
  bool is_ok = finger_chord(reader, line);
  int n_passed = 0;
  for (uint32_t i = 0; is_ok && i < SCORE_STRINGS; ++i) {
    const uint32_t string = line->is_up ? i : SCORE_STRINGS - 1 - i;
    const bool is_played = !isnan(line->fret[string]);
    if (is_played) {
      Pending pluck = pluck_of(line, string, line->is_up);
      pluck.after = (ScoreSpan){n_passed * spread.value, spread.is_beats};
      is_ok = add(reader, pluck);
    }
    n_passed += is_played || n_passed > 0 ? 1 : 0;
  }
  return is_ok;
}

/* What stands between the verb and the options, before a number. */
typedef enum { ON_ALL, ON_STRING, ON_CHORD } Object;

static const struct {
  const char* word;
  Object object;
  const TextRange* range; /* Of the number, or NULL */
  unsigned allowed;
  unsigned required;
  bool (*take)(Reader* reader, const ScoreLine* line);
} verbs[] = {
    {"pluck", ON_STRING, NULL, BITS_PLUCK, 0, take_pluck},
    {"fret", ON_STRING, &FRET, 0, 0, take_fret},
    {"hammer", ON_STRING, &FRET, BIT_FORCE, 0, take_hammer},
    {"pull", ON_STRING, &FRET, BIT_FORCE, 0, take_hammer},
    {"lift", ON_STRING, NULL, 0, 0, take_fret},
    {"slide", ON_STRING, &FRET, BIT_FOR, BIT_FOR, take_slide},
    {"bend", ON_STRING, &SEMITONES, BIT_FOR, 0, take_bend},
    {"vibrato", ON_STRING, &DEPTH, BIT_RATE | BIT_FOR, 0, take_vibrato},
    {"damp", ON_STRING, NULL, BIT_FOR, 0, take_damp},
    {"ring", ON_STRING, NULL, 0, 0, take_ring},
    {"touch", ON_STRING, NULL, BIT_AT | BIT_FOR, BIT_AT | BIT_FOR, take_touch},
    {"harmonic", ON_STRING, &NODE, BITS_PLUCK | BIT_FOR, 0, take_harmonic},
    {"palm", ON_ALL, &WEIGHT, 0, 0, take_palm},
    {"mute", ON_ALL, NULL, BIT_FOR, 0, take_mute},
    {"strum", ON_CHORD, NULL, BITS_STRUM, 0, take_strum},
};

static bool take_chord_fret(Text* text, uint32_t string, double* fret) {
  const char* const word = text_word(text);
  *fret = (double)NAN;
  if (word && (!strcmp(word, "x") || !strcmp(word, "X") || text_is_number(word, &FRET, fret))) {
    return true;
  }
  char quote[TEXT_QUOTE_SIZE];
  return text_fail_at(text, text->line, "found %s, expected %s, or x, for string %u",
                      text_quote(word, quote), FRET.expected, string + 1);
}

/* As chord charts do: the lowest string first. */
static bool take_chord(Text* text, ScoreLine* line) {
  const char* const stroke = text_word(text);
  if (!stroke || (strcmp(stroke, "down") != 0 && strcmp(stroke, "up") != 0)) {
    return text_fail(text, stroke, "down or up");
  }
  line->is_up = !strcmp(stroke, "up");
  bool is_played = false;
  for (uint32_t i = SCORE_STRINGS; i-- > 0;) {
    if (!take_chord_fret(text, i, &line->fret[i])) {
      return false;
    }
    is_played = is_played || !isnan(line->fret[i]);
  }
  return is_played || text_fail(text, "x", "a fret for one string at least");
}

static bool take_object(Text* text, Object object, ScoreLine* line) {
  double string = 1.0;
  const bool is_ok = object == ON_CHORD    ? take_chord(text, line)
                     : object == ON_STRING ? text_number(text, &STRING, &string)
                                           : true;
  line->string = is_ok ? (uint32_t)string - 1 : 0;
  return is_ok;
}

/* `word` is the verb; NULL is the end of the line. */
static bool read_verb(Reader* reader, const char* word, const Moment* moment) {
  Text* const text = &reader->text;
  ScoreLine line = {0};
  size_t i = 0;
  while (word && i < sizeof(verbs) / sizeof(verbs[0]) && strcmp(verbs[i].word, word) != 0) {
    ++i;
  }
  if (!word || i == sizeof(verbs) / sizeof(verbs[0])) {
    return text_fail(text, word,
                     "tempo or pluck, fret, hammer, pull, lift, slide, bend, vibrato, damp, "
                     "ring, touch, harmonic, palm, mute or strum");
  }
  return (bytes_append(&reader->moments, moment, sizeof(*moment)) || text_fail_memory(text)) &&
         take_object(text, verbs[i].object, &line) &&
         (!verbs[i].range || text_number(text, verbs[i].range, &line.number)) &&
         take_options(text, verbs[i].allowed, verbs[i].required, &line) &&
         verbs[i].take(reader, &line);
}

/* Settings */

static bool change_tempo(Reader* reader, ScoreSpan from) {
  Text* const text = &reader->text;
  double beats_a_minute = 0.0;
  return text_number(text, &BEATS_A_MINUTE, &beats_a_minute) && text_end(text) &&
         (score_tempo_add(&reader->tempo, from, beats_a_minute) || text_fail_memory(text));
}

static bool take_tempo(Reader* reader) {
  return text_is_first(&reader->text, "tempo", &reader->tempo_line) &&
         change_tempo(reader, (ScoreSpan){0});
}

static bool take_meter(Reader* reader) {
  Text* const text = &reader->text;
  if (reader->bars_line) {
    return text_fail_at(text, text->line,
                        "found 'meter' after bars in line %lu, expected it before",
                        (unsigned long)reader->bars_line);
  }
  return text_is_first(text, "meter", &reader->meter_line) &&
         take_beats_a_bar(text, &reader->meter) && text_end(text);
}

static bool add_setting(Reader* reader, ScoreSetting setting) {
  setting.line = reader->text.line;
  return bytes_append(&reader->settings, &setting, sizeof(setting)) ||
         text_fail_memory(&reader->text);
}

static bool take_tuning(Reader* reader) {
  static const char* const symbols[SCORE_STRINGS] = {"string1", "string2", "string3",
                                                     "string4", "string5", "string6"};
  if (!text_is_first(&reader->text, "tuning", &reader->tuning_line)) {
    return false;
  }
  for (uint32_t i = 0; i < SCORE_STRINGS; ++i) {
    ScoreSetting setting = {.symbol = symbols[i]};
    if (!take_note(&reader->text, &setting.value) || !add_setting(reader, setting)) {
      return false;
    }
  }
  return text_end(&reader->text);
}

static bool take_capo(Reader* reader) {
  Text* const text = &reader->text;
  ScoreSetting setting = {.symbol = "capo"};
  return text_is_first(text, "capo", &reader->capo_line) &&
         text_number(text, &CAPO, &setting.value) && text_end(text) && add_setting(reader, setting);
}

/* The range is the port's, which is not known here. */
static bool take_set(Reader* reader) {
  Text* const text = &reader->text;
  ScoreSetting setting = {.symbol = text_word(text)};
  if (!setting.symbol) {
    return text_fail(text, NULL, "the symbol of a control");
  }
  setting.text = text_word(text);
  if (!setting.text) {
    return text_fail(text, NULL, "a value");
  }
  return text_end(text) && add_setting(reader, setting);
}

/* A name may be of several words: they are drawn together, one blank between two. */
static bool take_preset(Reader* reader) {
  Text* const text = &reader->text;
  if (!text_is_first(text, "preset", &reader->preset_line)) {
    return false;
  }
  reader->preset = text_word(text);
  if (!reader->preset) {
    return text_fail(text, NULL, "the name of a preset");
  }
  char* end = reader->preset + strlen(reader->preset);
  for (char* word = text_word(text); word; word = text_word(text)) {
    const size_t length = strlen(word);
    *end++ = ' ';
    memmove(end, word, length + 1);
    end += length;
  }
  return true;
}

/* Lines */

static bool read_setting(Reader* reader, const char* word) {
  static const struct {
    const char* word;
    bool (*take)(Reader* reader);
  } settings[] = {
      {"tempo", take_tempo}, {"meter", take_meter}, {"tuning", take_tuning},
      {"capo", take_capo},   {"set", take_set},     {"preset", take_preset},
  };
  for (unsigned i = 0; i < sizeof(settings) / sizeof(settings[0]); ++i) {
    if (!strcmp(settings[i].word, word)) {
      return settings[i].take(reader);
    }
  }
  return text_fail(&reader->text, word, "a time, or tempo, meter, tuning, capo, set or preset");
}

/* A change of tempo has no use for a time that may depend on it. */
static bool read_change(Reader* reader, char* time, const Moment* moment) {
  if (moment->is_relative) {
    return text_fail(&reader->text, time, "seconds or BAR:BEAT, for a tempo");
  }
  return (bytes_append(&reader->moments, moment, sizeof(*moment)) ||
          text_fail_memory(&reader->text)) &&
         change_tempo(reader, moment->at);
}

static bool read_event(Reader* reader, char* time) {
  Moment moment;
  if (!read_moment(reader, time, &moment)) {
    return false;
  }
  const char* const verb = text_word(&reader->text);
  return verb && !strcmp(verb, "tempo") ? read_change(reader, time, &moment)
                                        : read_verb(reader, verb, &moment);
}

static bool read_line(Reader* reader) {
  Text* const text = &reader->text;
  if (text->length > SCORE_MAX_LINE) {
    return text_fail_at(text, text->line, "found a line of %zu bytes, expected at most %d",
                        text->length, SCORE_MAX_LINE);
  }
  if (!text_is_sound(text)) {
    return false;
  }
  char* const word = text_word(text);
  if (!word) {
    return true;
  }
  return strchr("+-.0123456789", *word) ? read_event(reader, word) : read_setting(reader, word);
}

static bool read_lines(Reader* reader) {
  while (text_next_line(&reader->text)) {
    if (!read_line(reader)) {
      return false;
    }
  }
  const uint32_t line = reader->text.line;
  return reader->pending.size > 0 || text_fail_at(&reader->text, line ? line : 1,
                                                  "found the end of the file, expected an event");
}

/* Times, once the tempo is known everywhere */

/* A moment, both ways. */
typedef struct {
  double time_s;
  double beats;
} Place;

typedef struct {
  ScoreEvent event;
  size_t order; /* In the file */
  bool is_stop;
} Entry;

static Place place_after(const ScoreTempo* tempo, Place from, ScoreSpan span) {
  Place place;
  if (span.is_beats) {
    place.beats = from.beats + span.value;
    place.time_s = score_tempo_time_s(tempo, place.beats);
  } else {
    place.time_s = from.time_s + span.value;
    place.beats = score_tempo_beats(tempo, place.time_s);
  }
  return place;
}

static bool is_in_time(Reader* reader, uint32_t line, const char* what, double value_s) {
  return value_s <= SCORE_MAX_TIME_S ||
         text_fail_at(&reader->text, line, "found a %s of %g s, expected at most %g s", what,
                      value_s, SCORE_MAX_TIME_S);
}

static bool place_moments(Reader* reader, Place* places) {
  const Moment* const moments = (const Moment*)(const void*)reader->moments.data;
  const size_t n = reader->moments.size / sizeof(*moments);
  const Place start = {0.0, 0.0};
  Place last = start;
  for (size_t i = 0; i < n; ++i) {
    last = place_after(&reader->tempo, moments[i].is_relative ? last : start, moments[i].at);
    places[i] = last;
    if (!is_in_time(reader, moments[i].line, "time", last.time_s)) {
      return false;
    }
  }
  return true;
}

static bool
place_event(Reader* reader, const Pending* pending, Place from, uint32_t line, Entry* out) {
  const Place start = place_after(&reader->tempo, from, pending->after);
  out->event = (ScoreEvent){start.time_s, line, pending->event};
  out->is_stop = pending->is_stop;
  if (pending->length_at != NO_LENGTH) {
    const Place end = place_after(&reader->tempo, start, pending->length);
    const double length_s =
        pending->length.is_beats ? end.time_s - start.time_s : pending->length.value;
    out->event.event.value[pending->length_at] = (float)length_s;
    if (!is_in_time(reader, line, "length", length_s)) {
      return false;
    }
  }
  return is_in_time(reader, line, "time", start.time_s);
}

static bool place_events(Reader* reader, const Place* places, Entry* entries, size_t n) {
  const Moment* const moments = (const Moment*)(const void*)reader->moments.data;
  const Pending* const pending = (const Pending*)(const void*)reader->pending.data;
  for (size_t i = 0; i < n; ++i) {
    const uint32_t moment = pending[i].moment;
    entries[i].order = i;
    if (!place_event(reader, &pending[i], places[moment], moments[moment].line, &entries[i])) {
      return false;
    }
  }
  return true;
}

static int compare(const void* a, const void* b) {
  const Entry* const one = a;
  const Entry* const other = b;
  if (one->event.time_s != other->event.time_s) {
    return one->event.time_s < other->event.time_s ? -1 : 1;
  }
  return one->order < other->order ? -1 : 1;
}

/* Take over what acts: the end of a vibrato does unless another one has begun on its string. */
static void keep_what_acts(Score* score, const Entry* entries, size_t n) {
  uint32_t swinging[SCORE_STRINGS] = {0}; /* The line that began it */
  for (size_t i = 0; i < n; ++i) {
    const ScoreEvent* const event = &entries[i].event;
    uint32_t* const line = &swinging[event->event.string];
    if (entries[i].is_stop && *line != event->line) {
      continue;
    }
    if (event->event.verb == GUITAR_VIBRATO) {
      *line = event->line;
    }
    score->events[score->n_events++] = *event;
    score->duration_s = event->time_s;
  }
}

/* Find the time of every event, and sort them. */
static bool place_all(Reader* reader, Score* score) {
  const size_t n = reader->pending.size / sizeof(Pending);
  Place* const places = calloc(reader->moments.size / sizeof(Moment) + 1, sizeof(*places));
  Entry* const entries = calloc(n, sizeof(*entries));
  score->events = calloc(n, sizeof(*score->events));
  bool is_ok = false;
  if (!places || !entries || !score->events || !score_tempo_finish(&reader->tempo)) {
    (void)text_fail_memory(&reader->text);
  } else if (place_moments(reader, places) && place_events(reader, places, entries, n)) {
    qsort(entries, n, sizeof(*entries), compare);
    keep_what_acts(score, entries, n);
    is_ok = true;
  }
  free(places);
  free(entries);
  return is_ok;
}

/* What the reader has goes over to the score. */
static Score* make_score(Reader* reader) {
  Score* const score = calloc(1, sizeof(*score));
  if (!score || !place_all(reader, score)) {
    (void)(score || text_fail_memory(&reader->text));
    score_free(score);
    return NULL;
  }
  score->n_settings = reader->settings.size / sizeof(ScoreSetting);
  score->settings = (ScoreSetting*)(void*)reader->settings.data;
  score->preset = reader->preset;
  score->preset_line = reader->preset_line;
  score->text = reader->text.bytes;
  reader->settings = reader->text.bytes = (Bytes){0};
  return score;
}

Score* score_new(const char* path, char* error, size_t error_size) {
  Reader reader = {.meter = USUAL_METER};
  Score* score = NULL;
  if (text_init(&reader.text, path, error, error_size)) {
    reader.text.is_comment_apart = true;
    score = read_lines(&reader) ? make_score(&reader) : NULL;
  }
  text_clear(&reader.text);
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
