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

/* The largest of |ε'/D_1'|, the share of its motion that is the body's, where the pole is wanted
 * and where it comes to.  Where a string is at one mode, twice their coupling is then four fifths
 * of what the mode dies faster by: they stay two poles at one pitch, and the string's has a fifth
 * of that. */
static const double MOST_SHARED = 0.16;
static const double MOST_SHARED_AT_LAST = 0.25;

/* The largest of |ε|/a_1, some 80 cents. */
static const double MOST_MOVED = 0.1;

/* Each round makes what is left of the error smaller by the share that the bridge has in the sound,
 * 1 in 1000 of the pitch where no mode is near; so one that has moved it but so far has been the
 * last. */
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

/* A function of z at a place. */
typedef struct {
  double complex value;
  double complex slope; /* Its derivative */
} Local;

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

/* S */
static Local give_at(const Bridge* bridge, const Place* place) {
  const Bank* const bank = &bridge->bank;
  Local sum = {0};
  for (uint32_t i = 0; i < bank->n_added; ++i) {
    const double complex one = inverse(d_of(place, (Pole){bank->a[i], bank->g[i]}));
    sum.value += bank->in[i] * one;
    sum.slope -= bank->in[i] * d_slope(place, bank->g[i]) * (one * one);
  }
  return sum;
}

/* ε of a string's fundamental, in whose slope only the body counts: all else changes slowly. */
static Local pull_of_bridge(const Bridge* bridge,
                            StringCoefs coefs,
                            uint32_t n_masses,
                            BridgeHold hold,
                            const Place* place,
                            const Local* give) {
  const Sums sums = sum_modes(coefs, n_masses, place);
  const BridgeTie tie = tie_of(bridge, &sums, coefs, n_masses, hold);
  const double strength = tie.weight * tie.pull * tie.pull;
  const double complex loose =
      inverse(1.0 + give->value * (tie.spring - strength * sums.rest)); /* Over S */
  return (Local){strength * sums.first * give->value * loose,
                 strength * sums.first * give->slope * (loose * loose)};
}

/* What a string may keep of its pull and stay itself, and in tune, whatever mode it is at. */
static double kept_of(const Local* pull, const Place* place, Pole own, double most_shared) {
  const double shared = cabs(pull->slope) / (most_shared * cabs(d_slope(place, own.g)));
  const double moved = cabs(pull->value) / (MOST_MOVED * own.a);
  return 1.0 / fmax(1.0, fmax(shared, moved));
}

/* The sound that is wanted of the two, and what was asked of the string alone for it. */
typedef struct {
  double angle;
  double wanted; /* Radius */
  double radius; /* What it comes to */
  double least;  /* g down to which the string may go */
} Wish;

/*
  The string's own fundamental, of which ε makes what is wanted: where that leaves it too few
  dampers, g is the least, and the radius is what it comes to, by a step of Newton's.
*/
static Pole own_pole(Wish* wish, const Place* place, const Local* pull) {
  const double complex left = pull->value - place->base;
  Pole own = {.g = cimag(left) / cimag(place->slope)};
  if (wish->radius == wish->wanted && own.g >= wish->least) {
    own.a = creal(left) - own.g * creal(place->slope);
    return own;
  }
  own.g = wish->least;
  const double complex missing = left - own.g * place->slope;
  const double complex rate = (pull->slope - d_slope(place, own.g)) * place->z;
  const double change = -cimag(missing) / cimag(rate);
  wish->radius = fmin(wish->radius * (1.0 + change), wish->wanted);
  own.a = creal(missing + change * rate);
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
                            BridgeHold* hold,
                            BridgeShift* shift) {
  const double step_s = 1.0 / target.rate_hz;
  const double g = -expm1(-2.0 * step_s / target.tone.tau_s);
  const double wanted = sqrt(1.0 - g);
  Wish wish = {
      .angle = 2.0 * PI * target.tone.f0_hz * step_s,
      .wanted = wanted,
      .radius = wanted,
      .least = g * (target.loss + LEAST_GROUND * (1.0 - target.loss)),
  };
  if (!(hold->mass * hold->lever > 0.0) || bridge->bank.n_added == 0) {
    return target;
  }
  Place place = place_of(wish.radius, wish.angle);
  Local give = give_at(bridge, &place);
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
    Local pull = pull_of_bridge(bridge, coefs, n_masses, *hold, &place, &give);
    const double kept = kept_of(&pull, &place, own, round == 0 ? MOST_SHARED : MOST_SHARED_AT_LAST);
    pull = (Local){kept * pull.value, kept * pull.slope};
    hold->lever *= sqrt(kept);
    own = own_pole(&wish, &place, &pull);
    if (!pole_is_complex(own)) {
      return target;
    }
    if (fabs(own.a - before.a) <= NEAR * own.a && fabs(own.g - before.g) <= NEAR_DAMPING * g &&
        fabs(wish.radius - place.radius) <= NEAR_DAMPING * g) {
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
