#include "tools/formats/scene.h"

#include "tools/formats/scene_body.h"
#include "tools/formats/scene_reader.h"

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

/* Statements */

static bool take_rate(SceneReader* reader) {
  Text* const text = &reader->text;
  return text_number(text, &HZ, &reader->rate_hz) && text_end(text) &&
         text_is_first(text, "rate", &reader->rate_line);
}

static bool take_end(SceneReader* reader) {
  Text* const text = &reader->text;
  return text_number(text, &DURATION, &reader->end_s) && text_end(text) &&
         text_is_first(text, "end", &reader->end_line);
}

static bool take_string(SceneReader* reader) {
  Text* const text = &reader->text;
  SceneName name = {.kind = SCENE_STRING};
  double n = 0.0;
  double mass_kg = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
  if (!scene_new_name(reader, &name) || !text_number(text, &COUNT, &n) ||
      !text_keyword(text, "mass") || !text_number(text, &KG, &mass_kg) ||
      !text_keyword(text, "stiffness") || !text_number(text, &STIFFNESS, &stiffness) ||
      !text_keyword(text, "damping") || !text_number(text, &DAMPING, &damping) || !text_end(text)) {
    return false;
  }
  name.n_masses = (uint32_t)n;
  return scene_done(reader, network_add_string(reader->network, name.n_masses, mass_kg, stiffness,
                                               damping, &name.first)) &&
         scene_declare(reader, name);
}

static bool take_mass(SceneReader* reader) {
  SceneName name = {.kind = SCENE_MASS};
  double mass_kg = 0.0;
  return scene_new_name(reader, &name) && text_number(&reader->text, &KG, &mass_kg) &&
         text_end(&reader->text) &&
         scene_done(reader, network_add_mass(reader->network, mass_kg, &name.first)) &&
         scene_declare(reader, name);
}

static bool take_ground(SceneReader* reader) {
  SceneName name = {.kind = SCENE_GROUND};
  return scene_new_name(reader, &name) && text_end(&reader->text) &&
         scene_done(reader, network_add_ground(reader->network, &name.first)) &&
         scene_declare(reader, name);
}

/* A spring or a damper. */
static bool take_link(SceneReader* reader,
                      const TextRange* range,
                      Status (*add)(Network* network, uint32_t p, uint32_t q, double value)) {
  Text* const text = &reader->text;
  char quote[TEXT_QUOTE_SIZE];
  uint32_t point[2] = {0, 0};
  double value = 0.0;
  if (!scene_point(reader, false, &point[0], quote) ||
      !scene_point(reader, false, &point[1], quote) || !text_number(text, range, &value) ||
      !text_end(text)) {
    return false;
  }
  if (point[0] == point[1]) {
    return text_fail_at(text, text->line, "found %s at both ends, expected two points", quote);
  }
  return scene_done(reader, add(reader->network, point[0], point[1], value));
}

static bool take_spring(SceneReader* reader) {
  return take_link(reader, &STIFFNESS, network_add_spring);
}

static bool take_damper(SceneReader* reader) {
  return take_link(reader, &DAMPING, network_add_damper);
}

static bool take_pickup(SceneReader* reader) {
  ScenePickup pickup = {0};
  return scene_mass(reader, &pickup.point) && text_number(&reader->text, &GAIN, &pickup.gain) &&
         text_end(&reader->text) &&
         (bytes_append(&reader->pickups, &pickup, sizeof(pickup)) ||
          text_fail_memory(&reader->text));
}

static bool take_event(SceneReader* reader) {
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
  return scene_mass(reader, &event.point) &&
         text_number(text, actions[action].range, &event.value) &&
         (action != SCENE_PUSH ||
          (text_keyword(text, "for") && text_number(text, &DURATION, &event.duration_s))) &&
         text_end(text) &&
         (bytes_append(&reader->events, &event, sizeof(event)) || text_fail_memory(text));
}

static bool read_line(SceneReader* reader) {
  static const struct {
    const char* word;
    bool (*take)(SceneReader* reader);
  } statements[] = {{"rate", take_rate},
                    {"string", take_string},
                    {"mass", take_mass},
                    {"ground", take_ground},
                    {"spring", take_spring},
                    {"damper", take_damper},
                    {"bend", scene_take_bend},
                    {"twist", scene_take_twist},
                    {"plate", scene_take_plate},
                    {"membrane", scene_take_membrane},
                    {"brace", scene_take_brace},
                    {"air", scene_take_air},
                    {"bridge", scene_take_bridge},
                    {"radiate", scene_take_radiate},
                    {"loss", scene_take_loss},
                    {"above", scene_take_above},
                    {"at", take_event},
                    {"pickup", take_pickup},
                    {"end", take_end}};
  if (!text_is_sound(&reader->text)) {
    return false;
  }
  const char* const word = text_word(&reader->text);
  for (size_t i = 0; word && i < sizeof(statements) / sizeof(statements[0]); ++i) {
    if (!strcmp(statements[i].word, word)) {
      return statements[i].take(reader);
    }
  }
  return !word ||
         text_fail(
             &reader->text, word,
             "rate, string, mass, ground, spring, damper, at, pickup, end, bend, twist, plate, "
             "membrane, brace, air, bridge, radiate, loss or above");
}

/* The whole */

static bool lacks(SceneReader* reader, const char* expected) {
  const uint32_t line = reader->text.line;
  return text_fail_at(&reader->text, line ? line : 1, "found the end of the file, expected %s",
                      expected);
}

static bool check_network(SceneReader* reader) {
  const Status status = network_check(reader->network, NULL);
  return status == STATUS_EMPTY ? lacks(reader, "a mass or a string") : scene_done(reader, status);
}

/* An event at the end or later would never be heard of. */
static bool check_events(SceneReader* reader) {
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

static bool is_whole(SceneReader* reader, ScenePurpose purpose) {
  if (!reader->rate_line) {
    return lacks(reader, "'rate HZ'");
  }
  if (!check_network(reader)) {
    return false;
  }
  if (purpose == SCENE_FOR_BODY) {
    return (reader->bridge.size || lacks(reader, "'bridge MASS WEIGHT'")) &&
           (reader->radiators.size || lacks(reader, "'radiate NAME GAIN'")) &&
           (reader->losses.size || lacks(reader, "'loss HZ Q'"));
  }
  if (!reader->pickups.size && purpose == SCENE_FOR_SOUND) {
    return lacks(reader, "'pickup MASS GAIN'");
  }
  if (!reader->end_line) {
    return purpose == SCENE_FOR_MODES || lacks(reader, "'end T'");
  }
  return check_events(reader);
}

static bool read_lines(SceneReader* reader) {
  while (text_next_line(&reader->text)) {
    if (!read_line(reader)) {
      return false;
    }
  }
  return true;
}

static Scene* make_scene(SceneReader* reader) {
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
  scene->n_bridge = reader->bridge.size / sizeof(ScenePickup);
  scene->bridge = (ScenePickup*)(void*)reader->bridge.data;
  scene->n_radiators = reader->radiators.size / sizeof(SceneRadiator);
  scene->radiators = (SceneRadiator*)(void*)reader->radiators.data;
  scene->n_losses = reader->losses.size / sizeof(SceneLoss);
  scene->losses = (SceneLoss*)(void*)reader->losses.data;
  scene->n_more = reader->more.size / sizeof(BodyMode);
  scene->more = (BodyMode*)(void*)reader->more.data;
  reader->network = NULL;
  reader->events = reader->pickups = (Bytes){0};
  reader->bridge = reader->radiators = reader->losses = reader->more = (Bytes){0};
  return scene;
}

Scene* scene_new(const char* path, ScenePurpose purpose, char* error, size_t error_size) {
  SceneReader reader = {.network = network_new()};
  Scene* scene = NULL;
  if (text_init(&reader.text, path, error, error_size) &&
      scene_done(&reader, reader.network ? STATUS_OK : STATUS_NO_MEMORY) && read_lines(&reader) &&
      is_whole(&reader, purpose)) {
    scene = make_scene(&reader);
  }
  text_clear(&reader.text);
  network_free(reader.network);
  free(reader.slots);
  bytes_clear(&reader.names);
  bytes_clear(&reader.events);
  bytes_clear(&reader.pickups);
  bytes_clear(&reader.bridge);
  bytes_clear(&reader.radiators);
  bytes_clear(&reader.losses);
  bytes_clear(&reader.more);
  return scene;
}

void scene_free(Scene* scene) {
  if (scene) {
    network_free(scene->network);
    free(scene->events);
    free(scene->pickups);
    free(scene->bridge);
    free(scene->radiators);
    free(scene->losses);
    free(scene->more);
    free(scene);
  }
}
