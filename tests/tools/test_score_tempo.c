#include "tools/formats/score_tempo.h"

#include "tests/support/random.h"
#include "tests/support/scores.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* The sums are of a few numbers below 1000 in double. */
static const double CLOSE = 1e-11;

static void assert_close(const char* what, double found, double expected) {
  if (!(fabs(found - expected) <= CLOSE)) {
    fail_msg("%s: found %.15g, expected %.15g", what, found, expected);
  }
}

/* What the k-th event is long, of those with a length there. */
static double length_s(const Score* score, size_t k, int at) {
  return (double)score->events[k].event.value[at];
}

static const struct {
  const char* text;
  double time_s; // Of the last event
} times[] = {
    {"1:1 lift 1", 0.0},
    {"1:2 lift 1", 0.5},
    {"2:1 lift 1", 2.0},
    {"3:1.5 lift 1", 4.25},
    {"tempo 96\n1:2 lift 1", 0.625},
    {"tempo 96\n3:1.5 lift 1", 8.5 * 60.0 / 96.0},
    {"1:2 lift 1\ntempo 60", 1.0},
    {"meter 3\n3:1 lift 1", 3.0},
    {"meter 3/4\ntempo 60\n3:3.75 lift 1", 8.75},
    {"meter 6/8\ntempo 180\n2:4 lift 1", 3.0},
    {"meter 1\n5:1.999 lift 1", 2.4995},
    {"tempo 60\n3:1 tempo 120\n2:4 lift 1", 7.0},
    {"tempo 60\n3:1 tempo 120\n3:1 lift 1", 8.0},
    {"tempo 60\n3:1 tempo 120\n4:1 lift 1", 10.0},
    {"tempo 60\n3:1 tempo 120\n4:1 tempo 30\n4:3 lift 1", 14.0},
    {"4:1 tempo 30\n3:1 tempo 120\ntempo 60\n4:3 lift 1", 14.0},
    {"tempo 60\n2.5 tempo 120\n1:4 lift 1", 2.75},
    {"tempo 60\n2.5 tempo 120\n1:3.5 tempo 60\n1:4 lift 1", 3.0},
    {"tempo 60\n1:3.5 tempo 60\n2.5 tempo 120\n1:4 lift 1", 2.75},
    {"tempo 60\n1:3 tempo 120\n2.5 tempo 240\n2:1 lift 1", 2.75},
    {"0 tempo 60\n1:2 lift 1", 1.0},
    {"1:1 tempo 60\n1:2 lift 1", 1.0},
    {"0 tempo 30\n0 tempo 60\n1:2 lift 1", 1.0},
    {"tempo 60\n2 tempo 120\n1 lift 1\n+2b lift 1", 2.5},
    {"tempo 60\n2 tempo 120\n1:2 lift 1\n+2 lift 1", 3.0},
    {"tempo 60\n1:1 lift 1\n+1b lift 1\n+0.5b lift 1", 1.5},
    {"tempo 60\n1:2 tempo 120\n+1b lift 1", 1.5},
};

static void bars_and_beats_are_where_a_hand_counts_them(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(times) / sizeof(times[0]); ++i) {
    Score* const score = scores_read(times[i].text);
    assert_close(times[i].text, score->events[score->n_events - 1].time_s, times[i].time_s);
    assert_true(score->duration_s == score->events[score->n_events - 1].time_s);
    score_free(score);
  }
}

static void lengths_in_beats_go_through_changes_of_tempo(void** state) {
  (void)state;
  Score* const score = scores_read("tempo 60\n1:3 tempo 120\n"
                                   "0 slide 1 5 for 1.5b\n1:2 slide 1 5 for 3b\n"
                                   "2 damp 1 for 1b\n9 bend 1 2 for 4b\n10 touch 1 at 0.5 for 2b\n"
                                   "20 vibrato 1 1 for 3b\n30 slide 1 5 for 2\n");
  assert_close("a length", length_s(score, 0, 1), 1.5);
  assert_close("a length", length_s(score, 1, 1), 2.0);
  assert_close("a length", length_s(score, 2, 0), 0.5);
  assert_close("a length", length_s(score, 3, 1), 2.0);
  assert_close("a length", length_s(score, 4, 1), 1.0);
  assert_close("the end", score->events[6].time_s, 21.5);
  assert_close("a length", length_s(score, 7, 1), 2.0);
  score_free(score);
}

/* Beats by a sum over small steps of time, with nothing known but the tempo at each. */
static void the_map_is_the_integral_of_the_tempo(void** state) {
  (void)state;
  enum { N_CHANGES = 40, STEPS = 60000 };
  Random random = random_start();
  double from_s[N_CHANGES];
  double tempi[N_CHANGES];
  ScoreTempo tempo = {0};
  for (int i = 0; i < N_CHANGES; ++i) {
    from_s[i] = floor(random_between(&random, 0.0, 600.0)) / 10.0;
    tempi[i] = random_between(&random, 20.0, 400.0);
    const ScoreSpan from = {from_s[i], false};
    assert_true(score_tempo_add(&tempo, from, tempi[i]));
  }
  assert_true(score_tempo_finish(&tempo));
  double beats = 0.0;
  for (int step = 0; step < STEPS; ++step) {
    const double time_s = 1e-3 * step;
    double latest_s = -1.0;
    double now = SCORE_USUAL_TEMPO;
    for (int i = 0; i < N_CHANGES; ++i) {
      if (from_s[i] <= time_s + 1e-9 && from_s[i] >= latest_s) {
        latest_s = from_s[i];
        now = tempi[i];
      }
    }
    assert_true(fabs(score_tempo_beats(&tempo, time_s) - beats) < 1e-8);
    assert_true(fabs(score_tempo_time_s(&tempo, beats) - time_s) < 1e-8);
    beats += 1e-3 * now / 60.0;
  }
  score_tempo_clear(&tempo);
}

/* Changes in seconds and the same ones in beats make one map. */
static void changes_in_seconds_and_in_beats_agree(void** state) {
  (void)state;
  Random random = random_start();
  for (int trial = 0; trial < 200; ++trial) {
    ScoreTempo in_seconds = {0};
    ScoreTempo mixed = {0};
    double time_s = 0.0;
    double beats = 0.0;
    double now = SCORE_USUAL_TEMPO;
    for (int i = 0; i < 20; ++i) {
      const double wait_s = random_between(&random, 0.01, 5.0);
      time_s += wait_s;
      beats += wait_s * now / 60.0;
      now = random_between(&random, 1.0, 1000.0);
      const ScoreSpan from_s = {time_s, false};
      const bool is_beats = random_below(&random, 2) == 1;
      const ScoreSpan either = {is_beats ? beats : time_s, is_beats};
      assert_true(score_tempo_add(&in_seconds, from_s, now));
      assert_true(score_tempo_add(&mixed, either, now));
    }
    assert_true(score_tempo_finish(&in_seconds) && score_tempo_finish(&mixed));
    for (double at = 0.0; at < 1.5 * time_s; at += 0.1) {
      const double a = score_tempo_beats(&in_seconds, at);
      assert_true(fabs(a - score_tempo_beats(&mixed, at)) < 1e-8);
      assert_true(fabs(score_tempo_time_s(&mixed, a) - at) < 1e-8);
    }
    score_tempo_clear(&in_seconds);
    score_tempo_clear(&mixed);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bars_and_beats_are_where_a_hand_counts_them),
      cmocka_unit_test(lengths_in_beats_go_through_changes_of_tempo),
      cmocka_unit_test(the_map_is_the_integral_of_the_tempo),
      cmocka_unit_test(changes_in_seconds_and_in_beats_agree),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
