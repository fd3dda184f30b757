#define _POSIX_C_SOURCE 200809L

#include "tests/support/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

Scene* scenes_read_bytes(const void* data, size_t size, ScenePurpose purpose, ScenesRead* read) {
  strcpy(read->path, "/tmp/hooke_scene_XXXXXX");
  read->error[0] = '\0';
  const int fd = mkstemp(read->path);
  assert_true(fd >= 0);
  assert_int_equal(write(fd, data, size), size);
  assert_int_equal(close(fd), 0);
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
