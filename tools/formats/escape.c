#include "tools/formats/escape.h"

#include <string.h>

/* How many bytes the character has that begins here; 0 if it is none that can be shown. */
static size_t letter_size(const unsigned char* text) {
  const unsigned char first = *text;
  if (first < 0x80) {
    return first >= ' ' && first != 0x7f;
  }
  const size_t size = first >= 0xf5   ? 0
                      : first >= 0xf0 ? 4
                      : first >= 0xe0 ? 3
                      : first >= 0xc2 ? 2
                                      : 0;
  for (size_t i = 1; i < size; ++i) {
    if ((text[i] & 0xc0) != 0x80) {
      return 0;
    }
  }
  /* U+0080 to U+009F are control characters, too. */
  return first == 0xc2 && text[1] < 0xa0 ? 0 : size;
}

static void spell(unsigned char byte, char spelt[8]) {
  const char name = byte == '\n' ? 'n' : byte == '\t' ? 't' : byte == '\r' ? 'r' : '\0';
  (void)(name ? snprintf(spelt, 8, "\\%c", name) : snprintf(spelt, 8, "\\x%02x", byte));
}

const char* escape_text(const char* text, char* out, size_t size) {
  const char* const end = out + size - 1;
  while (*text) {
    char spelt[8];
    const size_t letter = letter_size((const unsigned char*)text);
    if (!letter) {
      spell((unsigned char)*text, spelt);
    }
    const char* const piece = letter ? text : spelt;
    const size_t length = letter ? letter : strlen(spelt);
    if (length > (size_t)(end - out)) {
      break;
    }
    memcpy(out, piece, length);
    out += length;
    text += letter ? letter : 1;
  }
  *out = '\0';
  return text;
}

void escape_print(FILE* stream, const char* text) {
  char piece[256];
  while (*text) {
    text = escape_text(text, piece, sizeof(piece));
    (void)fputs(piece, stream);
  }
}
