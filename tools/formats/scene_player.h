/**
   A scene played: its network stepped, what is done to it at the exact step, its pickups summed.

   Frame n is the network at n steps, after what is done to it there, so frame 0 has what is done at
   0 s.  What is done at T is done at the step nearest to it; a push lasts for the steps from there
   to the one nearest to its end, and for one at least.

   Thread: one at a time for each scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_PLAYER_H
#define HOOKE_TOOLS_FORMATS_SCENE_PLAYER_H

#include "tools/formats/scene.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct ScenePlayer ScenePlayer;

/**
   Put a scene at rest and at its beginning.

   @param scene    Read for sound; its network is the player's as long as there is one
   @param rate_hz  Steps per second [Hz], > 0; the scene's own, or another
   @return To be given to scene_player_free(), or NULL: out of memory
*/
ScenePlayer* scene_player_new(Scene* scene, double rate_hz);

/** Free a player, not its scene; NULL is fine. */
void scene_player_free(ScenePlayer* player);

/** @return How many frames the scene is long, at least 1 */
uint64_t scene_player_length(const ScenePlayer* player);

/** Play on. Does not allocate.  @param[out] out  n_frames, the pickups' sum [1 is full scale] */
void scene_player_run(ScenePlayer* player, double* out, uint32_t n_frames);

/**
   Look at every mass, and bring all to rest where none moves any more: nothing is left of it but
   numbers too small for the arithmetic to be quick with.

   @return Whether all positions and velocities are finite
*/
bool scene_player_settle(ScenePlayer* player);

#endif
