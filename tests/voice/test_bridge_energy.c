/* Strings on a bridge gain nothing: whatever they are, however they move, and while they glide. */
#include "core/voice/bridge.h"

#include "core/bank/bodies.h"
#include "tests/support/bridges.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { DRAWS = 30, STEPS = 100000, MOST_ORDER = BRIDGES_MOST_ORDER };

static Strung strung;

/* A string at its limit or far from it, a few of them with as many masses as a bend would leave. */
static void draw_string(Random* random, double rate_hz, bool is_damped) {
  TuningTarget target = {
      .rate_hz = rate_hz,
      .tone = {random_log_between(random, 10.0, 0.49 * rate_hz),
               is_damped ? random_log_between(random, 1e-3, 10.0) : (double)INFINITY},
      .loss = is_damped ? random_between(random, 0.0, 1.0) : 0.0,
      .inharmonicity = random_below(random, 2) ? 0.0 : random_log_between(random, 1e-6, 0.1),
      .partials = (Partials)random_below(random, 3),
  };
  const uint32_t j = strung.n_strings++;
  const uint32_t most = tuning_max_masses(&target, BRIDGES_MASSES);
  const uint32_t n_masses = 1 + random_below(random, most > 1 ? most : 1);
  target.tone.f0_hz *= random_below(random, 3) ? 1.0 : random_between(random, 0.9, 1.0);
  target.tone.f0_hz = fmin(target.tone.f0_hz, 0.45 * rate_hz);
  const BridgeHold hold = {bridge_mass(random_log_between(random, 25.0, 4200.0)),
                           random_between(random, 0.0, 1.0)};
  strung.n_masses[j] = n_masses;
  strung.motions[j] = (Motion){.n = n_masses};
  assert_int_equal(tuning_fit(&target, n_masses, &strung.coefs[j]), STATUS_OK);
  strung.ties[j] = bridge_tie(&strung.bridge, strung.coefs[j], n_masses, hold);
}

static void draw_strung(Random* random, bool is_damped) {
  static const double rates[] = {8e3, 48e3, 192e3};
  const double rate_hz = rates[random_below(random, 3)];
  strung.n_strings = 0;
  bridges_draw(random, rate_hz, &strung.bridge);
  for (uint32_t i = 0; i < strung.bridge.bank.n_added; ++i) {
    strung.bridge.bank.g[i] *= is_damped;
  }
  while (strung.n_strings < BRIDGES_STRINGS) {
    draw_string(random, rate_hz, is_damped);
  }
}

static void draw_motion(Random* random) {
  Bridge* const bridge = &strung.bridge;
  for (uint32_t i = 0; i < bridge->bank.n_added; ++i) {
    bridge->bank.x[i] = random_between(random, -1.0, 1.0);
    bridge->bank.u[i] = random_between(random, -1.0, 1.0);
    bridge->y += bridge->bank.x[i];
  }
  for (uint32_t j = 0; j < strung.n_strings; ++j) {
    for (uint32_t i = 0; i < strung.n_masses[j]; ++i) {
      strung.motions[j].x[i] = random_between(random, -1.0, 1.0);
      strung.motions[j].u[i] = random_between(random, -1.0, 1.0);
    }
  }
}

/* Rounding is some 10⁻¹⁶ of the largest term of H in a step, and walks. */
static void energy_of_the_whole_never_grows(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < DRAWS; ++i) {
    draw_strung(&random, true);
    draw_motion(&random);
    const double start = bridges_energy(&strung);
    double before = start;
    assert_true(start > 0.0);
    for (int n = 0; n < STEPS; ++n) {
      bridges_step(&strung);
      if (n % 64 == 0) {
        const double now = bridges_energy(&strung);
        worst = fmax(worst, (now - before) / start);
        before = now;
      }
    }
    assert_true(before < start);
  }
  assert_within("growth", worst, 1e-12);
}

static void energy_is_kept_where_nothing_damps(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < DRAWS; ++i) {
    draw_strung(&random, false);
    draw_motion(&random);
    const double start = bridges_energy(&strung);
    for (int n = 0; n < STEPS; ++n) {
      bridges_step(&strung);
    }
    worst = fmax(worst, fabs(bridges_energy(&strung) / start - 1.0));
  }
  assert_within("drift", worst, 1e-10);
}

/* What a string has given, others have: none of it is lost on the way. */
static void string_at_rest_takes_from_one_that_moves(void** state) {
  (void)state;
  const TuningTarget low = {48e3, {110.0, (double)INFINITY}, 0.0, 0.0, PARTIALS_TRUEST};
  TuningTarget high = low;
  high.tone.f0_hz = 220.0;
  strung = (Strung){.n_strings = 2, .n_masses = {20, 20}};
  bridge_init(&strung.bridge, 48e3);
  strung.bridge.bank.g[0] = 0.0;
  for (uint32_t j = 0; j < 2; ++j) {
    assert_int_equal(tuning_fit(j == 0 ? &low : &high, 20, &strung.coefs[j]), STATUS_OK);
    strung.ties[j] = bridge_tie(&strung.bridge, strung.coefs[j], 20, (BridgeHold){0.01, 1.0});
    strung.motions[j].n = 20;
  }
  for (uint32_t i = 0; i < 20; ++i) {
    strung.motions[1].x[i] = sin((i + 1.0) * acos(-1.0) / 21.0);
  }
  double most = 0.0;
  for (int n = 0; n < STEPS; ++n) {
    bridges_step(&strung);
    most = fmax(most, strung.ties[0].weight * motion_energy(&strung.motions[0], strung.coefs[0]) /
                          bridges_energy(&strung));
  }
  assert_true(most > 0.5);
}

/* A string at the pitch of a mode that has not been kept from it: all that it has goes to the body
 * and comes back, and there is never more. */
static void wolf_beats_and_gains_nothing(void** state) {
  (void)state;
  const TuningTarget target = {48e3, {196.0, (double)INFINITY}, 0.0, 0.0, PARTIALS_TRUEST};
  const Body body = {.n_modes = 1, .modes = {{196.0, 1e6, 0.3, {0.0}}}};
  double least = 1.0;
  double back = 0.0;
  double most = 0.0;
  strung = (Strung){.n_strings = 1, .n_masses = {20}};
  bridge_init_on(&strung.bridge, &body, (BodyShape){1.0, 1.0}, 48e3);
  assert_int_equal(tuning_fit(&target, 20, &strung.coefs[0]), STATUS_OK);
  strung.ties[0] =
      bridge_tie(&strung.bridge, strung.coefs[0], 20, (BridgeHold){bridge_mass(196.0), 1.0});
  strung.motions[0].n = 20;
  for (uint32_t i = 0; i < 20; ++i) {
    strung.motions[0].x[i] = sin((i + 1.0) * acos(-1.0) / 21.0);
  }
  const double start = bridges_energy(&strung);
  for (int n = 0; n < STEPS; ++n) {
    bridges_step(&strung);
    const double whole = bridges_energy(&strung);
    const double share =
        strung.ties[0].weight * motion_energy(&strung.motions[0], strung.coefs[0]) / whole;
    least = fmin(least, share);
    back = least < 0.1 ? fmax(back, share) : back;
    most = fmax(most, whole / start - 1.0);
  }
  print_message("  its share falls to %.3f and comes back to %.3f\n", least, back);
  assert_true(least < 0.1 && back > 0.9);
  assert_within("growth", most, 1e-12);
}

/* In between two wholes that are stable, everything mixed in a straight line. */
static double mix(double a, double b, double share) {
  return a + share * (b - a);
}

static StringCoefs mix_coefs(StringCoefs a, StringCoefs b, double share) {
  return (StringCoefs){
      .k1 = mix(a.k1, b.k1, share),
      .k2 = mix(a.k2, b.k2, share),
      .z0 = mix(a.z0, b.z0, share),
      .z1 = mix(a.z1, b.z1, share),
      .k3 = mix(a.k3, b.k3, share),
  };
}

/* Whether K and 4 − 2Z − K are positive. */
static bool is_positive(void) {
  static double k[MOST_ORDER * MOST_ORDER];
  static double z[MOST_ORDER * MOST_ORDER];
  static double top[MOST_ORDER * MOST_ORDER];
  static double mass[MOST_ORDER];
  const size_t order = bridges_order(&strung);
  bridges_forces(&strung, k, z, mass);
  memcpy(top, k, sizeof(k));
  bridges_top(order, top, z, mass);
  return bridges_eliminate(order, 1, k) && k[order * order - 1] > 0.0 &&
         bridges_eliminate(order, 1, top) && top[order * order - 1] > 0.0;
}

static void gliding_strings_stay_stable(void** state) {
  static Strung from;
  static Strung to;
  (void)state;
  Random random = random_start();
  for (int i = 0; i < 4 * DRAWS; ++i) {
    draw_strung(&random, true);
    to = strung;
    draw_strung(&random, true);
    from = strung;
    for (double share = 0.0; share <= 1.0; share += 0.125) {
      for (uint32_t j = 0; j < BRIDGES_STRINGS; ++j) {
        const uint32_t n_masses = from.n_masses[j];
        const StringCoefs last =
            tuning_headroom(to.coefs[j], n_masses) > 0.0 ? to.coefs[j] : from.coefs[j];
        const BridgeTie a = from.ties[j];
        const BridgeTie b =
            bridge_tie(&from.bridge, last, n_masses,
                       (BridgeHold){a.weight * (n_masses + 1.0), 0.125 * (j + 1.0)});
        strung.coefs[j] = mix_coefs(from.coefs[j], last, share);
        strung.ties[j] = (BridgeTie){.weight = a.weight,
                                     .pull = mix(a.pull, b.pull, share),
                                     .spring = mix(a.spring, b.spring, share),
                                     .load = mix(a.load, b.load, share)};
      }
      assert_true(is_positive());
    }
  }
}

/* A string that a key can have at any pitch, on a bridge of any rate, as often as a harp has it. */
static double draw_headroom(Random* random) {
  const double rate_hz = random_log_between(random, 100.0, 192e3);
  TuningTarget target = {
      rate_hz,
      {random_log_between(random, 1e-3, 0.499) * rate_hz, random_log_between(random, 1e-3, 1e3)},
      random_between(random, 0.0, 1.0),
      random_log_between(random, 1e-6, 0.1),
      (Partials)random_below(random, 3)};
  const uint32_t limit = (uint32_t)random_log_between(random, 1.0, 1024.9);
  const uint32_t n_masses = tuning_max_masses(&target, limit);
  const double octaves = random_between(random, -69.0, 58.0) / 12.0;
  target.tone.f0_hz *= random_between(random, 0.7, 1.0); /* A bend that leaves it its masses */
  StringCoefs coefs = {0};
  if (n_masses == 0 || tuning_fit(&target, n_masses, &coefs)) {
    return 1.0;
  }
  static Bridge bridge;
  bridges_draw(random, rate_hz, &bridge);
  const BridgeHold hold = {bridge_mass(440.0 * exp2(octaves)), 1.0};
  return bridge_headroom(&bridge, 160.0 * bridge_tie(&bridge, coefs, n_masses, hold).load);
}

static void no_harp_comes_near_the_limit(void** state) {
  (void)state;
  Random random = random_start();
  double least = 1.0;
  for (int i = 0; i < 20000; ++i) {
    least = fmin(least, draw_headroom(&random));
  }
  print_message("  least headroom %g\n", least);
  assert_true(least >= 0.1);
}

/* The share of the limit that a key's string takes, on a bridge that takes nothing of its lever. */
static double
share_of(const Bridge* bridge, double rate_hz, uint32_t key, uint32_t limit, double lever) {
  const double f0_hz = 440.0 * exp2((key - 69.0) / 12.0);
  const TuningTarget target = {rate_hz, {f0_hz, 2.0}, 0.01, 0.0, PARTIALS_TRUEST};
  const uint32_t n_masses = tuning_max_masses(&target, limit);
  StringCoefs coefs = {0};
  assert_int_equal(tuning_fit(&target, n_masses, &coefs), STATUS_OK);
  const BridgeTie tie =
      bridge_tie(bridge, coefs, n_masses, (BridgeHold){bridge_mass(f0_hz), lever});
  assert_true(tie.pull == lever * coefs.k1);
  return 1.0 - bridge_headroom(bridge, tie.load);
}

/* The lever gives way to nothing that is played, only to what is at the top of the spectrum; nor
 * does that of half the resonance on any body but a banjo's, whose bridge weighs 2 g. */
static void usual_strings_have_their_whole_lever(void** state) {
  (void)state;
  static const double rates[] = {44.1e3, 48e3, 96e3, 192e3};
  static Bridge bridge;
  double most = 0.0;
  double most_on_body = 0.0;
  for (uint32_t i = 0; i < 4; ++i) {
    for (uint32_t key = 21; key <= 108; ++key) {
      bridge_init(&bridge, rates[i]);
      for (uint32_t limit = 1; limit <= 1024; limit *= 4) {
        most = fmax(most, share_of(&bridge, rates[i], key, limit, 1.0));
      }
    }
    for (int body = BODIES_NONE + 1; body < BODIES_FILE; ++body) {
      bridge_init_on(&bridge, bodies_shipped((BodiesChoice)body), (BodyShape){1.0, 1.0}, rates[i]);
      for (uint32_t key = 21; body != BODIES_BANJO && key <= 108; ++key) {
        most_on_body = fmax(most_on_body, share_of(&bridge, rates[i], key, 80, 0.25));
      }
    }
  }
  assert_within("share of the limit", most, 0.1 * BRIDGE_MOST_LOAD);
  assert_within("share of the limit, on a body", most_on_body, BRIDGE_MOST_LOAD);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(energy_of_the_whole_never_grows),
      cmocka_unit_test(energy_is_kept_where_nothing_damps),
      cmocka_unit_test(string_at_rest_takes_from_one_that_moves),
      cmocka_unit_test(wolf_beats_and_gains_nothing),
      cmocka_unit_test(gliding_strings_stay_stable),
      cmocka_unit_test(no_harp_comes_near_the_limit),
      cmocka_unit_test(usual_strings_have_their_whole_lever),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
