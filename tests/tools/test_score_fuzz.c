#include "tools/formats/score.h"

#include "tests/support/random.h"
#include "tests/support/scores.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static unsigned count_lines(const char* text, size_t size) {
  unsigned n = 0;
  for (size_t i = 0; i < size; ++i) {
    n += text[i] == '\n' || i + 1 == size ? 1 : 0;
  }
  return n ? n : 1;
}

/* Whether a value is one that the guitar takes, or the few that may be none. */
static bool is_event(const ScoreEvent* event) {
  bool is_ok = event->time_s >= 0.0 && event->time_s <= SCORE_MAX_TIME_S &&
               event->event.verb < GUITAR_N_VERBS && event->event.string < SCORE_STRINGS;
  for (int i = 0; i < 3; ++i) {
    const double value = (double)event->event.value[i];
    is_ok = is_ok && (isnan(value) ? event->event.verb == GUITAR_PLUCK && i > 0
                                   : value >= -12.0 && (value <= SCORE_MAX_TIME_S || isinf(value)));
  }
  return is_ok;
}

static const char whole[] = "tempo 96 # a\nmeter 3/4\ntuning E4 B3 F#3 D3 A2 E2\ncapo 2\n"
                            "preset Some Name\nset level -6\n"
                            "0.000 pluck 6 force 0.8 at 0.13\n3:1.5 fret 6 3\n+0.5 pluck 6 up\n"
                            "0.9 slide 6 5 for 0.2\n+1b lift 6\n4:1 tempo 80\n2 damp 6 for 1.5b\n"
                            "2.5 strum down 0 2 2 1 x 0 spread 0.03\n3 bend 2 -1.5\n"
                            "4 vibrato 1 0.3 rate 6 for 2\n5 harmonic 5 3 width 0.05\n"
                            "6 touch 4 at 0.25 for 1\n7 palm 0.5\n8 mute\n9 ring 1\n";

/* The length of the first `n` lines. */
static size_t lines_size(const char* text, size_t size, unsigned n) {
  size_t i = 0;
  for (; i < size && n > 0; ++i) {
    n -= text[i] == '\n' ? 1 : 0;
  }
  return i;
}

/* The lines up to the one that is named fail in the same words, and those before it do not; what
 * stands behind matters only where times are found. */
static void assert_line_is_right(const char* text, size_t size, const ScoresRead* read) {
  unsigned line = 0;
  char message[SCORE_ERROR_SIZE];
  ScoresRead again;
  assert_memory_equal(read->error, read->path, strlen(read->path));
  const char* const words = strstr(read->error, ": found ");
  assert_non_null(words);
  assert_int_equal(sscanf(read->error + strlen(read->path), ":%u: found", &line), 1);
  assert_in_range(line, 1, count_lines(text, size));
  assert_non_null(strstr(words, ", expected "));
  assert_null(strchr(read->error, '\n'));
  strcpy(message, words);
  if (strstr(words, "at most 3600") || strstr(words, "the end of the file")) {
    return;
  }
  assert_null(scores_read_bytes(text, lines_size(text, size, line), &again));
  assert_string_equal(strstr(again.error, ": found "), message);
  Score* const before = scores_read_bytes(text, lines_size(text, size, line - 1), &again);
  assert_true(before || strstr(again.error, "the end of the file") ||
              strstr(again.error, "at most 3600"));
  score_free(before);
}

/* Letters changed, cut out and doubled. */
static void spoil(Random* random, char* text, size_t* size) {
  static const char letters[] = "\n\r\t #.0123456789-+:/abefgprx\0\xff";
  const uint32_t at = random_below(random, (uint32_t)*size - 1);
  const uint32_t how = random_below(random, 4);
  if (how == 0) {
    memmove(text + at, text + at + 1, *size - at - 1);
    --*size;
  } else if (how == 1) {
    memmove(text + at + 1, text + at, *size - at);
    ++*size;
  } else {
    text[at] = letters[random_below(random, sizeof(letters) - 1)];
  }
}

static void spoilt_scores_are_read_or_refused(void** state) {
  (void)state;
  enum { N = 10000 };
  Random random = random_start();
  int n_read = 0;
  for (int i = 0; i < N; ++i) {
    char text[sizeof(whole) + 8];
    size_t size = sizeof(whole) - 1;
    ScoresRead read;
    memcpy(text, whole, size);
    for (uint32_t n = random_below(&random, 5); n > 0; --n) {
      spoil(&random, text, &size);
    }
    Score* const score = scores_read_bytes(text, size, &read);
    for (size_t k = 0; score && k < score->n_events; ++k) {
      assert_true(is_event(&score->events[k]));
      assert_true(k == 0 || score->events[k].time_s >= score->events[k - 1].time_s);
    }
    n_read += score ? 1 : 0;
    if (!score) {
      assert_line_is_right(text, size, &read);
    }
    score_free(score);
  }
  printf("%d of %d are still scores\n", n_read, N);
  assert_in_range(n_read, N / 20, N - N / 20);
}

/* Words that mean something, in any order. */
static void words_in_any_order_are_read_or_refused(void** state) {
  (void)state;
  static const char* const words[] = {
      "0",     "1",       "2",      "3:1",  "+1b",    "+0.5",  "0.5",      "6",
      "25",    "x",       "pluck",  "fret", "hammer", "pull",  "lift",     "slide",
      "bend",  "vibrato", "damp",   "ring", "touch",  "palm",  "harmonic", "mute",
      "strum", "down",    "up",     "for",  "at",     "force", "rate",     "set",
      "width", "capo",    "tuning", "E4",   "meter",  "tempo", "spread",   "preset",
      "#",     "\n",      "\n",     "nan",  "-1",     "1b"};
  enum { N = 10000, N_WORDS = sizeof(words) / sizeof(words[0]) };
  Random random = random_start();
  int n_read = 0;
  for (int i = 0; i < N; ++i) {
    char text[256] = "0 mute\n";
    ScoresRead read;
    for (uint32_t n = 1 + random_below(&random, 12); n > 0; --n) {
      strcat(text, words[random_below(&random, N_WORDS)]);
      strcat(text, " ");
    }
    Score* const score = scores_read_bytes(text, strlen(text), &read);
    n_read += score ? 1 : 0;
    if (!score) {
      assert_line_is_right(text, strlen(text), &read);
    }
    score_free(score);
  }
  printf("%d of %d are scores\n", n_read, N);
  assert_in_range(n_read, 10, N - 10);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(spoilt_scores_are_read_or_refused),
      cmocka_unit_test(words_in_any_order_are_read_or_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
