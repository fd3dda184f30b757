/**
   Text of others as a person may see it: file names can hold what moves cursors and forges lines.
*/
#ifndef HOOKE_TOOLS_FORMATS_ESCAPE_H
#define HOOKE_TOOLS_FORMATS_ESCAPE_H

#include <stddef.h>
#include <stdio.h>

/**
   Write `text` as one line: control characters, and bytes that are no UTF-8, as \\n, \\t, \\r or
   \\xHH. All else, a backslash too, is as it is.

   @param[out] out  No longer than `size`, and never cut within a character
   @param size      Room in `out` [bytes], > 0
   @return What there was no room for; "" if all is there.
*/
const char* escape_text(const char* text, char* out, size_t size);

/** Write all of it to a stream. */
void escape_print(FILE* stream, const char* text);

#endif
