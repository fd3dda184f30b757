#include "tests/support/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

Scene* scenes_read_bytes(const void* data, size_t size, ScenePurpose purpose, ScenesRead* read) {
  temporary_file(data, size, read->path);
  read->error[0] = '\0';
  Scene* const scene = scene_new(read->path, purpose, read->error, sizeof(read->error));
  assert_int_equal(unlink(read->path), 0);
  return scene;
}

Scene* scenes_read(const char* text) {
  ScenesRead read;
  Scene* const scene = scenes_read_bytes(text, strlen(text), SCENE_FOR_SOUND, &read);
  if (!scene) {
    fail_msg("%s", read.error);
  }
  return scene;
}
