#include "core/excite/bow.h"

#include "core/excite/contact.h"
#include "tests/support/oracle.h"
#include "tests/support/strung.h"
#include "tools/bench/bench_clock.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];

static bool is_long(void) {
  return getenv("HOOKE_TEST_LONG");
}

static Stroke stroke_anyhow(Random* random) {
  return (Stroke){
      .place = random_between(random, 0.0, 1.0),
      .pressure = random_between(random, -3.0, 4.0),
      .amplitude = random_log_between(random, 1e-6, 10.0),
      .attack_s = random_log_between(random, 1e-4, 0.1),
      .release_s = random_log_between(random, 1e-4, 0.1),
  };
}

/* Lift it, let it swell or begin another stroke, now and then. */
static void change_anyhow(Bow* bow, const Strung* strung, Random* random) {
  switch (random_below(random, 600)) {
  case 0:
    bow_lift(bow);
    break;
  case 1:
    bow_swell(bow, random_between(random, -0.5, 2.5), random_below(random, 500));
    break;
  case 2:
    bow_start(bow, &strung->chain, stroke_anyhow(random), strung->angle1, strung->rate_hz);
    break;
  default:
    break;
  }
}

/* What the place does, a second way: eᵀu. */
static double place_velocity(double place, const Motion* motion) {
  const double at = fmin(fmax(place * (motion->n + 1.0), 1.0), motion->n);
  const uint32_t i = (uint32_t)at;
  const double w = at - i;
  return (1.0 - w) * motion->u[i - 1] + (w > 0.0 ? w * motion->u[i] : 0.0);
}

/* Friction of the curve: at most the static, and where it slips just what the curve says. */
static void assert_on_the_curve(const Bow* bow, StringCoefs coefs) {
  const double force = bow->strength.value * bow->pressed.value * sqrt(coefs.k1);
  const double v0 = fmax(1e-300, 0.2 * bow->hair);
  if (bow->state == BOW_STICKS) {
    assert_true(bow->slip == 0.0 && fabs(bow->friction) <= 0.8 * force * (1.0 + 1e-12));
  } else {
    const double curve = force * (0.3 + 0.5 / (1.0 + fabs(bow->slip) / v0));
    assert_true(fabs(fabs(bow->friction) - curve) <= 1e-12 * curve);
    assert_true(bow->friction * bow->slip <= 0.0);
  }
}

static void power_comes_from_the_bow_alone(void** state) {
  (void)state;
  static Motion motion[2];
  Random random = random_start();
  double worst = 0.0;
  double worst_speed = 0.0;
  double worst_gift = 0.0;
  uint32_t n_of[3] = {0};
  for (int k = 0; k < (is_long() ? 2000 : 200); ++k) {
    Strung strung;
    Bow bow = {0};
    strung_up_anywhere(&strung, memory, &random, CHAIN_DOUBLE);
    const StringCoefs coefs = strung.chain.now;
    bow_start(&bow, &strung.chain, stroke_anyhow(&random), strung.angle1, strung.rate_hz);
    const double swing = bow.drawn.goal * random_below(&random, 4);
    chain_push(&strung.chain, strung.chain.n_masses / 2,
               (float)(swing * (strung.chain.n_masses + 1.0)));
    bow_notice(&bow, &strung.chain);
    strung_read(&strung, &motion[0]);
    double before = strung_energy(&motion[0], coefs);
    double rolled = 0.0;
    double size = 1e-300;
    for (int n = 0; n < 1000 && bow.is_active; ++n) {
      Motion* const old = &motion[n % 2];
      Motion* const new = &motion[(n + 1) % 2];
      const double place = bow.place.value;
      strung_step(&strung, 0);
      bow_act(&bow, &strung.chain);
      strung_read(&strung, new);
      const double speed = 0.5 * (place_velocity(place, old) + place_velocity(place, new));
      const double edge = place + (place < 0.5 ? -0.02 : 0.02);
      const double edge_speed = 0.5 * (place_velocity(edge, old) + place_velocity(edge, new));
      const double after = strung_energy(new, coefs);
      const double gained = after - before + strung_lost(old, new, coefs);
      const double roll = 0.5 * bow.spring * sqrt(coefs.k1) * bow.rolled * bow.rolled;
      const double pulled = (bow.friction + bow.drag) * bow.hair;
      size = fmax(size, fmax(fabs(pulled), after + roll));
      worst = fmax(worst, fabs(gained - bow.friction * speed - bow.drag * edge_speed) / size);
      worst_gift = fmax(worst_gift, (gained + roll - rolled - pulled) / size);
      assert_true(bow.drag * (edge_speed - bow.hair) <= 1e-12 * size);
      /* Where it sticks, the string and its roll go with the hair. */
      const double roll_speed = bow.slip + bow.hair - speed;
      const double pull = sqrt(coefs.k1) * roll_speed * (2.0 + 0.5 * bow.spring) +
                          sqrt(coefs.k1) * bow.spring * (bow.rolled - roll_speed);
      worst_speed = fmax(worst_speed, fabs(pull - bow.friction) /
                                          (fabs(bow.friction) + sqrt(coefs.k1) * bow.drawn.goal));
      assert_on_the_curve(&bow, coefs);
      assert_true(isfinite(after));
      ++n_of[bow.state];
      before = after;
      rolled = roll;
      change_anyhow(&bow, &strung, &random);
    }
  }
  print_message("  steps: %u stick, %u slip back, %u ahead\n", n_of[0], n_of[1], n_of[2]);
  assert_within("energy gained, less the work of the friction", worst, 1e-12);
  assert_within("energy that neither bow nor friction gave", worst_gift, 1e-12);
  assert_within("roll against friction", worst_speed, 2e-8);
  assert_true(n_of[0] > 1000 && n_of[1] > 1000 && n_of[2] > 100);
}

/* Whatever is asked for, the string has at most what the bow can pull it to. */
static void storms_of_strokes_stay_bounded(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int k = 0; k < (is_long() ? 3000 : 300); ++k) {
    Strung strung;
    Bow bow = {0};
    double given = 1e-30;
    double most = 0.0;
    static Motion motion;
    strung_up_anywhere(&strung, memory, &random, CHAIN_FLOAT);
    for (int n = 0; n < 4000; ++n) {
      if (random_below(&random, 500) == 0) {
        if (bow.is_active && random_below(&random, 2)) {
          bow_lift(&bow);
        } else {
          bow_start(&bow, &strung.chain, stroke_anyhow(&random), strung.angle1, strung.rate_hz);
        }
      }
      strung_step(&strung, 0);
      if (bow_act(&bow, &strung.chain)) {
        given += fmax(0.0, (bow.friction + bow.drag) * bow.hair);
      }
    }
    strung_read(&strung, &motion);
    most = motion_energy(&motion, strung.chain.now);
    assert_true(isfinite(most));
    worst = fmax(worst, most / given);
  }
  assert_within("energy, of what bows gave", worst, 1.01);
}

static void a_bow_at_rest_only_brakes(void** state) {
  (void)state;
  static Motion motion;
  Strung strung;
  Bow bow = {0};
  strung_key(&strung, memory, 57, 48000.0, 128, 1e9);
  assert_true(chain_hold(&strung.chain, CHAIN_DOUBLE));
  chain_push(&strung.chain, 40, 0.01f);
  bow_start(&bow, &strung.chain, (Stroke){0.13, 0.5, 0.25, 0.01, 0.01}, strung.angle1, 48000.0);
  bow.drawn.n_left = 0;
  double before = HUGE_VAL;
  double first = 0.0;
  for (int n = 0; n < 48000; ++n) {
    strung_step(&strung, 0);
    bow_act(&bow, &strung.chain);
    strung_read(&strung, &motion);
    const double energy = motion_energy(&motion, strung.chain.now) +
                          0.5 * bow.spring * sqrt(strung.chain.now.k1) * bow.rolled * bow.rolled;
    first = n == 0 ? energy : first;
    assert_true(energy <= before + 1e-13 * first);
    before = energy;
  }
  assert_true(before < 0.5 * first);
}

/* The same bow and string, but for a push: what the friction is from a state on. */
static BowState meet(const Bow* bow, Chain* chain, BowState from, double push, double* friction) {
  Bow now = *bow;
  const Contact contact = contact_at(chain, bow->place.value);
  now.state = from;
  contact_push(chain, &contact, push);
  bow_act(&now, chain);
  *friction = now.friction;
  return now.state;
}

/* Pushed back ever harder what sticks lets go when friction at rest is used up, and not before; and
 * what slips goes on slipping where what sticks would stick still, but not when it is pushed on. */
static void what_slips_goes_on_slipping(void** state) {
  (void)state;
  enum { N_PUSHES = 2000 };
  static _Alignas(CHAIN_ALIGNMENT) char copy[sizeof memory];
  Random random = random_start();
  uint32_t n_both = 0;
  uint32_t n_of[3] = {0};
  for (int k = 0; k < 20; ++k) {
    Strung strung;
    Bow bow = {0};
    strung_up_anywhere(&strung, memory, &random, CHAIN_DOUBLE);
    bow_start(&bow, &strung.chain, stroke_anyhow(&random), strung.angle1, strung.rate_hz);
    for (int n = 0; n < 10000; ++n) {
      strung_step(&strung, 0);
      bow_act(&bow, &strung.chain);
    }
    strung_step(&strung, 0);
    memcpy(copy, memory, sizeof memory);
    const double force = bow.pressed.value * sqrt(strung.chain.now.k1);
    const double far = 20.0 * (bow.hair + force) * (1.0 + 1.0 / sqrt(strung.chain.now.k1));
    double before = HUGE_VAL;
    for (int n = 0; n <= N_PUSHES; ++n) {
      const double push = far * (2.0 * n / N_PUSHES - 1.0);
      double friction = 0.0;
      double slipping = 0.0;
      const BowState stuck = meet(&bow, &strung.chain, BOW_STICKS, push, &friction);
      memcpy(memory, copy, sizeof memory);
      const BowState slipped = meet(&bow, &strung.chain, BOW_SLIPS_BACK, push, &slipping);
      memcpy(memory, copy, sizeof memory);
      if (stuck == BOW_STICKS) {
        assert_true(fabs(friction) <= 0.8 * force * (1.0 + 1e-9) && friction <= before);
        before = friction;
        n_both += slipped == BOW_SLIPS_BACK;
      } else {
        assert_true(slipped == stuck && slipping == friction);
        assert_true(fabs(friction) < 0.8 * force && (friction > 0.0) == (stuck == BOW_SLIPS_BACK));
      }
      ++n_of[stuck];
    }
  }
  print_message("  %u stick, %u of which can slip, %u slip back, %u ahead\n", n_of[0], n_both,
                n_of[1], n_of[2]);
  assert_true(n_of[0] > 1000 && n_of[1] > 1000 && n_of[2] > 1000 && n_both > 100);
}

static void a_bow_costs_little(void** state) {
  (void)state;
  enum { N = 20000 };
  Strung strung;
  Bow bow = {0};
  Bow gone = {0};
  strung_key(&strung, memory, 45, 48000.0, 128, 2.0);
  bow_start(&bow, &strung.chain, (Stroke){0.13, 0.5, 0.25, 0.01, 0.05}, strung.angle1, 48000.0);
  double start_s = bench_clock_now_s();
  for (int i = 0; i < N; ++i) {
    bow_act(&bow, &strung.chain);
  }
  print_message("  %.1f ns a frame", 1e9 * (bench_clock_now_s() - start_s) / N);
  start_s = bench_clock_now_s();
  for (int i = 0; i < N; ++i) {
    assert_false(bow_act(&gone, &strung.chain));
  }
  print_message(", lifted %.1f\n", 1e9 * (bench_clock_now_s() - start_s) / N);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(power_comes_from_the_bow_alone),
      cmocka_unit_test(a_bow_at_rest_only_brakes),
      cmocka_unit_test(what_slips_goes_on_slipping),
      cmocka_unit_test(storms_of_strokes_stay_bounded),
      cmocka_unit_test(a_bow_costs_little),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
