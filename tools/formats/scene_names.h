/**
   The names that a scene declares, and which points they stand for.

   Part of tools/formats/scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_NAMES_H
#define HOOKE_TOOLS_FORMATS_SCENE_NAMES_H

#include "tools/formats/bytes.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum { SCENE_A_MASS, SCENE_A_GROUND, SCENE_A_STRING } SceneKind;

/** What a name stands for. */
typedef struct {
  char* name;
  SceneKind kind;
  uint32_t line;     ///< Where it is declared
  uint32_t first;    ///< Its first point
  uint32_t n_masses; ///< Of a string: the points from `first` on; the two ends follow
} SceneName;

/** All names; all zero is a valid, empty set.  Those of one kind of point come in the order of
 * their points. */
typedef struct {
  Bytes list;       ///< SceneName each
  uint32_t* slots;  ///< A table by hash: a place in `list` plus 1, or 0
  uint32_t n_slots; ///< A power of 2, or 0
} SceneNames;

void scene_names_clear(SceneNames* names);

/** @return What `name` stands for, good until the next is added; NULL if nothing */
const SceneName* scene_names_find(const SceneNames* names, const char* name);

/** Add a name that is new, declared later and with higher points than all before; its letters are
 * used as long as the names are. @return false: out of memory */
bool scene_names_add(SceneNames* names, SceneName name);

/** @return The name which a point belongs to; the point must have one */
const SceneName* scene_names_of_point(const SceneNames* names, uint32_t point);

#endif
