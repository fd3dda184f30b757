#include "tools/formats/scene_fields.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COUNT = 10000000 };

typedef struct {
  const char* expected; // Completes "found …, expected …"
  const char* word;     // Which it must be, or NULL
  double min;
  double max;
} Rule;

/* Above 0 is from the smallest number on that has all its digits. */
static const Rule rules[] = {
    [FIELD_NEW_NAME] = {"a new name, of letters, digits, _ and -, a letter first", NULL, 0, 0},
    [FIELD_POINT] = {"a point declared above", NULL, 0, 0},
    [FIELD_MASS] = {"a mass declared above", NULL, 0, 0},
    [FIELD_COUNT] = {"a whole number of masses from 1 to 10000000", NULL, 1, MAX_COUNT},
    [FIELD_HZ] = {"a rate above 0 and up to 1e9 Hz", NULL, DBL_MIN, 1e9},
    [FIELD_KG] = {"a mass above 0 kg", NULL, DBL_MIN, DBL_MAX},
    [FIELD_STIFFNESS] = {"a stiffness from 0 N/m up", NULL, 0, DBL_MAX},
    [FIELD_DAMPING] = {"a damping from 0 kg/s up", NULL, 0, DBL_MAX},
    [FIELD_TIME] = {"a time from 0 to 1e6 s", NULL, 0, 1e6},
    [FIELD_DURATION] = {"a duration above 0 and up to 1e6 s", NULL, DBL_MIN, 1e6},
    [FIELD_LENGTH] = {"a displacement in m", NULL, -DBL_MAX, DBL_MAX},
    [FIELD_VELOCITY] = {"a velocity in m/s", NULL, -DBL_MAX, DBL_MAX},
    [FIELD_FORCE] = {"a force in N", NULL, -DBL_MAX, DBL_MAX},
    [FIELD_GAIN] = {"a gain", NULL, -DBL_MAX, DBL_MAX},
    [FIELD_WORD_MASS] = {"'mass'", "mass", 0, 0},
    [FIELD_WORD_STIFFNESS] = {"'stiffness'", "stiffness", 0, 0},
    [FIELD_WORD_DAMPING] = {"'damping'", "damping", 0, 0},
    [FIELD_WORD_FOR] = {"'for'", "for", 0, 0},
};

/* Letters are those of ASCII and all that other alphabets are written with. */
static bool is_letter(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
         (unsigned char)byte >= 0x80;
}

static bool is_name(const char* word) {
  if (!is_letter(*word)) {
    return false;
  }
  for (; *word; ++word) {
    if (!is_letter(*word) && !strchr("0123456789_-", *word)) {
      return false;
    }
  }
  return true;
}

static bool read_number(const char* word, const Rule* rule, double* number) {
  return scene_text_number(word, rule->min, rule->max, number);
}

static bool read_count(const char* word, const Rule* rule, uint32_t* count) {
  double number = 0.0;
  if (!read_number(word, rule, &number) || number != floor(number)) {
    return false;
  }
  *count = (uint32_t)number;
  return true;
}

static bool take_number(SceneText* text, const char* word, const Rule* rule, Fields* out) {
  if (!word || !read_number(word, rule, &out->number[out->n_numbers])) {
    return scene_text_fail(text, word, rule->expected);
  }
  ++out->n_numbers;
  return true;
}

static bool take_new_name(SceneText* text, const SceneNames* names, char* word, Fields* out) {
  if (!word || !is_name(word)) {
    return scene_text_fail(text, word, rules[FIELD_NEW_NAME].expected);
  }
  const SceneName* const old = scene_names_find(names, word);
  if (old) {
    char quote[SCENE_TEXT_QUOTE_SIZE];
    return scene_text_fail_at(text, text->line,
                              "found %s, declared in line %lu already, expected a new name",
                              scene_text_quote(word, quote), (unsigned long)old->line);
  }
  out->name = word;
  return true;
}

/* The point NAME.I of a string; `dot` is in `word`. */
static bool find_in_string(const SceneNames* names, char* word, char* dot, uint32_t* point) {
  const char* const digits = dot + 1;
  *dot = '\0';
  const SceneName* const name = scene_names_find(names, word);
  *dot = '.';
  if (!name || name->kind != SCENE_A_STRING || !*digits || strspn(digits, "0123456789") > 9 ||
      digits[strspn(digits, "0123456789")]) {
    return false;
  }
  const unsigned long i = strtoul(digits, NULL, 10);
  if (i < 1 || i > name->n_masses) {
    return false;
  }
  *point = name->first + (uint32_t)i - 1;
  return true;
}

static bool find_point(const SceneNames* names, char* word, Field field, uint32_t* point) {
  char* const dot = strchr(word, '.');
  if (dot) {
    return find_in_string(names, word, dot, point);
  }
  const SceneName* const name = scene_names_find(names, word);
  if (!name || name->kind == SCENE_A_STRING) {
    return false;
  }
  *point = name->first;
  return field == FIELD_POINT || name->kind == SCENE_A_MASS;
}

/* What a point that is not to be had is mistaken for. */
static bool refuse_point(SceneText* text, const SceneNames* names, char* word, Field field) {
  char quote[SCENE_TEXT_QUOTE_SIZE];
  char* const dot = strchr(word, '.');
  if (dot) {
    *dot = '\0';
  }
  const SceneName* const name = scene_names_find(names, word);
  if (dot) {
    *dot = '.';
  }
  if (name && name->kind == SCENE_A_STRING) {
    return scene_text_fail_at(text, text->line,
                              "found %s, expected one of the string's masses, 1 to %lu after a dot",
                              scene_text_quote(word, quote), (unsigned long)name->n_masses);
  }
  if (name && name->kind == SCENE_A_GROUND && !dot) {
    return scene_text_fail_at(text, text->line, "found %s, a ground, expected a mass",
                              scene_text_quote(word, quote));
  }
  return scene_text_fail(text, word, rules[field].expected);
}

static bool
take_point(SceneText* text, const SceneNames* names, char* word, Field field, Fields* out) {
  if (!word) {
    return scene_text_fail(text, word, rules[field].expected);
  }
  if (!find_point(names, word, field, &out->point[out->n_points])) {
    return refuse_point(text, names, word, field);
  }
  ++out->n_points;
  out->point_word = word;
  return true;
}

static bool read_field(SceneText* text, const SceneNames* names, Field field, Fields* out) {
  const Rule* const rule = &rules[field];
  char* const word = scene_text_next_word(text);
  switch (field) {
  case FIELD_NEW_NAME:
    return take_new_name(text, names, word, out);
  case FIELD_POINT:
  case FIELD_MASS:
    return take_point(text, names, word, field, out);
  case FIELD_COUNT:
    return (word && read_count(word, rule, &out->count)) ||
           scene_text_fail(text, word, rule->expected);
  default:
    return rule->word
               ? (word && !strcmp(word, rule->word)) || scene_text_fail(text, word, rule->expected)
               : take_number(text, word, rule, out);
  }
}

bool fields_read(SceneText* text, const SceneNames* names, const Field* fields, Fields* out) {
  for (; *fields != FIELD_END; ++fields) {
    if (!read_field(text, names, *fields, out)) {
      return false;
    }
  }
  return true;
}

bool fields_end(SceneText* text) {
  const char* const word = scene_text_next_word(text);
  return !word || scene_text_fail(text, word, "the end of the line");
}
