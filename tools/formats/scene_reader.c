#include "tools/formats/scene_reader.h"

#include <stdlib.h>
#include <string.h>

enum { FIRST_SLOTS = 64 };

bool scene_done(SceneReader* reader, Status status) {
  return !status || text_fail_at(&reader->text, reader->text.line, "%s", status_text(status));
}

/* Names */

static const SceneName* names_of(const SceneReader* reader) {
  return (const SceneName*)(const void*)reader->names.data;
}

/* Fowler, Noll and Vo's hash 1a. */
static uint32_t hash_of(const char* name) {
  uint32_t hash = 2166136261U;
  for (; *name; ++name) {
    hash = (hash ^ (uint8_t)*name) * 16777619U;
  }
  return hash;
}

/* The slot where a name is, or where it would go. */
static uint32_t* slot_of(const SceneReader* reader, const char* name) {
  uint32_t i = hash_of(name) & (reader->n_slots - 1);
  while (reader->slots[i] && strcmp(names_of(reader)[reader->slots[i] - 1].name, name) != 0) {
    i = (i + 1) & (reader->n_slots - 1);
  }
  return &reader->slots[i];
}

/* Make room for one name more than there are; no more than half of the slots are ever taken. */
static bool reserve_slots(SceneReader* reader, uint32_t n_names) {
  if (2 * n_names < reader->n_slots) {
    return true;
  }
  const uint32_t n_slots = reader->n_slots ? 2 * reader->n_slots : FIRST_SLOTS;
  uint32_t* const slots = calloc(n_slots, sizeof(*slots));
  if (!slots) {
    return false;
  }
  free(reader->slots);
  reader->slots = slots;
  reader->n_slots = n_slots;
  for (uint32_t i = 0; i < n_names; ++i) {
    *slot_of(reader, names_of(reader)[i].name) = i + 1;
  }
  return true;
}

const SceneName* scene_find(const SceneReader* reader, const char* name) {
  const uint32_t place = reader->n_slots ? *slot_of(reader, name) : 0;
  return place ? names_of(reader) + place - 1 : NULL;
}

bool scene_declare(SceneReader* reader, SceneName name) {
  const uint32_t n_names = (uint32_t)(reader->names.size / sizeof(name));
  name.line = reader->text.line;
  if (!reserve_slots(reader, n_names) || !bytes_append(&reader->names, &name, sizeof(name))) {
    return text_fail_memory(&reader->text);
  }
  *slot_of(reader, name.name) = n_names + 1;
  return true;
}

/* Letters are those of ASCII and all that other alphabets are written with. */
static bool is_letter(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
         (unsigned char)byte >= 0x80;
}

static bool is_name(const char* word) {
  if (!is_letter(*word)) {
    return false;
  }
  while (*word && (is_letter(*word) || strchr("0123456789_-", *word))) {
    ++word;
  }
  return !*word;
}

bool scene_new_name(SceneReader* reader, SceneName* name) {
  Text* const text = &reader->text;
  char quote[TEXT_QUOTE_SIZE];
  name->name = text_word(text);
  if (!name->name || !is_name(name->name)) {
    return text_fail(text, name->name, "a new name, of letters, digits, _ and -, a letter first");
  }
  const SceneName* const old = scene_find(reader, name->name);
  return !old || text_fail_at(text, text->line,
                              "found %s, declared in line %lu already, expected a new name",
                              text_quote(name->name, quote), (unsigned long)old->line);
}

/* Points */

/* What the word's part before its dot stands for. */
static const SceneName* find_before_dot(const SceneReader* reader, char* word, char* dot) {
  if (dot) {
    *dot = '\0';
  }
  const SceneName* const name = scene_find(reader, word);
  if (dot) {
    *dot = '.';
  }
  return name;
}

/* A place on a string from its digits, from 1; 0 if it is none. */
static unsigned long place_on_string(const SceneName* name, const char* digits) {
  const size_t n_digits = strspn(digits, "0123456789");
  const unsigned long i =
      n_digits && n_digits < 10 && !digits[n_digits] ? strtoul(digits, NULL, 10) : 0;
  return i <= name->n_masses ? i : 0;
}

/* The mass of a sheet that `dot` and what follows it name: .COLUMN.ROW. */
static bool point_of_sheet(SceneReader* reader,
                           const SceneName* name,
                           const char* dot,
                           uint32_t* point,
                           const char* quote) {
  static const TextRange COUNT = {"", 1.0, SCENE_MOST_COLUMNS, true};
  Text* const text = &reader->text;
  const uint32_t* const n = name->mesh.n;
  char digits[8] = "";
  const char* const second = dot ? strchr(dot + 1, '.') : NULL;
  double column = 0.0;
  double row = 0.0;
  if (second && (size_t)(second - dot - 1) < sizeof(digits)) {
    memcpy(digits, dot + 1, (size_t)(second - dot - 1));
  }
  if (!second || !text_is_number(digits, &COUNT, &column) ||
      !text_is_number(second + 1, &COUNT, &row) || column > n[0] || row > n[1]) {
    return text_fail_at(text, text->line,
                        "found %s, expected one of the sheet's masses, .1.1 to .%lu.%lu after its "
                        "name",
                        quote, (unsigned long)n[0], (unsigned long)n[1]);
  }
  *point = scene_mesh_point(&name->mesh, (uint32_t)column, (uint32_t)row);
  return !reader->network->is_ground[*point] ||
         text_fail_at(text, text->line,
                      "found %s, which lies outside of the outline, expected a mass inside", quote);
}

bool scene_point(SceneReader* reader, bool is_mass, uint32_t* point, char quote[TEXT_QUOTE_SIZE]) {
  Text* const text = &reader->text;
  char* const word = text_word(text);
  char* const dot = word ? strchr(word, '.') : NULL;
  const SceneName* const name = word ? find_before_dot(reader, word, dot) : NULL;
  (void)text_quote(word, quote);
  if (name && name->kind == SCENE_STRING) {
    const unsigned long i = dot ? place_on_string(name, dot + 1) : 0;
    *point = name->first + (uint32_t)i - 1;
    return i > 0 ||
           text_fail_at(text, text->line,
                        "found %s, expected one of the string's masses, 1 to %lu after a dot",
                        quote, (unsigned long)name->n_masses);
  }
  if (name && name->kind == SCENE_SHEET) {
    return point_of_sheet(reader, name, dot, point, quote);
  }
  if (!name || dot) {
    return text_fail(text, word, is_mass ? "a mass declared above" : "a point declared above");
  }
  *point = name->first;
  return !is_mass || name->kind != SCENE_GROUND ||
         text_fail_at(text, text->line, "found %s, a ground, expected a mass", quote);
}

bool scene_mass(SceneReader* reader, uint32_t* point) {
  char quote[TEXT_QUOTE_SIZE];
  return scene_point(reader, true, point, quote);
}
