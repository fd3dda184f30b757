#include "core/bridge.h"

#include "core/complex_of.h"

#include <complex.h>
#include <math.h>
#include <stdbool.h>

static const double PI = 3.14159265358979323846;

static const double BRIDGE_HZ = 60.0;
static const double BRIDGE_ZETA = 0.5;

/* Of the rate: where symplectic Euler still makes of a bridge what it is meant to be. */
static const double MOST_BRIDGE_ANGLE = 2.0 * 3.14159265358979323846 / 16.0;

static const double MOST_MASS = 0.01;
static const double MASS_HALVED_HZ = 110.0;

/* The share of a string's dampers to the ground that stays, whatever the bridge takes. */
static const double LEAST_GROUND = 0.5;

/* Each takes what is left of the error by the share that the bridge has in the pitch, 1 in 1000. */
enum { ROUNDS = 4 };

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

/* ε of a string's fundamental. */
static double complex pull_of_bridge(const Bridge* bridge,
                                     StringCoefs coefs,
                                     uint32_t n_masses,
                                     BridgeHold hold,
                                     const Place* place) {
  const BridgeTie tie = bridge_tie(coefs, n_masses, hold);
  const double strength = tie.weight * tie.pull * tie.pull;
  Mode mode = first_mode(coefs, n_masses);
  const double square = mode.square;
  double complex rest = 0.0;
  for (uint32_t k = 2; k <= n_masses; ++k) {
    next_mode(&mode, coefs);
    rest += mode.square * inverse(d_of(place, mode.pole));
  }
  const double complex bare = d_of(place, bridge->bare);
  return strength * square * inverse(bare + tie.spring - strength * rest);
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

Bridge bridge_at(double rate_hz) {
  const double angle = fmin(2.0 * PI * BRIDGE_HZ / rate_hz, MOST_BRIDGE_ANGLE);
  return (Bridge){.bare = {.a = angle * angle, .g = 2.0 * BRIDGE_ZETA * angle}};
}

double bridge_mass(double f0_hz) {
  return MOST_MASS / (1.0 + f0_hz / MASS_HALVED_HZ);
}

BridgeTie bridge_tie(StringCoefs coefs, uint32_t n_masses, BridgeHold hold) {
  const double weight = hold.mass / (n_masses + 1.0);
  const double pull = hold.lever * coefs.k1;
  Mode mode = first_mode(coefs, n_masses);
  double slow = mode.square / mode.pole.a;
  double fast = mode.square / (4.0 - 2.0 * mode.pole.g - mode.pole.a);
  for (uint32_t k = 2; k <= n_masses; ++k) {
    next_mode(&mode, coefs);
    slow += mode.square / mode.pole.a;
    fast += mode.square / (4.0 - 2.0 * mode.pole.g - mode.pole.a);
  }
  const double load = weight * pull * pull * (slow + fast);
  const double kept = fmin(1.0, BRIDGE_MOST_LOAD / load);
  return (BridgeTie){
      .weight = weight,
      .pull = sqrt(kept) * pull,
      .spring = kept * weight * pull * pull * slow,
      .load = kept * load,
  };
}

double bridge_headroom(const Bridge* bridge, double load) {
  return 1.0 - 0.25 * (bridge->bare.a + 2.0 * bridge->bare.g + load);
}

TuningTarget
bridge_correct(const Bridge* bridge, TuningTarget target, uint32_t n_masses, BridgeHold hold) {
  TuningTarget own = target;
  StringCoefs coefs = {0};
  if (!(hold.mass * hold.lever > 0.0) || tuning_fit(&own, n_masses, &coefs)) {
    return target;
  }
  const double g = -expm1(-2.0 / (target.rate_hz * target.tone.tau_s));
  Wish wish = {
      .angle = 2.0 * PI * target.tone.f0_hz / target.rate_hz,
      .radius = exp(-1.0 / (target.rate_hz * target.tone.tau_s)),
      .least = g * (target.loss + LEAST_GROUND * (1.0 - target.loss)),
  };
  for (int round = 0; round < ROUNDS; ++round) {
    const Place place = place_of(wish.radius, wish.angle);
    const Pole pole = own_pole(&wish, pull_of_bridge(bridge, coefs, n_masses, hold, &place));
    if (!pole_is_complex(pole)) {
      return target;
    }
    own.tone = pole_tone(target.rate_hz, pole);
    own.loss = pole.g > 0.0 ? fmin(target.loss * g / pole.g, 1.0) : target.loss;
    if (tuning_fit(&own, n_masses, &coefs)) {
      return target;
    }
  }
  return own;
}
