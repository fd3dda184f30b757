#include "tools/report/report_page.h"

#include "tools/report/figure.h"
#include "tools/report/report_html.h"
#include "tools/report/report_pins.h"

#include <math.h>

static const char TITLE[] = "The figures and numbers of Morgan and Qiao (2009), computed anew";

static const char INTRODUCTION[] =
    "D. Morgan and S. Qiao, “Analysis of Damped Mass-Spring Systems for Sound Synthesis” (EURASIP "
    "Journal on Audio, Speech, and Music Processing, 2009), beside what Hooke computes.  Numbers "
    "in "
    "parentheses are the paper's equations.  A mass m on a spring k and a damper Z has γ = Z/m and "
    "ω0² = k/m; its eigenvalues are σ ± jμ; h is the time step; σ_d and ω_d are the damping and "
    "the "
    "frequency that are heard once it is stepped by symplectic Euler.";

static const char NUMBERS[] =
    "Under “paper” stand the numbers that this project's tests hold to be the paper's: those it "
    "prints, and, where there are more digits than one would print, what its formulas give in a "
    "program apart from this one.  The difference is ours less the paper's.  It may be one unit of "
    "the last digit; for ω0 and γ of the string it may be more, for these were had from 1 − "
    "exp(−2h/τ) "
    "in double precision, which keeps twelve digits of it.  To twenty digits ω0 is "
    "5293.2393003368564032 and γ 7.4628577364144843712.";

static const char style[] =
    ":root{color-scheme:light dark}"
    "body{font:16px/1.5 system-ui,sans-serif;max-width:50rem;margin:2rem auto;padding:0 1rem;"
    "color:#1a1a1a;background:#fff}"
    "h1{font-size:1.6rem;line-height:1.25}h2{font-size:1.2rem;margin-top:2.5rem}"
    "figure{margin:1rem 0}img{width:100%;height:auto}"
    "dl{display:grid;grid-template-columns:max-content 1fr;gap:.2rem 1rem;margin:0}"
    "dt{color:#666}dd{margin:0}"
    ".wide{overflow-x:auto}table{border-collapse:collapse;font-size:.9rem}"
    "th,td{text-align:left;padding:.15rem .8rem .15rem 0;border-bottom:1px solid #ccc;"
    "white-space:nowrap}"
    ".n{text-align:right;font-variant-numeric:tabular-nums}"
    "@media(prefers-color-scheme:dark){body{color:#e6e6e6;background:#000}dt{color:#a0a0a0}"
    "th,td{border-color:#444}img{filter:invert(1) hue-rotate(180deg)}}";

void report_page_name(char name[REPORT_NAME_SIZE], unsigned number, const char* ending) {
  (void)snprintf(name, REPORT_NAME_SIZE, "figure-%02u.%s", number, ending);
}

/* Two digits more than stated, as far as a double has them. */
static void write_ours(FILE* out, const ReportPin* pin) {
  const int decimals = report_pin_decimals(pin);
  (void)fprintf(out, "%.*f", decimals < 12 ? decimals + 2 : decimals, pin->ours(pin->argument));
}

static void write_markdown_row(FILE* out, const ReportPin* pin) {
  const double difference = report_pin_difference(pin);
  (void)fprintf(out, "| %s | %s | %s | %s | ", pin->where, pin->quantity, pin->unit, pin->paper);
  write_ours(out, pin);
  (void)fprintf(out, " | %.1e | %.0e |\n", difference, report_pin_precision(pin));
}

void report_page_markdown(FILE* out) {
  unsigned n_pins = 0;
  const ReportPin* const pins = report_pins(&n_pins);
  (void)fprintf(out, "# %s\n\n%s\n\n## Numbers\n\n%s\n\n", TITLE, INTRODUCTION, NUMBERS);
  (void)fputs("| figure | quantity | unit | paper | ours | difference | allowed |\n"
              "|---|---|---|---:|---:|---:|---:|\n",
              out);
  for (unsigned i = 0; i < n_pins; ++i) {
    write_markdown_row(out, &pins[i]);
  }
  (void)fputs("\n## Figures\n\n| figure | shows | of the paper's |\n|---|---|---|\n", out);
  for (unsigned i = 0; i < FIGURE_COUNT; ++i) {
    const Figure* const figure = figure_at(i);
    char name[REPORT_NAME_SIZE];
    report_page_name(name, figure->number, "svg");
    (void)fprintf(out, "| [%u](%s) | %s | %s |\n", figure->number, name, figure->title,
                  figure->source);
  }
}

static void write_html_row(FILE* out, const ReportPin* pin) {
  report_html_element(out, "<tr><td>", pin->where, "</td>");
  report_html_element(out, "<td>", pin->quantity, "</td>");
  report_html_element(out, "<td>", pin->unit, "</td>");
  report_html_element(out, "<td class=\"n\">", pin->paper, "</td><td class=\"n\">");
  write_ours(out, pin);
  const double difference = report_pin_difference(pin);
  const bool agrees = fabs(difference) < report_pin_precision(pin);
  (void)fprintf(out, "</td><td class=\"n\">%.1e</td><td>%s</td></tr>\n", difference,
                agrees ? "yes" : "<strong>no</strong>");
}

static void write_numbers(FILE* out) {
  unsigned n_pins = 0;
  const ReportPin* const pins = report_pins(&n_pins);
  (void)fputs("<h2>Numbers</h2>\n", out);
  report_html_element(out, "<p>", NUMBERS, "</p>\n");
  (void)fputs("<div class=\"wide\"><table>\n<tr><th>figure</th><th>quantity</th><th>unit</th>"
              "<th class=\"n\">paper</th><th class=\"n\">ours</th><th class=\"n\">difference</th>"
              "<th>agree</th></tr>\n",
              out);
  for (unsigned i = 0; i < n_pins; ++i) {
    write_html_row(out, &pins[i]);
  }
  (void)fputs("</table></div>\n", out);
}

static bool write_figure(FILE* out, const ReportPlace* place, const Figure* figure) {
  char name[REPORT_NAME_SIZE];
  (void)fprintf(out, "<h2 id=\"figure-%02u\">Figure %u: ", figure->number, figure->number);
  report_html_element(out, "", figure->title, "</h2>\n<figure>\n");
  report_page_name(name, figure->number, "svg");
  const bool is_written = report_html_picture(out, place, name, figure->shows);
  report_html_element(out, "<figcaption><p>", figure->shows, "</p>\n");
  report_html_element(out, "<dl><dt>Computed by</dt><dd>", figure->equation, "</dd>\n");
  report_html_element(out, "<dt>The paper's figure</dt><dd>", figure->source,
                      "</dd></dl></figcaption>\n");
  (void)fputs("</figure>\n", out);
  return is_written;
}

bool report_page_html(FILE* out, const ReportPlace* place, const TradeReport* trade) {
  bool is_written = true;
  (void)fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
              "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
              out);
  report_html_element(out, "<title>", TITLE, "</title>\n");
  (void)fprintf(out, "<style>%s</style>\n</head>\n<body>\n", style);
  report_html_element(out, "<h1>", TITLE, "</h1>\n");
  report_html_element(out, "<p>", INTRODUCTION, "</p>\n");
  write_numbers(out);
  for (unsigned i = 0; is_written && i < FIGURE_COUNT; ++i) {
    is_written = write_figure(out, place, figure_at(i));
  }
  is_written = is_written && trade_page_html(out, place, trade);
  (void)fputs("</body>\n</html>\n", out);
  return is_written;
}
