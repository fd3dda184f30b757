#include "tools/formats/score.h"

#include "tests/support/scores.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* All of the message. */
static void assert_refused(const char* text, size_t size, unsigned line, const char* what) {
  ScoresRead read;
  char expected[SCORE_ERROR_SIZE];
  Score* const score = scores_read_bytes(text, size, &read);
  if (score) {
    fail_msg("not refused: %s", text);
  }
  (void)snprintf(expected, sizeof(expected), "%s:%u: found %s", read.path, line, what);
  assert_string_equal(read.error, expected);
}

#define EOL "the end of the line, expected "
#define TIME ", expected a time: seconds from 0 to 3600, BAR:BEAT, or +T after the line above"
#define WORD ", expected a time, or tempo, meter, tuning, capo, set or preset"
#define VERB                                                                                       \
  ", expected tempo or pluck, fret, hammer, pull, lift, slide, bend, vibrato, damp, ring, touch, " \
  "harmonic, palm, mute or strum"
#define STRING ", expected a string from 1, the highest, to 6"
#define FRET ", expected a fret from 0 to 24"
#define FORCE ", expected a force from 0 to 1"
#define PLACE ", expected a place from 0 to 1, from the bridge"
#define LENGTH ", expected a length from 0 to 3600 s, or in beats, as 1.5b"
#define NOTE ", expected a note, as E4, F#3 or Bb2, or as a MIDI number from 0 to 127"
#define TEMPO ", expected a tempo from 1 to 1000 beats a minute"
#define METER ", expected a meter, as 4 or 3/4, of 1 to 64 beats"
#define END ", expected the end of the line"
#define BARS ", expected BAR:BEAT, a bar from 1 to 100000 and a beat from 1 to below "

/* The line that is refused is the last one. */
static const struct {
  const char* text;
  const char* what;
} refusals[] = {
    {"", "the end of the file, expected an event"},
    {"# nothing\ntempo 90\n", "the end of the file, expected an event"},
    {"1 tempo 90\n", "the end of the file, expected an event"},
    {"pluck 6", "'pluck'" WORD},
    {"Tempo 90", "'Tempo'" WORD},
    {"at 0 pluck 6", "'at'" WORD},
    {"0 mute\n\nfoo", "'foo'" WORD},
    {"0", EOL "tempo or pluck, fret, hammer, pull, lift, slide, bend, vibrato, damp, ring, touch, "
              "harmonic, palm, mute or strum"},
    {"0 # pluck 6", EOL "tempo or pluck, fret, hammer, pull, lift, slide, bend, vibrato, damp, "
                        "ring, touch, harmonic, palm, mute or strum"},
    {"0 plock 6", "'plock'" VERB},
    {"0 Pluck 6", "'Pluck'" VERB},
    {"0 set level 0", "'set'" VERB},
    {"0 0 pluck 6", "'0'" VERB},
    {"-1 mute", "'-1'" TIME},
    {"3600.1 mute", "'3600.1'" TIME},
    {"1e400 mute", "'1e400'" TIME},
    {"0x10 mute", "'0x10'" TIME},
    {"1s mute", "'1s'" TIME},
    {"1,5 mute", "'1,5'" TIME},
    {"1b mute", "'1b'" TIME},
    {"+ mute", "'+'" TIME},
    {"+b mute", "'+b'" TIME},
    {"+-1 mute", "'+-1'" TIME},
    {"++1 mute", "'++1'" TIME},
    {"+1:2 mute", "'+1:2'" TIME},
    {"+1bb mute", "'+1bb'" TIME},
    {"0:1 mute", "'0:1'" BARS "5"},
    {"1:0 mute", "'1:0'" BARS "5"},
    {"1:5 mute", "'1:5'" BARS "5"},
    {"meter 3/4\n1:4 mute", "'1:4'" BARS "4"},
    {"1.5:1 mute", "'1.5:1'" BARS "5"},
    {"1:1:1 mute", "'1:1:1'" BARS "5"},
    {"1: mute", "'1:'" BARS "5"},
    {"1:nan mute", "'1:nan'" BARS "5"},
    {"100001:1 mute", "'100001:1'" BARS "5"},
    {"tempo 1\n100:1 mute", "a time of 23760 s, expected at most 3600 s"},
    {"3600 mute\n+1 mute", "a time of 3601 s, expected at most 3600 s"},
    {"3600 strum down 0 0 0 0 0 0", "a time of 3600.02 s, expected at most 3600 s"},
    {"tempo 1\n0 damp 1 for 100b", "a length of 6000 s, expected at most 3600 s"},
    {"0 pluck", EOL "a string from 1, the highest, to 6"},
    {"0 pluck 0", "'0'" STRING},
    {"0 pluck 7", "'7'" STRING},
    {"0 pluck -1", "'-1'" STRING},
    {"0 pluck 1.5", "'1.5'" STRING},
    {"0 pluck E", "'E'" STRING},
    {"0 pluck nan", "'nan'" STRING},
    {"0 pluck 6#", "'6#'" STRING},
    {"0 pluck 4294967297", "'4294967297'" STRING},
    {"0 pluck 1 force", EOL "a force from 0 to 1"},
    {"0 pluck 1 force 1.1", "'1.1'" FORCE},
    {"0 pluck 1 force -0.5", "'-0.5'" FORCE},
    {"0 pluck 1 force nan", "'nan'" FORCE},
    {"0 pluck 1 at 2", "'2'" PLACE},
    {"0 pluck 1 hardness 2", "'2', expected a hardness from 0 to 1"},
    {"0 pluck 1 width 0", "'0', expected a width from 0.01 to 0.6 of the string"},
    {"0 pluck 1 width 0.7", "'0.7', expected a width from 0.01 to 0.6 of the string"},
    {"0 pluck 1 loud",
     "'loud', expected force, at, hardness, width, down, up or the end of the line"},
    {"0 pluck 1 force 1 up 1", "'1', expected at, hardness, width or the end of the line"},
    {"0 pluck 1 width 0.1 for 1", "'for', expected force, at, down, up or the end of the line"},
    {"0 pluck 1 force 1 force 1", "'force' after 'force', expected one of them only"},
    {"0 pluck 1 hardness 1 width 0.1", "'width' after 'hardness', expected one of them only"},
    {"0 pluck 1 up down", "'down' after 'up', expected one of them only"},
    {"0 fret 1", EOL "a fret from 0 to 24"},
    {"0 fret 1 25", "'25'" FRET},
    {"0 fret 1 -1", "'-1'" FRET},
    {"0 fret 1 x", "'x'" FRET},
    {"0 fret 1 3 for 1", "'for'" END},
    {"0 hammer 1 3 for 1", "'for', expected force or the end of the line"},
    {"0 pull 1 3 force 2", "'2'" FORCE},
    {"0 lift 1 3", "'3'" END},
    {"0 slide 1 3", EOL "'for'"},
    {"0 slide 1 3 for", EOL "a length from 0 to 3600 s, or in beats, as 1.5b"},
    {"0 slide 1 3 for -1", "'-1'" LENGTH},
    {"0 slide 1 3 for +1", "'+1'" LENGTH},
    {"0 slide 1 3 for b", "'b'" LENGTH},
    {"0 slide 1 3 for inf", "'inf'" LENGTH},
    {"0 slide 1 3 for 1e9", "'1e9'" LENGTH},
    {"0 slide 1 3 for 1e9b", "'1e9b'" LENGTH},
    {"0 bend 1 25", "'25', expected a bend from -12 to 24 semitones"},
    {"0 bend 1 -13", "'-13', expected a bend from -12 to 24 semitones"},
    {"0 vibrato 1 -1", "'-1', expected a depth from 0 to 12 semitones"},
    {"0 vibrato 1 1 rate 0", "'0', expected a rate from 0.1 to 20 Hz"},
    {"0 vibrato 1 1 rate 21", "'21', expected a rate from 0.1 to 20 Hz"},
    {"0 vibrato 1 1 at 1", "'at', expected rate, for or the end of the line"},
    {"0 touch 1 for 1", EOL "'at'"},
    {"0 touch 1 at 0.5", EOL "'for'"},
    {"0 harmonic 1 1", "'1', expected a whole number from 2 to 20, of the harmonic"},
    {"0 harmonic 1 2.5", "'2.5', expected a whole number from 2 to 20, of the harmonic"},
    {"0 palm 1.5", "'1.5', expected a weight from 0 to 1"},
    {"0 palm 1 0.5", "'0.5'" END},
    {"0 mute 1", "'1', expected for or the end of the line"},
    {"0 ring 1 for 1", "'for'" END},
    {"0 strum 0 0 0 0 0 0", "'0', expected down or up"},
    {"0 strum", EOL "down or up"},
    {"0 strum up 0 0 0 0 0", EOL "a fret from 0 to 24, or x, for string 1"},
    {"0 strum up 0 25 0 0 0 0", "'25', expected a fret from 0 to 24, or x, for string 5"},
    {"0 strum up xx 0 0 0 0 0", "'xx', expected a fret from 0 to 24, or x, for string 6"},
    {"0 strum up 0 0 0 0 0 0 0", "'0', expected force, at, hardness, width, spread or the end of "
                                 "the line"},
    {"0 strum up x x x x x x", "'x', expected a fret for one string at least"},
    {"0 strum up 0 0 0 0 0 0 spread -1", "'-1'" LENGTH},
    {"tempo 0", "'0'" TEMPO},
    {"tempo 1001", "'1001'" TEMPO},
    {"tempo 90 bpm", "'bpm'" END},
    {"tempo", EOL "a tempo from 1 to 1000 beats a minute"},
    {"tempo 90\n\ntempo 90", "a second 'tempo', expected the one in line 1 only"},
    {"+1 tempo 90", "'+1', expected seconds or BAR:BEAT, for a tempo"},
    {"1:1 tempo fast", "'fast'" TEMPO},
    {"meter 0", "'0'" METER},
    {"meter 3/5", "'3/5'" METER},
    {"meter 3/", "'3/'" METER},
    {"meter 3.5", "'3.5'" METER},
    {"meter 65/4", "'65/4'" METER},
    {"meter", EOL "a meter, as 4 or 3/4, of 1 to 64 beats"},
    {"meter 3\nmeter 3", "a second 'meter', expected the one in line 1 only"},
    {"1:1 mute\n2:1 mute\nmeter 3", "'meter' after bars in line 1, expected it before"},
    {"tuning E4 B3 G3 D3 A2", EOL "a note, as E4, F#3 or Bb2, or as a MIDI number from 0 to 127"},
    {"tuning E4 B3 G3 D3 A2 E2 B1", "'B1'" END},
    {"tuning H4 B3 G3 D3 A2 E2", "'H4'" NOTE},
    {"tuning E4 B B3 D3 A2 E2", "'B'" NOTE},
    {"tuning E##4 B3 G3 D3 A2 E2", "'E##4'" NOTE},
    {"tuning G#9 B3 G3 D3 A2 E2", "'G#9'" NOTE},
    {"tuning Cb-1 B3 G3 D3 A2 E2", "'Cb-1'" NOTE},
    {"tuning E4.5 B3 G3 D3 A2 E2", "'E4.5'" NOTE},
    {"tuning 64.5 B3 G3 D3 A2 E2", "'64.5'" NOTE},
    {"tuning 128 B3 G3 D3 A2 E2", "'128'" NOTE},
    {"tuning 1 2 3 4 5 6\ntuning 1 2 3 4 5 6",
     "a second 'tuning', expected the one in line 1 only"},
    {"capo", EOL "a capo at a whole fret from 0 to 24"},
    {"capo -1", "'-1', expected a capo at a whole fret from 0 to 24"},
    {"capo 1.5", "'1.5', expected a capo at a whole fret from 0 to 24"},
    {"capo 1\ncapo 1", "a second 'capo', expected the one in line 1 only"},
    {"set", EOL "the symbol of a control"},
    {"set level", EOL "a value"},
    {"set level 1 2", "'2'" END},
    {"preset", EOL "the name of a preset"},
    {"preset # A", EOL "the name of a preset"},
    {"preset A\npreset A", "a second 'preset', expected the one in line 1 only"},
    {"0 pluck \033[31m", "'\\x1b[31m'" STRING},
    {"0 mute\r\n0 mute\r\n0 muse\r", "'muse'" VERB},
    {"\xef\xbb\xbf"
     "0 muse",
     "'muse'" VERB},
};

static unsigned count_lines(const char* text, size_t size) {
  unsigned n = 0;
  for (size_t i = 0; i < size; ++i) {
    n += text[i] == '\n' || i + 1 == size ? 1 : 0;
  }
  return n ? n : 1;
}

static void what_is_wrong_is_told_by_line_and_word(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(refusals) / sizeof(refusals[0]); ++i) {
    const char* const text = refusals[i].text;
    assert_refused(text, strlen(text), count_lines(text, strlen(text)), refusals[i].what);
  }
}

/* What comes behind does not matter, except where it is missing. */
static void the_first_mistake_is_told(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(refusals) / sizeof(refusals[0]); ++i) {
    char text[256];
    const char* const first = refusals[i].text;
    if (!strstr(refusals[i].what, "of the file") && !strstr(refusals[i].what, "at most")) {
      (void)snprintf(text, sizeof(text), "%s\n0 mute\nnonsense\n", first);
      assert_refused(text, strlen(text), count_lines(first, strlen(first)), refusals[i].what);
    }
  }
}

static void a_nul_byte_is_refused_wherever_it_is(void** state) {
  (void)state;
  static const char inside[] = "0 mute\n0 pluck\0 6\n";
  static const char in_comment[] = "0 mute\n# \0\n";
  static const char last[] = "0 mute\n\0";
  assert_refused(inside, sizeof(inside) - 1, 2, "a NUL byte, expected text");
  assert_refused(in_comment, sizeof(in_comment) - 1, 2, "a NUL byte, expected text");
  assert_refused(last, sizeof(last) - 1, 2, "a NUL byte, expected text");
}

static void a_line_has_an_end(void** state) {
  (void)state;
  char* const text = malloc(SCORE_MAX_LINE + 16);
  assert_non_null(text);
  memset(text, '#', SCORE_MAX_LINE);
  strcpy(text + SCORE_MAX_LINE, "\n0 mute\n");
  ScoresRead read;
  Score* const score = scores_read_bytes(text, strlen(text), &read);
  assert_non_null(score);
  score_free(score);
  strcpy(text + SCORE_MAX_LINE, "#\n0 mute\n");
  assert_refused(text, strlen(text), 1, "a line of 65537 bytes, expected at most 65536");
  memset(text, 'x', 100);
  strcpy(text + 100, "\n");
  assert_refused(text, strlen(text), 1, "'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...'" WORD);
  free(text);
}

static void a_file_that_cannot_be_read_is_named(void** state) {
  (void)state;
  char error[SCORE_ERROR_SIZE];
  assert_null(score_new("/nowhere/x.score", error, sizeof(error)));
  assert_string_equal(error, "/nowhere/x.score: No such file or directory");
  assert_null(score_new("/", error, sizeof(error)));
  assert_string_equal(error, "/: Is a directory");
  assert_null(score_new("/dev/zero", error, sizeof(error)));
  assert_string_equal(error, "/dev/zero: found more than 64 MiB, expected at most that");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_wrong_is_told_by_line_and_word),
      cmocka_unit_test(the_first_mistake_is_told),
      cmocka_unit_test(a_nul_byte_is_refused_wherever_it_is),
      cmocka_unit_test(a_line_has_an_end),
      cmocka_unit_test(a_file_that_cannot_be_read_is_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
