/**
   The command line of `hooke render`.
*/
#ifndef HOOKE_TOOLS_COMMANDS_RENDER_OPTIONS_H
#define HOOKE_TOOLS_COMMANDS_RENDER_OPTIONS_H

#include "tools/commands/args.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct {
  Args args;
  const char* in;
  const char* out;
  const char* preset; ///< NULL: none
  const char* plugin; ///< Its URI
  const char** sets;  ///< In the order given
  size_t n_sets;
  long rate_hz;  ///< 0: the usual one
  long block;    ///< [frames]
  long bits;     ///< 0: the usual ones
  double tail_s; ///< Below 0: until silent
  bool lists_presets;
  bool is_quiet;
  bool is_anyway; ///< Whether a scene that is unstable is rendered too
} RenderOptions;

/**
   Read the command line.

   @param argc  Words in `argv`, without the program's name
   @param argv  "render" and what follows, ended by NULL
   @return false after a line on stderr; the options are to be cleared all the same.
*/
bool render_options_read(RenderOptions* options, int argc, char** argv);

void render_options_clear(RenderOptions* options);

#endif
