#include "tools/formats/text.h"

#include "tools/formats/escape.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char BLANKS[] = " \t\r\v\f";
static const char BLANKS_AND_COMMENT[] = " \t\r\v\f#";
static const char BYTE_ORDER_MARK[] = "\xef\xbb\xbf";

enum { MAX_SIZE = 64 << 20, QUOTED_LETTERS = 40 };

bool text_init(Text* text, const char* path, char* error, size_t error_size) {
  *text = (Text){.path = path, .error = error, .error_size = error_size};
  if (!bytes_read(&text->bytes, path, MAX_SIZE, error, error_size)) {
    return false;
  }
  if (!bytes_append(&text->bytes, "", 1)) {
    (void)snprintf(error, error_size, "%s: out of memory", path);
    return false;
  }
  text->next = strncmp((const char*)text->bytes.data, BYTE_ORDER_MARK, 3) != 0 ? 0 : 3;
  return true;
}

void text_clear(Text* text) {
  bytes_clear(&text->bytes);
}

bool text_next_line(Text* text) {
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

bool text_is_sound(Text* text) {
  return strlen(text->at) == text->length ||
         text_fail_at(text, text->line, "found a NUL byte, expected text");
}

char* text_word(Text* text) {
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

bool text_number(Text* text, const TextRange* range, double* number) {
  const char* const word = text_word(text);
  return text_is_number(word, range, number) || text_fail(text, word, range->expected);
}

bool text_keyword(Text* text, const char* keyword) {
  char expected[TEXT_QUOTE_SIZE];
  const char* const word = text_word(text);
  return (word && !strcmp(word, keyword)) || text_fail(text, word, text_quote(keyword, expected));
}

bool text_end(Text* text) {
  const char* const word = text_word(text);
  return !word || text_fail(text, word, "the end of the line");
}

bool text_is_number(const char* word, const TextRange* range, double* number) {
  char* end = NULL;
  if (!word || word[strspn(word, "+-.0123456789eE")]) {
    return false;
  }
  *number = strtod(word, &end);
  return end != word && !*end && *number >= range->min && *number <= range->max &&
         (!range->is_whole || *number == floor(*number));
}

const char* text_quote(const char* word, char quote[TEXT_QUOTE_SIZE]) {
  if (!word) {
    return "the end of the line";
  }
  char letters[QUOTED_LETTERS + 1];
  const char* const rest = escape_text(word, letters, sizeof(letters));
  (void)snprintf(quote, TEXT_QUOTE_SIZE, "'%s%s'", letters, *rest ? "..." : "");
  return quote;
}

bool text_fail_at(Text* text, uint32_t line, const char* format, ...) {
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

bool text_fail(Text* text, const char* word, const char* expected) {
  char quote[TEXT_QUOTE_SIZE];
  return text_fail_at(text, text->line, "found %s, expected %s", text_quote(word, quote), expected);
}

bool text_fail_memory(Text* text) {
  return text_fail_at(text, text->line, "out of memory");
}

bool text_is_first(Text* text, const char* statement, uint32_t* line) {
  if (*line) {
    return text_fail_at(text, text->line, "found a second '%s', expected the one in line %lu only",
                        statement, (unsigned long)*line);
  }
  *line = text->line;
  return true;
}
