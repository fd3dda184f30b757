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

enum { DRAWS = 400, MOST_ORDER = BRIDGES_MOST_ORDER };

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
  strung.ties[j] = bridge_tie(&strung.bridge, strung.coefs[j], n_masses, hold);
}

static void draw_string(Random* random, double rate_hz) {
  TuningTarget target = draw_target(random);
  target.tone.f0_hz = fmin(target.tone.f0_hz, rate_hz / 6.0);
  target.rate_hz = rate_hz;
  add_string(&target, draw_masses(random, &target), draw_hold(random, &target));
}

static void draw_strings(Random* random, double rate_hz, uint32_t n_strings) {
  strung.n_strings = 0;
  while (strung.n_strings < n_strings) {
    draw_string(random, rate_hz);
  }
}

static void draw_strung(Random* random) {
  const double rate_hz = random_below(random, 2) ? 8e3 : 48e3;
  bridges_draw(random, rate_hz, &strung.bridge);
  draw_strings(random, rate_hz, 1 + random_below(random, BRIDGES_STRINGS));
}

/* On a body of 1 to `n_modes`. */
static void draw_body(Random* random, double rate_hz, uint32_t n_modes) {
  const Body body = bridges_body(random, 1 + random_below(random, n_modes), rate_hz);
  bridge_init_on(&strung.bridge, &body, (BodyShape){1.0, 1.0}, rate_hz);
}

static double cents(double f_hz, double of_hz) {
  return 1200.0 * log2(f_hz / of_hz);
}

/* What one pole is off by. */
typedef struct {
  double cents;
  double decay; /* Of τ, relative */
} Off;

static Off off_by(double complex pole, const TuningTarget* target) {
  const double f_hz = carg(pole) * target->rate_hz / (2.0 * PI);
  const double tau_s = -1.0 / (log(cabs(pole)) * target->rate_hz);
  return (Off){fabs(cents(f_hz, target->tone.f0_hz)), tau_s / target->tone.tau_s - 1.0};
}

/* Where the whole is to have a pole it has one: of all that live no longer than is wanted, the one
 * whose pitch is off by least; and where `is_exact`, the nearest to both. */
static Off nearest(const TuningTarget* target, bool is_exact) {
  const size_t n = 2 * bridges_order(&strung);
  Off best = {HUGE_VAL, HUGE_VAL};
  double least = HUGE_VAL;
  bridges_poles(&strung, poles);
  for (size_t i = 0; i < n; ++i) {
    if (cimag(poles[i]) > 0.0) {
      const Off off = off_by(poles[i], target);
      const double distance = off.cents + (is_exact ? 1e3 * fabs(off.decay) : 0.0);
      if (distance < least && off.decay < 1e-5) {
        best = off;
        least = distance;
      }
    }
  }
  return best;
}

/* The worst of many strings. */
typedef struct {
  double cents;
  double decay;    /* Of those that lose no more than they may */
  double between;  /* What is lost between the masses, over all */
  double asked;    /* What was asked of the string, from what is wanted of both [cents] */
  int n_exact;     /* Those that lose no more than they may */
  int n_shortened; /* Those whose lever is shorter than it was to be */
} Worst;

/* One string, alone on the bridge that there is. */
static void
try_string(const TuningTarget* target, uint32_t n_masses, BridgeHold hold, Worst* worst) {
  BridgeHold kept = hold;
  BridgeShift shift = {0};
  const TuningTarget own = bridge_correct(&strung.bridge, *target, n_masses, &kept, &shift);
  const double g = -expm1(-2.0 / (target->rate_hz * target->tone.tau_s));
  const double g_own = -expm1(-2.0 / (target->rate_hz * own.tone.tau_s));
  const double least = 0.5 * (1.0 - target->loss);
  const bool is_exact = g_own * (1.0 - own.loss) > (least + 1e-6) * g;
  assert_true(g_own * (1.0 - own.loss) > (least - 1e-6) * g);
  assert_true(kept.mass == hold.mass && kept.lever > 0.0 && kept.lever <= hold.lever);
  strung.n_strings = 0;
  add_string(&own, n_masses, kept);
  const Off off = nearest(target, is_exact);
  worst->cents = fmax(worst->cents, off.cents);
  worst->decay = is_exact ? fmax(worst->decay, fabs(off.decay)) : worst->decay;
  worst->between = fmax(worst->between, fabs(g_own * own.loss / g - target->loss));
  worst->asked = fmax(worst->asked, fabs(cents(own.tone.f0_hz, target->tone.f0_hz)));
  worst->n_exact += is_exact;
  worst->n_shortened += kept.lever < hold.lever;
}

static void assert_tuned(const Worst* worst) {
  print_message("  %d decay as they are to, %d have a shorter lever\n", worst->n_exact,
                worst->n_shortened);
  assert_within("pitch [cents]", worst->cents, 1e-5);
  assert_within("decay", worst->decay, 1e-5);
  assert_within("dampers between the masses", worst->between, 1e-9);
  assert_within("asked of the string [cents]", worst->asked, 100.0);
}

/* What a string alone on one mass is off by; without the correction it is off by far more. */
static void string_on_the_bridge_has_its_pitch_and_decay(void** state) {
  (void)state;
  Random random = random_start();
  Worst worst = {0};
  double uncorrected = 0.0;
  for (int i = 0; i < DRAWS; ++i) {
    const TuningTarget target = draw_target(&random);
    const uint32_t n_masses = draw_masses(&random, &target);
    const BridgeHold hold = draw_hold(&random, &target);
    bridge_init(&strung.bridge, target.rate_hz);
    try_string(&target, n_masses, hold, &worst);
    strung.n_strings = 0;
    add_string(&target, n_masses, hold);
    uncorrected = fmax(uncorrected, nearest(&target, false).cents);
  }
  assert_true(worst.n_exact > DRAWS / 3 && worst.n_exact < DRAWS);
  assert_true(uncorrected > 0.5);
  assert_int_equal(worst.n_shortened, 0);
  assert_tuned(&worst);
}

static void string_on_a_body_has_its_pitch_and_decay(void** state) {
  (void)state;
  Random random = random_start();
  Worst worst = {0};
  for (int i = 0; i < DRAWS; ++i) {
    const TuningTarget target = draw_target(&random);
    draw_body(&random, target.rate_hz, BRIDGES_MODES);
    try_string(&target, draw_masses(&random, &target), draw_hold(&random, &target), &worst);
  }
  assert_true(worst.n_exact > DRAWS / 8 && worst.n_exact < DRAWS);
  assert_true(worst.n_shortened > 0 && worst.n_shortened < DRAWS / 2);
  assert_tuned(&worst);
}

/* Right at a mode, or within a few cents of it. */
static void string_at_a_mode_has_its_pitch(void** state) {
  (void)state;
  Random random = random_start();
  Worst worst = {0};
  for (int i = 0; i < DRAWS; ++i) {
    TuningTarget target = draw_target(&random);
    const Body body =
        bridges_body(&random, 1 + random_below(&random, BRIDGES_MODES), target.rate_hz);
    const double mode_hz = body.modes[random_below(&random, body.n_modes)].f0_hz;
    const double off = i % 2 ? 0.0 : random_between(&random, -50.0, 50.0);
    target.tone.f0_hz = fmin(mode_hz * exp2(off / 1200.0), target.rate_hz / 6.0);
    bridge_init_on(&strung.bridge, &body, (BodyShape){1.0, 1.0}, target.rate_hz);
    try_string(&target, draw_masses(&random, &target), draw_hold(&random, &target), &worst);
  }
  assert_true(worst.n_shortened > DRAWS / 3);
  assert_tuned(&worst);
}

/* How many poles are near a string that is held at the pitch of a mode without asking, and how far
 * off. */
static uint32_t n_near(double lever, double* most_cents) {
  const TuningTarget target = {48e3, {196.0, 4.0}, 0.2, 0.0, PARTIALS_TRUEST};
  const Body body = {.n_modes = 1, .modes = {{196.0, 40.0, 0.3, {0.0}}}};
  uint32_t n_near = 0;
  bridge_init_on(&strung.bridge, &body, (BodyShape){1.0, 1.0}, 48e3);
  strung.n_strings = 0;
  add_string(&target, 20, (BridgeHold){bridge_mass(196.0), lever});
  bridges_poles(&strung, poles);
  *most_cents = 0.0;
  for (size_t i = 0; i < 2 * bridges_order(&strung); ++i) {
    const double off = off_by(poles[i], &target).cents;
    if (cimag(poles[i]) > 0.0 && off < 100.0) {
      *most_cents = fmax(*most_cents, off);
      ++n_near;
    }
  }
  return n_near;
}

/* What the lever is kept from: two poles to both sides of the pitch, which beat; and with as much
 * as it may have, two that do not. */
static void wolf_is_two_poles(void** state) {
  (void)state;
  const TuningTarget target = {48e3, {196.0, 4.0}, 0.2, 0.0, PARTIALS_TRUEST};
  BridgeHold hold = {bridge_mass(196.0), 1.0};
  BridgeShift shift = {0};
  double off = 0.0;
  assert_int_equal(n_near(1.0, &off), 2);
  print_message("  two poles %.1f cents off", off);
  assert_true(off > 20.0 && off < 60.0);
  (void)bridge_correct(&strung.bridge, target, 20, &hold, &shift);
  assert_int_equal(n_near(hold.lever, &off), 2);
  print_message(", with a lever of %.3f %.2f\n", hold.lever, off);
  assert_true(hold.lever > 0.1 && hold.lever < 0.9 && off < 2.0);
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

/* The strings as a network of springs and dampers, h = 1; the links to the bridge, and what a lever
 * takes of them to the ground, have a spring
   alone, and the last damper is at the wall. */
static Network* network_of(void) {
  Network* const network = network_new();
  uint32_t ground = 0;
  uint32_t bridge = 0;
  double spring = strung.bridge.bank.a[0];
  assert_non_null(network);
  network_add_ground(network, &ground);
  network_add_mass(network, 1.0, &bridge);
  network_add_damper(network, bridge, ground, strung.bridge.bank.g[0]);
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
    network_add_spring(network, before, bridge, tie->weight * tie->pull);
    network_add_spring(network, before, ground, tie->weight * (c.k1 - tie->pull));
    network_add_damper(network, before, ground, tie->weight * c.z1);
    spring += tie->spring - tie->weight * tie->pull;
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
    strung.n_strings = 0;
    bridge_init(&strung.bridge, 8e3);
    strung.bridge.bank.a[0] *= 60.0; /* Or the strings' own pull would ask for a negative spring. */
    for (int j = 0; j < 3; ++j) {
      TuningTarget target = {
          8e3, {random_between(&random, 100.0, 900.0), 0.5}, 0.3, 0.0, PARTIALS_LUMPED};
      const uint32_t n_masses = 1 + random_below(&random, tuning_max_masses(&target, 12));
      add_string(
          &target, n_masses,
          (BridgeHold){random_between(&random, 0.001, 0.1), random_between(&random, 0.5, 1.0)});
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

/* What is left of the springs once the strings are where the body holds them is what the body has
 * without: each mode its own, and none between them. */
static void strings_at_rest_leave_the_body_its_springs(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < DRAWS; ++i) {
    draw_strung(&random);
    const Bank* const bank = &strung.bridge.bank;
    const size_t order = bridges_order(&strung);
    const size_t first = order - bank->n_added;
    bridges_forces(&strung, stiffness, damping, mass);
    assert_true(bridges_eliminate(order, bank->n_added, stiffness));
    for (size_t k = first; k < order; ++k) {
      for (size_t j = first; j < order; ++j) {
        const double own = mass[k] * bank->a[k - first];
        const double left = stiffness[k + j * order] - (k == j ? own : 0.0);
        worst = fmax(worst, fabs(left) / own);
      }
    }
  }
  assert_within("springs", worst, 1e-8);
}

static double load_of(void) {
  double load = 0.0;
  for (uint32_t j = 0; j < strung.n_strings; ++j) {
    load += strung.ties[j].load;
  }
  return load;
}

/* det(4M − 2Z − K) of the whole, over that of its parts alone: what the strings leave of the
 * body's. */
static double share_left(void) {
  const Bank* const bank = &strung.bridge.bank;
  const size_t order = bridges_order(&strung);
  const size_t first = order - bank->n_added;
  double share = 1.0;
  bridges_forces(&strung, stiffness, damping, mass);
  bridges_top(order, stiffness, damping, mass);
  assert_true(bridges_eliminate(order, 1, stiffness));
  for (size_t k = first; k < order; ++k) {
    share *= stiffness[k + k * order] /
             (mass[k] * (4.0 - bank->a[k - first] - 2.0 * bank->g[k - first]));
  }
  return share;
}

static void headroom_is_what_is_left_of_the_limit(void** state) {
  (void)state;
  Random random = random_start();
  double worst = 0.0;
  for (int i = 0; i < DRAWS; ++i) {
    draw_strung(&random);
    worst = fmax(worst, fabs(share_left() - bridge_headroom(&strung.bridge, load_of())));
  }
  assert_within("headroom", worst, 1e-9);
}

/* Make all strings so heavy that `share` of the limit is left, and see whether the whole grows. */
static double radius_at(double share) {
  const double taken = 1.0 - bridge_headroom(&strung.bridge, load_of());
  const double factor = (1.0 - share) / taken;
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
  double below = 0.0;
  double above = HUGE_VAL;
  for (int i = 0; i < DRAWS; ++i) {
    const double rate_hz = random_below(&random, 2) ? 8e3 : 48e3;
    draw_body(&random, rate_hz, 12);
    draw_strings(&random, rate_hz, 1 + random_below(&random, 3));
    below = fmax(below, radius_at(1e-3));
    above = fmin(above, radius_at(-1e-3));
  }
  print_message("  largest radius below %g, least above %g, from 1\n", below - 1.0, above - 1.0);
  assert_true(below <= 1.0 + 1e-9);
  assert_true(above > 1.0 + 1e-6);
}

static double nearest_cents(double complex pole, size_t n) {
  double least = HUGE_VAL;
  for (size_t i = 0; i < n; ++i) {
    if (cimag(poles[i]) > 0.0) {
      least = fmin(least, fabs(cents(carg(poles[i]), carg(pole))));
    }
  }
  return least;
}

static int by_size(const void* a, const void* b) {
  const double x = *(const double*)a;
  const double y = *(const double*)b;
  return (x > y) - (x < y);
}

/* How far the modes of a body like a guitar's are from where they are without strings, in cents:
 * the one in the middle, and nine in ten. */
static void move_modes(Random* random, double lever, bool has_springs, double off[2]) {
  enum { N_BODIES = 20, N_MODES = 10 };
  static double all[N_BODIES * N_MODES];
  for (int i = 0; i < N_BODIES; ++i) {
    Body body = {.n_modes = N_MODES};
    double f0_hz = 90.0;
    for (uint32_t k = 0; k < N_MODES; ++k) {
      f0_hz *= random_between(random, 1.1, 1.5);
      body.modes[k] = (BodyMode){
          f0_hz, random_between(random, 15.0, 40.0), random_between(random, 0.1, 0.5), {0.0}};
    }
    bridge_init_on(&strung.bridge, &body, (BodyShape){1.0, 1.0}, 48e3);
    const Bank* const bank = &strung.bridge.bank;
    strung.n_strings = 0;
    for (int j = 0; j < BRIDGES_STRINGS; ++j) {
      const double f_hz = random_log_between(random, 80.0, 700.0);
      const TuningTarget target = {48e3, {f_hz, 2.0}, 0.1, 0.0, PARTIALS_TRUEST};
      add_string(&target, 24, (BridgeHold){bridge_mass(f_hz), lever});
      strung.ties[j].spring *= has_springs;
    }
    bridges_poles(&strung, poles);
    for (uint32_t k = 0; k < N_MODES; ++k) {
      double complex alone[2];
      oracle_mass_poles(bank->a[k], bank->g[k], alone);
      all[i * N_MODES + (int)k] =
          nearest_cents(cimag(alone[0]) > 0.0 ? alone[0] : alone[1], 2 * bridges_order(&strung));
    }
  }
  qsort(all, N_BODIES * N_MODES, sizeof(double), by_size);
  off[0] = all[N_BODIES * N_MODES / 2];
  off[1] = all[N_BODIES * N_MODES * 9 / 10];
}

/* With four strings that are tied as half the resonance ties them; without what a taut string is
 * taken for, they would be elsewhere. */
static void modes_of_a_body_stay_put(void** state) {
  (void)state;
  Random random = random_start();
  double off[2];
  double without[2];
  move_modes(&random, 0.25, true, off);
  move_modes(&random, 0.25, false, without);
  print_message("  half of them within %.2f cents, nine in ten %.1f; without springs %.1f, %.1f\n",
                off[0], off[1], without[0], without[1]);
  assert_true(off[0] < 2.0 && off[1] < 15.0);
  assert_true(without[0] > 4.0 * off[0]);
}

/* "60 Hz, half the critical damping; at rates below 960 Hz, a sixteenth of the rate", and "a
 * string's mass is 0.01/((1 + f0/110 Hz) (1 + (f0/1500 Hz)²)) kg". */
static void bridge_and_masses_are_as_printed(void** state) {
  (void)state;
  for (double rate_hz = 100.0; rate_hz < 1e6; rate_hz *= 1.7) {
    const double omega = 2.0 * PI * (rate_hz < 960.0 ? rate_hz / 16.0 : 60.0);
    const Pole printed = pole_from_analog(rate_hz, omega, omega);
    const Bank* const bank = &strung.bridge.bank;
    bridge_init(&strung.bridge, rate_hz);
    assert_int_equal(bank->n_added, 1);
    assert_true(fabs(bank->a[0] / printed.a - 1.0) < 1e-12);
    assert_true(fabs(bank->g[0] / printed.g - 1.0) < 1e-12 && bank->in[0] == 1.0);
  }
  for (double f0_hz = 20.0; f0_hz < 5000.0; f0_hz *= 1.3) {
    const double over = (1.0 + f0_hz / 110.0) * (1.0 + f0_hz * f0_hz / (1500.0 * 1500.0));
    assert_true(fabs(bridge_mass(f0_hz) * over / 0.01 - 1.0) < 1e-12);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(string_on_the_bridge_has_its_pitch_and_decay),
      cmocka_unit_test(string_on_a_body_has_its_pitch_and_decay),
      cmocka_unit_test(string_at_a_mode_has_its_pitch),
      cmocka_unit_test(wolf_is_two_poles),
      cmocka_unit_test(whole_has_the_poles_of_a_network),
      cmocka_unit_test(strings_at_rest_leave_the_body_its_springs),
      cmocka_unit_test(headroom_is_what_is_left_of_the_limit),
      cmocka_unit_test(whole_is_stable_up_to_the_limit_and_not_beyond),
      cmocka_unit_test(modes_of_a_body_stay_put),
      cmocka_unit_test(bridge_and_masses_are_as_printed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
