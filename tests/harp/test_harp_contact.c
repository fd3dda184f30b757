/* What the player does while a hammer or a bow is at a string of the harp. */
#include "core/excite/contact.h"
#include "tests/support/harps.h"
#include "tests/support/measure.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { RATE = 48000, STRIKE = 3, BOW = 6, N_INSTANTS = 12 };

static float left[RATE];

/* As loud as if nothing were done, whatever the moment of a bend that is next to none: what a
 * hammer or a bow has just given is not taken back as if the bend had. */
static void a_bend_does_not_take_back_what_is_being_given(void** state) {
  (void)state;
  double worst = 0.0;
  for (uint32_t way = STRIKE; way <= BOW; way += BOW - STRIKE) {
    const HarpPatch patch = harps_patch(way);
    Harp* const harp = harps_new(RATE, &patch);
    for (uint32_t key = 33; key <= 81; key += 12) {
      double level = 0.0;
      for (uint32_t instant = 0; instant < N_INSTANTS; ++instant) {
        /* The first is never. */
        const size_t at = instant == 0 ? RATE / 4 : 40 * instant;
        harps_restart(harp, &patch);
        harp_note_on(harp, 0, key, 100);
        harps_run(harp, at, left, NULL);
        harp_bend(harp, 0, 1e-6);
        harps_run(harp, RATE / 4 - at, left + at, NULL);
        const double now = measure_rms(left + RATE / 100, RATE / 5);
        level = instant == 0 ? now : level;
        worst = fmax(worst, fabs(20.0 * log10(now / level)));
      }
    }
    harp_free(harp);
  }
  assert_within("dB", worst, 0.5);
}

static void assert_sees(const HarpString* string) {
  const Chain* const chain = &string->voice.chain;
  if (string->voice.bow.is_active) {
    const Contact contact = contact_at(chain, string->voice.bow.place.value);
    assert_true(string->voice.bow.before == contact_velocity(chain, &contact));
  }
  if (string->voice.hammer.is_active) {
    const Contact contact = contact_at(chain, string->voice.hammer.make.place);
    const double now = string->voice.hammer.position - contact_position(chain, &contact);
    assert_true(string->voice.hammer.now == now);
  }
}

/* A bend by a fifth takes masses from a string, and a pluck gives them back and moves it. */
static void what_touches_a_string_sees_it_as_it_is(void** state) {
  (void)state;
  uint32_t n_seen = 0;
  for (uint32_t way = STRIKE; way <= BOW; way += BOW - STRIKE) {
    HarpPatch patch = harps_patch(way);
    HarpPatch pluck = harps_patch(0);
    patch.string.max_masses = CHAIN_MAX_MASSES;
    pluck.string.max_masses = CHAIN_MAX_MASSES;
    Harp* const harp = harps_new(RATE, &patch);
    for (uint32_t key = 45; key <= 81; key += 4) {
      for (size_t at = 20; at <= 5120; at *= 2) {
        const HarpString* const string = &harp->strings[key];
        harps_restart(harp, &patch);
        harp_note_on(harp, 0, key, 100);
        harps_run(harp, at, NULL, NULL);
        n_seen += string->voice.bow.is_active || string->voice.hammer.is_active;
        harp_bend(harp, 0, 7.0);
        assert_sees(string);
        harps_run(harp, 10, NULL, NULL);
        harp_set_patch(harp, &pluck, 100);
        harp_note_on(harp, 0, key, 100);
        assert_sees(string);
      }
    }
    harp_free(harp);
  }
  assert_true(n_seen > 100);
}

/* Steps, of the level. */
static double brightness(Harp* harp, const HarpPatch* patch) {
  double steps = 0.0;
  harps_restart(harp, patch);
  harp_note_on(harp, 0, 45, 100);
  harps_run(harp, RATE / 2, left, NULL);
  for (size_t i = RATE / 4; i < RATE / 2; ++i) {
    steps += pow((double)(left[i] - left[i - 1]), 2.0);
  }
  return sqrt(steps) / measure_rms(left + RATE / 4, RATE / 4);
}

static void place_and_hardness_are_the_patchs(void** state) {
  (void)state;
  HarpPatch patch = harps_patch(STRIKE);
  Harp* const harp = harps_new(RATE, &patch);
  const double usual = brightness(harp, &patch);
  patch.hardness = 0.0;
  const double soft = brightness(harp, &patch);
  patch.hardness = 0.9;
  const double hard = brightness(harp, &patch);
  patch.hardness = 0.5;
  patch.pluck = 0.05;
  const double elsewhere = brightness(harp, &patch);
  print_message("  usual %.2f, soft %.2f, hard %.2f, elsewhere %.2f\n", usual, soft, hard,
                elsewhere);
  assert_true(soft < usual && hard > 1.02 * usual);
  assert_true(fabs(elsewhere / usual - 1.0) > 0.1);
  harp_free(harp);
}

/* Helmholtz's motion is as bright at any place and pressure; so look at the bow itself. */
static void place_and_pressure_of_a_bow_are_the_patchs(void** state) {
  (void)state;
  HarpPatch patch = harps_patch(BOW);
  Harp* const harp = harps_new(RATE, &patch);
  const Bow* const bow = &harp->strings[45].voice.bow;
  double before = 0.0;
  for (int fifth = 0; fifth <= 5; ++fifth) {
    patch.hardness = 0.2 * fifth;
    patch.pluck = 0.06 + 0.02 * fifth;
    harps_restart(harp, &patch);
    harp_note_on(harp, 0, 45, 100);
    harps_run(harp, RATE / 2, left, NULL);
    /* Of Schelleng's most, that of a place is 1/β of the speed's. */
    const double share =
        bow->pressed.value / bow->drawn.value * patch.pluck * pow(0.13 / patch.pluck, 0.25);
    assert_true(fabs(bow->place.value - patch.pluck) < 1e-12);
    assert_true(share > 1.02 * before);
    before = share;
  }
  harp_free(harp);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_bend_does_not_take_back_what_is_being_given),
      cmocka_unit_test(what_touches_a_string_sees_it_as_it_is),
      cmocka_unit_test(place_and_hardness_are_the_patchs),
      cmocka_unit_test(place_and_pressure_of_a_bow_are_the_patchs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
