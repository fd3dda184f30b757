/* The bridge's closed forms against dense matrices: pitch, decay, springs, and the limit. */
#include "core/voice/bridge.h"

#include "core/analysis/modes.h"
#include "tests/support/bridges.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

enum { DRAWS = 300, MOST_ORDER = BRIDGES_STRINGS * BRIDGES_MASSES + 1 };

static Strung strung;
static double stiffness[MOST_ORDER * MOST_ORDER];
static double damping[MOST_ORDER * MOST_ORDER];
static double mass[MOST_ORDER];
static double complex poles[2 * MOST_ORDER];

/* A string that has at least a tenth of a key's damping, up to a sixth of the rate. */
static TuningTarget draw_target(Random* random) {
  static const double rates[] = {8e3, 22050.0, 48e3, 192e3};
  const double rate_hz = rates[random_below(random, 4)];
  return (TuningTarget){
      .rate_hz = rate_hz,
      .tone = {random_log_between(random, 25.0, rate_hz / 6.0),
               random_log_between(random, 0.1, 10.0)},
      .loss = random_below(random, 3) ? random_between(random, 0.0, 1.0) : 0.0,
      .inharmonicity = random_below(random, 2) ? 0.0 : random_log_between(random, 1e-6, 0.01),
      .partials = (Partials)random_below(random, 3),
  };
}

static uint32_t draw_masses(Random* random, const TuningTarget* target) {
  const uint32_t most = tuning_max_masses(target, BRIDGES_MASSES);
  assert_true(most > 0);
  return 1 + random_below(random, most);
}

static BridgeHold draw_hold(Random* random, const TuningTarget* target) {
  return (BridgeHold){bridge_mass(target->tone.f0_hz), random_between(random, 0.01, 1.0)};
}

/* Tie another string to the bridge, tuned to `asked`. */
static void add_string(const TuningTarget* asked, uint32_t n_masses, BridgeHold hold) {
  const uint32_t j = strung.n_strings++;
  strung.n_masses[j] = n_masses;
  assert_int_equal(tuning_fit(asked, n_masses, &strung.coefs[j]), STATUS_OK);
  strung.ties[j] = bridge_tie(strung.coefs[j], n_masses, hold);
}

static void draw_string(Random* random, double rate_hz) {
  TuningTarget target = draw_target(random);
  target.tone.f0_hz = fmin(target.tone.f0_hz, rate_hz / 6.0);
  target.rate_hz = rate_hz;
  add_string(&target, draw_masses(random, &target), draw_hold(random, &target));
}

static void draw_strung(Random* random) {
  const double rate_hz = random_below(random, 2) ? 8e3 : 48e3;
  const uint32_t n_strings = 1 + random_below(random, BRIDGES_STRINGS);
  strung = (Strung){.bridge = bridge_at(rate_hz)};
  while (strung.n_strings < n_strings) {
    draw_string(random, rate_hz);
  }
}

/* What the whole has nearest to a tone. */
static Tone tone_near(const TuningTarget* target) {
  const double angle = 2.0 * PI * target->tone.f0_hz / target->rate_hz;
  const double radius = exp(-1.0 / (target->rate_hz * target->tone.tau_s));
  const double complex wanted = complex_of(radius * cos(angle), radius * sin(angle));
  const size_t n = 2 * bridges_order(&strung);
  size_t best = 0;
  bridges_poles(&strung, poles);
  for (size_t i = 1; i < n; ++i) {
    best = cabs(poles[i] - wanted) < cabs(poles[best] - wanted) ? i : best;
  }
  return (Tone){carg(poles[best]) * target->rate_hz / (2.0 * PI),
                -1.0 / (log(cabs(poles[best])) * target->rate_hz)};
}

static double cents(double f_hz, double of_hz) {
  return 1200.0 * log2(f_hz / of_hz);
}

/* What a string alone on the bridge is off by; without the correction it is off by far more. */
static void string_on_the_bridge_has_its_pitch_and_decay(void** state) {
  (void)state;
  Random random = random_start();
  double worst_cents = 0.0;
  double worst_decay = 0.0;
  double worst_between = 0.0;
  double uncorrected = 0.0;
  int n_exact = 0;
  for (int i = 0; i < DRAWS; ++i) {
    const TuningTarget target = draw_target(&random);
    const uint32_t n_masses = draw_masses(&random, &target);
    const BridgeHold hold = draw_hold(&random, &target);
    const Bridge bridge = bridge_at(target.rate_hz);
    BridgeShift shift = {0};
    const TuningTarget own = bridge_correct(&bridge, target, n_masses, hold, &shift);
    strung = (Strung){.bridge = bridge};
    add_string(&own, n_masses, hold);
    const Tone tone = tone_near(&target);
    worst_cents = fmax(worst_cents, fabs(cents(tone.f0_hz, target.tone.f0_hz)));
    const double g = -expm1(-2.0 / (target.rate_hz * target.tone.tau_s));
    const double g_own = -expm1(-2.0 / (target.rate_hz * own.tone.tau_s));
    const double z0 = g_own * (1.0 - own.loss);
    assert_true(z0 > (0.5 * (1.0 - target.loss) - 1e-6) * g);
    if (z0 > (0.5 * (1.0 - target.loss) + 1e-6) * g) {
      worst_decay = fmax(worst_decay, fabs(tone.tau_s / target.tone.tau_s - 1.0));
      ++n_exact;
    } else {
      assert_true(tone.tau_s < target.tone.tau_s * 1.00001);
    }
    worst_between = fmax(worst_between, fabs(g_own * own.loss / g - target.loss));
    strung = (Strung){.bridge = bridge};
    add_string(&target, n_masses, hold);
    uncorrected = fmax(uncorrected, fabs(cents(tone_near(&target).f0_hz, target.tone.f0_hz)));
  }
  assert_true(n_exact > DRAWS / 3 && n_exact < DRAWS);
  assert_true(uncorrected > 0.5);
  assert_within("pitch [cents]", worst_cents, 1e-4);
  assert_within("decay", worst_decay, 1e-4);
  assert_within("dampers between the masses", worst_between, 1e-9);
}

/* The nearest of `n` poles. */
static double distance(double complex pole, const Modes* modes) {
  double least = HUGE_VAL;
  for (uint32_t k = 0; k < modes->n_modes; ++k) {
    for (int side = 0; side < 2; ++side) {
      least = fmin(least, cabs(modes->mode[k].pole[side] - pole));
    }
  }
  return least;
}

/* The strings as a network of springs and dampers, h = 1; the links to the bridge have a spring
   alone, and the last damper is at the wall. */
static Network* network_of(void) {
  Network* const network = network_new();
  uint32_t ground = 0;
  uint32_t bridge = 0;
  double spring = strung.bridge.bare.a;
  assert_non_null(network);
  network_add_ground(network, &ground);
  network_add_mass(network, 1.0, &bridge);
  network_add_damper(network, bridge, ground, strung.bridge.bare.g);
  for (uint32_t j = 0; j < strung.n_strings; ++j) {
    const StringCoefs c = strung.coefs[j];
    const BridgeTie* const tie = &strung.ties[j];
    uint32_t before = ground;
    for (uint32_t i = 0; i < strung.n_masses[j]; ++i) {
      uint32_t point = 0;
      network_add_mass(network, tie->weight, &point);
      network_add_spring(network, before, point, tie->weight * c.k1);
      network_add_damper(network, before, point, tie->weight * c.z1);
      network_add_damper(network, point, ground, tie->weight * c.z0);
      before = point;
    }
    network_add_spring(network, before, bridge, tie->weight * c.k1);
    network_add_damper(network, before, ground, tie->weight * c.z1);
    spring += tie->spring - tie->weight * c.k1;
  }
  network_add_spring(network, bridge, ground, spring);
  assert_int_equal(network_check(network, NULL), STATUS_OK);
  return network;
}

static void whole_has_the_poles_of_a_network(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < 20; ++i) {
    strung = (Strung){.bridge = bridge_at(8e3)};
    strung.bridge.bare.a *= 30.0; /* Or the strings' own pull would ask for a negative spring. */
    for (int j = 0; j < 3; ++j) {
      TuningTarget target = {
          8e3, {random_between(&random, 100.0, 900.0), 0.5}, 0.3, 0.0, PARTIALS_LUMPED};
      const uint32_t n_masses = 1 + random_below(&random, tuning_max_masses(&target, 12));
      add_string(&target, n_masses, (BridgeHold){random_between(&random, 0.001, 0.1), 1.0});
    }
    Network* const network = network_of();
    Modes* modes = NULL;
    assert_int_equal(modes_solve(network, 1.0, 0, &modes), STATUS_OK);
    bridges_poles(&strung, poles);
    assert_int_equal(modes->n_modes, bridges_order(&strung));
    for (size_t p = 0; p < 2 * bridges_order(&strung); ++p) {
      worst = fmax(worst, distance(poles[p], modes));
    }
    modes_free(modes);
    network_free(network);
  }
  assert_within("pole", worst, 1e-9);
}

static void strings_at_rest_leave_the_bridge_its_spring(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < DRAWS; ++i) {
    draw_strung(&random);
    bridges_forces(&strung, stiffness, damping, mass);
    const double spring = bridges_complement(bridges_order(&strung), stiffness);
    worst = fmax(worst, fabs(spring / strung.bridge.bare.a - 1.0));
  }
  assert_within("spring", worst, 1e-8);
}

static double load_of(void) {
  double load = 0.0;
  for (uint32_t j = 0; j < strung.n_strings; ++j) {
    load += strung.ties[j].load;
  }
  return load;
}

/* 4M − 2Z − K of the whole into `stiffness`. */
static double top_complement(void) {
  const size_t order = bridges_order(&strung);
  bridges_forces(&strung, stiffness, damping, mass);
  for (size_t i = 0; i < order * order; ++i) {
    stiffness[i] = -stiffness[i] - 2.0 * damping[i];
  }
  for (size_t i = 0; i < order; ++i) {
    stiffness[i + i * order] += 4.0 * mass[i];
  }
  return bridges_complement(order, stiffness);
}

static void headroom_is_what_is_left_of_the_limit(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < DRAWS; ++i) {
    draw_strung(&random);
    const double predicted = 4.0 * bridge_headroom(&strung.bridge, load_of());
    worst = fmax(worst, fabs(top_complement() - predicted));
  }
  assert_within("headroom", worst, 1e-9);
}

/* Make all strings so heavy that `share` of the limit is left, and see whether the whole grows. */
static double radius_at(double share) {
  const double room = 4.0 - strung.bridge.bare.a - 2.0 * strung.bridge.bare.g;
  const double factor = room * (1.0 - share) / load_of();
  double radius = 0.0;
  for (uint32_t j = 0; j < strung.n_strings; ++j) {
    BridgeTie* const tie = &strung.ties[j];
    tie->weight *= factor;
    tie->spring *= factor;
    tie->load *= factor;
  }
  bridges_poles(&strung, poles);
  for (size_t p = 0; p < 2 * bridges_order(&strung); ++p) {
    radius = fmax(radius, cabs(poles[p]));
  }
  return radius;
}

static void whole_is_stable_up_to_the_limit_and_not_beyond(void** state) {
  (void)state;
  Random random = random_start();
  for (int i = 0; i < DRAWS / 5; ++i) {
    draw_strung(&random);
    assert_true(radius_at(1e-3) <= 1.0 + 1e-9);
    assert_true(radius_at(-1e-3) > 1.0 + 1e-6);
  }
}

/* "60 Hz, half the critical damping; at rates below 960 Hz, a sixteenth of the rate", and "a
 * string's mass is 0.01/((1 + f0/110 Hz) (1 + (f0/1500 Hz)²)) of the bridge's". */
static void bridge_and_masses_are_as_printed(void** state) {
  (void)state;
  for (double rate_hz = 100.0; rate_hz < 1e6; rate_hz *= 1.7) {
    const double omega = 2.0 * PI * (rate_hz < 960.0 ? rate_hz / 16.0 : 60.0);
    const Pole printed = pole_from_analog(rate_hz, omega, omega);
    const Pole bare = bridge_at(rate_hz).bare;
    assert_true(fabs(bare.a / printed.a - 1.0) < 1e-12 && fabs(bare.g / printed.g - 1.0) < 1e-12);
  }
  for (double f0_hz = 20.0; f0_hz < 5000.0; f0_hz *= 1.3) {
    const double over = (1.0 + f0_hz / 110.0) * (1.0 + f0_hz * f0_hz / (1500.0 * 1500.0));
    assert_true(fabs(bridge_mass(f0_hz) * over / 0.01 - 1.0) < 1e-12);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(string_on_the_bridge_has_its_pitch_and_decay),
      cmocka_unit_test(whole_has_the_poles_of_a_network),
      cmocka_unit_test(strings_at_rest_leave_the_bridge_its_spring),
      cmocka_unit_test(headroom_is_what_is_left_of_the_limit),
      cmocka_unit_test(whole_is_stable_up_to_the_limit_and_not_beyond),
      cmocka_unit_test(bridge_and_masses_are_as_printed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
