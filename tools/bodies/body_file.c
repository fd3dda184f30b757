#include "tools/bodies/body_file.h"

#include "core/bank/body_read.h"
#include "tools/bodies/reduce.h"
#include "tools/formats/bytes.h"

#include <stdio.h>
#include <string.h>

enum { MAX_SIZE = 16 << 20 };

static bool ends_with(const char* path, const char* ending) {
  const size_t length = strlen(path);
  return length > strlen(ending) && !strcmp(path + length - strlen(ending), ending);
}

static bool
take_table(const char* path, const Bytes* text, Body* body, char* error, size_t error_size) {
  BodyError wrong;
  if (body_read((const char*)text->data, text->size, body, &wrong)) {
    (void)snprintf(error, error_size, "%s:%u: found %s, expected %s", path, wrong.line, wrong.found,
                   wrong.expected);
    return false;
  }
  return true;
}

static bool read_table(const char* path, Body* body, char* error, size_t error_size) {
  Bytes text = {0};
  const bool is_read = bytes_read(&text, path, MAX_SIZE, error, error_size) &&
                       take_table(path, &text, body, error, error_size);
  bytes_clear(&text);
  return is_read;
}

static bool
read_scene(const char* path, Body* body, Reduction* reduction, char* error, size_t error_size) {
  Scene* const scene = scene_new(path, SCENE_FOR_BODY, error, error_size);
  if (!scene) {
    return false;
  }
  const Status status = reduce_scene(scene, body, reduction);
  if (status) {
    (void)snprintf(error, error_size, "%s: could not find its modes: %s", path,
                   status_text(status));
  }
  scene_free(scene);
  return !status;
}

bool body_file_read(
    const char* path, Body* body, Reduction* reduction, char* error, size_t error_size) {
  if (reduction) {
    *reduction = (Reduction){0};
  }
  if (ends_with(path, ".body")) {
    return read_table(path, body, error, error_size);
  }
  if (ends_with(path, ".scene")) {
    return read_scene(path, body, reduction, error, error_size);
  }
  (void)snprintf(error, error_size,
                 "%s: found no body, expected a name that ends with .body or "
                 ".scene",
                 path);
  return false;
}
