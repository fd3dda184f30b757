/**
   The text of a Scala file: its lines, the numbers in them, and what is wrong.

   Part of core/scale/scale.
*/
#ifndef HOOKE_CORE_SCALE_SCALE_TEXT_H
#define HOOKE_CORE_SCALE_SCALE_TEXT_H

#include "core/scale/scale.h"

#include <stdbool.h>
#include <stddef.h>

/** A place in a text. */
typedef struct {
  const char* at;       /**< In the line */
  const char* begin;    /**< Of the line, or of what is not blank in it */
  const char* line_end; /**< Behind the line, before its end mark */
  const char* next;     /**< Where the next line begins */
  const char* end;      /**< Behind the text */
  unsigned line;        /**< Its number, from 1; 0 before the first */
  ScaleError* error;    /**< Where messages go */
} ScaleText;

/** A number as it is written. */
typedef struct {
  double value; /**< Of up to 19 digits, with at most two roundings; INFINITY if it is too large */
  bool has_point;
} ScaleNumber;

/** Start before the first line.
    @return false, after a message, if the text is too long or has a NUL byte */
bool scale_text_start(ScaleText* text, const char* bytes, size_t n_bytes, ScaleError* error);

/** @return Whether there is another line that is no comment, which then is the current one */
bool scale_text_next(ScaleText* text);

/** As scale_text_next(), but skips empty lines too, and the blanks at the line's beginning. */
bool scale_text_next_value(ScaleText* text);

/** Take a decimal number, maybe with a sign and a point, and the blanks before it.
    @return false if there is none, with the place maybe moved */
bool scale_text_number(ScaleText* text, ScaleNumber* number);

/** Take `byte` and the blanks before it.  @return false, with nothing taken, if it is not there */
bool scale_text_take(ScaleText* text, char byte);

/** @return Whether a value ends here: at a blank, a '!', the line's end, or a letter that can be no
    part of a number.  Not at a comma or colon, lest `701,955` be read as 701. */
bool scale_text_is_end(const ScaleText* text);

/** Say that the current line was found, or the end of the text if `at_end`.
    @param expected  A format of printf and what it needs
    @return false */
__attribute__((format(printf, 3, 4))) bool
scale_text_fail(ScaleText* text, bool at_end, const char* expected, ...);

#endif
