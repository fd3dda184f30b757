/* Whatever plucks, strikes and bows a string, at any rate and in any order, the string gets no
 * energy but what was pushed into it. */
#include "core/excite/bow.h"
#include "core/excite/contact.h"
#include "core/excite/hammer.h"
#include "core/excite/pluck.h"

#include "tests/support/hammers.h"
#include "tests/support/oracle.h"
#include "tests/support/strung.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* Felts are pressed by the difference of positions, and some are as stiff as 10³ strings, so the
 * worst of these draws is from 2e-11 to 4e-11, as compilers round; of a million a few are stiffer
 * still, and their hammers far away. */
static const double ROUNDING = 1e-10;
static const double ROUNDING_OF_MANY = 1e-8;

static const double rates_hz[] = {8000.0, 22050.0, 48000.0, 96000.0, 192000.0};
enum {
  N_GESTURES = 50,
  LONGEST = 40,
  N_RATES = 5,
  N_PLUCKS = 0,
  N_STRIKES = 1,
  N_STROKES = 2,
  N_OTHERS = 3
};

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];
static Motion motions[2];
static bool is_long(void) {
  return getenv("HOOKE_TEST_LONG");
}

/** A string and all that is at it, and the books of its energy. */
typedef struct {
  Strung strung;
  Hammer hammer;
  Bow bow;
  double amplitude;      /* About that of all that plays it */
  double energy;         /* Of string, hammer and roll */
  double size;           /* The most that it was */
  double gift;           /* The most that came from nowhere in a step, of that */
  double held;           /* What hammer and felt had */
  double bowed;          /* What bows gave, of that */
  uint32_t counts[4];    /* Gestures */
  uint32_t n_frames[3];  /* With a hammer, with a bow, with both */
  const Motion* current; /* What it does now */
} Played;

static void string_up(Played* played, Random* random, double rate_hz) {
  const double highest = fmin(108.0, 69.0 + 12.0 * log2(0.4 * rate_hz / 440.0));
  const double key = random_between(random, 21.0, highest);
  const TuningTarget target = {
      .rate_hz = rate_hz,
      .tone = {440.0 * exp2((key - 69.0) / 12.0), random_log_between(random, 0.005, 100.0)},
      .loss = random_below(random, 3) ? random_log_between(random, 1e-4, 1.0) : 0.0,
      .inharmonicity = random_below(random, 2) ? random_log_between(random, 1e-6, 1e-2) : 0.0,
      .partials = (Partials)random_below(random, 3),
  };
  const double most = random_below(random, 20) ? 40.0 : 1000.0;
  strung_up(&played->strung, memory, &target, (uint32_t)random_log_between(random, 1.0, most),
            CHAIN_DOUBLE);
  played->hammer = (Hammer){0};
  played->bow = (Bow){0};
  played->amplitude = random_log_between(random, 1e-6, 10.0);
  played->size = 0.0;
}

static double roll_energy(const Played* played) {
  const double spring = played->bow.spring * sqrt(played->strung.chain.now.k1);
  return played->bow.is_active ? 0.5 * spring * played->bow.rolled * played->bow.rolled : 0.0;
}

static double all_energy(const Played* played) {
  const Hammer* const hammer = &played->hammer;
  const double struck =
      hammer->is_active ? hammers_energy(hammer, &played->strung, played->current) : 0.0;
  return strung_energy(played->current, played->strung.chain.now) + struck + roll_energy(played);
}

/* Hammer and felt. */
static double felt_of(const Played* played) {
  return hammers_energy(&played->hammer, &played->strung, played->current);
}

/* Open the books anew, after something was done; what a felt holds has not grown by it. */
static void look(Played* played) {
  const double held = played->held;
  Chain* const chain = &played->strung.chain;
  chain_hold(chain, CHAIN_DOUBLE);
  if (played->hammer.is_active) {
    hammer_notice(&played->hammer, chain);
  }
  if (played->bow.is_active) {
    bow_notice(&played->bow, chain);
  }
  strung_read(&played->strung, &motions[0]);
  played->current = &motions[0];
  played->energy = all_energy(played);
  played->size = fmax(played->size, played->energy);
  if (played->hammer.is_active) {
    assert_true(felt_of(played) <= held + ROUNDING * played->size);
  }
}

/* The hammer with the bow, or the edge of its hair. */
static bool share_a_mass(const Played* played) {
  const double place = played->bow.place.value;
  const Contact a = contact_at(&played->strung.chain, played->hammer.make.place);
  const Contact b = contact_at(&played->strung.chain, place);
  const Contact c = contact_at(&played->strung.chain, place + (place < 0.5 ? -0.02 : 0.02));
  return (a.mass[0] <= b.mass[1] && b.mass[0] <= a.mass[1]) ||
         (a.mass[0] <= c.mass[1] && c.mass[0] <= a.mass[1]);
}

static void step(Played* played) {
  Hammer* const hammer = &played->hammer;
  Bow* const bow = &played->bow;
  Chain* const chain = &played->strung.chain;
  if (hammer->is_active && bow->is_active && share_a_mass(played)) {
    hammer->is_active = false;
    look(played);
  }
  const bool was_struck = hammer->is_active, was_bowed = bow->is_active;
  const Motion* const before = played->current;
  Motion* const after = &motions[before == &motions[0]];
  strung_step(&played->strung, 0);
  hammer_act(hammer, chain);
  bow_act(bow, chain);
  strung_read(&played->strung, after);
  played->current = after;
  const double work = was_bowed ? (bow->friction + bow->drag) * bow->hair : 0.0;
  const double lost = strung_lost(before, after, chain->now);
  const double energy = all_energy(played);
  played->size = fmax(played->size, fmax(energy, fabs(work)));
  played->gift = fmax(played->gift, (energy + lost - played->energy - work) / played->size);
  played->bowed = fmax(played->bowed, work / played->size);
  played->energy = energy;
  played->n_frames[0] += was_struck;
  played->n_frames[1] += was_bowed;
  played->n_frames[2] += was_struck && was_bowed;
  assert_true(isfinite(energy));
}

static void strike_anyhow(Played* played, Random* random) {
  const Strung* const strung = &played->strung;
  if (random_below(random, 4) == 0) {
    const Strike strike = {random_between(random, -0.1, 1.1), random_between(random, 0.0, 1.0),
                           random_log_between(random, 0.02, 1.0), played->amplitude};
    hammer_throw(&played->hammer, &strung->chain, strike, strung->angle1, strung->rate_hz);
  } else {
    HammerMake make = hammers_anyhow(random, random_below(random, 2) ? 1.0 : 0.0);
    const double slower = played->amplitude * strung->angle1 / make.velocity;
    make.velocity *= slower;
    make.felt.loss /= slower;
    make.felt.stiffness *= pow(slower, 1.0 - make.felt.exponent);
    hammer_start(&played->hammer, &strung->chain, make, strung->rate_hz);
  }
}

static void bow_anyhow(Played* played, Random* random) {
  const Stroke stroke = {.place = random_between(random, 0.0, 1.0),
                         .pressure = random_between(random, -2.0, 3.0),
                         .amplitude = played->amplitude * random_log_between(random, 0.1, 10.0),
                         .attack_s = random_log_between(random, 1e-4, 0.1),
                         .release_s = random_log_between(random, 1e-4, 0.1)};
  const Strung* const strung = &played->strung;
  bow_start(&played->bow, &strung->chain, stroke, strung->angle1, strung->rate_hz);
}

static void gesture(Played* played, Random* random) {
  const uint32_t what = random_below(random, 8);
  played->held = played->hammer.is_active ? felt_of(played) : 0.0;
  if (what < 2) {
    const Pluck pluck = {random_between(random, 0.0, 1.0), random_between(random, 0.0, 1.0),
                         played->amplitude * random_between(random, -1.0, 1.0), 0.0};
    (void)pluck_pull(&played->strung.chain, pluck);
    ++played->counts[N_PLUCKS];
  } else if (what < 4) {
    strike_anyhow(played, random);
    played->held = HUGE_VAL;
    ++played->counts[N_STRIKES];
  } else if (what < 6) {
    bow_anyhow(played, random);
    ++played->counts[N_STROKES];
  } else if (what == 6) {
    bow_swell(&played->bow, random_between(random, -0.5, 2.5), random_below(random, 50));
    ++played->counts[N_OTHERS];
  } else {
    bow_lift(&played->bow);
    ++played->counts[N_OTHERS];
  }
  look(played);
}

static void nothing_comes_from_nowhere(void** state) {
  (void)state;
  static Played played;
  Random random = random_start();
  const uint32_t n_strings = is_long() ? 4000 : 20;
  for (size_t r = 0; r < N_RATES; ++r) {
    for (uint32_t k = 0; k < n_strings; ++k) {
      string_up(&played, &random, rates_hz[r]);
      hammers_shake(&played.strung, &random, random_below(&random, 2) ? 0.0 : played.amplitude);
      look(&played);
      for (uint32_t g = 0; g < N_GESTURES; ++g) {
        gesture(&played, &random);
        for (uint32_t n = random_below(&random, LONGEST) + 1; n > 0; --n) {
          step(&played);
        }
      }
    }
  }
  print_message(
      "  %u plucks, %u strikes, %u strokes, %u lifts and swells; frames with a hammer %u, a "
      "bow %u, both %u\n",
      played.counts[0], played.counts[1], played.counts[2], played.counts[3], played.n_frames[0],
      played.n_frames[1], played.n_frames[2]);
  assert_within("energy from nowhere in a step, of all that there was", played.gift,
                is_long() ? ROUNDING_OF_MANY : ROUNDING);
  assert_true(played.n_frames[2] > 1000 && played.bowed > 0.01);
}

/* They would tell of a millionth. */
static void the_books_see_a_push(void** state) {
  (void)state;
  static Played played;
  Random random = random_start();
  for (uint32_t k = 0; k < 200; ++k) {
    string_up(&played, &random, rates_hz[k % N_RATES]);
    played.gift = 0.0;
    const uint32_t i = random_below(&random, played.strung.chain.n_masses);
    chain_push(&played.strung.chain, i, (float)played.amplitude);
    look(&played);
    step(&played);
    assert_true(played.gift <= ROUNDING);
    const double u = (double)chain_velocity(&played.strung.chain, i);
    const double more = 1e-3 * played.amplitude * (u < 0.0 ? -1.0 : 1.0);
    /* With it positions move too, as a force would move them. */
    contact_push(&played.strung.chain, &(Contact){{i, i}, {1.0, 0.0}, 1.0}, more);
    step(&played);
    assert_true(fabs(played.gift) > ROUNDING);
  }
}

/* It says what it gives, which from rest is ½ fᵀx − ⅛ fᵀf, f its force and x where that holds the
 * string: x and ½ f are what is added. */
static void a_pluck_gives_its_pull_and_no_more(void** state) {
  (void)state;
  static Played played;
  static Motion before;
  Random random = random_start();
  double worst[3] = {0.0};
  for (uint32_t k = 0; k < (is_long() ? 100000 : 5000); ++k) {
    string_up(&played, &random, rates_hz[k % N_RATES]);
    const Chain* const chain = &played.strung.chain;
    const bool is_at_rest = random_below(&random, 2);
    const Pluck pluck = {random_between(&random, 0.0, 1.0), random_between(&random, 0.0, 1.0),
                         played.amplitude, 0.0};
    hammers_shake(&played.strung, &random, is_at_rest ? 0.0 : played.amplitude);
    look(&played);
    before = *played.current;
    const double energy = played.energy;
    const double told = pluck_pull(&played.strung.chain, pluck);
    look(&played);
    double sum = 0.0, given = 0.0;
    for (uint32_t i = 0; i < before.n; ++i) {
      const double x = played.current->x[i] - before.x[i];
      const double f = 2.0 * (played.current->u[i] - before.u[i]);
      assert_true(x > -1e-6 * played.amplitude && f > -1e-6 * played.amplitude);
      sum += f;
      given += 0.5 * f * x - 0.125 * f * f;
    }
    const double a1 = tuning_mode(chain->now, chain->n_masses, 1).a;
    const double asked = pluck.amplitude * (chain->n_masses + 1.0) * (2.0 / PI) * a1;
    worst[0] = fmax(worst[0], is_at_rest ? fabs(sum / asked - 1.0) : 0.0);
    worst[1] = fmax(worst[1], fabs(played.energy - energy - told) / played.size);
    worst[2] = fmax(worst[2], is_at_rest ? fabs(given / told - 1.0) : 0.0);
  }
  /* What is added is in floats. */
  assert_within("force, of what is asked for", worst[0], 2e-6);
  /* The energies of two states in motion are taken from each other. */
  assert_within("energy, of what it says", worst[1], 1e-11);
  assert_within("from rest, of what its force gives", worst[2], 1e-4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_comes_from_nowhere),
      cmocka_unit_test(the_books_see_a_push),
      cmocka_unit_test(a_pluck_gives_its_pull_and_no_more),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
