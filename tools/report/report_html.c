#include "tools/report/report_html.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* Text as HTML has it, in attributes too. */
static void write_text(FILE* out, const char* text) {
  for (; *text; ++text) {
    const char* const special = strchr("&<>\"", *text);
    if (special) {
      (void)fprintf(out, "&#%d;", *special);
    } else {
      (void)fputc(*text, out);
    }
  }
}

static void write_base64(FILE* out, const unsigned char* bytes, size_t n_bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t i = 0; i < n_bytes; i += 3) {
    const size_t left = n_bytes - i;
    const unsigned word = (unsigned)bytes[i] << 16 | (left > 1 ? (unsigned)bytes[i + 1] << 8 : 0U) |
                          (left > 2 ? bytes[i + 2] : 0U);
    (void)fputc(digits[word >> 18], out);
    (void)fputc(digits[word >> 12 & 63], out);
    (void)fputc(left > 1 ? digits[word >> 6 & 63] : '=', out);
    (void)fputc(left > 2 ? digits[word & 63] : '=', out);
  }
}

void report_html_element(FILE* out, const char* open, const char* text, const char* close) {
  (void)fputs(open, out);
  write_text(out, text);
  (void)fputs(close, out);
}

bool report_html_picture(FILE* out, const ReportPlace* place, const char* name, const char* shows) {
  size_t n_bytes = 0;
  char* const picture = report_place_read(place, name, &n_bytes);
  if (!picture) {
    return false;
  }
  report_html_element(out, "<img alt=\"", shows, "\" src=\"");
  (void)fputs("data:image/svg+xml;base64,", out);
  write_base64(out, (const unsigned char*)picture, n_bytes);
  (void)fputs("\">\n", out);
  free(picture);
  return true;
}
