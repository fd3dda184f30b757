/**
   What a scene has besides its network.

   Part of tools/formats/scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_PART_H
#define HOOKE_TOOLS_FORMATS_SCENE_PART_H

#include <stdint.h>

/** What is done to a mass. */
typedef enum { SCENE_DISPLACE, SCENE_STRIKE, SCENE_PUSH } SceneAction;

typedef struct {
  SceneAction action;
  uint32_t point;    /**< Of the network */
  uint32_t line;     /**< Of the file, from 1 */
  double time_s;     /**< ≥ 0 [s] */
  double value;      /**< [m], [m/s] or [N] */
  double duration_s; /**< Of a push, > 0 [s] */
} SceneEvent;

typedef struct {
  uint32_t point; /**< Of the network */
  double gain;    /**< [1/m] */
} ScenePickup;

/** A mass that moves air. */
typedef struct {
  uint32_t point;
  double area_m2;    /**< Times the gain */
  double place_m[2]; /**< From the middle of its sheet [m] */
} SceneRadiator;

typedef struct {
  double f0_hz;
  double q;
} SceneLoss;

#endif
