#include "tools/formats/score.h"

#include "tests/support/scores.h"
#include "tests/support/speed.h"
#include "tools/formats/bytes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#define GUITAR_VERB_NAME(verb, a, b, c) #verb,
static const char* const names[] = {GUITAR_VERBS(GUITAR_VERB_NAME)};
#undef GUITAR_VERB_NAME

__attribute__((format(printf, 2, 3))) static void say(Bytes* bytes, const char* format, ...) {
  char line[128];
  va_list args;
  va_start(args, format);
  const int n = vsnprintf(line, sizeof(line), format, args);
  va_end(args);
  assert_true(bytes_append(bytes, line, (size_t)n));
}

/* All events, each as "TIME VERB STRING VALUE VALUE VALUE;", strings from 1. */
static void assert_events(const char* text, const char* expected) {
  Score* const score = scores_read(text);
  Bytes found = {0};
  for (size_t i = 0; i < score->n_events; ++i) {
    const GuitarEvent* const event = &score->events[i].event;
    say(&found, "%s%g %s %u", i ? " " : "", score->events[i].time_s, names[event->verb],
        event->string + 1);
    for (int k = 0; k < 3; ++k) {
      say(&found, " %g", (double)event->value[k]);
    }
    say(&found, ";");
  }
  assert_true(bytes_append(&found, "", 1));
  if (strcmp((const char*)found.data, expected) != 0) {
    fail_msg("%s\n  is     %s\n  not    %s", text, (const char*)found.data, expected);
  }
  bytes_clear(&found);
  score_free(score);
}

static const struct {
  const char* text;
  const char* events;
} lines[] = {
    {"0 pluck 6", "0 PLUCK 6 0.7 nan nan;"},
    {"0.25 pluck 1 force 1", "0.25 PLUCK 1 1 nan nan;"},
    {"0.25 pluck 1 force 0", "0.25 PLUCK 1 0 nan nan;"},
    {"1 pluck 2 at 0.13", "1 PLUCK 2 0.7 0.13 nan;"},
    {"1 pluck 2 hardness 0.25", "1 PLUCK 2 0.7 nan 0.25;"},
    {"1 pluck 2 down", "1 PLUCK 2 0.7 nan nan;"},
    {"1 pluck 2 up", "1 PLUCK 2 -0.7 nan nan;"},
    {"1 pluck 3 up hardness 1 at 0 force 0.5", "1 PLUCK 3 -0.5 0 1;"},
    {"1 pluck 3 width 0.6", "1 PLUCK 3 0.7 nan 0;"},
    {"1 pluck 3 width 0.01", "1 PLUCK 3 0.7 nan 1;"},
    {"1 pluck 3 width 0.0774596669", "1 PLUCK 3 0.7 nan 0.5;"},
    {"0.5 fret 6 3", "0.5 FRET 6 3 0 0;"},
    {"0.5 fret 6 24", "0.5 FRET 6 24 0 0;"},
    {"0.5 fret 1 2.5", "0.5 FRET 1 2.5 0 0;"},
    {"0.5 hammer 2 5", "0.5 HAMMER 2 5 0.5 0;"},
    {"0.5 hammer 2 5 force 0.9", "0.5 HAMMER 2 5 0.9 0;"},
    {"0.5 pull 2 3 force 0.25", "0.5 HAMMER 2 3 0.25 0;"},
    {"1.2 lift 6", "1.2 FRET 6 0 0 0;"},
    {"0.9 slide 6 5 for 0.25", "0.9 SLIDE 6 5 0.25 0;"},
    {"1 bend 2 1.5", "1 BEND 2 1.5 0 0;"},
    {"1 bend 2 -12 for 2", "1 BEND 2 -12 2 0;"},
    {"1 bend 2 24 for 0", "1 BEND 2 24 0 0;"},
    {"1 vibrato 4 0.3", "1 VIBRATO 4 0.3 5 0;"},
    {"1 vibrato 4 0.25 rate 6 for 2", "1 VIBRATO 4 0.25 6 0; 3 VIBRATO 4 0 6 0;"},
    {"1 vibrato 4 0", "1 VIBRATO 4 0 5 0;"},
    {"2 damp 6", "2 DAMP 6 inf 0 0;"},
    {"2 damp 6 for 0.125", "2 DAMP 6 0.125 0 0;"},
    {"2 ring 5", "2 LET_RING 5 0 0 0;"},
    {"2 touch 5 at 0.5 for 0.25", "2 TOUCH 5 0.5 0.25 0;"},
    {"2 touch 5 for 1 at 1", "2 TOUCH 5 1 1 0;"},
    {"2 harmonic 1 2", "2 TOUCH 1 0.5 0.15 0; 2 PLUCK 1 0.7 nan nan;"},
    {"2 harmonic 1 4 force 1 for 0.5 at 0.125 hardness 1 up",
     "2 TOUCH 1 0.25 0.5 0; 2 PLUCK 1 -1 0.125 1;"},
    {"3 palm 0.75", "3 PALM 1 0.75 0 0;"},
    {"3 palm 0", "3 PALM 1 0 0 0;"},
    {"3 mute", "3 DAMP 1 inf 0 0; 3 DAMP 2 inf 0 0; 3 DAMP 3 inf 0 0; 3 DAMP 4 inf 0 0; "
               "3 DAMP 5 inf 0 0; 3 DAMP 6 inf 0 0;"},
    {"3 mute for 1", "3 DAMP 1 1 0 0; 3 DAMP 2 1 0 0; 3 DAMP 3 1 0 0; 3 DAMP 4 1 0 0; "
                     "3 DAMP 5 1 0 0; 3 DAMP 6 1 0 0;"},
    {"2 strum down 0 2 2 1 0 3 spread 0.25",
     "2 FRET 6 0 0 0; 2 FRET 5 2 0 0; 2 FRET 4 2 0 0; 2 FRET 3 1 0 0; 2 FRET 2 0 0 0; "
     "2 FRET 1 3 0 0; 2 PLUCK 6 0.7 nan nan; 2.25 PLUCK 5 0.7 nan nan; 2.5 PLUCK 4 0.7 nan nan; "
     "2.75 PLUCK 3 0.7 nan nan; 3 PLUCK 2 0.7 nan nan; 3.25 PLUCK 1 0.7 nan nan;"},
    {"2 strum up x 3 x 0 1 0 force 0.5 at 0.25 hardness 0.5",
     "2 DAMP 6 inf 0 0; 2 FRET 5 3 0 0; 2 DAMP 4 inf 0 0; 2 FRET 3 0 0 0; 2 FRET 2 1 0 0; "
     "2 FRET 1 0 0 0; 2 PLUCK 1 -0.5 0.25 0.5; 2.02 PLUCK 2 -0.5 0.25 0.5; "
     "2.04 PLUCK 3 -0.5 0.25 0.5; 2.08 PLUCK 5 -0.5 0.25 0.5;"},
    {"0 strum down x X 0 2 x x spread 0",
     "0 DAMP 6 inf 0 0; 0 DAMP 5 inf 0 0; 0 FRET 4 0 0 0; 0 FRET 3 2 0 0; 0 DAMP 2 inf 0 0; "
     "0 DAMP 1 inf 0 0; 0 PLUCK 4 0.7 nan nan; 0 PLUCK 3 0.7 nan nan;"},
    {"tempo 240\n0 strum down x x x x 0 0 spread 0.5b",
     "0 DAMP 6 inf 0 0; 0 DAMP 5 inf 0 0; 0 DAMP 4 inf 0 0; 0 DAMP 3 inf 0 0; 0 FRET 2 0 0 0; "
     "0 FRET 1 0 0 0; 0 PLUCK 2 0.7 nan nan; 0.125 PLUCK 1 0.7 nan nan;"},
};

static void every_event_is_what_its_line_says(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(lines) / sizeof(lines[0]); ++i) {
    assert_events(lines[i].text, lines[i].events);
  }
}

static void events_come_by_time_and_then_by_line(void** state) {
  (void)state;
  assert_events("2 lift 1\n1 lift 2\n2 lift 3\n0 lift 4\n1.0 lift 5\n2 lift 6\n",
                "0 FRET 4 0 0 0; 1 FRET 2 0 0 0; 1 FRET 5 0 0 0; 2 FRET 1 0 0 0; 2 FRET 3 0 0 0; "
                "2 FRET 6 0 0 0;");
  Score* const score = scores_read("\n3 lift 1\n# a comment\n2 mute\n");
  assert_int_equal(score->n_events, 7);
  assert_int_equal(score->events[0].line, 4);
  assert_int_equal(score->events[6].line, 2);
  assert_true(score->duration_s == 3.0);
  score_free(score);
}

static void relative_times_count_from_the_line_above(void** state) {
  (void)state;
  assert_events("tempo 60\n+0.5 lift 1\n4 lift 2\n+0.25 lift 3\n+1b lift 4\n2 lift 5\n+0 lift 6\n",
                "0.5 FRET 1 0 0 0; 2 FRET 5 0 0 0; 2 FRET 6 0 0 0; 4 FRET 2 0 0 0; "
                "4.25 FRET 3 0 0 0; 5.25 FRET 4 0 0 0;");
  /* A strum or a vibrato ends later than it begins. */
  assert_events("1 vibrato 1 1 for 3\n+1 lift 2\n",
                "1 VIBRATO 1 1 5 0; 2 FRET 2 0 0 0; 4 VIBRATO 1 0 5 0;");
  /* A change of tempo is a line with a time too. */
  assert_events("0 lift 1\n2 tempo 60\n+1b lift 2\n", "0 FRET 1 0 0 0; 3 FRET 2 0 0 0;");
}

static void the_end_of_a_vibrato_spares_the_next(void** state) {
  (void)state;
  assert_events("0 vibrato 1 1 for 2\n1 vibrato 1 0.5 for 2\n",
                "0 VIBRATO 1 1 5 0; 1 VIBRATO 1 0.5 5 0; 3 VIBRATO 1 0 5 0;");
  assert_events("0 vibrato 1 1 for 2\n1 vibrato 2 0.5\n",
                "0 VIBRATO 1 1 5 0; 1 VIBRATO 2 0.5 5 0; 2 VIBRATO 1 0 5 0;");
  assert_events("1 vibrato 1 0.5\n0 vibrato 1 1 for 1\n",
                "0 VIBRATO 1 1 5 0; 1 VIBRATO 1 0.5 5 0;");
  assert_events("0 vibrato 1 1 for 1\n1 vibrato 1 0.5\n",
                "0 VIBRATO 1 1 5 0; 1 VIBRATO 1 0 5 0; 1 VIBRATO 1 0.5 5 0;");
}

static void what_is_not_given_is_the_panels(void** state) {
  (void)state;
  Score* const score = scores_read("0 pluck 1\n0 damp 1\n");
  assert_true(isnan(score->events[0].event.value[1]) && isnan(score->events[0].event.value[2]));
  assert_true(isinf(score->events[1].event.value[0]));
  assert_null(score->preset);
  assert_int_equal(score->n_settings, 0);
  score_free(score);
}

static void settings_keep_their_order(void** state) {
  (void)state;
  static const struct {
    const char* symbol;
    const char* text;
    double value;
    uint32_t line;
  } expected[] = {
      {"level", "-6.5", 0, 2},   {"string1", NULL, 64, 3}, {"string2", NULL, 58, 3},
      {"string3", NULL, 54, 3},  {"string4", NULL, 50, 3}, {"string5", NULL, 35, 3},
      {"string6", NULL, 127, 3}, {"capo", NULL, 2, 4},     {"level", "loud", 0, 6},
  };
  Score* const score = scores_read("0 ring 1\nset level -6.5\ntuning E4 bb3 F#3 50 Cb2 G9\ncapo 2\n"
                                   "preset  Nylon \t Strings # a comment\nset level loud\n");
  assert_int_equal(score->n_settings, sizeof(expected) / sizeof(expected[0]));
  for (size_t i = 0; i < score->n_settings; ++i) {
    const ScoreSetting* const setting = &score->settings[i];
    assert_string_equal(setting->symbol, expected[i].symbol);
    assert_int_equal(setting->line, expected[i].line);
    assert_true(setting->text ? expected[i].text && !strcmp(setting->text, expected[i].text)
                              : !expected[i].text && setting->value == expected[i].value);
  }
  assert_string_equal(score->preset, "Nylon Strings");
  assert_int_equal(score->preset_line, 5);
  score_free(score);
}

static void every_note_has_its_number(void** state) {
  (void)state;
  static const char* const octave[] = {"C",  "C#", "D",  "D#", "E",  "F",
                                       "F#", "G",  "G#", "A",  "A#", "B"};
  static const char* const flats[] = {"c",  "db", "d",  "eb", "fb", "f",
                                      "gb", "g",  "ab", "a",  "bb", "cb"};
  for (int note = 0; note < 128; note += 2) {
    char text[128];
    const int up = note + 1;
    (void)snprintf(text, sizeof(text), "tuning %s%d %s%d %d 1 1 1\n0 mute\n", octave[note % 12],
                   note / 12 - 1, flats[up % 12], up / 12 - 1 + (up % 12 == 11 ? 1 : 0), note);
    Score* const score = scores_read(text);
    assert_true(score->settings[0].value == note && score->settings[1].value == up);
    assert_true(score->settings[2].value == note);
    score_free(score);
  }
}

static void line_ends_tabs_and_marks_do_not_matter(void** state) {
  (void)state;
  static const char* const texts[] = {
      "1 fret 6 3\r\n2 lift 6\r\n",
      "\xef\xbb\xbf# a mark\n1 fret 6 3\n2 lift 6",
      "\t1\tfret  6\v3\t# why\n\n\n \n2 lift 6 #",
      "#\n2 lift 6\n1.0 fret 6. 3e0\n",
      "01.00 fret +6 +3\r\r\n2. lift 6\r",
  };
  for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); ++i) {
    assert_events(texts[i], "1 FRET 6 3 0 0; 2 FRET 6 0 0 0;");
  }
}

/* In the worst order of times. */
static void a_million_events_load_in_a_few_seconds(void** state) {
  (void)state;
  Bytes bytes = {0};
  ScoresRead read;
  for (int i = 0; i < SCORE_MAX_EVENTS; ++i) {
    say(&bytes, "%.3f pluck %d at 0.25\n", 0.001 * (SCORE_MAX_EVENTS - i), 1 + i % 6);
  }
  const clock_t start = clock();
  Score* const score = scores_read_bytes(bytes.data, bytes.size, &read);
  const double cpu_s = (double)(clock() - start) / CLOCKS_PER_SEC;
  if (!score) {
    fail_msg("%s", read.error);
  }
  printf("%d events: %.3f s\n", SCORE_MAX_EVENTS, cpu_s);
  assert_int_equal(score->n_events, SCORE_MAX_EVENTS);
  for (size_t i = 1; i < score->n_events; ++i) {
    assert_true(score->events[i].time_s > score->events[i - 1].time_s);
  }
  assert_true(cpu_s < 5.0 * speed_slowdown());
  score_free(score);
  say(&bytes, "0 lift 1\n");
  assert_null(scores_read_bytes(bytes.data, bytes.size, &read));
  assert_non_null(strstr(read.error, ":1000001: found more than 1000000 events, expected no more"));
  bytes_clear(&bytes);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_event_is_what_its_line_says),
      cmocka_unit_test(events_come_by_time_and_then_by_line),
      cmocka_unit_test(relative_times_count_from_the_line_above),
      cmocka_unit_test(the_end_of_a_vibrato_spares_the_next),
      cmocka_unit_test(what_is_not_given_is_the_panels),
      cmocka_unit_test(settings_keep_their_order),
      cmocka_unit_test(every_note_has_its_number),
      cmocka_unit_test(line_ends_tabs_and_marks_do_not_matter),
      cmocka_unit_test(a_million_events_load_in_a_few_seconds),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
