#include "tests/support/scores.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* A line with a number that is taken, and one a little outside. */
static const struct {
  const char* line;
  const char* taken;
  const char* refused;
} bounds[] = {
    {"%s mute", "0", "-0.001"},
    {"%s mute", "3600", "3600.001"},
    {"1:%s mute", "1", "0.999"},
    {"1:%s mute", "4.999", "5"},
    {"tempo 1000\n%s:1 mute", "15000", "100001"},
    {"0 ring %s", "1", "0"},
    {"0 ring %s", "6", "7"},
    {"0 fret 1 %s", "0", "-0.001"},
    {"0 fret 1 %s", "24", "24.001"},
    {"0 bend 1 %s", "-12", "-12.001"},
    {"0 bend 1 %s", "24", "24.001"},
    {"0 vibrato 1 %s", "0", "-0.001"},
    {"0 vibrato 1 %s", "12", "12.001"},
    {"0 vibrato 1 1 rate %s", "0.1", "0.0999"},
    {"0 vibrato 1 1 rate %s", "20", "20.001"},
    {"0 harmonic 1 %s", "2", "1"},
    {"0 harmonic 1 %s", "20", "21"},
    {"0 palm %s", "0", "-0.001"},
    {"0 palm %s", "1", "1.001"},
    {"0 pluck 1 force %s", "0", "-0.001"},
    {"0 pluck 1 force %s", "1", "1.001"},
    {"0 pluck 1 at %s", "0", "-0.001"},
    {"0 pluck 1 at %s", "1", "1.001"},
    {"0 pluck 1 hardness %s", "0", "-0.001"},
    {"0 pluck 1 hardness %s", "1", "1.001"},
    {"0 pluck 1 width %s", "0.01", "0.00999"},
    {"0 pluck 1 width %s", "0.6", "0.6001"},
    {"0 damp 1 for %s", "0", "-0.001"},
    {"0 damp 1 for %s", "3600", "3600.001"},
    {"0 damp 1 for %s", "7200b", "7200.001b"},
    {"0 strum up 0 0 0 0 0 %s", "24", "24.001"},
    {"0 mute\ntempo %s", "1", "0.999"},
    {"0 mute\ntempo %s", "1000", "1000.001"},
    {"0 mute\nmeter %s", "1", "0"},
    {"0 mute\nmeter %s", "64", "65"},
    {"0 mute\ncapo %s", "0", "-1"},
    {"0 mute\ncapo %s", "24", "25"},
    {"0 mute\ntuning 1 2 3 4 5 %s", "0", "-1"},
    {"0 mute\ntuning 1 2 3 4 5 %s", "127", "128"},
    {"0 mute\ntuning 1 2 3 4 5 %s", "C-1", "Cb-1"},
    {"0 mute\ntuning 1 2 3 4 5 %s", "G9", "G#9"},
};

static void ranges_have_their_ends(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(bounds) / sizeof(bounds[0]); ++i) {
    char text[128];
    const char* const hole = strstr(bounds[i].line, "%s");
    const int before = (int)(hole - bounds[i].line);
    ScoresRead read;
    (void)snprintf(text, sizeof(text), "%.*s%s%s", before, bounds[i].line, bounds[i].taken,
                   hole + 2);
    score_free(scores_read(text));
    (void)snprintf(text, sizeof(text), "%.*s%s%s", before, bounds[i].line, bounds[i].refused,
                   hole + 2);
    if (scores_read_bytes(text, strlen(text), &read)) {
      fail_msg("not refused: %s", text);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ranges_have_their_ends),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
