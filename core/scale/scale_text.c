#include "core/scale/scale_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* One more digit fits below this. */
static const uint64_t MANTISSA_LIMIT = UINT64_C(1000000000000000000);

enum { LONGEST_QUOTE = 48 };

static bool is_blank(char byte) {
  return byte == ' ' || byte == '\t';
}

static bool is_digit(char byte) {
  return byte >= '0' && byte <= '9';
}

static bool is_letter(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
}

static bool has(const ScaleText* text, size_t n_bytes) {
  return (size_t)(text->line_end - text->at) >= n_bytes;
}

static void skip_blanks(ScaleText* text) {
  while (has(text, 1) && is_blank(*text->at)) {
    ++text->at;
  }
}

static void advance_line(ScaleText* text) {
  const char* at = text->next;
  text->at = at;
  text->begin = at;
  while (at != text->end && *at != '\n' && *at != '\r') {
    ++at;
  }
  text->line_end = at;
  const bool is_pair = text->end - at >= 2 && at[0] == '\r' && at[1] == '\n';
  text->next = at == text->end ? at : at + (is_pair ? 2 : 1);
  ++text->line;
}

/* The end of a line's blanks does not belong to what was found. */
static void quote(const ScaleText* text, char* found) {
  const char* end = text->line_end;
  while (end != text->begin && is_blank(end[-1])) {
    --end;
  }
  const size_t length = (size_t)(end - text->begin);
  const size_t n_shown = length > LONGEST_QUOTE ? LONGEST_QUOTE : length;
  *found++ = '\'';
  for (size_t i = 0; i < n_shown; ++i) {
    const char byte = text->begin[i];
    *found++ = byte >= ' ' && byte <= '~' ? byte : '?';
  }
  strcpy(found, n_shown < length ? "...'" : "'");
}

static void find_nul(ScaleText* text) {
  do {
    advance_line(text);
  } while (!memchr(text->begin, '\0', (size_t)(text->line_end - text->begin)));
}

bool scale_text_start(ScaleText* text, const char* bytes, size_t n_bytes, ScaleError* error) {
  const bool has_mark = n_bytes >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0;
  const char* const begin = n_bytes ? bytes : "";
  *text = (ScaleText){.next = begin + (has_mark ? 3 : 0), .end = begin + n_bytes, .error = error};
  if (n_bytes > SCALE_MAX_BYTES) {
    (void)scale_text_fail(text, true, "a text of at most %d bytes", SCALE_MAX_BYTES);
    (void)snprintf(error->found, sizeof(error->found), "%zu bytes", n_bytes);
    return false;
  }
  if (memchr(begin, '\0', n_bytes)) {
    find_nul(text);
    (void)scale_text_fail(text, false, "plain text");
    (void)snprintf(error->found, sizeof(error->found), "a NUL byte");
    return false;
  }
  return true;
}

bool scale_text_next(ScaleText* text) {
  while (text->next != text->end) {
    advance_line(text);
    if (!has(text, 1) || *text->at != '!') {
      return true;
    }
  }
  return false;
}

bool scale_text_next_value(ScaleText* text) {
  while (scale_text_next(text)) {
    skip_blanks(text);
    text->begin = text->at;
    if (has(text, 1) && *text->at != '!') {
      return true;
    }
  }
  return false;
}

/* Not strtod(): that goes by the locale, and past the end of a text without NUL. */
bool scale_text_number(ScaleText* text, ScaleNumber* number) {
  uint64_t mantissa = 0;
  int exponent = 0;
  bool has_digit = false;
  skip_blanks(text);
  *number = (ScaleNumber){.value = 0.0};
  const bool has_sign = has(text, 1) && (*text->at == '-' || *text->at == '+');
  const bool is_negative = has_sign && *text->at == '-';
  text->at += has_sign ? 1 : 0;
  for (; has(text, 1) && (is_digit(*text->at) || (*text->at == '.' && !number->has_point));
       ++text->at) {
    if (*text->at == '.') {
      number->has_point = true;
      continue;
    }
    const bool is_kept = mantissa < MANTISSA_LIMIT;
    has_digit = true;
    mantissa = is_kept ? 10 * mantissa + (uint64_t)(*text->at - '0') : mantissa;
    exponent += (is_kept ? 0 : 1) - (number->has_point ? 1 : 0);
  }
  const double power = pow(10.0, fabs((double)exponent));
  const double size = exponent < 0 ? (double)mantissa / power : (double)mantissa * power;
  number->value = is_negative ? -size : size;
  return has_digit;
}

bool scale_text_take(ScaleText* text, char byte) {
  const char* const before = text->at;
  skip_blanks(text);
  if (!has(text, 1) || *text->at != byte) {
    text->at = before;
    return false;
  }
  ++text->at;
  return true;
}

bool scale_text_is_end(const ScaleText* text) {
  if (!has(text, 1)) {
    return true;
  }
  const char byte = *text->at;
  const char after = has(text, 2) ? text->at[1] : ' ';
  const bool is_exponent =
      (byte == 'e' || byte == 'E') && (is_digit(after) || after == '+' || after == '-');
  return is_blank(byte) || byte == '!' || (is_letter(byte) && !is_exponent);
}

bool scale_text_fail(ScaleText* text, bool at_end, const char* expected, ...) {
  ScaleError* const error = text->error;
  va_list arguments;
  error->line = text->line ? text->line : 1;
  if (at_end) {
    strcpy(error->found, "the end of the text");
  } else {
    quote(text, error->found);
  }
  va_start(arguments, expected);
  (void)vsnprintf(error->expected, sizeof(error->expected), expected, arguments);
  va_end(arguments);
  return false;
}
