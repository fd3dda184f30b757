/**
   The page and the table of the report.

   Thread: any.
*/
#ifndef HOOKE_TOOLS_REPORT_REPORT_PAGE_H
#define HOOKE_TOOLS_REPORT_REPORT_PAGE_H

#include "tools/report/report_place.h"
#include "tools/report/trade_page.h"

#include <stdbool.h>
#include <stdio.h>

/** The longest of the names below, and its zero. */
enum { REPORT_NAME_SIZE = 32 };

/** "figure-03.svg" and its like, for figure `number` and the ending "svg". */
void report_page_name(char name[REPORT_NAME_SIZE], unsigned number, const char* ending);

/** Write the Markdown: all numbers, and a line for each figure. */
void report_page_markdown(FILE* out);

/**
   Write the page, with all pictures in it.

   @return false with errno set if a picture cannot be read
*/
bool report_page_html(FILE* out, const ReportPlace* place, const TradeReport* trade);

#endif
