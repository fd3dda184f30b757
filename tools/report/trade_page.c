#include "tools/report/trade_page.h"

#include "tools/report/gnuplot.h"
#include "tools/report/report_html.h"
#include "tools/report/trade_picture.h"
#include "tools/report/trade_words.h"

enum { NAME_SIZE = 48 };

Status trade_page_measure(TradeReport* report) {
  report->check = trade_check_all();
  return trade_survey(&report->survey);
}

void trade_page_free(TradeReport* report) {
  trade_survey_free(&report->survey);
}

static FILE* open_file(const ReportPlace* place, const TradePicture* picture, const char* ending) {
  char name[NAME_SIZE];
  (void)snprintf(name, sizeof(name), "%s.%s", picture->name, ending);
  return report_place_file(place, name);
}

static bool
write_picture(const ReportPlace* place, const TradeReport* report, const TradePicture* picture) {
  FILE* const data = open_file(place, picture, "dat");
  if (!data) {
    return false;
  }
  trade_picture_data(data, &report->survey, picture);
  if (!report_place_close(data)) {
    return false;
  }
  FILE* const script = open_file(place, picture, "gp");
  if (!script) {
    return false;
  }
  trade_picture_script(script, picture);
  return report_place_close(script);
}

bool trade_page_files(const ReportPlace* place, const TradeReport* report) {
  FILE* const points = report_place_file(place, "errors.csv");
  if (!points) {
    return false;
  }
  trade_picture_points(points, &report->survey);
  bool is_written = report_place_close(points);
  for (unsigned i = 0; is_written && i < TRADE_N_PICTURES; ++i) {
    is_written = write_picture(place, report, trade_picture(i));
  }
  return is_written;
}

bool trade_page_draw(const ReportPlace* place, char* error, size_t error_size) {
  bool is_drawn = true;
  for (unsigned i = 0; is_drawn && i < TRADE_N_PICTURES; ++i) {
    char name[NAME_SIZE];
    (void)snprintf(name, sizeof(name), "%s.gp", trade_picture(i)->name);
    is_drawn = gnuplot_run(place->part_fd, name, error, error_size);
  }
  return is_drawn;
}

static void write_paragraph(FILE* out, const char* text, bool is_html) {
  if (is_html) {
    report_html_element(out, "<p>", text, "</p>\n");
  } else {
    (void)fprintf(out, "%s\n\n", text);
  }
}

static void write_words(FILE* out, const TradeReport* report, bool is_html) {
  const TradeSetting best = trade_words_best(&report->survey);
  const TradeSetting settings[] = {{TRADE_DEFAULT_PARTIALS, TRADE_DEFAULT_MASSES}, best};
  char text[TRADE_TEXT_SIZE];
  trade_words_method(&report->survey, text);
  write_paragraph(out, text, is_html);
  trade_words_check(&report->check, text);
  write_paragraph(out, text, is_html);
  for (unsigned i = 0; i < sizeof(settings) / sizeof(settings[0]); ++i) {
    trade_words_sentence(&report->survey, settings[i], text);
    write_paragraph(out, text, is_html);
  }
  trade_words_advice(&report->survey, text);
  write_paragraph(out, text, is_html);
}

/* The settings of 55 Hz, a row each. */
static void write_settings(FILE* out, const TradeSurvey* survey) {
  static const char* const names[] = {"Lumped", "True", "Truest"};
  static const uint32_t masses[] = {57, 80, 113, 160, 256};
  (void)fputs("| partials | masses | cents at partials 5, 10, 20 | cents of the first 20: B = 0, "
              "B = 1e-4 | true within 5 cents to | % of a core |\n|---|---:|---|---|---:|---:|\n",
              out);
  for (unsigned i = 0; i < 15; ++i) {
    const TradeSetting setting = {(Partials)(i / 5), masses[i % 5]};
    const TradePoint* const ideal = trade_words_point(survey, setting, 0, 0);
    const TradePoint* const stiff = trade_words_point(survey, setting, 0, 1);
    if (ideal && stiff) {
      const BenchWay method = ideal->method;
      const uint32_t n = ideal->n_masses;
      const uint32_t k = bench_way_true_up_to(method, ideal->string, n, 5.0);
      (void)fprintf(
          out, "| %s | %u | %.2g, %.2g, %.2g | %.2g, %.2g | %.0f Hz | %.3f |\n",
          names[setting.partials], n, bench_way_partial_cents(method, ideal->string, n, 5),
          bench_way_partial_cents(method, ideal->string, n, 10),
          bench_way_partial_cents(method, ideal->string, n, 20), ideal->error[TRADE_PARTIALS],
          stiff->error[TRADE_PARTIALS], bench_way_ideal_hz(ideal->string, k), 100.0 * ideal->share);
    }
  }
}

static void write_front(FILE* out, const TradeSurvey* survey, const TradePicture* picture) {
  (void)fputs("| string | frontier of | method | masses | error | % of a core |\n"
              "|---:|---|---|---:|---:|---:|\n",
              out);
  for (size_t i = 0; i < survey->n; ++i) {
    const TradePoint* const point = &survey->points[i];
    const bool is_first = point->is_front[TRADE_AMONG_ALL][picture->error];
    const bool is_shown =
        point->string.rate_hz == TRADE_DEFAULT_RATE_HZ &&
        point->string.inharmonicity == trade_string(0, picture->stiffness, 0).inharmonicity;
    if (is_shown && (is_first || point->is_front[TRADE_AMONG_STRINGS][picture->error])) {
      char name[TRADE_NAME_SIZE];
      bench_way_name(point->method, name);
      (void)fprintf(out, "| %g Hz | %s | %s | %u | %.3g %s | %.4f |\n", point->string.f0_hz,
                    is_first ? "all" : "strings", name, point->n_masses,
                    trade_level(point, picture->error), picture->unit, 100.0 * point->share);
    }
  }
}

void trade_page_markdown(FILE* out, const TradeReport* report) {
  (void)fputs("\n## Error against run time\n\n", out);
  write_words(out, report, false);
  (void)fputs("### What one could set: 55 Hz at 48 kHz, whole numbers\n\n", out);
  write_settings(out, &report->survey);
  for (unsigned i = 0; i < TRADE_N_PICTURES; ++i) {
    const TradePicture* const picture = trade_picture(i);
    char text[TRADE_TEXT_SIZE];
    trade_words_default(&report->survey, picture, text);
    (void)fprintf(out, "\n### %s\n\n![%s](%s.svg)\n\n%s\n\n", picture->title, picture->title,
                  picture->name, text);
    write_front(out, &report->survey, picture);
  }
  (void)fputs("\nAll points, at all rates, are in [errors.csv](errors.csv).\n", out);
}

bool trade_page_html(FILE* out, const ReportPlace* place, const TradeReport* report) {
  bool is_written = true;
  (void)fputs("<h2 id=\"error\">Error against run time</h2>\n", out);
  write_words(out, report, true);
  for (unsigned i = 0; is_written && i < TRADE_N_PICTURES; ++i) {
    const TradePicture* const picture = trade_picture(i);
    char name[NAME_SIZE];
    char text[TRADE_TEXT_SIZE];
    (void)snprintf(name, sizeof(name), "%s.svg", picture->name);
    trade_words_default(&report->survey, picture, text);
    report_html_element(out, "<h3>", picture->title, "</h3>\n<figure>\n");
    is_written = report_html_picture(out, place, name, picture->title);
    report_html_element(out, "<figcaption><p>", picture->shows, "</p>\n");
    report_html_element(out, "<p>", text, "</p></figcaption>\n</figure>\n");
  }
  return is_written;
}
