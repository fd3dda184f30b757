#include "tools/formats/scene_statements.h"

#include "tools/formats/scene_fields.h"

#include <string.h>

typedef struct {
  const char* word;
  Field fields[FIELDS_MAX];
  bool (*take)(SceneReader* reader, const Fields* fields);
} Statement;

static bool fail_status(SceneReader* reader, Status status) {
  return scene_text_fail_at(&reader->text, reader->text.line, "%s", status_text(status));
}

static bool done(SceneReader* reader, Status status) {
  return !status || fail_status(reader, status);
}

static bool declare(SceneReader* reader, SceneName name) {
  name.line = reader->text.line;
  return scene_names_add(&reader->names, name) || fail_status(reader, STATUS_NO_MEMORY);
}

static bool is_first(SceneReader* reader, const char* word, uint32_t* line) {
  if (*line) {
    return scene_text_fail_at(&reader->text, reader->text.line,
                              "found a second '%s', expected the one in line %lu only", word,
                              (unsigned long)*line);
  }
  *line = reader->text.line;
  return true;
}

static bool take_rate(SceneReader* reader, const Fields* fields) {
  reader->rate_hz = fields->number[0];
  return is_first(reader, "rate", &reader->rate_line);
}

static bool take_end(SceneReader* reader, const Fields* fields) {
  reader->end_s = fields->number[0];
  return is_first(reader, "end", &reader->end_line);
}

static bool take_string(SceneReader* reader, const Fields* fields) {
  SceneName name = {.name = fields->name, .kind = SCENE_A_STRING, .n_masses = fields->count};
  return done(reader, network_add_string(reader->network, fields->count, fields->number[0],
                                         fields->number[1], fields->number[2], &name.first)) &&
         declare(reader, name);
}

static bool take_mass(SceneReader* reader, const Fields* fields) {
  SceneName name = {.name = fields->name, .kind = SCENE_A_MASS};
  return done(reader, network_add_mass(reader->network, fields->number[0], &name.first)) &&
         declare(reader, name);
}

static bool take_ground(SceneReader* reader, const Fields* fields) {
  SceneName name = {.name = fields->name, .kind = SCENE_A_GROUND};
  return done(reader, network_add_ground(reader->network, &name.first)) && declare(reader, name);
}

static bool has_two_ends(SceneReader* reader, const Fields* fields) {
  char quote[SCENE_TEXT_QUOTE_SIZE];
  return fields->point[0] != fields->point[1] ||
         scene_text_fail_at(&reader->text, reader->text.line,
                            "found %s at both ends, expected two points",
                            scene_text_quote(fields->point_word, quote));
}

static bool take_spring(SceneReader* reader, const Fields* fields) {
  return has_two_ends(reader, fields) &&
         done(reader, network_add_spring(reader->network, fields->point[0], fields->point[1],
                                         fields->number[0]));
}

static bool take_damper(SceneReader* reader, const Fields* fields) {
  return has_two_ends(reader, fields) &&
         done(reader, network_add_damper(reader->network, fields->point[0], fields->point[1],
                                         fields->number[0]));
}

static bool take_pickup(SceneReader* reader, const Fields* fields) {
  const ScenePickup pickup = {.point = fields->point[0], .gain = fields->number[0]};
  return bytes_append(&reader->pickups, &pickup, sizeof(pickup)) ||
         fail_status(reader, STATUS_NO_MEMORY);
}

static bool take_event(SceneReader* reader, const Fields* fields, SceneAction action) {
  const SceneEvent event = {.action = action,
                            .point = fields->point[0],
                            .line = reader->text.line,
                            .time_s = fields->number[0],
                            .value = fields->number[1],
                            .duration_s = fields->number[2]};
  return bytes_append(&reader->events, &event, sizeof(event)) ||
         fail_status(reader, STATUS_NO_MEMORY);
}

static bool take_displace(SceneReader* reader, const Fields* fields) {
  return take_event(reader, fields, SCENE_DISPLACE);
}

static bool take_strike(SceneReader* reader, const Fields* fields) {
  return take_event(reader, fields, SCENE_STRIKE);
}

static bool take_push(SceneReader* reader, const Fields* fields) {
  return take_event(reader, fields, SCENE_PUSH);
}

static const Statement statements[] = {
    {"rate", {FIELD_HZ}, take_rate},
    {"string",
     {FIELD_NEW_NAME, FIELD_COUNT, FIELD_WORD_MASS, FIELD_KG, FIELD_WORD_STIFFNESS, FIELD_STIFFNESS,
      FIELD_WORD_DAMPING, FIELD_DAMPING},
     take_string},
    {"mass", {FIELD_NEW_NAME, FIELD_KG}, take_mass},
    {"ground", {FIELD_NEW_NAME}, take_ground},
    {"spring", {FIELD_POINT, FIELD_POINT, FIELD_STIFFNESS}, take_spring},
    {"damper", {FIELD_POINT, FIELD_POINT, FIELD_DAMPING}, take_damper},
    {"pickup", {FIELD_MASS, FIELD_GAIN}, take_pickup},
    {"end", {FIELD_DURATION}, take_end},
    {NULL, {FIELD_END}, NULL},
};

/* What follows "at T". */
static const Statement actions[] = {
    {"displace", {FIELD_MASS, FIELD_LENGTH}, take_displace},
    {"strike", {FIELD_MASS, FIELD_VELOCITY}, take_strike},
    {"push", {FIELD_MASS, FIELD_FORCE, FIELD_WORD_FOR, FIELD_DURATION}, take_push},
    {NULL, {FIELD_END}, NULL},
};

static const Statement* find(const Statement* list, const char* word) {
  while (list->word && strcmp(list->word, word) != 0) {
    ++list;
  }
  return list->word ? list : NULL;
}

static bool take(SceneReader* reader, const Statement* statement, Fields* fields) {
  return fields_read(&reader->text, &reader->names, statement->fields, fields) &&
         fields_end(&reader->text) && statement->take(reader, fields);
}

static bool read_action(SceneReader* reader) {
  static const Field time[] = {FIELD_TIME, FIELD_END};
  Fields fields = {0};
  if (!fields_read(&reader->text, &reader->names, time, &fields)) {
    return false;
  }
  const char* const word = scene_text_next_word(&reader->text);
  const Statement* const action = word ? find(actions, word) : NULL;
  if (!action) {
    return scene_text_fail(&reader->text, word, "displace, strike or push");
  }
  return take(reader, action, &fields);
}

bool scene_statements_read(SceneReader* reader) {
  if (!scene_text_is_sound(&reader->text)) {
    return false;
  }
  const char* const word = scene_text_next_word(&reader->text);
  if (!word) {
    return true;
  }
  if (!strcmp(word, "at")) {
    return read_action(reader);
  }
  Fields fields = {0};
  const Statement* const statement = find(statements, word);
  return statement ? take(reader, statement, &fields)
                   : scene_text_fail(&reader->text, word,
                                     "rate, string, mass, ground, spring, damper, at, pickup or "
                                     "end");
}
