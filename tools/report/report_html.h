/**
   Words and pictures of the report's page.

   Thread: any.
*/
#ifndef HOOKE_TOOLS_REPORT_REPORT_HTML_H
#define HOOKE_TOOLS_REPORT_REPORT_HTML_H

#include "tools/report/report_place.h"

#include <stdbool.h>
#include <stdio.h>

/** Write `text`, in which nothing is markup, between two tags. */
void report_html_element(FILE* out, const char* open, const char* text, const char* close);

/**
   Write a picture into the page itself.

   @param name   Of an SVG in `place`
   @param shows  In words
   @return false with errno set if it cannot be read
*/
bool report_html_picture(FILE* out, const ReportPlace* place, const char* name, const char* shows);

#endif
