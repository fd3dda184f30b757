/* Strokes that swell, and follow each other. */
#include "core/excite/bow.h"

#include "core/excite/contact.h"
#include "tests/support/oracle.h"
#include "tests/support/strung.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];

static Bow bow_on(Strung* strung, uint32_t key, Stroke stroke) {
  Bow bow = {0};
  strung_key(strung, memory, key, 48000.0, 128, 2.0);
  bow_start(&bow, &strung->chain, stroke, strung->angle1, 48000.0);
  return bow;
}

static void bow_frames(Strung* strung, Bow* bow, uint32_t n_frames) {
  for (uint32_t n = 0; n < n_frames; ++n) {
    strung_step(strung, 0);
    bow_act(bow, &strung->chain);
  }
}

static void a_swell_goes_in_a_straight_line(void** state) {
  (void)state;
  static const struct {
    double wanted, got;
    uint32_t n_frames;
  } swells[] = {{1.7, 1.7, 1000}, {0.2, 0.2, 333}, {-1.0, 0.0, 100}, {9.0, 2.0, 7}, {0.5, 0.5, 0}};
  Strung strung;
  Bow bow = bow_on(&strung, 57, (Stroke){0.13, 0.5, 0.25, 0.01, 0.05});
  bow_frames(&strung, &bow, 5000);
  const double speed = bow.hair;
  const double force = bow.pressed.value;
  double before = 1.0;
  for (size_t k = 0; k < sizeof swells / sizeof *swells; ++k) {
    const uint32_t n_frames = swells[k].n_frames;
    bow_swell(&bow, swells[k].wanted, n_frames);
    for (uint32_t n = 1; n <= n_frames + 5; ++n) {
      const double way = n < n_frames ? (double)n / n_frames : 1.0;
      const double strength = before + way * (swells[k].got - before);
      bow_frames(&strung, &bow, 1);
      assert_true(fabs(bow.hair - strength * speed) <= 1e-12 * speed);
      assert_true(bow.pressed.value == force);
      assert_true(bow.is_active);
    }
    before = bow.strength.value;
    assert_true(before == swells[k].got);
  }
}

/* All is in proportion to it: twice the strength is twice the stroke, to the last bit. */
static void a_swollen_stroke_is_a_stronger_stroke(void** state) {
  (void)state;
  static Motion motion[2];
  for (uint32_t key = 33; key <= 93; key += 12) {
    for (int way = 0; way < 2; ++way) {
      Strung strung;
      Bow bow = bow_on(&strung, key, (Stroke){0.2, 0.7, way == 0 ? 0.1 : 0.2, 0.02, 0.05});
      if (way == 0) {
        bow_swell(&bow, 2.0, 0);
      }
      bow_frames(&strung, &bow, 6000);
      strung_read(&strung, &motion[way]);
    }
    for (uint32_t i = 0; i < motion[0].n; ++i) {
      assert_true(motion[0].x[i] == motion[1].x[i] && motion[0].u[i] == motion[1].u[i]);
    }
  }
}

/* Hair, force and place go on from where they are, whatever the strokes and their strength. */
static void a_stroke_takes_over_from_the_one_before(void** state) {
  (void)state;
  static const Stroke strokes[] = {{0.13, 0.5, 0.25, 0.01, 0.05},
                                   {0.13, 0.5, 0.25, 0.01, 0.05},
                                   {0.3, 0.9, 0.05, 0.02, 0.05},
                                   {0.06, 0.1, 0.5, 0.005, 0.05}};
  Strung strung;
  Bow bow = bow_on(&strung, 57, strokes[0]);
  for (size_t k = 1; k < 8; ++k) {
    bow_swell(&bow, 0.25 * (double)k, 100);
    bow_frames(&strung, &bow, k % 3 == 2 ? 200 : 3000);
    if (k % 2 == 0) {
      bow_lift(&bow);
      bow_frames(&strung, &bow, 600);
    }
    const Bow was = bow;
    const Stroke stroke = strokes[k % 4];
    const double n_frames = 48000.0 * stroke.attack_s;
    bow_start(&bow, &strung.chain, stroke, strung.angle1, 48000.0);
    const double force = was.strength.value * was.pressed.value;
    const double hair_step = fabs(bow.drawn.goal - was.hair) / n_frames;
    const double force_step = fabs(bow.pressed.goal - force) / (0.3 * n_frames);
    bow_frames(&strung, &bow, 1);
    assert_true(fabs(bow.hair - was.hair) <= hair_step * (1.0 + 1e-9));
    assert_true(fabs(bow.pressed.value - force) <= force_step * (1.0 + 1e-9));
    assert_true(fabs(bow.place.value - was.place.value) <= 0.3 / n_frames);
    bow_frames(&strung, &bow, (uint32_t)n_frames);
    assert_true(bow.place.value == fmin(stroke.place, 0.2) && bow.hair == bow.drawn.goal);
    assert_true(bow.strength.value == 1.0 && bow.is_active && !bow.is_lifted);
    const Contact contact = contact_at(&strung.chain, bow.place.value);
    assert_true(fabs(bow.before - contact_velocity(&strung.chain, &contact)) < 1e-6 * bow.hair);
  }
}

/* The most that Schelleng's bow can press: 2 √k1 b/β, which the corner brings, is what friction
 * falls by where it slips fast.  At 0.13 no pressure is 0.36 of it, all 0.47. */
static void force_is_a_share_of_schellengs_most(void** state) {
  (void)state;
  double worst = 0.0;
  for (uint32_t key = 33; key <= 81; key += 6) {
    for (int tenth = 0; tenth <= 10; ++tenth) {
      Strung strung;
      Bow bow = {0};
      strung_key(&strung, memory, key, 48000.0, 128, 2.0);
      bow_start(&bow, &strung.chain, (Stroke){0.1, 0.1 * tenth, 0.2, 0.04, 0.03}, strung.angle1,
                strung.rate_hz);
      const double most = 2.0 * bow.drawn.goal / (0.1 * (0.8 - 0.3));
      const double share = 0.36 * pow(0.47 / 0.36, 0.1 * tenth) * pow(0.1 / 0.13, 0.25);
      worst = fmax(worst, fabs(bow.pressed.goal / (share * most) - 1.0));
    }
  }
  assert_within("force, relative", worst, 1e-12);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_swell_goes_in_a_straight_line),
      cmocka_unit_test(a_swollen_stroke_is_a_stronger_stroke),
      cmocka_unit_test(a_stroke_takes_over_from_the_one_before),
      cmocka_unit_test(force_is_a_share_of_schellengs_most),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
