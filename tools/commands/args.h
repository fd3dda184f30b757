/**
   Command lines: options by a table, numbers in their range, one clear line for what is wrong.
*/
#ifndef HOOKE_TOOLS_COMMANDS_ARGS_H
#define HOOKE_TOOLS_COMMANDS_ARGS_H

#include <stdbool.h>

/** What a program returns to the shell. */
enum { ARGS_OK = 0, ARGS_FAILURE = 1, ARGS_USAGE = 2 };

/** What args_next() found, when it is not the index of an option. */
enum { ARGS_END = -1, ARGS_OPERAND = -2, ARGS_ERROR = -3 };

/** An option. */
typedef struct {
  const char* name; ///< With its dashes
  bool takes_value; ///< As "--name value" or "--name=value"
} ArgsOption;

/** A place in a command line. */
typedef struct {
  const char* command;       ///< For messages
  char** words;              ///< What is left of argv, ended by NULL
  const ArgsOption* options; ///< Ended by an option without a name
  const char* value;         ///< Of the option or operand found last
  bool has_no_more_options;  ///< "--" was seen
} Args;

/**
   Go to the next word.

   @return The index of an option, ARGS_OPERAND, or ARGS_END; ARGS_ERROR after a line on stderr.
*/
int args_next(Args* args);

/**
   Read a number and check its range.

   @param what         Its name in a message
   @param[out] number  Untouched on failure
   @return false after a line on stderr if `text` is not wholly a finite number from `min` to `max`.
*/
bool args_number(
    const Args* args, const char* what, const char* text, double min, double max, double* number);

/** args_number() for whole numbers. */
bool args_whole(
    const Args* args, const char* what, const char* text, long min, long max, long* number);

/** Write "COMMAND: message" as one line to stderr. @return `code` */
__attribute__((format(printf, 3, 4))) int
args_fail(const Args* args, int code, const char* format, ...);

#endif
