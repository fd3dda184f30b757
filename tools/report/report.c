#include "tools/report/report.h"

#include "tools/commands/args.h"
#include "tools/report/figure.h"
#include "tools/report/gnuplot.h"
#include "tools/report/report_page.h"
#include "tools/report/report_place.h"
#include "tools/report/trade_page.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

const char report_help[] =
    "usage: hooke report DIR\n"
    "\n"
    "Draw figures 3 to 5, 8 to 19 and 21 of Morgan and Qiao's \"Analysis of Damped Mass-Spring\n"
    "Systems for Sound Synthesis\", compute its Table 1 and its other numbers, and map how far\n"
    "the instrument is from instability, by this program's own code.  DIR, which is made if\n"
    "need be, gets\n"
    "\n"
    "  report.html                         all of it in one page\n"
    "  report.md                           the numbers: the paper's, ours, the difference\n"
    "  figure-NN.svg                       a picture each\n"
    "  figure-NN.dat, figure-NN.gp         what it was drawn from; gnuplot figure-NN.gp draws it\n"
    "                                      again\n"
    "  error-NAME.svg, .dat, .gp           error against run time, of all ways to make a string\n"
    "  errors.csv                          all that is compared in them\n"
    "\n"
    "Run time is measured, in some ten seconds, and is a little different every time.\n"
    "It needs gnuplot.  Files of these names are replaced.\n";

static const struct option options[] = {{0}};

/* One size, font and set of colours for all: Okabe and Ito's, which the colour-blind can tell
 * apart, and tints of them. */
static const char preamble[] = "reset\n"
                               "set encoding utf8\n"
                               "set terminal svg size 760,400 font 'sans-serif,14' \\\n"
                               "  background '#ffffff'\n"
                               "set output '%s'\n"
                               "data = '%s'\n"
                               "black = '#000000'; grey = '#8c8c8c'; blue = '#0072b2'\n"
                               "red = '#d55e00'; green = '#009e73'; purple = '#b0558a'\n"
                               "sky = '#56b4e9'; orange = '#c98400'\n"
                               "vibrates = '#d3e6f3'; creeps = '#fbe8c4'; flips = '#f2dbe8'\n"
                               "grows = '#e6e6e6'\n"
                               "set border lc rgb '#404040'\n"
                               "set tics nomirror\n"
                               "set bmargin 3.7\n"
                               "set tmargin 2\n\n";

static bool write_data(const ReportPlace* place, const Figure* figure) {
  char name[REPORT_NAME_SIZE];
  report_page_name(name, figure->number, "dat");
  FILE* const data = report_place_file(place, name);
  if (!data) {
    return false;
  }
  const Status status = figure->write(data);
  const bool is_written = report_place_close(data);
  errno = status == STATUS_NO_MEMORY ? ENOMEM : errno;
  return status == STATUS_OK && is_written;
}

static bool write_script(const ReportPlace* place, const Figure* figure) {
  char name[REPORT_NAME_SIZE];
  char picture[REPORT_NAME_SIZE];
  char data[REPORT_NAME_SIZE];
  report_page_name(name, figure->number, "gp");
  report_page_name(picture, figure->number, "svg");
  report_page_name(data, figure->number, "dat");
  FILE* const script = report_place_file(place, name);
  if (!script) {
    return false;
  }
  (void)fprintf(script, preamble, picture, data);
  (void)fprintf(script, "%sunset output\n", figure->script);
  return report_place_close(script);
}

static bool write_figures(const ReportPlace* place) {
  for (unsigned i = 0; i < FIGURE_COUNT; ++i) {
    if (!write_data(place, figure_at(i)) || !write_script(place, figure_at(i))) {
      return false;
    }
  }
  return true;
}

static bool draw(const ReportPlace* place, char* error, size_t error_size) {
  char name[REPORT_NAME_SIZE];
  bool is_drawn = true;
  for (unsigned i = 0; is_drawn && i < FIGURE_COUNT; ++i) {
    report_page_name(name, figure_at(i)->number, "gp");
    is_drawn = gnuplot_run(place->part_fd, name, error, error_size);
  }
  return is_drawn;
}

static bool write_pages(const ReportPlace* place, const TradeReport* trade) {
  FILE* const table = report_place_file(place, "report.md");
  if (table) {
    report_page_markdown(table);
    trade_page_markdown(table, trade);
  }
  if (!table || !report_place_close(table)) {
    return false;
  }
  FILE* const page = report_place_file(place, "report.html");
  const bool is_whole = page && report_page_html(page, place, trade);
  const int reason = errno;
  const bool is_written = page && report_place_close(page);
  errno = is_whole ? errno : reason;
  return is_whole && is_written;
}

/* What differs from run to run comes last: run time. */
static bool write_trade(const ReportPlace* place, char* error, size_t error_size) {
  TradeReport trade;
  if (trade_page_measure(&trade)) {
    errno = ENOMEM;
    return false;
  }
  const bool is_written = trade_page_files(place, &trade) &&
                          trade_page_draw(place, error, error_size) && write_pages(place, &trade);
  const int reason = errno;
  trade_page_free(&trade);
  errno = reason;
  return is_written;
}

static int make(const Args* args, const char* path) {
  char error[512] = "";
  ReportPlace place;
  if (!gnuplot_is_there()) {
    return args_fail(args, ARGS_FAILURE, "found no gnuplot that runs, expected one in PATH");
  }
  if (!report_place_open(&place, path)) {
    return args_fail(args, ARGS_FAILURE, "%s: %s", path, strerror(errno));
  }
  const bool is_done = write_figures(&place) && draw(&place, error, sizeof(error)) &&
                       write_trade(&place, error, sizeof(error));
  if (!is_done) {
    report_place_drop(&place);
  }
  if (!is_done || !report_place_keep(&place)) {
    return args_fail(args, ARGS_FAILURE, "%s: %s", path, *error ? error : strerror(errno));
  }
  return printf("%s/report.html\n", path) < 0 ? ARGS_FAILURE : ARGS_OK;
}

int report_main(int argc, char** argv) {
  (void)argc;
  Args args = {.command = "hooke report", .argc = argc, .argv = argv, .options = options};
  const char* path = NULL;
  for (int found = args_next(&args); found != ARGS_END; found = args_next(&args)) {
    if (found == ARGS_ERROR) {
      return ARGS_USAGE;
    }
    if (path) {
      return args_fail(&args, ARGS_USAGE, "found '%s', expected one directory only", args.value);
    }
    path = args.value;
  }
  return path ? make(&args, path) : args_fail(&args, ARGS_USAGE, "found no directory to write to");
}
