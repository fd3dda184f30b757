/**
   `hooke render` of a score: how a host is set for it, and what it is sent.
*/
#ifndef HOOKE_TOOLS_COMMANDS_SCORE_RENDER_H
#define HOOKE_TOOLS_COMMANDS_SCORE_RENDER_H

#include "tools/commands/args.h"
#include "tools/formats/score.h"
#include "tools/host/host.h"
#include "tools/host/play.h"

#include <stdbool.h>

/** The plugin that plays a score. */
#define SCORE_RENDER_PLUGIN "urn:hooke:guitar"

/** @return Whether `path` is that of a score, by its ending */
bool score_render_is_score(const char* path);

/** Say whether the plugin takes the events of scores. @return false after a line on stderr */
bool score_render_is_playable(const Args* args, Host* host);

/**
   Load the score's preset.

   @param path  Of the score, for the message
   @return false after a line on stderr
*/
bool score_render_load_preset(const Args* args, const char* path, const Score* score, Host* host);

/** Set the score's controls. @return false after a line on stderr */
bool score_render_set(const Args* args, const char* path, const Score* score, Host* host);

/** @return The score as play() takes it, good as long as the score is */
PlaySong score_render_song(const Score* score);

#endif
