/**
   A scene as it is read: what is declared so far, and points by their names.

   Part of tools/formats/scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_READER_H
#define HOOKE_TOOLS_FORMATS_SCENE_READER_H

#include "core/analysis/network.h"
#include "tools/formats/scene_mesh.h"
#include "tools/formats/text.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum { SCENE_MASS, SCENE_GROUND, SCENE_STRING, SCENE_SHEET, SCENE_AIR } SceneKind;

/** A name, and which points it stands for. */
typedef struct {
  char* name;
  SceneKind kind;
  uint32_t line;     /**< Where it is declared */
  uint32_t first;    /**< Its first point */
  uint32_t n_masses; /**< Of a string: the points from `first` on; the two ends follow */
  SceneMesh mesh;    /**< Of a sheet */
  double area_m2;    /**< Of air */
} SceneName;

typedef struct {
  Text text;
  Bytes names;      /**< SceneName each */
  uint32_t* slots;  /**< A table of names by hash: a place in `names` plus 1, or 0 */
  uint32_t n_slots; /**< A power of 2, or 0 */
  Network* network;
  Bytes events;    /**< SceneEvent each */
  Bytes pickups;   /**< ScenePickup each */
  Bytes bridge;    /**< ScenePickup each */
  Bytes radiators; /**< SceneRadiator each */
  Bytes losses;    /**< SceneLoss each */
  Bytes more;      /**< BodyMode each */
  double rate_hz;
  double end_s;
  uint32_t rate_line; /**< 0: not declared yet */
  uint32_t end_line;
} SceneReader;

/** Whether `status` is STATUS_OK; what it is otherwise is said. */
bool scene_done(SceneReader* reader, Status status);

/** What is declared by a name, or NULL. */
const SceneName* scene_find(const SceneReader* reader, const char* name);

/** Declare a name. */
bool scene_declare(SceneReader* reader, SceneName name);

/** Take the next word as a name that is not declared yet. */
bool scene_new_name(SceneReader* reader, SceneName* name);

/** Take a point that is declared above; its word is quoted in `quote`. */
bool scene_point(SceneReader* reader, bool is_mass, uint32_t* point, char quote[TEXT_QUOTE_SIZE]);

/** Take a mass that is declared above. */
bool scene_mass(SceneReader* reader, uint32_t* point);

#endif
