/**
   The text of a scene: its lines, their words, and one line for what is wrong.

   Part of tools/formats/scene.
*/
#ifndef HOOKE_TOOLS_FORMATS_SCENE_TEXT_H
#define HOOKE_TOOLS_FORMATS_SCENE_TEXT_H

#include "tools/formats/bytes.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Room for a word as scene_text_quote() writes it [bytes]. */
enum { SCENE_TEXT_QUOTE_SIZE = 64 };

/** A place in a text. */
typedef struct {
  const char* path; ///< For messages
  char* error;      ///< Where they go
  size_t error_size;
  Bytes bytes;           ///< The text; words in it are ended by NUL as they are found
  size_t next;           ///< Where the next line begins
  char* at;              ///< In the line, which is ended by NUL
  size_t length;         ///< Of the line [bytes]
  uint32_t line;         ///< Its number, from 1; 0 before the first
  bool is_comment_apart; ///< Whether '#' begins a comment only where a word could begin; false at
                         ///< first: it does so everywhere
} SceneText;

/**
   Read a whole file.

   @param path        Used as long as the text is
   @param[out] error  One line, whenever something here fails; used as long as the text is
   @return false if it cannot be read or memory is out; the text is to be cleared all the same.
*/
bool scene_text_init(SceneText* text, const char* path, char* error, size_t error_size);

void scene_text_clear(SceneText* text);

/** @return Whether there is another line, which then is the one that words come from */
bool scene_text_next_line(SceneText* text);

/** @return Whether the line is free of NUL bytes; if not, after a message */
bool scene_text_is_sound(SceneText* text);

/** @return The next word, as long-lived as the text; NULL at the end of the line or a comment */
char* scene_text_next_word(SceneText* text);

/** Read a number in decimals; hexadecimal ones, infinities and NaN are none.
    @return false, and `number` undefined, if `word` is not wholly a number from `min` to `max` */
bool scene_text_number(const char* word, double min, double max, double* number);

/** Write `word` in quotes, cut where it is long and without control characters; NULL is the end of
 * a line. @return `quote` */
const char* scene_text_quote(const char* word, char quote[SCENE_TEXT_QUOTE_SIZE]);

/** Write "PATH:LINE: " and a message. @return false */
__attribute__((format(printf, 3, 4))) bool
scene_text_fail_at(SceneText* text, uint32_t line, const char* format, ...);

/** Write "PATH:LINE: found WORD, expected EXPECTED" about the line that is being read.
    @return false */
bool scene_text_fail(SceneText* text, const char* word, const char* expected);

#endif
