/** Scenes from text, for tests. */
#ifndef HOOKE_TESTS_SUPPORT_SCENES_H
#define HOOKE_TESTS_SUPPORT_SCENES_H

#include "tests/support/temporary.h"
#include "tools/formats/scene.h"

#include <stddef.h>

/** Where a scene was, and what was said about it. */
typedef struct {
  char path[TEMPORARY_SIZE];
  char error[SCENE_ERROR_SIZE];
} ScenesRead;

/** scene_new() of a file with these bytes, which is gone again. */
Scene* scenes_read_bytes(const void* data, size_t size, ScenePurpose purpose, ScenesRead* read);

/** A scene with sound; the test fails if it is refused. */
Scene* scenes_read(const char* text);

#endif
