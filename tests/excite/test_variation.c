#include "core/excite/variation.h"

#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { N = 20000 };

static const Pluck asked = {.place = 0.2, .hardness = 0.5, .amplitude = 0.1, .softness = 0.3};

/* How far it is off, each of the most that it may be. */
typedef struct {
  double off[3];
} Off;

static Off off(Pluck pluck, Pluck from) {
  return (Off){{(pluck.place / from.place - 1.0) / VARIATION_PLACE,
                (pluck.hardness - from.hardness) / VARIATION_HARDNESS,
                20.0 * log10(pluck.amplitude / from.amplitude) / VARIATION_LEVEL_DB}};
}

static bool are_same(Pluck a, Pluck b) {
  return a.place == b.place && a.hardness == b.hardness && a.amplitude == b.amplitude &&
         a.softness == b.softness;
}

static void without_it_notes_are_what_is_asked(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 100; ++n) {
    assert_true(are_same(variation_of((Variation){0.0, 1 + n}, n, n, asked), asked));
  }
}

static void the_same_note_of_a_take_is_the_same(void** state) {
  (void)state;
  const Pluck once = variation_of((Variation){1.0, 7}, 60, 3, asked);
  assert_true(once.softness == asked.softness);
  assert_true(are_same(once, variation_of((Variation){1.0, 7}, 60, 3, asked)));
  assert_false(are_same(once, variation_of((Variation){1.0, 8}, 60, 3, asked)));
  assert_false(are_same(once, variation_of((Variation){1.0, 7}, 61, 3, asked)));
  assert_false(are_same(once, variation_of((Variation){1.0, 7}, 60, 4, asked)));
}

/* Evenly spread: the mean is 0, the square's a third, and no two have to do with each other. */
static void notes_differ_to_both_sides_and_no_further(void** state) {
  (void)state;
  static const double amounts[] = {0.25, 1.0};
  for (int a = 0; a < 2; ++a) {
    double products[4][4] = {{0.0}};
    double largest = 0.0;
    for (uint32_t n = 0; n < N; ++n) {
      const Off one = off(variation_of((Variation){amounts[a], 1}, 60 + n % 2, n, asked), asked);
      const double values[4] = {1.0, one.off[0], one.off[1], one.off[2]};
      for (int i = 0; i < 16; ++i) {
        products[i / 4][i % 4] += values[i / 4] * values[i % 4] / N;
        largest = fmax(largest, fabs(values[1 + i % 3]));
      }
    }
    assert_within("largest, of the most", largest, amounts[a] * (1.0 + 1e-9));
    assert_true(largest > 0.999 * amounts[a]);
    for (int i = 0; i < 4; ++i) {
      for (int k = 1; k < 4; ++k) {
        const double expected = i == k ? amounts[a] * amounts[a] / 3.0 : 0.0;
        assert_within("from evenly spread", fabs(products[i][k] - expected), 4.0 / sqrt(N));
      }
    }
  }
}

/* A place and the one as far from the other wall are one. */
static void both_walls_are_alike(void** state) {
  (void)state;
  for (uint32_t n = 0; n < 1000; ++n) {
    const double place = 0.5 * n / 999.0;
    const Variation variation = {1.0, 5};
    const Pluck near = variation_of(variation, 60, n, (Pluck){place, 0.0, 1.0, 0.0});
    const Pluck far = variation_of(variation, 60, n, (Pluck){1.0 - place, 1.0, 1.0, 0.0});
    assert_within("from the mirror", place < 0.5 ? fabs(near.place + far.place - 1.0) : 0.0, 1e-12);
    assert_true(near.place >= 0.0 && near.place <= 1.0);
    assert_true(near.hardness >= 0.0 && far.hardness <= 1.0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(without_it_notes_are_what_is_asked),
      cmocka_unit_test(the_same_note_of_a_take_is_the_same),
      cmocka_unit_test(notes_differ_to_both_sides_and_no_further),
      cmocka_unit_test(both_walls_are_alike),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
