/**
   A text file as lines of words, and one line for what is wrong in it: what scenes and scores are
   read with.

   Whatever returns a bool here returns false after a message.  Thread: one for each text.
*/
#ifndef HOOKE_TOOLS_FORMATS_TEXT_H
#define HOOKE_TOOLS_FORMATS_TEXT_H

#include "tools/formats/bytes.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Room for a word as text_quote() writes it [bytes]. */
enum { TEXT_QUOTE_SIZE = 64 };

/** A place in a text. */
typedef struct {
  const char* path; /**< For messages */
  char* error;      /**< Where they go */
  size_t error_size;
  Bytes bytes;   /**< The text; words in it are ended by NUL as they are found */
  size_t next;   /**< Where the next line begins */
  char* at;      /**< In the line, which is ended by NUL */
  size_t length; /**< Of the line [bytes] */
  uint32_t line; /**< Its number, from 1; 0 before the first */
  bool
      is_comment_apart; /**< Whether '#' begins a comment only where a word could begin; false at */
                        /**< first: it does so everywhere */
} Text;

/** What a number may be. */
typedef struct {
  const char* expected; /**< Completes "found …, expected …" */
  double min;
  double max;
  bool is_whole;
} TextRange;

/**
   Read a whole file of at most 64 MiB.

   @param path        Used as long as the text is
   @param[out] error  One line, whenever something here fails; used as long as the text is
   @return false if it cannot be read; the text is to be cleared all the same.
*/
bool text_init(Text* text, const char* path, char* error, size_t error_size);

void text_clear(Text* text);

/** @return Whether there is another line, which then is the one that words come from; no message */
bool text_next_line(Text* text);

/** @return Whether the line is free of NUL bytes */
bool text_is_sound(Text* text);

/** @return The next word, as long-lived as the text; NULL at the end of the line or a comment */
char* text_word(Text* text);

/** Take the next word as a number. */
bool text_number(Text* text, const TextRange* range, double* number);

/** Take the next word, which must be this one. */
bool text_keyword(Text* text, const char* keyword);

/** @return Whether the line has no more words */
bool text_end(Text* text);

/** Read a number in decimals; hexadecimal ones, infinities and NaN are none.
    @return false, without a message, and `number` undefined, if `word` is not wholly one in range;
    NULL is none */
bool text_is_number(const char* word, const TextRange* range, double* number);

/** Write `word` in quotes, cut where it is long and escaped as escape.h says; NULL is the end of a
 * line. @return `quote` */
const char* text_quote(const char* word, char quote[TEXT_QUOTE_SIZE]);

/** Write "PATH:LINE: " and a message. @return false */
__attribute__((format(printf, 3, 4))) bool
text_fail_at(Text* text, uint32_t line, const char* format, ...);

/** Write "PATH:LINE: found WORD, expected EXPECTED" about the line that is being read.
    @return false */
bool text_fail(Text* text, const char* word, const char* expected);

/** Write that memory is out. @return false */
bool text_fail_memory(Text* text);

/**
   Claim that a statement is the first of its kind.

   @param line  Where it was found before; 0: nowhere, and this line from now on
*/
bool text_is_first(Text* text, const char* statement, uint32_t* line);

#endif
