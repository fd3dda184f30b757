/**
   `hooke render` of a scene: judged first, then simulated in double and written as it goes.
*/
#ifndef HOOKE_TOOLS_COMMANDS_SCENE_RENDER_H
#define HOOKE_TOOLS_COMMANDS_SCENE_RENDER_H

#include "tools/commands/args.h"
#include "tools/formats/scene.h"
#include "tools/formats/soundfile.h"
#include "tools/host/play.h"

#include <stdbool.h>

/** @return Whether `path` is that of a scene, by its ending */
bool scene_render_is_scene(const char* path);

/**
   Say whether a scene may be rendered.

   @param rate_hz  Steps per second [Hz]
   @return ARGS_OK; SCENE_UNSTABLE or ARGS_FAILURE after a line on stderr, which names the mode that
   grows and the rate that would do
*/
int scene_render_judge(const Args* args, const char* path, const Scene* scene, double rate_hz);

/**
   Play a scene into a sound file, the same on both sides.

   @param shows_progress  On stderr
   @param[out] result     Undefined on failure
   @param[out] error      One line, on failure
   @param error_size      Room in `error` [bytes]
   @return false if a write fails, a number is not finite any more or too large for the file, memory
   is out, or SIGINT or SIGTERM, if blocked by the caller, is pending.
*/
bool scene_render_play(Scene* scene,
                       double rate_hz,
                       bool shows_progress,
                       SoundFile* sound,
                       PlayResult* result,
                       char* error,
                       size_t error_size);

#endif
