/**
   Error against run time: its part of the report.

   Thread: any.
*/
#ifndef HOOKE_TOOLS_REPORT_TRADE_PAGE_H
#define HOOKE_TOOLS_REPORT_TRADE_PAGE_H

#include "core/base/status.h"
#include "tools/bench/bench_survey.h"
#include "tools/report/report_place.h"
#include "tools/report/trade_check.h"

#include <stdbool.h>
#include <stdio.h>

/** What there is to report. */
typedef struct {
  TradeSurvey survey;
  TradeCheck check;
} TradeReport;

/** Survey and check. @return STATUS_OK or STATUS_NO_MEMORY */
Status trade_page_measure(TradeReport* report);

/** Free what is in it. */
void trade_page_free(TradeReport* report);

/** Write errors.csv, and data and script of each picture. @return false with errno set */
bool trade_page_files(const ReportPlace* place, const TradeReport* report);

/** Run gnuplot on the scripts. @return Whether all was done; see gnuplot_run() */
bool trade_page_draw(const ReportPlace* place, char* error, size_t error_size);

/** Write the Markdown: what is said, the defaults that one could have, and the frontiers. */
void trade_page_markdown(FILE* out, const TradeReport* report);

/** Write the page: what is said, and all pictures. @return false with errno set if one cannot be
 * read */
bool trade_page_html(FILE* out, const ReportPlace* place, const TradeReport* report);

#endif
