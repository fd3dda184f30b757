/**
   A scene: a network of masses, springs and dampers, what is done to it, and where it is heard.

   A scene file is text, one statement a line; `#` begins a comment, and what is declared can be
   used in the lines below.  Units are SI.

       rate HZ                                           steps per second, and the sound's rate
       string NAME N mass KG stiffness K damping Z       N masses, NAME.1 to NAME.N, between two
                                                         fixed ends
       mass NAME KG
       ground NAME                                       a point that does not move
       spring POINT POINT K                              [N/m]
       damper POINT POINT Z                              [kg/s]
       at T displace MASS X                              moved by X [m] at T [s], besides its motion
       at T strike MASS V                                V [m/s] added to its velocity
       at T push MASS F for D                            F [N] from T on, D [s] long
       pickup MASS GAIN                                  GAIN times its position [m] is heard; the
                                                         sound is the sum over all pickups
       end T                                             the sound's length [s]

   Thread: any, one at a time for each scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_H
#define HOOKE_TOOLS_FORMATS_SCENE_H

#include "core/analysis/network.h"

#include <stddef.h>
#include <stdint.h>

/** Room for any message of scene_new() about a path of usual length [bytes]. */
enum { SCENE_ERROR_SIZE = 4608 };

/** What a scene is read for. */
typedef enum {
  SCENE_FOR_MODES, /**< Its network and rate; pickups and an end may be missing */
  SCENE_FOR_SOUND  /**< All of it */
} ScenePurpose;

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

typedef struct {
  double rate_hz;     /**< > 0 */
  double end_s;       /**< > 0; 0 if there is none */
  Network* network;   /**< Checked, at rest */
  SceneEvent* events; /**< As they come in the file */
  size_t n_events;
  ScenePickup* pickups;
  size_t n_pickups;
} Scene;

/**
   Read a scene file.

   @param[out] error  On failure one line, without its end: "PATH:LINE: found …, expected …"
   @param error_size  Room in `error` [bytes]
   @return The scene, to be given to scene_free(), or NULL on failure
*/
Scene* scene_new(const char* path, ScenePurpose purpose, char* error, size_t error_size);

/** Free a scene and its network; NULL is fine. */
void scene_free(Scene* scene);

#endif
