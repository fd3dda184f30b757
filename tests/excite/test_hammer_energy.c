/* What a hammer and its felt do with energy: they keep it, or lose it, and never make any. */
#include "core/excite/hammer.h"

#include "tests/support/hammers.h"
#include "tests/support/oracle.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static _Alignas(CHAIN_ALIGNMENT) char memory[32 * CHAIN_MAX_MASSES];

static bool is_long(void) {
  return getenv("HOOKE_TEST_LONG");
}

/* The felt's energy a second way. */
static double stored(const Felt* felt, double c) {
  return c > 0.0 ? felt->stiffness * pow(c, felt->exponent + 1.0) / (felt->exponent + 1.0) : 0.0;
}

typedef struct {
  double drift;  /* Largest |change| of the energy in a step, without loss, of all */
  double growth; /* Largest growth in a step */
  uint32_t n_contacts;
} Balance;

/* Follow one hammer on one string, with all energies in double, step by step. */
static void follow(Strung* strung, Hammer* hammer, uint32_t most, Balance* balance) {
  static Motion motion;
  static Motion free;
  const StringCoefs coefs = strung->chain.now;
  strung_read(strung, &motion);
  double felt = hammers_energy(hammer, strung, &motion);
  double before = strung_energy(&motion, coefs) + felt;
  const double whole = before + 1e-300;
  bool was_pressed = false;
  for (uint32_t n = 0; n < most && hammer->is_active; ++n) {
    /* What dampers take: ½ (u' + u)ᵀZ u, from the motion before and after. */
    free = motion;
    strung_step(strung, 0);
    hammer_act(hammer, &strung->chain);
    strung_read(strung, &motion);
    const double lost = strung_lost(&free, &motion, coefs);
    felt = hammers_energy(hammer, strung, &motion);
    const double after = strung_energy(&motion, coefs) + felt;
    const double change = (after + lost - before) / fmax(whole, fabs(before));
    balance->drift = fmax(balance->drift, fabs(change));
    balance->growth = fmax(balance->growth, change);
    balance->n_contacts += hammer->force > 0.0 && !was_pressed;
    was_pressed = hammer->force > 0.0;
    assert_true(hammer->force >= 0.0 && isfinite(after));
    before = after;
  }
}

static void balance_anyhow(double loss, uint32_t n_contacts, Balance* balance) {
  Random random = random_start();
  while (balance->n_contacts < n_contacts) {
    Strung strung;
    strung_up_anywhere(&strung, memory, &random, CHAIN_DOUBLE);
    for (int k = 0; k < 200; ++k) {
      const HammerMake make = hammers_anyhow(&random, loss);
      Hammer hammer;
      if (strung.chain.n_masses > 40 && k > 10) {
        break; /* Long strings take long to add up. */
      }
      hammers_shake(&strung, &random, random_below(&random, 2) ? 0.0 : make.velocity);
      hammer_start(&hammer, &strung.chain, make, strung.rate_hz);
      follow(&strung, &hammer, 24, balance);
    }
  }
}

static void energy_is_kept_to_rounding(void** state) {
  (void)state;
  Balance balance = {0};
  balance_anyhow(0.0, is_long() ? 1000000 : 100000, &balance);
  print_message("  %u contacts\n", balance.n_contacts);
  /* Felts are pressed by the difference of positions, and some are as stiff as 10³ strings. */
  assert_within("change of energy in a step, of all of it", balance.drift, 3e-11);
}

static void lossy_felts_never_add_energy(void** state) {
  (void)state;
  Balance balance = {0};
  balance_anyhow(1.0, is_long() ? 1000000 : 100000, &balance);
  assert_within("growth of energy in a step, of all of it", balance.growth, 3e-11);
  assert_true(balance.drift > 1e-2);
}

/* The force that leaves nothing over, by halving alone, in the felt's own equation. */
static void felt_solves_its_equation(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int n = 0; n < 100000; ++n) {
    const Felt felt = {random_log_between(&random, 1e-20, 1e20), random_between(&random, 1.0, 5.0),
                       random_below(&random, 2) ? random_log_between(&random, 1e-3, 1e3) : 0.0};
    const double free = random_between(&random, -1.0, 1.0) * random_log_between(&random, 1e-6, 1.0);
    const double before = random_below(&random, 4)
                              ? random_between(&random, -1.0, 1.0)
                              : free * (1.0 + random_between(&random, -1e-3, 1e-3));
    const double admittance = random_log_between(&random, 0.5, 1e4);
    double after = 0.0;
    const double force = felt_press(&felt, before, free, admittance, &after);
    double low = fmin(0.0, free) - 1.0;
    double high = free;
    while (low > -1e40 && low > before - 1e40) {
      const double d = low - before;
      const double f = d == 0.0 ? 0.0 : (stored(&felt, low) - stored(&felt, before)) / d;
      if (low - free + admittance * f * fmax(0.0, 1.0 + felt.loss * d) <= 0.0) {
        break;
      }
      low = 2.0 * low - high;
    }
    const double lowest = low;
    for (int i = 0; i < 400; ++i) {
      const double c = 0.5 * (low + high);
      const double d = c - before;
      const double f = d == 0.0 ? 0.0 : (stored(&felt, c) - stored(&felt, before)) / d;
      if (c - free + admittance * f * fmax(0.0, 1.0 + felt.loss * d) > 0.0) {
        high = c;
      } else {
        low = c;
      }
    }
    assert_true(force >= 0.0 && isfinite(force));
    worst = fmax(worst, fabs(after - 0.5 * (low + high)) / (free - lowest));
    assert_true(fabs(after - (free - admittance * force)) <= 1e-14 * fmax(1.0, fabs(after)));
  }
  /* The halving divides a difference of energies by one of compressions. */
  assert_within("compression, of where it was sought", worst, 1e-12);
}

/* After a pluck in mid-contact, or a change of masses, a look makes the books balance again. */
static void looking_anew_mends_the_books(void** state) {
  (void)state;
  Random random = random_start();
  Balance balance = {0};
  for (int k = 0; k < 300; ++k) {
    Strung strung;
    Hammer hammer;
    strung_up_anywhere(&strung, memory, &random, CHAIN_DOUBLE);
    const HammerMake make = hammers_anyhow(&random, 0.0);
    hammer_start(&hammer, &strung.chain, make, strung.rate_hz);
    follow(&strung, &hammer, 3, &balance);
    const double pushed = hammer.force > 0.0 ? 0.1 * hammer.now : make.velocity;
    chain_push(&strung.chain, strung.chain.n_masses / 2, (float)pushed);
    hammer_notice(&hammer, &strung.chain);
    follow(&strung, &hammer, 10, &balance);
  }
  assert_within("change of energy in a step, of all of it", balance.drift, 3e-11);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(felt_solves_its_equation),
      cmocka_unit_test(energy_is_kept_to_rounding),
      cmocka_unit_test(lossy_felts_never_add_energy),
      cmocka_unit_test(looking_anew_mends_the_books),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
