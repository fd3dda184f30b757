/**
   A control set from the command line.
*/
#ifndef HOOKE_TOOLS_HOST_SETTING_H
#define HOOKE_TOOLS_HOST_SETTING_H

#include "tools/commands/args.h"
#include "tools/host/host.h"

#include <stdbool.h>

/**
   Set a control input to a value in its range.

   @param setting  "SYMBOL=VALUE"; the value is in the port's unit
   @return false after a line on stderr, which names the range if the value is outside.
*/
bool setting_apply(const Args* args, Host* host, const char* setting);

/** The same in two words: a symbol, and the text of a value. */
bool setting_set(const Args* args, Host* host, const char* symbol, const char* text);

#endif
