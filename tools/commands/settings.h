/**
   A plugin's controls, as they are set and listed on a command line.
*/
#ifndef HOOKE_TOOLS_COMMANDS_SETTINGS_H
#define HOOKE_TOOLS_COMMANDS_SETTINGS_H

#include "tools/commands/args.h"
#include "tools/host/host.h"

#include <stdbool.h>

/**
   Set a control.

   @param args  What messages begin with
   @param text  A number in the control's range, the name of one of its values, or for a switch on,
   off, true, false, yes or no; capital letters are as good as small ones
   @return false after a line on stderr that says what is expected.
*/
bool settings_set(const Args* args, Host* host, const char* symbol, const char* text);

/** settings_set() of "SYMBOL=VALUE" */
bool settings_apply(const Args* args, Host* host, const char* setting);

/** Write a line for each control to stdout: its symbol, range, default and unit, and the names of
 * its values. */
void settings_list(Host* host);

#endif
