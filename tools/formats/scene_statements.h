/**
   The statements of a scene: each line adds to what was read before.

   Part of tools/formats/scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_STATEMENTS_H
#define HOOKE_TOOLS_FORMATS_SCENE_STATEMENTS_H

#include "tools/formats/scene.h"
#include "tools/formats/scene_names.h"
#include "tools/formats/scene_text.h"

#include <stdbool.h>
#include <stdint.h>

/** What has been read. */
typedef struct {
  SceneText text;
  SceneNames names;
  Network* network;
  Bytes events;  ///< SceneEvent each
  Bytes pickups; ///< ScenePickup each
  double rate_hz;
  double end_s;
  uint32_t rate_line; ///< 0: not declared yet
  uint32_t end_line;
} SceneReader;

/** Read the statement in the line that the text is at, if there is one. @return false after a
 * message */
bool scene_statements_read(SceneReader* reader);

#endif
