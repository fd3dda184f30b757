#include "core/scale/scale.h"

#include "tests/support/scala.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

static void equal_temperament_is_the_formula_to_the_last_bit(void** state) {
  static const double a4_hz[] = {440.0, 400.0, 415.3, 432.1, 443.7, 480.0};
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scale_equal(&scale);
  scale_map_linear(&map);
  for (size_t i = 0; i < sizeof(a4_hz) / sizeof(*a4_hz); ++i) {
    assert_int_equal(scale_tune(&scale, &map, a4_hz[i], hz), STATUS_OK);
    for (int key = 0; key < SCALE_KEYS; ++key) {
      assert_true(hz[key] == a4_hz[i] * exp2((key - 69.0) / 12.0));
    }
  }
}

static void a_maps_frequency_holds_at_440_and_follows_a4(void** state) {
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scala_scale_file("meantone.scl", &scale);
  scala_map("0\n0\n127\n60\n60\n261.625565\n0\n", &map);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  assert_true(hz[60] == 261.625565);
  assert_int_equal(scale_tune(&scale, &map, 220.0, hz), STATUS_OK);
  assert_true(hz[60] == 261.625565 / 2.0);
  assert_int_equal(scale_tune(&scale, &map, 415.3, hz), STATUS_OK);
  assert_true(fabs(hz[60] / (261.625565 * 415.3 / 440.0) - 1.0) < 2.0 * DBL_EPSILON);
  scale_free(&scale);
  scale_map_free(&map);
}

static void octaves_of_ratios_double_to_the_last_bit(void** state) {
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scala_scale_file("pythagorean.scl", &scale);
  scale_map_linear(&map);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  for (int key = 12; key < SCALE_KEYS; ++key) {
    assert_true(hz[key] == 2.0 * hz[key - 12]);
  }
  scale_free(&scale);
}

static void keys_that_are_not_retuned_keep_equal_temperament(void** state) {
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scala_scale_file("meantone.scl", &scale);
  scala_map("1\n40\n80\n60\n100\n300\n1\n0\n", &map);
  assert_int_equal(scale_tune(&scale, &map, 430.0, hz), STATUS_OK);
  for (int key = 0; key < SCALE_KEYS; ++key) {
    const double equal_hz = 430.0 * exp2((key - 69.0) / 12.0);
    assert_int_equal(hz[key] == equal_hz, key < 40 || key > 80);
  }
  scale_free(&scale);
  scale_map_free(&map);
}

static void the_next_pattern_uses_notes_of_the_scale(void** state) {
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scala_scale_file("pythagorean.scl", &scale);
  scala_map("4\n0\n127\n60\n60\n256\n7\n0\n2\n4\n5\n", &map);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  /* Key 67 is entry 3 of the next pattern, degree 5 + 7, not a fourth above a fifth by chance; key
     70 is degree 4 + 14, 6 above the octave: 729/512, not 81/64 above two fifths. */
  assert_true(hz[67] == 512.0);
  assert_true(hz[70] == 256.0 * 2.0 * 729.0 / 512.0);
  assert_true(hz[56] == 256.0 / 2.0 * 4.0 / 3.0);
  scale_free(&scale);
  scale_map_free(&map);
}

static void a_scale_of_no_notes_is_a_unison(void** state) {
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scala_scale("\n0\n", &scale);
  assert_int_equal(scale.n_notes, 0);
  scale_map_linear(&map);
  assert_int_equal(scale_tune(&scale, &map, 432.0, hz), STATUS_OK);
  for (int key = 0; key < SCALE_KEYS; ++key) {
    assert_true(hz[key] == 432.0);
  }
  scala_map("2\n0\n127\n60\n60\n100\n0\n0\nx\n", &map);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  assert_true(hz[60] == 100.0 && isnan(hz[61]) && hz[0] == 100.0 && isnan(hz[127]));
  scale_free(&scale);
  scale_map_free(&map);
}

/* A ratio that doubles cannot hold, raised to 127: without its lost part it were 60 roundings off.
 */
static void a_high_power_of_a_ratio_stays_true(void** state) {
  static const char text[] = "commas\n1\n81/80\n";
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scala_scale(text, &scale);
  scala_map("0\n0\n127\n0\n0\n100\n0\n", &map);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  for (int key = 0; key < SCALE_KEYS; ++key) {
    const long double expected_hz = 100.0L * powl(81.0L / 80.0L, (long double)key);
    assert_true((double)fabsl((long double)hz[key] / expected_hz - 1.0L) <=
                3.0 * (DBL_EPSILON / 2.0));
  }
  scale_free(&scale);
  scale_map_free(&map);
}

static void a_pitch_out_of_range_is_silent(void** state) {
  static const char* const texts[] = {"\n1\n120000.\n", "\n1\n-120000.\n", "\n1\n1/1000000000\n",
                                      "\n2\n1000000000000000000000000000000\n-120000.\n"};
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scale_map_linear(&map);
  for (size_t i = 0; i < sizeof(texts) / sizeof(*texts); ++i) {
    Scale scale;
    int n_heard = 0;
    scala_scale(texts[i], &scale);
    assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
    for (int key = 0; key < SCALE_KEYS; ++key) {
      assert_true(isnan(hz[key]) || (hz[key] >= 1e-3 && hz[key] <= 1e6));
      n_heard += isnan(hz[key]) ? 0 : 1;
    }
    assert_true(hz[69] == 440.0);
    assert_true(n_heard >= 1 && n_heard <= 2);
    scale_free(&scale);
  }
}

static void the_ends_of_the_range_sound(void** state) {
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scale_equal(&scale);
  scala_map("0\n0\n127\n60\n127\n1000000.\n0\n", &map);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  assert_true(hz[127] == 1e6);
  assert_int_equal(scale_tune(&scale, &map, 440.1, hz), STATUS_OK);
  assert_true(isnan(hz[127]) && !isnan(hz[126]));
  scala_map("0\n0\n127\n60\n0\n0.001\n0\n", &map);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  assert_true(hz[0] == 1e-3);
  assert_int_equal(scale_tune(&scale, &map, 439.9, hz), STATUS_OK);
  assert_true(isnan(hz[0]) && !isnan(hz[1]));
  scale_map_free(&map);
}

/* Equal steps to the octave as a text, in cents. */
static char* equal_text(int n_steps) {
  char* const text = malloc(32 * (size_t)n_steps + 64);
  assert_non_null(text);
  size_t n = (size_t)sprintf(text, "equal steps\n%d\n", n_steps);
  for (int i = 1; i <= n_steps; ++i) {
    n += (size_t)sprintf(text + n, "%.10f\n", i * 1200.0 / n_steps);
  }
  return text;
}

static void a_scale_of_any_length_tunes_all_keys(void** state) {
  static const int lengths[] = {1200, 1848, 3558, 3600, 100000};
  (void)state;
  for (size_t i = 0; i < sizeof(lengths) / sizeof(*lengths); ++i) {
    char* const text = equal_text(lengths[i]);
    Scale scale;
    ScaleMap map;
    double hz[SCALE_KEYS];
    scala_scale(text, &scale);
    scale_map_linear(&map);
    assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
    for (int key = 0; key < SCALE_KEYS; ++key) {
      assert_true(fabs(hz[key] / (440.0 * exp2((key - 69.0) / lengths[i])) - 1.0) < 1e-12);
    }
    scale_free(&scale);
    free(text);
  }
}

/* A third of the octave to each key, which no key comes near without a map. */
static void a_map_reaches_all_notes_of_a_long_scale(void** state) {
  char* const text = equal_text(3558);
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scala_scale(text, &scale);
  scala_map("3\n0\n127\n60\n60\n261.6\n3558\n0\n1186\n2372\n", &map);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  for (int key = 40; key < 80; ++key) {
    assert_true(fabs(hz[key] / (261.6 * exp2((key - 60.0) / 3.0)) - 1.0) < 1e-12);
  }
  scale_free(&scale);
  scale_map_free(&map);
  free(text);
}

/* Twelve equal notes; key 69, which has 440 Hz, is left out. */
static void a_reference_without_a_degree_lies_between_its_neighbours(void** state) {
  static const struct {
    const char* text;
    double semitones; // Of key 69 above key 59
  } maps[] = {
      {"12\n0\n127\n59\n69\n440\n12\n0\nx\n2\nx\n4\n5\nx\n7\nx\n9\nx\n11\n", 10.0},
      {"12\n0\n127\n59\n69\n440\n12\n0\nx\n1\nx\n2\n3\nx\n4\nx\n5\nx\n6\n", 5.5},
      {"11\n0\n127\n59\n69\n440\n12\n0\nx\n2\nx\n4\n5\nx\n7\n\n\n", (7.0 + 12.0) / 2.0},
      {"8\n0\n127\n60\n69\n440\n12\nx\nx\nx\n4\nx\nx\nx\n-1\n", (-1.0 + 16.0) / 2.0 + 13.0},
      {"1000000\n0\n127\n59\n69\n440\n24\n0\n", 12.0},
  };
  Scale scale;
  (void)state;
  scale_equal(&scale);
  for (size_t i = 0; i < sizeof(maps) / sizeof(*maps); ++i) {
    ScaleMap map;
    double hz[SCALE_KEYS];
    scala_map(maps[i].text, &map);
    assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
    assert_true(isnan(hz[69]));
    assert_true(fabs(hz[59] / (440.0 * exp2(-maps[i].semitones / 12.0)) - 1.0) < 1e-12);
    scale_map_free(&map);
  }
}

static void white_keys_from_key_59_put_it_at_b(void** state) {
  static const char keys[] = "12\n0\n127\n59\n69\n440\n7\n0\nx\n1\nx\n2\n3\nx\n4\nx\n5\nx\n6\n";
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scala_scale("major\n7\n200.\n400.\n500.\n700.\n900.\n1100.\n2/1\n", &scale);
  scala_map(keys, &map);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  assert_true(fabs(hz[59] - 246.9416506) < 1e-6);
  scale_free(&scale);
  scala_scale("just\n7\n9/8\n5/4\n4/3\n3/2\n5/3\n15/8\n2/1\n", &scale);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  assert_true(fabs(hz[59] * sqrt(5.0 / 3.0 * 15.0 / 8.0) - 440.0) < 1e-9);
  scale_free(&scale);
  scale_map_free(&map);
}

static void assert_refused(const Scale* scale, const ScaleMap* map, double a4_hz) {
  double hz[SCALE_KEYS];
  for (int key = 0; key < SCALE_KEYS; ++key) {
    hz[key] = key;
  }
  assert_int_equal(scale_tune(scale, map, a4_hz, hz), STATUS_BAD_ARGUMENT);
  for (int key = 0; key < SCALE_KEYS; ++key) {
    assert_true(hz[key] == key);
  }
}

static void nonsense_is_refused(void** state) {
  Scale scale;
  ScaleMap good;
  (void)state;
  scale_equal(&scale);
  scale_map_linear(&good);
  int32_t degrees[] = {0, 1};
  good.n_entries = 2;
  good.degrees = degrees;
  double hz[SCALE_KEYS];
  assert_int_equal(scale_tune(&scale, &good, 440.0, hz), STATUS_OK);
  const double bad_hz[] = {0.0, -440.0, (double)NAN, (double)INFINITY, (double)-INFINITY};
  for (size_t i = 0; i < sizeof(bad_hz) / sizeof(*bad_hz); ++i) {
    ScaleMap map = good;
    map.reference_hz = bad_hz[i];
    assert_refused(&scale, &good, bad_hz[i]);
    assert_refused(&scale, &map, 440.0);
  }
#define REFUSED(field, value)                                                                      \
  do {                                                                                             \
    ScaleMap map = good;                                                                           \
    map.field = (value);                                                                           \
    assert_refused(&scale, &map, 440.0);                                                           \
    degrees[0] = 0;                                                                                \
    degrees[1] = 1;                                                                                \
  } while (0)
  REFUSED(n_entries, SCALE_MAX_PATTERN + 1);
  REFUSED(first_key, 128);
  REFUSED(last_key, 128);
  REFUSED(middle_key, 128);
  REFUSED(reference_key, 128);
  REFUSED(reference_hz, 1.01e6);
  REFUSED(reference_hz, 0.99e-3);
  REFUSED(octave_degree, SCALE_MAX_DEGREE + 1);
  REFUSED(octave_degree, -SCALE_MAX_DEGREE - 1);
  REFUSED(degrees[0], SCALE_MAX_DEGREE + 1);
  REFUSED(degrees[1], -SCALE_MAX_DEGREE - 1);
#undef REFUSED
  degrees[0] = degrees[1] = SCALE_UNMAPPED;
  assert_refused(&scale, &good, 440.0);
  good.first_key = 60;
  good.last_key = 59;
  assert_refused(&scale, &good, 440.0);
  scale_map_linear(&good);
  scale.n_notes = SCALE_MAX_NOTES + 1;
  assert_refused(&scale, &good, 440.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(equal_temperament_is_the_formula_to_the_last_bit),
      cmocka_unit_test(a_maps_frequency_holds_at_440_and_follows_a4),
      cmocka_unit_test(octaves_of_ratios_double_to_the_last_bit),
      cmocka_unit_test(keys_that_are_not_retuned_keep_equal_temperament),
      cmocka_unit_test(the_next_pattern_uses_notes_of_the_scale),
      cmocka_unit_test(a_scale_of_no_notes_is_a_unison),
      cmocka_unit_test(a_high_power_of_a_ratio_stays_true),
      cmocka_unit_test(a_pitch_out_of_range_is_silent),
      cmocka_unit_test(the_ends_of_the_range_sound),
      cmocka_unit_test(a_scale_of_any_length_tunes_all_keys),
      cmocka_unit_test(a_map_reaches_all_notes_of_a_long_scale),
      cmocka_unit_test(a_reference_without_a_degree_lies_between_its_neighbours),
      cmocka_unit_test(white_keys_from_key_59_put_it_at_b),
      cmocka_unit_test(nonsense_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
