/* Tables of modes: what they say, and how what is wrong is said. */

#include "core/bank/body_read.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* From memory that ends where the text does. */
static Status read_copy(const char* text,
                        size_t size,
                        Status (*read)(const char*, size_t, Body*, BodyError*),
                        Body* body,
                        BodyError* error) {
  char* const copy = malloc(size ? size : 1);
  assert_non_null(copy);
  memcpy(copy, text, size);
  const Status status = read(copy, size, body, error);
  free(copy);
  return status;
}

static void read_well(const char* text, Body* body) {
  BodyError error;
  if (read_copy(text, strlen(text), body_read, body, &error)) {
    fail_msg("'%s': %u: found %s, expected %s", text, error.line, error.found, error.expected);
  }
}

static void a_table_is_its_lines(void** state) {
  (void)state;
  static const double lines[3][5] = {{103.0, 14.0, 0.9, 1.0, 1.0},
                                     {208.5, 25.0, 4e-3, -0.9, 1.25e1},
                                     {1e3, 31.25, 0.6, 0.0, -0.3}};
  Body body;
  read_well("# a table\nmode 1e3 31.25 .6 0 -0.3 # the last\n\n  mode\t103 14 0.9 1 1\r\n"
            "mode 208.5 25 4e-3 -.9 +1.25E1",
            &body);
  assert_int_equal(body.n_modes, 3);
  double worst = 0.0;
  const double factor = body.modes[0].radiation[0];
  for (int k = 0; k < 3; ++k) {
    const BodyMode* const mode = &body.modes[k];
    const double got[5] = {mode->f0_hz, mode->q, mode->mass_kg, mode->radiation[0] / factor,
                           mode->radiation[1] / factor};
    for (int i = 0; i < 5; ++i) {
      worst = fmax(worst, fabs(got[i] - lines[k][i]) / fmax(1.0, fabs(lines[k][i])));
    }
  }
  assert_within("what a line says, relative", worst, 1e-15);
  double sum = 0.0;
  int n = 0;
  for (int band = 9; band < 27; ++band) {
    sum += body.power[band];
    ++n;
  }
  assert_within("leveled", fabs(sum / n - BODY_POWER), 1e-12);
}

static void all_ways_of_writing_a_table_read_alike(void** state) {
  (void)state;
  static const char* const texts[] = {
      "mode 100 20 0.5 1 2\nmode 300 40 2 0.5 -1\n",
      "\xef\xbb\xbfmode 100 20 0.5 1 2\nmode 300 40 2 0.5 -1",
      "mode 300 40 2 0.5 -1\r\n\r\nmode 100 20 0.5 1 2\r\n#\n",
      "\tmode   100.0 2e1 5e-1 01 +2#x\n mode 3.0E+2 40 2. .5 -1.0\n",
      /* Heard is any unit. */
      "mode 100 20 0.5 4 8\nmode 300 40 2 2 -4\n",
  };
  Body first;
  read_well(texts[0], &first);
  for (size_t i = 1; i < sizeof(texts) / sizeof(texts[0]); ++i) {
    Body body;
    read_well(texts[i], &body);
    assert_int_equal(body.n_modes, first.n_modes);
    assert_memory_equal(body.modes, first.modes, first.n_modes * sizeof(BodyMode));
    assert_memory_equal(body.power, first.power, sizeof(first.power));
  }
}

/* As many as were asked for, evenly, with what neighbours of a plate's have: no two together, and
 * none far from the next; masses and radiation by the mean, whatever the seed. */
static void a_crowd_is_what_it_is_said_to_be(void** state) {
  (void)state;
  double n_modes = 0.0;
  double mobility = 0.0;
  double squares[2] = {0.0, 0.0};
  double product = 0.0;
  double shortest = HUGE_VAL;
  double gaps = 0.0;
  double gap_squares = 0.0;
  enum { SEEDS = 400 };
  for (int seed = 0; seed < SEEDS; ++seed) {
    char text[128];
    Body body;
    BodyError error;
    (void)snprintf(text, sizeof(text),
                   "above 1000 density 0.1 q 30 mass 2 radiation 3 seed %d to 2000", seed);
    assert_int_equal(read_copy(text, strlen(text), body_read_modes, &body, &error), STATUS_OK);
    n_modes += body.n_modes;
    for (uint32_t k = 0; k < body.n_modes; ++k) {
      const BodyMode* const mode = &body.modes[k];
      const double moved[2] = {mode->radiation[0] / mode->mass_kg,
                               mode->radiation[1] / mode->mass_kg};
      assert_true(mode->f0_hz > 1000.0 && mode->f0_hz < 2000.0 && mode->q == 30.0);
      mobility += 1.0 / mode->mass_kg;
      squares[0] += moved[0] * moved[0];
      squares[1] += moved[1] * moved[1];
      product += moved[0] * moved[1];
      if (k > 0) {
        const double gap = mode->f0_hz - body.modes[k - 1].f0_hz;
        shortest = fmin(shortest, gap);
        gaps += gap;
        gap_squares += gap * gap;
      }
    }
  }
  const double n_gaps = n_modes - SEEDS;
  const double mean = gaps / n_gaps;
  printf("%.1f modes a seed, gaps of %.3f Hz and more\n", n_modes / SEEDS, shortest);
  assert_within("how many", fabs(n_modes / SEEDS / 100.0 - 1.0), 0.01);
  /* ⟨b²⟩ = 1, but for the least of it, which makes it 1.0005. */
  assert_within("mobility", fabs(mobility / n_modes * 2.0 - 1.0), 0.03);
  assert_within("left and right", fabs(squares[0] / squares[1] - 1.0), 0.05);
  /* R² ⟨b²⟩ (1 + ⟨e²⟩)/M², e even to 0.2 */
  assert_within("radiation", fabs(squares[0] / n_modes / (9.0 / 4.0 * (1.0 + 0.04 / 3.0)) - 1.0),
                0.05);
  assert_within("alike to 0.974", fabs(product / sqrt(squares[0] * squares[1]) - 0.9737), 0.003);
  /* Wigner's: ⟨s²⟩/⟨s⟩² = 4/π; of a random row it would be 2. */
  assert_within("distances", fabs(gap_squares / n_gaps / (mean * mean) - 1.2732), 0.02);
}

/* At both ends of a crowd that grows, and between them on a straight line of logarithms. */
static void a_crowd_changes_as_it_is_said_to(void** state) {
  (void)state;
  static const char text[] = "above 500 density 0.005 to 0.08 q 10 to 40 mass 1 radiation 1 to 4 "
                             "seed 3 to 2000";
  Body body;
  BodyError error;
  assert_int_equal(read_copy(text, strlen(text), body_read_modes, &body, &error), STATUS_OK);
  double worst = 0.0;
  double n_low = 0.0;
  for (uint32_t k = 0; k < body.n_modes; ++k) {
    worst = fmax(worst, fabs(body.modes[k].q / (10.0 * body.modes[k].f0_hz / 500.0) - 1.0));
    n_low += body.modes[k].f0_hz < 1000.0 ? 1.0 : 0.0;
  }
  assert_within("Q", worst, 1e-12);
  /* The density grows as f²: (f³ − F³)/(3 F²) 0.005 of them are below f. */
  assert_within("below 1 kHz", fabs(n_low - 5.8), 2.0);
  assert_within("all", fabs(body.n_modes - 52.5), 4.0);
}

static void the_same_text_gives_the_same_modes(void** state) {
  (void)state;
  static const char text[] =
      "above 500 density 0.05 q 30 mass 1 radiation 1 seed %c to 2000\nmode 1 1 1 1 1\n";
  Body bodies[3];
  for (int i = 0; i < 3; ++i) {
    char copy[sizeof(text)];
    (void)snprintf(copy, sizeof(copy), text, i < 2 ? '7' : '8');
    read_well(copy, &bodies[i]);
  }
  assert_memory_equal(&bodies[0], &bodies[1], sizeof(Body));
  assert_true(bodies[0].modes[1].f0_hz != bodies[2].modes[1].f0_hz);
}

static const struct {
  const char* text;
  unsigned line;
  const char* found;
  const char* expected;
} refusals[] = {
    {"", 1, "the end of the text", "a line 'mode F Q M LEFT RIGHT'"},
    {"# nothing\n\n", 2, "the end of the text", "a line 'mode F Q M LEFT RIGHT'"},
    {"mode 100 20 1 0 0\n", 1, "the end of the text", "a mode that is heard, left or right"},
    {"mode 100 20 1 1e-300 0\n", 1, "the end of the text", "a mode that is heard, left or right"},
    {"\nmodes 100 20 1 1 1\n", 2, "'modes'", "mode or above"},
    {"mode\n", 1, "the end of the line", "a frequency from 1 to 100000 Hz"},
    {"mode 0.5 20 1 1 1", 1, "'0.5'", "a frequency from 1 to 100000 Hz"},
    {"mode nan 20 1 1 1", 1, "'nan'", "a frequency from 1 to 100000 Hz"},
    {"mode 100 0.5 1 1 1", 1, "'0.5'", "a Q from 0.51 to 1000000"},
    {"mode 100 20 0 1 1", 1, "'0'", "a mass from 1e-9 to 1e9 kg"},
    {"mode 100 20 -1 1 1", 1, "'-1'", "a mass from 1e-9 to 1e9 kg"},
    {"mode 100 20 1 1 1e10", 1, "'1e10'", "a radiation from -1e9 to 1e9"},
    {"mode 100 20 1 1,5 1", 1, "'1,5'", "a radiation from -1e9 to 1e9"},
    {"mode 100 20 1 0x1 1", 1, "'0x1'", "a radiation from -1e9 to 1e9"},
    {"mode 100 20 1 1e 1", 1, "'1e'", "a radiation from -1e9 to 1e9"},
    {"mode 100 20 1 1e99999 1", 1, "'1e99999'", "a radiation from -1e9 to 1e9"},
    {"mode 100 20 1 . 1", 1, "'.'", "a radiation from -1e9 to 1e9"},
    {"mode 100 20 1 1", 1, "the end of the line", "a radiation from -1e9 to 1e9"},
    {"mode 100 20 1 1 1 1", 1, "'1'", "the end of the line"},
    {"mode 100 20 1 1 \x01\xff#", 1,
     "'?"
     "?'",
     "a radiation from -1e9 to 1e9"},
    {"above 100 dense", 1, "'dense'", "'density'"},
    {"above 100 density 0", 1, "'0'", "a density from 1e-6 to 10 modes per Hz"},
    {"above 100 density 1 to q", 1, "'q'", "a density from 1e-6 to 10 modes per Hz"},
    {"above 100 density 1 q 20 mass 1 radiation 0", 1, "'0'", "a radiation from 1e-9 to 1e9"},
    {"above 100 density 1 q 20 mass 1 radiation 1 seed 1.5 to 200", 1, "'1.5'",
     "a whole seed from 0 to 1000000000"},
    {"above 100 density 1 q 20 mass 1 radiation 1 seed 1 to 100", 1, "'100'",
     "a frequency above 100 Hz"},
    {"above 100 density 1 q 20 mass 1 radiation 1 seed 1", 1, "the end of the line", "'to'"},
    {"above 100 density 10 q 20 mass 1 radiation 1 seed 1 to 1000", 1, "a mode at ",
     "256 modes at most"},
};

static void what_is_wrong_is_said(void** state) {
  (void)state;
  for (size_t i = 0; i < sizeof(refusals) / sizeof(refusals[0]); ++i) {
    Body body;
    Body before;
    BodyError error;
    memset(&body, 0x5A, sizeof(body));
    before = body;
    assert_int_equal(
        read_copy(refusals[i].text, strlen(refusals[i].text), body_read, &body, &error),
        STATUS_BAD_TEXT);
    assert_memory_equal(&body, &before, sizeof(body));
    if (error.line != refusals[i].line ||
        strncmp(error.found, refusals[i].found, strlen(refusals[i].found)) != 0 ||
        strcmp(error.expected, refusals[i].expected) != 0) {
      fail_msg("'%s': %u: found %s, expected %s", refusals[i].text, error.line, error.found,
               error.expected);
    }
  }
}

static void there_is_an_end_to_modes_and_texts(void** state) {
  (void)state;
  static const char line[] = "mode 100 20 1 1 1\n";
  static char text[BODY_MAX_BYTES + 1];
  const size_t size = sizeof(line) - 1;
  Body body;
  BodyError error;
  for (int n = 256; n <= 257; ++n) {
    for (int k = 0; k < n; ++k) {
      memcpy(text + size * (size_t)k, line, size);
    }
    assert_int_equal(read_copy(text, size * (size_t)n, body_read, &body, &error),
                     n == 256 ? STATUS_OK : STATUS_BAD_TEXT);
  }
  assert_int_equal(error.line, 257);
  memset(text, '\n', sizeof(text));
  memcpy(text, line, size);
  assert_int_equal(read_copy(text, sizeof(text) - 1, body_read, &body, &error), STATUS_OK);
  assert_int_equal(read_copy(text, sizeof(text), body_read, &body, &error), STATUS_BAD_TEXT);
  assert_string_equal(error.expected, "one of at most 1048576 bytes");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_table_is_its_lines),
      cmocka_unit_test(all_ways_of_writing_a_table_read_alike),
      cmocka_unit_test(a_crowd_is_what_it_is_said_to_be),
      cmocka_unit_test(a_crowd_changes_as_it_is_said_to),
      cmocka_unit_test(the_same_text_gives_the_same_modes),
      cmocka_unit_test(what_is_wrong_is_said),
      cmocka_unit_test(there_is_an_end_to_modes_and_texts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
