#include "core/scale/scale.h"

#include "tests/support/scala.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/* Two roundings of a sum of up to 2^14 cents, and three of the frequency. */
static const double TOLERANCE =
    2.0 * 0x1p13 * DBL_EPSILON * (0.6931471805599453 / 1200.0) + 3.0 * (DBL_EPSILON / 2.0);

enum { N_PRIMES = 4, MOST_NOTES = 19, UNMAPPED = INT32_MIN };

static const long double primes[N_PRIMES] = {2.0L, 3.0L, 5.0L, 7.0L};

/* A pitch as fractions of primes: 3^(1/2) is {{0, 1, 0, 0}, 2}. */
typedef struct {
  int powers[N_PRIMES];
  int divisor;
} Monzo;

typedef struct {
  const char* file;
  int n_notes;
  Monzo pitches[MOST_NOTES]; // Degrees 1 to n_notes
} Known;

#define EQUAL(i, n)                                                                                \
  { {(i), 0, 0, 0}, (n) }
/* So many fifths of 5^(1/4), less so many octaves. */
#define MEANTONE(fifths, octaves)                                                                  \
  { {-4 * (octaves), 0, (fifths), 0}, 4 }
#define JUST(twos, threes, fives, sevens)                                                          \
  { {(twos), (threes), (fives), (sevens)}, 1 }

static const Known knowns[] = {
    {"meantone.scl",
     12,
     {MEANTONE(7, 4), MEANTONE(2, 1), MEANTONE(-3, -2), MEANTONE(4, 2), MEANTONE(-1, -1),
      MEANTONE(6, 3), MEANTONE(1, 0), MEANTONE(8, 4), MEANTONE(3, 1), MEANTONE(-2, -2),
      MEANTONE(5, 2), JUST(1, 0, 0, 0)}},
    {"pythagorean.scl",
     12,
     {JUST(-11, 7, 0, 0), JUST(-3, 2, 0, 0), JUST(5, -3, 0, 0), JUST(-6, 4, 0, 0),
      JUST(2, -1, 0, 0), JUST(-9, 6, 0, 0), JUST(-1, 1, 0, 0), JUST(-12, 8, 0, 0),
      JUST(-4, 3, 0, 0), JUST(4, -2, 0, 0), JUST(-7, 5, 0, 0), JUST(1, 0, 0, 0)}},
    {"bohlen-pierce.scl",
     13,
     {JUST(0, 3, -2, 0), JUST(0, -1, 2, -1), JUST(0, 2, 0, -1), JUST(0, 0, -1, 1),
      JUST(0, 1, 2, -2), JUST(0, -1, 1, 0), JUST(0, 2, -1, 0), JUST(0, 0, -2, 2), JUST(0, 1, 1, -1),
      JUST(0, -1, 0, 1), JUST(0, 2, -2, 1), JUST(0, -2, 2, 0), JUST(0, 1, 0, 0)}},
    {"19-equal.scl",
     19,
     {EQUAL(1, 19), EQUAL(2, 19), EQUAL(3, 19), EQUAL(4, 19), EQUAL(5, 19), EQUAL(6, 19),
      EQUAL(7, 19), EQUAL(8, 19), EQUAL(9, 19), EQUAL(10, 19), EQUAL(11, 19), EQUAL(12, 19),
      EQUAL(13, 19), EQUAL(14, 19), EQUAL(15, 19), EQUAL(16, 19), EQUAL(17, 19), EQUAL(18, 19),
      EQUAL(19, 19)}},
    {"just-major.scl",
     7,
     {JUST(-3, 2, 0, 0), JUST(-2, 0, 1, 0), JUST(2, -1, 0, 0), JUST(-1, 1, 0, 0), JUST(0, -1, 1, 0),
      JUST(-3, 1, 1, 0), JUST(1, 0, 0, 0)}},
    /* 1203.5 cents are 2407/2400 of an octave. */
    {"stretched.scl",
     12,
     {EQUAL(2407, 28800), EQUAL(4814, 28800), EQUAL(7221, 28800), EQUAL(9628, 28800),
      EQUAL(12035, 28800), EQUAL(14442, 28800), EQUAL(16849, 28800), EQUAL(19256, 28800),
      EQUAL(21663, 28800), EQUAL(24070, 28800), EQUAL(26477, 28800), EQUAL(28884, 28800)}},
    {"reversed.scl",
     6,
     {EQUAL(11, 12), EQUAL(-2505, 12000), EQUAL(90025, 120000), JUST(-1, 1, 0, 0), EQUAL(5, 12),
      EQUAL(1, 1)}},
};

enum { JUST_MAJOR = 4 };

static long double octaves_of(const Monzo* monzo) {
  long double octaves = 0.0L;
  for (int i = 0; i < N_PRIMES; ++i) {
    octaves += monzo->powers[i] * log2l(primes[i]);
  }
  return octaves / monzo->divisor;
}

/* Walks a period at a time instead of dividing. */
static long double octaves_at(const Known* known, int degree) {
  long double octaves = 0.0L;
  const long double period = octaves_of(&known->pitches[known->n_notes - 1]);
  for (; degree < 0; degree += known->n_notes) {
    octaves -= period;
  }
  for (; degree >= known->n_notes; degree -= known->n_notes) {
    octaves += period;
  }
  return octaves + (degree ? octaves_of(&known->pitches[degree - 1]) : 0.0L);
}

/* Walks a key at a time instead of dividing. */
static int degree_at(const ScaleMap* map, int n_notes, int key) {
  const int octave = map->octave_degree ? map->octave_degree : n_notes;
  int entry = 0;
  int base = 0;
  if (map->n_entries == 0) {
    return key - (int)map->middle_key;
  }
  for (int at = (int)map->middle_key; at < key; ++at) {
    entry = entry + 1 == (int)map->n_entries ? 0 : entry + 1;
    base += entry == 0 ? octave : 0;
  }
  for (int at = (int)map->middle_key; at > key; --at) {
    base -= entry == 0 ? octave : 0;
    entry = entry == 0 ? (int)map->n_entries - 1 : entry - 1;
  }
  return map->degrees[entry] == UNMAPPED ? UNMAPPED : map->degrees[entry] + base;
}

static void assert_tuned(const Known* known, const ScaleMap* map, double a4_hz) {
  Scale scale;
  double hz[SCALE_KEYS];
  scala_scale_file(known->file, &scale);
  assert_int_equal(scale.n_notes, known->n_notes);
  assert_int_equal(scale_tune(&scale, map, a4_hz, hz), STATUS_OK);
  const int reference = degree_at(map, known->n_notes, (int)map->reference_key);
  for (int key = 0; key < SCALE_KEYS; ++key) {
    const int degree = degree_at(map, known->n_notes, key);
    if (degree == UNMAPPED) {
      assert_true(isnan(hz[key]));
      continue;
    }
    const long double expected_hz = (long double)map->reference_hz * (long double)a4_hz / 440.0L *
                                    exp2l(octaves_at(known, degree) - octaves_at(known, reference));
    const double error = (double)fabsl((long double)hz[key] / expected_hz - 1.0L);
    if ((double)expected_hz < SCALE_MIN_HZ || (double)expected_hz > SCALE_MAX_HZ) {
      assert_true(isnan(hz[key]));
    } else if (!(error <= TOLERANCE)) {
      fail_msg("%s, key %d: %.17g Hz, %g off", known->file, key, hz[key], error);
    }
  }
  scale_free(&scale);
}

static void known_scales_sound_as_their_primes_say(void** state) {
  ScaleMap map;
  (void)state;
  scale_map_linear(&map);
  for (size_t i = 0; i < sizeof(knowns) / sizeof(*knowns); ++i) {
    assert_tuned(&knowns[i], &map, 440.0);
    assert_tuned(&knowns[i], &map, 415.3);
  }
}

static void a_map_takes_them_anywhere_on_the_keys(void** state) {
  static const char* const texts[] = {
      "0\n0\n127\n69\n69\n440\n0\n",
      "0 linear\n0\n127\n62\n0\n20.5\n7 is ignored\n",
      "0\n0\n127\n127\n127\n5000\n0\n",
      "3\n0\n127\n60\n61\n300\n0\n0\n5\n2\n",
      "5\n0\n127\n64\n66\n261.625565\n14\n-3\nx\n1\n40\n",
      "12\n0\n127\n0\n127\n261.6\n-7\n0\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n",
      "1\n0\n127\n60\n60\n261\n1\n-1000\n",
      "1024\n0\n127\n60\n60\n261\n5\n3\n2\n1\n",
  };
  ScaleMap map;
  (void)state;
  for (size_t i = 0; i < sizeof(knowns) / sizeof(*knowns); ++i) {
    for (size_t j = 0; j < sizeof(texts) / sizeof(*texts); ++j) {
      scala_map(texts[j], &map);
      assert_tuned(&knowns[i], &map, 440.0);
      scale_map_free(&map);
    }
  }
}

static void seven_notes_on_the_white_keys_leave_the_black_ones_silent(void** state) {
  Scale scale;
  ScaleMap map;
  double hz[SCALE_KEYS];
  (void)state;
  scala_map_file("white-keys.kbm", &map);
  assert_tuned(&knowns[JUST_MAJOR], &map, 440.0);
  scala_scale_file("just-major.scl", &scale);
  assert_int_equal(scale_tune(&scale, &map, 440.0, hz), STATUS_OK);
  for (int key = 0; key < SCALE_KEYS; ++key) {
    assert_int_equal(isnan(hz[key]) != 0, strchr("\1\3\6\10\12", key % 12) && key % 12 != 0);
  }
  assert_true(hz[69] == 440.0 && hz[60] == 264.0 && hz[64] == 330.0 && hz[72] == 528.0);
  assert_true(hz[59] == 247.5 && hz[48] == 132.0 && hz[0] == 8.25);
  scale_free(&scale);
  scale_map_free(&map);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(known_scales_sound_as_their_primes_say),
      cmocka_unit_test(a_map_takes_them_anywhere_on_the_keys),
      cmocka_unit_test(seven_notes_on_the_white_keys_leave_the_black_ones_silent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
