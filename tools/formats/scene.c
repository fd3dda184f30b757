#include "tools/formats/scene.h"

#include "tools/formats/text.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* Above 0 is from the smallest number on that has all its digits. */
static const TextRange HZ = {"a rate above 0 and up to 1e9 Hz", DBL_MIN, 1e9, false};
static const TextRange COUNT = {"a whole number of masses from 1 to 10000000", 1, 1e7, true};
static const TextRange KG = {"a mass above 0 kg", DBL_MIN, DBL_MAX, false};
static const TextRange STIFFNESS = {"a stiffness from 0 N/m up", 0, DBL_MAX, false};
static const TextRange DAMPING = {"a damping from 0 kg/s up", 0, DBL_MAX, false};
static const TextRange TIME = {"a time from 0 to 1e6 s", 0, 1e6, false};
static const TextRange DURATION = {"a duration above 0 and up to 1e6 s", DBL_MIN, 1e6, false};
static const TextRange LENGTH = {"a displacement in m", -DBL_MAX, DBL_MAX, false};
static const TextRange VELOCITY = {"a velocity in m/s", -DBL_MAX, DBL_MAX, false};
static const TextRange FORCE = {"a force in N", -DBL_MAX, DBL_MAX, false};
static const TextRange GAIN = {"a gain", -DBL_MAX, DBL_MAX, false};

enum { FIRST_SLOTS = 64 };

typedef enum { A_MASS, A_GROUND, A_STRING } Kind;

/* A name, and which points it stands for. */
typedef struct {
  char* name;
  Kind kind;
  uint32_t line;     /* Where it is declared */
  uint32_t first;    /* Its first point */
  uint32_t n_masses; /* Of a string: the points from `first` on; the two ends follow */
} Name;

typedef struct {
  Text text;
  Bytes names;      /* Name each */
  uint32_t* slots;  /* A table of names by hash: a place in `names` plus 1, or 0 */
  uint32_t n_slots; /* A power of 2, or 0 */
  Network* network;
  Bytes events;  /* SceneEvent each */
  Bytes pickups; /* ScenePickup each */
  double rate_hz;
  double end_s;
  uint32_t rate_line; /* 0: not declared yet */
  uint32_t end_line;
} Reader;

static bool done(Reader* reader, Status status) {
  return !status || text_fail_at(&reader->text, reader->text.line, "%s", status_text(status));
}

/* Names */

static const Name* names_of(const Reader* reader) {
  return (const Name*)(const void*)reader->names.data;
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
static uint32_t* slot_of(const Reader* reader, const char* name) {
  uint32_t i = hash_of(name) & (reader->n_slots - 1);
  while (reader->slots[i] && strcmp(names_of(reader)[reader->slots[i] - 1].name, name) != 0) {
    i = (i + 1) & (reader->n_slots - 1);
  }
  return &reader->slots[i];
}

/* Make room for one name more than there are; no more than half of the slots are ever taken. */
static bool reserve_slots(Reader* reader, uint32_t n_names) {
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

static const Name* find_name(const Reader* reader, const char* name) {
  const uint32_t place = reader->n_slots ? *slot_of(reader, name) : 0;
  return place ? names_of(reader) + place - 1 : NULL;
}

static bool declare(Reader* reader, Name name) {
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

static bool take_new_name(Reader* reader, Name* name) {
  Text* const text = &reader->text;
  char quote[TEXT_QUOTE_SIZE];
  name->name = text_word(text);
  if (!name->name || !is_name(name->name)) {
    return text_fail(text, name->name, "a new name, of letters, digits, _ and -, a letter first");
  }
  const Name* const old = find_name(reader, name->name);
  return !old || text_fail_at(text, text->line,
                              "found %s, declared in line %lu already, expected a new name",
                              text_quote(name->name, quote), (unsigned long)old->line);
}

/* Points */

/* What the word's part before its dot stands for. */
static const Name* find_before_dot(const Reader* reader, char* word, char* dot) {
  if (dot) {
    *dot = '\0';
  }
  const Name* const name = find_name(reader, word);
  if (dot) {
    *dot = '.';
  }
  return name;
}

/* A place on a string from its digits, from 1; 0 if it is none. */
static unsigned long place_on_string(const Name* name, const char* digits) {
  const size_t n_digits = strspn(digits, "0123456789");
  const unsigned long i =
      n_digits && n_digits < 10 && !digits[n_digits] ? strtoul(digits, NULL, 10) : 0;
  return i <= name->n_masses ? i : 0;
}

/* Take a point that is declared above; its word is quoted in `quote`. */
static bool take_point(Reader* reader, bool is_mass, uint32_t* point, char quote[TEXT_QUOTE_SIZE]) {
  Text* const text = &reader->text;
  char* const word = text_word(text);
  char* const dot = word ? strchr(word, '.') : NULL;
  const Name* const name = word ? find_before_dot(reader, word, dot) : NULL;
  (void)text_quote(word, quote);
  if (name && name->kind == A_STRING) {
    const unsigned long i = dot ? place_on_string(name, dot + 1) : 0;
    *point = name->first + (uint32_t)i - 1;
    return i > 0 ||
           text_fail_at(text, text->line,
                        "found %s, expected one of the string's masses, 1 to %lu after a dot",
                        quote, (unsigned long)name->n_masses);
  }
  if (!name || dot) {
    return text_fail(text, word, is_mass ? "a mass declared above" : "a point declared above");
  }
  *point = name->first;
  return !is_mass || name->kind == A_MASS ||
         text_fail_at(text, text->line, "found %s, a ground, expected a mass", quote);
}

static bool take_mass_point(Reader* reader, uint32_t* point) {
  char quote[TEXT_QUOTE_SIZE];
  return take_point(reader, true, point, quote);
}

/* Statements */

static bool take_rate(Reader* reader) {
  Text* const text = &reader->text;
  return text_number(text, &HZ, &reader->rate_hz) && text_end(text) &&
         text_is_first(text, "rate", &reader->rate_line);
}

static bool take_end(Reader* reader) {
  Text* const text = &reader->text;
  return text_number(text, &DURATION, &reader->end_s) && text_end(text) &&
         text_is_first(text, "end", &reader->end_line);
}

static bool take_string(Reader* reader) {
  Text* const text = &reader->text;
  Name name = {.kind = A_STRING};
  double n = 0.0;
  double mass_kg = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
  if (!take_new_name(reader, &name) || !text_number(text, &COUNT, &n) ||
      !text_keyword(text, "mass") || !text_number(text, &KG, &mass_kg) ||
      !text_keyword(text, "stiffness") || !text_number(text, &STIFFNESS, &stiffness) ||
      !text_keyword(text, "damping") || !text_number(text, &DAMPING, &damping) || !text_end(text)) {
    return false;
  }
  name.n_masses = (uint32_t)n;
  return done(reader, network_add_string(reader->network, name.n_masses, mass_kg, stiffness,
                                         damping, &name.first)) &&
         declare(reader, name);
}

static bool take_mass(Reader* reader) {
  Name name = {.kind = A_MASS};
  double mass_kg = 0.0;
  return take_new_name(reader, &name) && text_number(&reader->text, &KG, &mass_kg) &&
         text_end(&reader->text) &&
         done(reader, network_add_mass(reader->network, mass_kg, &name.first)) &&
         declare(reader, name);
}

static bool take_ground(Reader* reader) {
  Name name = {.kind = A_GROUND};
  return take_new_name(reader, &name) && text_end(&reader->text) &&
         done(reader, network_add_ground(reader->network, &name.first)) && declare(reader, name);
}

/* A spring or a damper. */
static bool take_link(Reader* reader,
                      const TextRange* range,
                      Status (*add)(Network* network, uint32_t p, uint32_t q, double value)) {
  Text* const text = &reader->text;
  char quote[TEXT_QUOTE_SIZE];
  uint32_t point[2] = {0, 0};
  double value = 0.0;
  if (!take_point(reader, false, &point[0], quote) ||
      !take_point(reader, false, &point[1], quote) || !text_number(text, range, &value) ||
      !text_end(text)) {
    return false;
  }
  if (point[0] == point[1]) {
    return text_fail_at(text, text->line, "found %s at both ends, expected two points", quote);
  }
  return done(reader, add(reader->network, point[0], point[1], value));
}

static bool take_spring(Reader* reader) {
  return take_link(reader, &STIFFNESS, network_add_spring);
}

static bool take_damper(Reader* reader) {
  return take_link(reader, &DAMPING, network_add_damper);
}

static bool take_pickup(Reader* reader) {
  ScenePickup pickup = {0};
  return take_mass_point(reader, &pickup.point) &&
         text_number(&reader->text, &GAIN, &pickup.gain) && text_end(&reader->text) &&
         (bytes_append(&reader->pickups, &pickup, sizeof(pickup)) ||
          text_fail_memory(&reader->text));
}

static bool take_event(Reader* reader) {
  static const struct {
    const char* word;
    const TextRange* range;
  } actions[] = {[SCENE_DISPLACE] = {"displace", &LENGTH},
                 [SCENE_STRIKE] = {"strike", &VELOCITY},
                 [SCENE_PUSH] = {"push", &FORCE}};
  Text* const text = &reader->text;
  SceneEvent event = {.line = text->line};
  if (!text_number(text, &TIME, &event.time_s)) {
    return false;
  }
  const char* const word = text_word(text);
  unsigned action = SCENE_DISPLACE;
  while (word && action <= SCENE_PUSH && strcmp(actions[action].word, word) != 0) {
    ++action;
  }
  if (!word || action > SCENE_PUSH) {
    return text_fail(text, word, "displace, strike or push");
  }
  event.action = (SceneAction)action;
  return take_mass_point(reader, &event.point) &&
         text_number(text, actions[action].range, &event.value) &&
         (action != SCENE_PUSH ||
          (text_keyword(text, "for") && text_number(text, &DURATION, &event.duration_s))) &&
         text_end(text) &&
         (bytes_append(&reader->events, &event, sizeof(event)) || text_fail_memory(text));
}

static bool read_line(Reader* reader) {
  static const struct {
    const char* word;
    bool (*take)(Reader* reader);
  } statements[] = {{"rate", take_rate},     {"string", take_string}, {"mass", take_mass},
                    {"ground", take_ground}, {"spring", take_spring}, {"damper", take_damper},
                    {"at", take_event},      {"pickup", take_pickup}, {"end", take_end}};
  if (!text_is_sound(&reader->text)) {
    return false;
  }
  const char* const word = text_word(&reader->text);
  for (size_t i = 0; word && i < sizeof(statements) / sizeof(statements[0]); ++i) {
    if (!strcmp(statements[i].word, word)) {
      return statements[i].take(reader);
    }
  }
  return !word || text_fail(&reader->text, word,
                            "rate, string, mass, ground, spring, damper, at, pickup or end");
}

/* The whole */

static bool lacks(Reader* reader, const char* expected) {
  const uint32_t line = reader->text.line;
  return text_fail_at(&reader->text, line ? line : 1, "found the end of the file, expected %s",
                      expected);
}

static bool check_network(Reader* reader) {
  const Status status = network_check(reader->network, NULL);
  return status == STATUS_EMPTY ? lacks(reader, "a mass or a string") : done(reader, status);
}

/* An event at the end or later would never be heard of. */
static bool check_events(Reader* reader) {
  const SceneEvent* const events = (const SceneEvent*)(const void*)reader->events.data;
  const size_t n_events = reader->events.size / sizeof(*events);
  for (size_t i = 0; i < n_events; ++i) {
    if (!(events[i].time_s < reader->end_s)) {
      return text_fail_at(&reader->text, events[i].line,
                          "found a time of %g s, expected one before the end at %g s",
                          events[i].time_s, reader->end_s);
    }
  }
  return true;
}

static bool is_whole(Reader* reader, ScenePurpose purpose) {
  if (!reader->rate_line) {
    return lacks(reader, "'rate HZ'");
  }
  if (!check_network(reader)) {
    return false;
  }
  if (!reader->pickups.size && purpose == SCENE_FOR_SOUND) {
    return lacks(reader, "'pickup MASS GAIN'");
  }
  if (!reader->end_line) {
    return purpose == SCENE_FOR_MODES || lacks(reader, "'end T'");
  }
  return check_events(reader);
}

static bool read_lines(Reader* reader) {
  while (text_next_line(&reader->text)) {
    if (!read_line(reader)) {
      return false;
    }
  }
  return true;
}

static Scene* make_scene(Reader* reader) {
  Scene* const scene = calloc(1, sizeof(*scene));
  if (!scene) {
    (void)text_fail_memory(&reader->text);
    return NULL;
  }
  scene->rate_hz = reader->rate_hz;
  scene->end_s = reader->end_s;
  scene->network = reader->network;
  scene->n_events = reader->events.size / sizeof(SceneEvent);
  scene->events = (SceneEvent*)(void*)reader->events.data;
  scene->n_pickups = reader->pickups.size / sizeof(ScenePickup);
  scene->pickups = (ScenePickup*)(void*)reader->pickups.data;
  reader->network = NULL;
  reader->events = reader->pickups = (Bytes){0};
  return scene;
}

Scene* scene_new(const char* path, ScenePurpose purpose, char* error, size_t error_size) {
  Reader reader = {.network = network_new()};
  Scene* scene = NULL;
  if (text_init(&reader.text, path, error, error_size) &&
      done(&reader, reader.network ? STATUS_OK : STATUS_NO_MEMORY) && read_lines(&reader) &&
      is_whole(&reader, purpose)) {
    scene = make_scene(&reader);
  }
  text_clear(&reader.text);
  network_free(reader.network);
  free(reader.slots);
  bytes_clear(&reader.names);
  bytes_clear(&reader.events);
  bytes_clear(&reader.pickups);
  return scene;
}

void scene_free(Scene* scene) {
  if (scene) {
    network_free(scene->network);
    free(scene->events);
    free(scene->pickups);
    free(scene);
  }
}
