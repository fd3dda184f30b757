/**
   The statements of a scene that make bodies: sheets, braces and air, where strings pull at them,
   what of them is heard, and how long it lasts.

   Each takes the rest of its line, and returns false after a message.

   Part of tools/formats/scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_BODY_H
#define HOOKE_TOOLS_FORMATS_SCENE_BODY_H

#include "tools/formats/scene_reader.h"

#include <stdbool.h>

bool scene_take_bend(SceneReader* reader);
bool scene_take_twist(SceneReader* reader);
bool scene_take_plate(SceneReader* reader);
bool scene_take_membrane(SceneReader* reader);
bool scene_take_brace(SceneReader* reader);
bool scene_take_air(SceneReader* reader);
bool scene_take_bridge(SceneReader* reader);
bool scene_take_radiate(SceneReader* reader);
bool scene_take_loss(SceneReader* reader);
bool scene_take_above(SceneReader* reader);

#endif
