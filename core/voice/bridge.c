#include "core/voice/bridge.h"

#include "core/base/complex_of.h"
#include "core/base/maths.h"

#include <complex.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

static const double BRIDGE_HZ = 60.0;
static const double BRIDGE_ZETA = 0.5;

/* Of the rate: where symplectic Euler still makes of a bridge what it is meant to be. */
static const double MOST_BRIDGE_ANGLE = 2.0 * PI / 16.0;

static const double MOST_MASS = 0.01;
static const double MASS_HALVED_HZ = 110.0;
static const double MASS_HALVED_AGAIN_HZ = 1500.0;

/* The share of a string's dampers to the ground that stays, whatever the bridge takes. */
static const double LEAST_GROUND = 0.5;

/* Each round makes what is left of the error smaller by the share that the bridge has in the sound,
 * 1 in 1000 of the pitch; so one that has moved it but so far has been the last. */
static const double NEAR = 1e-7;
static const double NEAR_DAMPING = 1e-4;
enum { MOST_ROUNDS = 5 };

/* A pole, and what D is made of there. */
typedef struct {
  double complex base;  /* z − 2 + 1/z */
  double complex slope; /* 1 − 1/z */
} Place;

static Place place_of(double radius, double angle) {
  const double complex z = complex_of(radius * cos(angle), radius * sin(angle));
  const double complex back = complex_of(cos(angle) / radius, -sin(angle) / radius);
  return (Place){z - 2.0 + back, 1.0 - back};
}

static double complex d_of(const Place* place, Pole pole) {
  return place->base + pole.a + pole.g * place->slope;
}

/* 1/d without the care for infinities that makes C's division slow. */
static double complex inverse(double complex d) {
  return conj(d) / (creal(d) * creal(d) + cimag(d) * cimag(d));
}

/* The modes of a string one by one: sin² of half an angle that turns by π/(N + 1) for each. */
typedef struct {
  double half_sin, half_cos;
  double turn_sin, turn_cos;
  double share; /* 2/(N + 1) */
  Pole pole;
  double square; /* φ² at the last mass */
} Mode;

static void next_mode(Mode* mode, StringCoefs c) {
  const double s = mode->half_sin * mode->turn_cos + mode->half_cos * mode->turn_sin;
  mode->half_cos = mode->half_cos * mode->turn_cos - mode->half_sin * mode->turn_sin;
  mode->half_sin = s;
  const double lambda = 4.0 * s * s;
  mode->pole =
      (Pole){.a = ((c.k3 * lambda + c.k2) * lambda + c.k1) * lambda, .g = c.z0 + c.z1 * lambda};
  mode->square = mode->share * lambda * mode->half_cos * mode->half_cos;
}

static Mode first_mode(StringCoefs coefs, uint32_t n_masses) {
  const double half = 0.5 * PI / (n_masses + 1.0);
  Mode mode = {.half_cos = 1.0,
               .turn_sin = sin(half),
               .turn_cos = cos(half),
               .share = 2.0 / (n_masses + 1.0)};
  next_mode(&mode, coefs);
  return mode;
}

/* Sums over the modes of a string. */
typedef struct {
  double first;        /* φ_1² */
  double slow;         /* eᵀK⁻¹e */
  double fast;         /* eᵀ(4 − 2Z − K)⁻¹e */
  double complex rest; /* Σ_{k ≥ 2} φ_k²/D_k(z) */
} Sums;

/* `rest` only where there is a place. */
static Sums sum_modes(StringCoefs coefs, uint32_t n_masses, const Place* place) {
  Mode mode = first_mode(coefs, n_masses);
  Sums sums = {.first = mode.square};
  for (uint32_t k = 1;; ++k) {
    sums.slow += mode.square / mode.pole.a;
    sums.fast += mode.square / (4.0 - 2.0 * mode.pole.g - mode.pole.a);
    if (k == n_masses) {
      return sums;
    }
    next_mode(&mode, coefs);
    if (place) {
      sums.rest += mode.square * inverse(d_of(place, mode.pole));
    }
  }
}

static BridgeTie tie_of(
    const Bridge* bridge, const Sums* sums, StringCoefs coefs, uint32_t n_masses, BridgeHold hold) {
  const double weight = hold.mass / (n_masses + 1.0);
  const double pull = hold.lever * coefs.k1;
  const double strength = weight * pull * pull;
  const double load = strength * (sums->slow + sums->fast);
  const double kept = fmin(1.0, BRIDGE_MOST_LOAD / (load * bridge->give));
  return (BridgeTie){
      .weight = weight,
      .pull = sqrt(kept) * pull,
      .spring = kept * strength * sums->slow,
      .load = kept * load,
  };
}

/* 1/S(z), how stiff the bridge is there. */
static double complex stiffness_at(const Bridge* bridge, const Place* place) {
  const Bank* const bank = &bridge->bank;
  double complex sum = 0.0;
  for (uint32_t i = 0; i < bank->n_added; ++i) {
    sum += bank->in[i] * inverse(d_of(place, (Pole){bank->a[i], bank->g[i]}));
  }
  return inverse(sum);
}

/* ε of a string's fundamental. */
static double complex pull_of_bridge(const Bridge* bridge,
                                     StringCoefs coefs,
                                     uint32_t n_masses,
                                     BridgeHold hold,
                                     const Place* place) {
  const Sums sums = sum_modes(coefs, n_masses, place);
  const BridgeTie tie = tie_of(bridge, &sums, coefs, n_masses, hold);
  const double strength = tie.weight * tie.pull * tie.pull;
  const double complex bare = stiffness_at(bridge, place);
  return strength * sums.first * inverse(bare + tie.spring - strength * sums.rest);
}

/* The sound that is wanted of the two, and what was asked of the string alone for it. */
typedef struct {
  double angle;
  double radius;
  double least;  /* g down to which the string may go */
  bool is_short; /* Whether the bridge takes more than that */
} Wish;

/*
  The string's own fundamental, of which ε makes what is wanted: where that leaves it too few
  dampers, g is the least, and the radius is what it comes to, r² − r Im ε/sin θ − (1 − g) = 0.
*/
static Pole own_pole(Wish* wish, double complex pull) {
  Place place = place_of(wish->radius, wish->angle);
  Pole own = {.g = cimag(pull - place.base) / cimag(place.slope)};
  wish->is_short = wish->is_short || own.g < wish->least;
  if (wish->is_short) {
    const double extra = cimag(pull) / sin(wish->angle);
    own.g = wish->least;
    wish->radius = 0.5 * (extra + sqrt(extra * extra + 4.0 * (1.0 - own.g)));
    place = place_of(wish->radius, wish->angle);
  }
  own.a = creal(pull - place.base) - own.g * creal(place.slope);
  return own;
}

/* Its modes are there. */
static void settle(Bridge* bridge) {
  const Bank* const bank = &bridge->bank;
  bridge->y = 0.0;
  bridge->is_leaving = false;
  bridge->give = 0.0;
  for (uint32_t i = 0; i < bank->n_added; ++i) {
    bridge->give += bank->in[i] / (4.0 - 2.0 * bank->g[i] - bank->a[i]);
  }
}

void bridge_init(Bridge* bridge, double rate_hz) {
  const double angle = fmin(2.0 * PI * BRIDGE_HZ / rate_hz, MOST_BRIDGE_ANGLE);
  bank_clear(&bridge->bank);
  bank_add(&bridge->bank,
           (BankMode){.pole = {.a = angle * angle, .g = 2.0 * BRIDGE_ZETA * angle}, .in = 1.0});
  settle(bridge);
}

void bridge_init_on(Bridge* bridge, const Body* body, BodyShape shape, double rate_hz) {
  body_bank(body, shape, rate_hz, &bridge->bank);
  settle(bridge);
}

void bridge_rest(Bridge* bridge) {
  bank_rest(&bridge->bank);
  bridge->y = 0.0;
}

double bridge_mass(double f0_hz) {
  const double high = f0_hz / MASS_HALVED_AGAIN_HZ;
  return MOST_MASS / ((1.0 + f0_hz / MASS_HALVED_HZ) * (1.0 + high * high));
}

BridgeTie bridge_tie(const Bridge* bridge, StringCoefs coefs, uint32_t n_masses, BridgeHold hold) {
  const Sums sums = sum_modes(coefs, n_masses, NULL);
  return tie_of(bridge, &sums, coefs, n_masses, hold);
}

double bridge_headroom(const Bridge* bridge, double load) {
  return 1.0 - bridge->give * load;
}

/* What to ask of the string for its fundamental to have a pole; what sits between the masses stays.
 */
static TuningTarget ask(TuningTarget target, double g, Pole own) {
  const double between = target.loss * g;
  target.tone = pole_tone(target.rate_hz, own);
  target.loss = own.g > 0.0 ? fmin(between / own.g, 1.0) : target.loss;
  return target;
}

static Pole guess(const TuningTarget* target, double g, const BridgeShift* shift) {
  const bool is_known = shift->pitch > 0.0;
  const double own_g = is_known ? g * fmin(shift->damping, 1.0) : g;
  const double angle = 2.0 * PI * target->tone.f0_hz / target->rate_hz;
  const double turn = is_known ? fmin(angle * shift->pitch, 0.999 * PI) : angle;
  return (Pole){.a = 2.0 - own_g - 2.0 * sqrt(1.0 - own_g) * cos(turn), .g = own_g};
}

TuningTarget bridge_correct(const Bridge* bridge,
                            TuningTarget target,
                            uint32_t n_masses,
                            BridgeHold hold,
                            BridgeShift* shift) {
  const double step_s = 1.0 / target.rate_hz;
  const double g = -expm1(-2.0 * step_s / target.tone.tau_s);
  Wish wish = {
      .angle = 2.0 * PI * target.tone.f0_hz * step_s,
      .radius = sqrt(1.0 - g),
      .least = g * (target.loss + LEAST_GROUND * (1.0 - target.loss)),
  };
  if (!(hold.mass * hold.lever > 0.0) || bridge->bank.n_added == 0) {
    return target;
  }
  Pole own = guess(&target, g, shift);
  for (int round = 0; round < MOST_ROUNDS; ++round) {
    const TuningTarget asked = ask(target, g, own);
    const Pole before = own;
    StringCoefs coefs = {0};
    if (tuning_fit(&asked, n_masses, &coefs)) {
      return target;
    }
    const Place place = place_of(wish.radius, wish.angle);
    own = own_pole(&wish, pull_of_bridge(bridge, coefs, n_masses, hold, &place));
    if (!pole_is_complex(own)) {
      return target;
    }
    if (fabs(own.a - before.a) <= NEAR * own.a && fabs(own.g - before.g) <= NEAR_DAMPING * g) {
      break;
    }
  }
  const TuningTarget asked = ask(target, g, own);
  *shift = (BridgeShift){asked.tone.f0_hz / target.tone.f0_hz, g > 0.0 ? own.g / g : 1.0};
  return asked;
}

void bridge_step(Bridge* bridge, double force, double spring) {
  bridge->y = bank_push(&bridge->bank, force - spring * bridge->y);
}
