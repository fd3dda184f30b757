#include "tools/formats/scene.h"

#include "tools/formats/scene_statements.h"

#include <stdlib.h>

static bool done(SceneReader* reader, Status status) {
  return !status || scene_text_fail_at(&reader->text, reader->text.line, "%s", status_text(status));
}

static bool read_lines(SceneReader* reader) {
  while (scene_text_next_line(&reader->text)) {
    if (!scene_statements_read(reader)) {
      return false;
    }
  }
  return true;
}

static bool lacks(SceneReader* reader, const char* expected) {
  const uint32_t line = reader->text.line;
  return scene_text_fail_at(&reader->text, line ? line : 1,
                            "found the end of the file, expected %s", expected);
}

static bool refuse_free(SceneReader* reader, uint32_t point) {
  char quote[SCENE_TEXT_QUOTE_SIZE];
  const SceneName* const name = scene_names_of_point(&reader->names, point);
  return scene_text_fail_at(&reader->text, name->line,
                            "found %s hanging on no ground, expected springs from it to one",
                            scene_text_quote(name->name, quote));
}

static bool check_network(SceneReader* reader) {
  NetworkFault fault = {NETWORK_POINT, 0};
  Status status = network_check(reader->network, &fault);
  if (status == STATUS_EMPTY) {
    return lacks(reader, "a mass or a string");
  }
  status = status ? status : network_find_free(reader->network, &fault);
  return status == STATUS_FREE ? refuse_free(reader, fault.index) : done(reader, status);
}

/* An event at the end or later would never be heard of. */
static bool check_events(SceneReader* reader) {
  const SceneEvent* const events = (const SceneEvent*)(const void*)reader->events.data;
  const size_t n_events = reader->events.size / sizeof(*events);
  for (size_t i = 0; i < n_events; ++i) {
    if (!(events[i].time_s < reader->end_s)) {
      return scene_text_fail_at(&reader->text, events[i].line,
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
  if (!reader->pickups.size && purpose == SCENE_FOR_SOUND) {
    return lacks(reader, "'pickup MASS GAIN'");
  }
  if (!reader->end_line) {
    return purpose == SCENE_FOR_MODES || lacks(reader, "'end T'");
  }
  return check_events(reader);
}

static Scene* make_scene(SceneReader* reader) {
  Scene* const scene = calloc(1, sizeof(*scene));
  if (!scene) {
    (void)done(reader, STATUS_NO_MEMORY);
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
  SceneReader reader = {.network = network_new()};
  Scene* scene = NULL;
  if (scene_text_init(&reader.text, path, error, error_size) &&
      done(&reader, reader.network ? STATUS_OK : STATUS_NO_MEMORY) && read_lines(&reader) &&
      is_whole(&reader, purpose)) {
    scene = make_scene(&reader);
  }
  scene_names_clear(&reader.names);
  scene_text_clear(&reader.text);
  network_free(reader.network);
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
