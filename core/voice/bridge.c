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

/* The most that the modes of the body may move, over what the string does, in squares: where the
 * pole is wanted, and where it comes to.  Where a string is at one mode, twice their coupling is
 * then four fifths of what the mode dies faster by: they stay two poles at one pitch, and the
 * string's has a fifth of that. */
static const double MOST_SHARED = 0.16;
static const double MOST_SHARED_AT_LAST = 0.25;

/* The largest of |ε|/a_1, some 80 cents. */
static const double MOST_MOVED = 0.1;

/* Each round makes what is left of the error a small part of what it was, as the slopes are nearly
 * right; so one that has moved it but so far has been the last. */
static const double NEAR = 1e-7;
static const double NEAR_DAMPING = 1e-4;
enum { MOST_ROUNDS = 12 };

/* A pole, and what D is made of there. */
typedef struct {
  double radius;
  double complex z;
  double complex back;  /* 1/z */
  double complex base;  /* z − 2 + 1/z */
  double complex slope; /* 1 − 1/z */
} Place;

static Place place_of(double radius, double angle) {
  const double complex z = complex_of(radius * cos(angle), radius * sin(angle));
  const double complex back = complex_of(cos(angle) / radius, -sin(angle) / radius);
  return (Place){radius, z, back, z - 2.0 + back, 1.0 - back};
}

static double complex d_of(const Place* place, Pole pole) {
  return place->base + pole.a + pole.g * place->slope;
}

/* dD/dz */
static double complex d_slope(const Place* place, double g) {
  return 1.0 - (1.0 - g) * place->back * place->back;
}

/* S, dS/dz, and Σ 1/(M_i |D_i|²): how the modes move, in squares. */
typedef struct {
  double complex value;
  double complex slope;
  double square;
} Give;

static double square_of(double complex d) {
  return creal(d) * creal(d) + cimag(d) * cimag(d);
}

/* 1/d without the care for infinities that makes C's division slow. */
static double complex inverse(double complex d) {
  return conj(d) / square_of(d);
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

static Give give_at(const Bridge* bridge, const Place* place) {
  const Bank* const bank = &bridge->bank;
  Give sum = {0};
  for (uint32_t i = 0; i < bank->n_added; ++i) {
    const double complex one = inverse(d_of(place, (Pole){bank->a[i], bank->g[i]}));
    sum.value += bank->in[i] * one;
    sum.slope -= bank->in[i] * d_slope(place, bank->g[i]) * (one * one);
    sum.square += bank->in[i] * square_of(one);
  }
  return sum;
}

/* ε of a string's fundamental. */
typedef struct {
  double complex value;
  double complex slope; /* dε/dz, in which only the body counts: all else changes slowly */
  double complex by_a;  /* dε/da, where what holds the string's end goes with a */
  double shared;        /* How the body moves over the string, in squares */
  double lever;         /* That is left by BRIDGE_MOST_LOAD */
} Pull;

static Pull pull_of_bridge(const Bridge* bridge,
                           StringCoefs coefs,
                           uint32_t n_masses,
                           BridgeHold hold,
                           const Place* place,
                           const Give* give) {
  const Mode first = first_mode(coefs, n_masses);
  const Sums sums = sum_modes(coefs, n_masses, place);
  const BridgeTie tie = tie_of(bridge, &sums, coefs, n_masses, hold);
  const double strength = tie.weight * tie.pull * tie.pull;
  const double complex held = tie.spring - strength * sums.rest;
  const double complex loose = inverse(1.0 + give->value * held);
  const double complex value = strength * sums.first * give->value * loose;
  return (Pull){
      .value = value,
      .slope = strength * sums.first * give->slope * (loose * loose),
      .by_a = value * (1.0 + loose) / first.pole.a,
      .shared = strength * sums.first * give->square * square_of(loose),
      .lever = tie.pull / coefs.k1,
  };
}

/* Let the lever give way to where a string stays itself, and in tune, whatever mode it is at. */
static bool give_way(Pull* pull, double a, double most_shared, BridgeHold* hold) {
  const double over = fmax(pull->shared / most_shared, cabs(pull->value) / (MOST_MOVED * a));
  if (!(over > 1.0)) {
    return false;
  }
  hold->lever = pull->lever / sqrt(over);
  pull->value /= over;
  pull->slope /= over;
  pull->by_a /= over;
  return true;
}

/* The sound that is wanted of the two, and what was asked of the string alone for it. */
typedef struct {
  double angle;
  double wanted; /* Radius */
  double radius; /* What it comes to */
  double least;  /* g down to which the string may go */
} Wish;

/*
  A step of Newton's from one fundamental of the string's own to the next, of which ε makes what is
  wanted.  Where that leaves it too few dampers, g is the least, and the radius is what it comes to.
*/
static Pole next_pole(Wish* wish, const Place* place, const Pull* pull, Pole own) {
  const double complex share = inverse(1.0 - pull->by_a);
  const double complex left = share * (pull->value - place->base - own.a);
  const double complex turned = share * place->slope;
  const double g = cimag(left) / cimag(turned);
  if (wish->radius == wish->wanted && g >= wish->least) {
    return (Pole){.a = own.a + creal(left) - g * creal(turned), .g = g};
  }
  const double complex missing = left - wish->least * turned;
  const double complex rate = share * (pull->slope - d_slope(place, wish->least)) * place->z;
  const double change = fmax(-cimag(missing) / cimag(rate), -0.5);
  wish->radius = fmin(wish->radius * (1.0 + change), wish->wanted);
  return (Pole){.a = own.a + creal(missing + change * rate), .g = wish->least};
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

static Wish wish_of(const TuningTarget* target, double g) {
  const double radius = sqrt(1.0 - g);
  return (Wish){
      .angle = 2.0 * PI * target->tone.f0_hz / target->rate_hz,
      .wanted = radius,
      .radius = radius,
      .least = g * (target->loss + LEAST_GROUND * (1.0 - target->loss)),
  };
}

/* Whether a round has changed next to nothing. */
static bool is_near(Pole own, Pole before, double radius, double radius_before, double g) {
  return fabs(own.a - before.a) <= NEAR * own.a && fabs(own.g - before.g) <= NEAR_DAMPING * g &&
         fabs(radius - radius_before) <= NEAR_DAMPING * g;
}

TuningTarget bridge_correct(const Bridge* bridge,
                            TuningTarget target,
                            uint32_t n_masses,
                            BridgeHold* hold,
                            BridgeShift* shift) {
  const double g = -expm1(-2.0 / (target.tone.tau_s * target.rate_hz));
  if (!(hold->mass * hold->lever > 0.0) || bridge->bank.n_added == 0) {
    return target;
  }
  Wish wish = wish_of(&target, g);
  Place place = place_of(wish.radius, wish.angle);
  Give give = give_at(bridge, &place);
  Pole own = guess(&target, g, shift);
  for (int round = 0; round < MOST_ROUNDS; ++round) {
    const TuningTarget asked = ask(target, g, own);
    const Pole before = own;
    StringCoefs coefs = {0};
    if (tuning_fit(&asked, n_masses, &coefs)) {
      return target;
    }
    if (place.radius != wish.radius) {
      place = place_of(wish.radius, wish.angle);
      give = give_at(bridge, &place);
    }
    Pull pull = pull_of_bridge(bridge, coefs, n_masses, *hold, &place, &give);
    const bool is_less =
        give_way(&pull, own.a, round == 0 ? MOST_SHARED : MOST_SHARED_AT_LAST, hold);
    own = next_pole(&wish, &place, &pull, own);
    if (!pole_is_complex(own)) {
      return target;
    }
    if (!is_less && is_near(own, before, wish.radius, place.radius, g)) {
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
