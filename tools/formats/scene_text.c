#include "tools/formats/scene_text.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char BLANKS[] = " \t\r\v\f";
static const char BLANKS_AND_COMMENT[] = " \t\r\v\f#";
static const char BYTE_ORDER_MARK[] = "\xef\xbb\xbf";

enum { CHUNK = 1 << 16, QUOTED_LETTERS = 40 };

static bool fail(SceneText* text, const char* reason) {
  (void)snprintf(text->error, text->error_size, "%s: %s", text->path, reason);
  return false;
}

static bool read_all(SceneText* text, FILE* file) {
  char chunk[CHUNK];
  size_t n = 0;
  while ((n = fread(chunk, 1, sizeof(chunk), file)) > 0) {
    if (!bytes_append(&text->bytes, chunk, n)) {
      return fail(text, "out of memory");
    }
  }
  if (ferror(file)) {
    return fail(text, strerror(errno));
  }
  return bytes_append(&text->bytes, "", 1) || fail(text, "out of memory");
}

/* What has no business on a terminal. */
static bool is_control(char letter) {
  return (unsigned char)letter < ' ' || letter == 0x7f;
}

bool scene_text_init(SceneText* text, const char* path, char* error, size_t error_size) {
  *text = (SceneText){.path = path, .error = error, .error_size = error_size};
  FILE* const file = fopen(path, "rb");
  if (!file) {
    return fail(text, strerror(errno));
  }
  const bool is_read = read_all(text, file);
  (void)fclose(file);
  if (is_read && !strncmp((const char*)text->bytes.data, BYTE_ORDER_MARK, 3)) {
    text->next = 3;
  }
  return is_read;
}

void scene_text_clear(SceneText* text) {
  bytes_clear(&text->bytes);
}

bool scene_text_next_line(SceneText* text) {
  const size_t left = text->bytes.size - 1 - text->next;
  if (left == 0) {
    return false;
  }
  text->at = (char*)text->bytes.data + text->next;
  char* const end = memchr(text->at, '\n', left);
  text->length = end ? (size_t)(end - text->at) : left;
  text->at[text->length] = '\0';
  text->next += text->length + (end ? 1 : 0);
  ++text->line;
  return true;
}

bool scene_text_is_sound(SceneText* text) {
  return strlen(text->at) == text->length ||
         scene_text_fail_at(text, text->line, "found a NUL byte, expected text");
}

char* scene_text_next_word(SceneText* text) {
  char* const word = text->at + strspn(text->at, BLANKS);
  char* const end =
      *word == '#' ? word
                   : word + strcspn(word, text->is_comment_apart ? BLANKS : BLANKS_AND_COMMENT);
  if (end == word) {
    text->at = word + strlen(word);
    return NULL;
  }
  /* What follows a comment sign is as good as not there. */
  const bool is_last = *end == '#' || !*end;
  text->at = is_last ? end + strlen(end) : end + 1;
  *end = '\0';
  return word;
}

bool scene_text_number(const char* word, double min, double max, double* number) {
  char* end = NULL;
  if (word[strspn(word, "+-.0123456789eE")]) {
    return false;
  }
  *number = strtod(word, &end);
  return end != word && !*end && *number >= min && *number <= max;
}

const char* scene_text_quote(const char* word, char quote[SCENE_TEXT_QUOTE_SIZE]) {
  if (!word) {
    return "the end of the line";
  }
  const size_t length = strlen(word);
  (void)snprintf(quote, SCENE_TEXT_QUOTE_SIZE, "'%.*s%s'", QUOTED_LETTERS, word,
                 length > QUOTED_LETTERS ? "..." : "");
  for (char* letter = quote; *letter; ++letter) {
    *letter = is_control(*letter) ? '?' : *letter;
  }
  return quote;
}

bool scene_text_fail_at(SceneText* text, uint32_t line, const char* format, ...) {
  va_list list;
  va_start(list, format);
  const int n =
      snprintf(text->error, text->error_size, "%s:%lu: ", text->path, (unsigned long)line);
  if (n >= 0 && (size_t)n < text->error_size) {
    (void)vsnprintf(text->error + n, text->error_size - (size_t)n, format, list);
  }
  va_end(list);
  return false;
}

bool scene_text_fail(SceneText* text, const char* word, const char* expected) {
  char quote[SCENE_TEXT_QUOTE_SIZE];
  return scene_text_fail_at(text, text->line, "found %s, expected %s",
                            scene_text_quote(word, quote), expected);
}
