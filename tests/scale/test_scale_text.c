#include "core/scale/scale.h"

#include "tests/support/random.h"
#include "tests/support/scala.h"

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

static void read_well(ScalaRead read, const char* text, void* out) {
  ScaleError error;
  if (scala_read_copy(read, text, strlen(text), out, &error)) {
    fail_msg("'%s': %u: found %s, expected %s", text, error.line, error.found, error.expected);
  }
}

static void assert_scales_read_alike(const char* text, const char* plain) {
  Scale scales[2];
  read_well(scala_read_scale, plain, &scales[0]);
  read_well(scala_read_scale, text, &scales[1]);
  assert_int_equal(scales[0].n_notes, scales[1].n_notes);
  assert_memory_equal(scales[0].pitches, scales[1].pitches, scales[0].n_notes * sizeof(ScalePitch));
  scale_free(&scales[0]);
  scale_free(&scales[1]);
}

static void assert_maps_read_alike(const char* text, const char* plain) {
  ScaleMap maps[2];
  read_well(scala_read_map, plain, &maps[0]);
  read_well(scala_read_map, text, &maps[1]);
  const ScaleMap* const a = &maps[0];
  const ScaleMap* const b = &maps[1];
  assert_true(a->n_entries == b->n_entries && a->first_key == b->first_key);
  assert_true(a->last_key == b->last_key && a->middle_key == b->middle_key);
  assert_true(a->reference_key == b->reference_key && a->reference_hz == b->reference_hz);
  assert_true(a->octave_degree == b->octave_degree);
  assert_memory_equal(a->degrees, b->degrees, a->n_entries * sizeof(int32_t));
  scale_map_free(&maps[0]);
  scale_map_free(&maps[1]);
}

static void all_ways_of_writing_a_scale_read_alike(void** state) {
  static const char plain[] = "name\n3\n408.0\n81/64\n2/1\n";
  static const char* const texts[] = {
      "name\n3\n408.0\n81/64\n2/1",
      "\n3\n408.0\n81/64\n2/1",
      "name\r\n3\r\n408.0\r\n81/64\r\n2/1\r\n",
      "\r\r\n3\r408.0\r81/64\r2/1\r",
      "\xef\xbb\xbf! comment\nname\n3\n408.0\n81/64\n2/1\n",
      "\xef\xbb\xbfname\n3\n408.0\n81/64\n2/1\n",
      " ! this is the name\n3\n408.0\n81/64\n2/1\n",
      "!\nname\n! more\n3\n!\n408.0\n!5/4\n81/64\n!!\n2/1\n!",
      "name\n\n3\n\n408.0\n \t\n81/64\n  ! \n2/1\n\n",
      "name\n\t3 \n \t408.0 \n\t81/64\t\n 2/1 \t\n",
      "12\n3 notes\n408.0 cents\n81/64 E\\\n2/1 C 5/4\n",
      "12\n3!\n408.0cents\n81/64!\n2/1octave\n",
      "n\xe4me\n3\n408.0 \xa2\n81/64 \xe2\x99\xad\n2/1\n",
      "name\n3\n408.\n81/64\n2\n",
      "name\n003\n00408.000\n081/0064\n02/01\n",
      "name\n+3\n+408.0\n+81/64\n+2\n",
      "name\n3\n408.0\n81 / 64\n2 /\t1\n",
      "name\n3\n408.0\n81/64\n2 octave/1\n",
      "name\n3\n408.0\n81/64\n2 5/4\n",
      "name\n3\n408.0\n81/64\n2",
      "name\n3\n408.0\n81/64\n2 ",
      "name\n3\n408.0 /2\n81/64 /2\n2/1\n",
      "name\n3\n408.0\n81/64eb\n2/1E\n",
      "name\n3\n408.0\n81/64\n2/1\n5/1\nthis is the end of a mail\n0/0\n",
  };
  (void)state;
  for (size_t i = 0; i < sizeof(texts) / sizeof(*texts); ++i) {
    assert_scales_read_alike(texts[i], plain);
  }
}

static void all_ways_of_writing_a_map_read_alike(void** state) {
  static const char plain[] = "4\n1\n126\n60\n69\n440.5\n-3\n0\n-7\nx\nx\n";
  static const char* const texts[] = {
      "4\n1\n126\n60\n69\n440.5\n-3\n0\n-7",
      "4\r\n1\r\n126\r\n60\r\n69\r\n440.5\r\n-3\r\n0\r\n-7\r\nX\r\nx\r\n",
      "\xef\xbb\xbf! map\n4\n!\n1\n\n126\n ! \n60\n69\n440.5\n-3\n0\n!\n\n-7\nx\n!x",
      "\xef\xbb\xbf 4 keys\n\t1\n126 last\n60 C\n69 A\n+0440.50 Hz\n-3!\n0 C\n-7\nx x\nx\nend",
      "4\n1\n126\n60\n69\n440.5\n-3\n-0\n-7\nx!\n X\n",
      "4\n1\n126\n60\n69\n440.5\n-3\n+0 / 2\n-7\nx\n \t\n",
  };
  (void)state;
  for (size_t i = 0; i < sizeof(texts) / sizeof(*texts); ++i) {
    assert_maps_read_alike(texts[i], plain);
  }
}

static void what_is_read_is_what_was_written(void** state) {
  static const char text[] =
      "name\n6\n-5.0\n10/20\n.5\n-120000.\n1000000000000000000000000000000/2147483647\n"
      "9007199254740991/9007199254740993\n";
  static const ScalePitch pitches[] = {{-5.0, 1.0, 1.0},          {0.0, 10.0, 20.0},
                                       {0.5, 1.0, 1.0},           {-120000.0, 1.0, 1.0},
                                       {0.0, 1e30, 2147483647.0}, {0.0, 0x1p53 - 1.0, 0x1p53}};
  static const char map_text[] = "3\n1\n126\n59\n70\n431.25\n-11\n-4\nx\n1000000\n";
  static Scale scale;
  static ScaleMap map;
  ScaleError error;
  (void)state;
  assert_int_equal(scale_read(text, strlen(text), &scale, &error), STATUS_OK);
  assert_int_equal(scale.n_notes, 6);
  for (size_t i = 0; i < 6; ++i) {
    assert_true(scale.pitches[i].cents == pitches[i].cents);
    assert_true(scale.pitches[i].over == pitches[i].over);
    assert_true(scale.pitches[i].under == pitches[i].under);
  }
  assert_int_equal(scale_map_read(map_text, strlen(map_text), &map, &error), STATUS_OK);
  assert_true(map.n_entries == 3 && map.first_key == 1 && map.last_key == 126);
  assert_true(map.middle_key == 59 && map.reference_key == 70 && map.reference_hz == 431.25);
  assert_true(map.octave_degree == -11 && map.degrees[0] == -4);
  assert_true(map.degrees[1] == SCALE_UNMAPPED && map.degrees[2] == 1000000);
  scale_free(&scale);
  scale_map_free(&map);
}

/* Up to 15 digits, a whole number and a power of ten are exact, and there is one rounding. */
static void decimals_are_read_as_the_nearest_double(void** state) {
  Random random = random_start();
  static Scale scale;
  ScaleError error;
  (void)state;
  for (int i = 0; i < 10000; ++i) {
    char text[64];
    const double cents = random_between(&random, -1e5, 1e5);
    const int n_digits = (int)random_below(&random, 10);
    (void)snprintf(text, sizeof(text), "\n1\n%#.*f", n_digits, cents);
    assert_int_equal(scale_read(text, strlen(text), &scale, &error), STATUS_OK);
    assert_true(scale.pitches[0].cents == strtod(text + 3, NULL));
    scale_free(&scale);
  }
}

static void long_numbers_and_lines_are_read(void** state) {
  static char text[5000];
  static Scale scale;
  ScaleError error;
  (void)state;
  memset(text, 'd', 2000);
  memcpy(text + 2000, "\n2\n701.9550008653874177", 23);
  memset(text + 2023, '1', 900);
  memcpy(text + 2923, "\n", 1);
  memset(text + 2924, '0', 900);
  memcpy(text + 3824, "3/2 ", 4);
  memset(text + 3828, 'c', 900);
  assert_int_equal(scale_read(text, 4728, &scale, &error), STATUS_OK);
  assert_true(fabs(scale.pitches[0].cents - 701.9550008653874177) < 2e-13);
  assert_true(scale.pitches[1].over == 3.0 && scale.pitches[1].under == 2.0);
  scale_free(&scale);
  memset(text + 2006, '9', 900);
  assert_int_equal(scale_read(text, 2900, &scale, &error), STATUS_BAD_TEXT);
  assert_string_equal(error.found, "'701999999999999999999999999999999999999999999999...'");
}

/* The longest map, and a scale as long as a text has room for. */
static void the_largest_scale_and_map_are_read_whole(void** state) {
  enum { N_NOTES = (SCALE_MAX_BYTES - 16) / 2 };
  char* const text = malloc(SCALE_MAX_BYTES);
  Scale scale;
  ScaleMap map;
  ScaleError error;
  (void)state;
  assert_non_null(text);
  size_t n = (size_t)sprintf(text, "\n%d\n", N_NOTES);
  for (int i = 1; i <= N_NOTES; ++i) {
    text[n++] = i % 2 ? '3' : '5';
    text[n++] = '\n';
  }
  assert_int_equal(scale_read(text, n, &scale, &error), STATUS_OK);
  assert_int_equal(scale.n_notes, N_NOTES);
  assert_true(scale.pitches[N_NOTES - 1].over == 5.0 && scale.pitches[N_NOTES - 2].over == 3.0);
  scale_free(&scale);
  n = (size_t)sprintf(text, "%d\n0\n127\n0\n0\n440\n0\n", SCALE_MAX_PATTERN);
  for (int i = 0; i < SCALE_MAX_PATTERN; ++i) {
    n += (size_t)sprintf(text + n, "%d\n", i);
  }
  assert_int_equal(scale_map_read(text, n, &map, &error), STATUS_OK);
  assert_int_equal(map.degrees[SCALE_MAX_PATTERN - 1], SCALE_MAX_PATTERN - 1);
  scale_map_free(&map);
  free(text);
}

/* A number of notes that the text has no room for costs no memory. */
static void a_promise_of_notes_takes_no_memory(void** state) {
  static const char text[] = "name\n8388608\n3/2\n";
  Scale scale;
  ScaleError error;
  (void)state;
  assert_int_equal(scale_read(text, strlen(text), &scale, &error), STATUS_BAD_TEXT);
  assert_string_equal(error.found, "the end of the text");
}

static const char* const seeds[] = {
    "! meantone.scl\n!\nname\n 5\n!\n 76.04900\n 193.15686 C#\n 5/4\n 25/16\n 2/1\n",
    "name\r\n3\r\n-5.0\r\n10/20\r\n3 ! tritave\r\n",
    "\xef\xbb\xbf\n0\n",
    "! white\n12\n0\n127\n60\n69\n440.0\n7\n0\nx\n1\nx\n2\n3\nx\n4\nx\n5\nx\n6\n",
    "0\n0\n127\n60\n69\n261.625565\n0\n",
    "3\r\n10\r\n100\r\n64\r\n64\r\n300.\r\n-2\r\n-5\r\nx",
};

enum { N_SEEDS = sizeof(seeds) / sizeof(*seeds), MUTANT_SIZE = 512 };

static size_t mutate(Random* random, char* text, size_t n) {
  static const char* const bits[] = {
      "\n",   "\r",          "!", "/", ".",    "-",   "x",
      " ",    "\t",          "0", "9", "1024", "1e9", "99999999999999999999",
      "\xff", "\xef\xbb\xbf"};
  const size_t at = n ? random_below(random, (uint32_t)n) : 0;
  if (random_below(random, 4) == 0 && n) {
    text[at] = (char)random_below(random, 256);
    return n;
  }
  if (random_below(random, 3) == 0) {
    return random_below(random, 4) == 0 ? at : n;
  }
  if (random_below(random, 2) == 0 && n) {
    memmove(text + at, text + at + 1, n - at - 1);
    return n - 1;
  }
  const char* const bit = bits[random_below(random, sizeof(bits) / sizeof(*bits))];
  const size_t length = strlen(bit);
  if (n + length > MUTANT_SIZE) {
    return n;
  }
  memmove(text + at + length, text + at, n - at);
  memcpy(text + at, bit, length);
  return n + length;
}

static void assert_is_good_error(const ScaleError* error, const char* text, size_t n) {
  unsigned n_lines = 1;
  for (size_t i = 0; i < n; ++i) {
    n_lines += text[i] == '\n' || text[i] == '\r' ? 1 : 0;
  }
  assert_in_range(error->line, 1, n_lines);
  assert_true(strlen(error->found) > 0 && strlen(error->found) < SCALE_FOUND_SIZE);
  assert_true(strlen(error->expected) > 0 && strlen(error->expected) < SCALE_EXPECTED_SIZE - 1);
  for (const char* c = error->found; *c; ++c) {
    assert_in_range(*c, ' ', '~');
  }
}

static void ten_thousand_broken_texts_do_no_harm(void** state) {
  Random random = random_start();
  int n_read = 0;
  int n_refused = 0;
  static Scale scale;
  static ScaleMap map;
  (void)state;
  scale_equal(&scale);
  scale_map_linear(&map);
  for (int i = 0; i < 10000; ++i) {
    char text[MUTANT_SIZE];
    double hz[SCALE_KEYS];
    ScaleError error;
    const size_t seed = random_below(&random, N_SEEDS);
    size_t n = strlen(seeds[seed]);
    memcpy(text, seeds[seed], n);
    for (uint32_t j = 0, n_mutations = 1 + random_below(&random, 6); j < n_mutations; ++j) {
      n = mutate(&random, text, n);
    }
    memset(&error, 0, sizeof(error));
    Scale new_scale;
    ScaleMap new_map;
    const bool is_scale = seed < 3;
    const Status status = is_scale ? scala_read_copy(scala_read_scale, text, n, &new_scale, &error)
                                   : scala_read_copy(scala_read_map, text, n, &new_map, &error);
    if (status) {
      assert_int_equal(status, STATUS_BAD_TEXT);
      assert_is_good_error(&error, text, n);
      ++n_refused;
      continue;
    }
    ++n_read;
    if (is_scale) {
      scale_free(&scale);
      scale = new_scale;
    } else {
      scale_map_free(&map);
      map = new_map;
    }
    assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
    for (int key = 0; key < SCALE_KEYS; ++key) {
      assert_true(isnan(hz[key]) || (hz[key] >= SCALE_MIN_HZ && hz[key] <= SCALE_MAX_HZ));
    }
  }
  assert_true(n_read > 1000 && n_refused > 1000);
  scale_free(&scale);
  scale_map_free(&map);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_ways_of_writing_a_scale_read_alike),
      cmocka_unit_test(all_ways_of_writing_a_map_read_alike),
      cmocka_unit_test(what_is_read_is_what_was_written),
      cmocka_unit_test(decimals_are_read_as_the_nearest_double),
      cmocka_unit_test(long_numbers_and_lines_are_read),
      cmocka_unit_test(the_largest_scale_and_map_are_read_whole),
      cmocka_unit_test(a_promise_of_notes_takes_no_memory),
      cmocka_unit_test(ten_thousand_broken_texts_do_no_harm),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
