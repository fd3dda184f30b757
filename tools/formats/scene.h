/**
   A scene: a network of masses, springs and dampers, what is done to it, and where it is heard; or
   what a body is made of, and where strings pull at it.

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

   What bodies are made of, besides:

       bend A B C K                  a moment spring: its energy is K/2 (x_A − 2 x_B + x_C)² [N/m]
       twist A B C D K               K/2 (x_A − x_B − x_C + x_D)²
       plate NAME COLUMNS ROWS size W H density S bending DX DY edge EDGE [SHAPE]
                                     W × H [m], S [kg/m²], DX and DY [N m], masses NAME.COLUMN.ROW;
                                     EDGE is free, hinged or clamped; SHAPE is round, or `outline`
                                     with its widths from the first row to the last, as shares
       membrane NAME COLUMNS ROWS size W H density S tension T [SHAPE]
                                     T [N/m]; the rim is held (tools/formats/scene_mesh.h)
       brace MASS MASS mass KG bending EI
                                     a bar glued to a plate, along a row, column or diagonal [N m²]
       air NAME mass KG area S volume V walls PLATE...
                                     the air of a box of V [m³]: what of it moves in its hole, a
                                     mass of S [m²], and the plates outwards change its volume
       bridge MASS WEIGHT            where strings pull, by shares of their force
       radiate NAME GAIN             a plate, membrane or air that is heard
       loss HZ Q                     the Q of modes, besides what dampers do: on a straight line
                                     between two of these where both axes are logarithmic
       above HZ density ...          modes by chance, where the network ends, as in a table
                                     (core/bank/body_read.h)

   Thread: any, one at a time for each scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_H
#define HOOKE_TOOLS_FORMATS_SCENE_H

#include "core/analysis/network.h"
#include "core/bank/body.h"
#include "tools/formats/scene_part.h"

#include <stddef.h>
#include <stdint.h>

/** Room for any message of scene_new() about a path of usual length [bytes]. */
enum { SCENE_ERROR_SIZE = 4608 };

/** What a scene is read for. */
typedef enum {
  SCENE_FOR_MODES, /**< Its network and rate; pickups and an end may be missing */
  SCENE_FOR_SOUND, /**< All of it, but for what only bodies need */
  SCENE_FOR_BODY   /**< Its network, bridge, losses, and what is heard of it */
} ScenePurpose;

typedef struct {
  double rate_hz;     /**< > 0 */
  double end_s;       /**< > 0; 0 if there is none */
  Network* network;   /**< Checked, at rest */
  SceneEvent* events; /**< As they come in the file */
  size_t n_events;
  ScenePickup* pickups;
  size_t n_pickups;
  ScenePickup* bridge; /**< Shares of a force */
  size_t n_bridge;
  SceneRadiator* radiators;
  size_t n_radiators;
  SceneLoss* losses; /**< The lowest first */
  size_t n_losses;
  BodyMode* more; /**< Beyond the network's */
  size_t n_more;
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
