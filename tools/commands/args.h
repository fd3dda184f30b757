/**
   Command lines: getopt_long() with numbers in their range and one clear line for what is wrong.
*/
#ifndef HOOKE_TOOLS_COMMANDS_ARGS_H
#define HOOKE_TOOLS_COMMANDS_ARGS_H

#include <getopt.h>
#include <stdbool.h>

/** What a program returns to the shell; the last is an answer, about a scene or a string. */
enum { ARGS_OK = 0, ARGS_FAILURE = 1, ARGS_USAGE = 2, ARGS_UNSTABLE = 3 };

/** What args_next() found: from ARGS_OPTION on an option. */
enum { ARGS_END = -1, ARGS_OPERAND = -2, ARGS_ERROR = -3, ARGS_OPTION = 256 };

/** A command line on its way through getopt_long(), of which there is one in a process. */
typedef struct {
  const char* command; /**< For messages */
  int argc;
  char** argv;
  const struct option* options; /**< As getopt_long() takes them, with values from ARGS_OPTION on */
  const char* value;            /**< Of the option or operand found last */
  bool is_over;                 /**< There are no more options */
} Args;

/**
   Go to the next word.

   @return The value of an option, ARGS_OPERAND, or ARGS_END; ARGS_ERROR after a line on stderr.
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

/** args_number(), and `word`, which the caller has looked for, is named among what is expected. */
bool args_number_or(const Args* args,
                    const char* what,
                    const char* text,
                    double min,
                    double max,
                    const char* word,
                    double* number);

/** args_number() for whole numbers. */
bool args_whole(
    const Args* args, const char* what, const char* text, long min, long max, long* number);

/** Write "COMMAND: message" as one line to stderr, whatever is in names of files: see escape.h.
    @return `code` */
__attribute__((format(printf, 3, 4))) int
args_fail(const Args* args, int code, const char* format, ...);

#endif
