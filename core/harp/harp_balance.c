#include "core/harp/harp_balance.h"

#include "core/base/complex_of.h"
#include "core/base/maths.h"
#include "core/excite/spectrum.h"
#include "core/harp/harp_stereo.h"
#include "core/string/pickup.h"

#include <complex.h>
#include <math.h>
#include <stddef.h>

/* Power, of the amplitude's square: that of the patch as the panel has it at first, key 60. */
static const double POWER = 0.5;

/* The time that is listened to [s], and the key whose decay all are measured by. */
static const double WINDOW_S = 0.4;
static const double MIDDLE_KEY = 60.0;

/* Most that a decay is made up for, in power. */
static const double MOST_DECAY = 10.0;

/* Largest amplitude of each side, of the string's: what is too low to be heard, or is gone at once,
 * may not drive a limiter. */
static const double LARGEST = 2.0;

/* What a strike is thought to be made stronger by: how bright it is depends on that, a little. */
static const double USUAL_STRIKE = 0.8;

/* A mode's a that is not below 4 is not stable, and not heard. */
static const double LARGEST_A = 3.999;

/* Modes that are taken one by one; the rest in runs of a quarter of their number, each for a mode
 * of it that no comb can fall into step with. */
enum { ONE_BY_ONE = 32, RUN = 4 };
static const double GOLDEN = 0.61803398874989485;

/* Partials whose place between the body's modes matters. */
enum { MET_BY_MODES = 8 };

/* What turns by an angle from mode to mode: the string's shape, the exciter's two cosines, and the
 * sines at the masses that are read, and at the one that pulls at the body. */
enum { STRING, EXCITED, TAPPED = 3, PULLED = TAPPED + 2, MOST_TURNS };

typedef struct {
  double angle[MOST_TURNS];
  double now[MOST_TURNS];
  double before[MOST_TURNS];
  double twice[MOST_TURNS]; /* Cosine of the angle */
} Turns;

typedef struct {
  StringCoefs coefs;
  Spectrum spectrum;
  PickupType pickup_type;
  double weights[2];
  double rate_hz;
  double spread;
  double dry;       /* Gain of what is read */
  const Body* body; /* NULL: none */
  BodyShape shape;
  double wet;                /* Gain of what it is pulled by, with the weight at the string's end */
  const HarpMember* members; /* NULL: one */
  bool is_held;              /* None of them dies */
} Heard;

/* Sums over the modes, as they begin and over the whole time. */
typedef struct {
  double begun;
  double whole;
  double plain; /* As it begins, not weighed */
  double alone; /* Over the whole time, exactly: of one, and of all members, where there are more */
  double together;
} Power;

/* Gain squared of the filters of BS.1770 at a frequency squared, as they are before they are made
 * for a rate: what the head does to the sound, and what is not heard below. */
static double k_weight(double square) {
  static const double HEAD = 1681.974450955533 * 1681.974450955533;
  static const double HEAD_Q = 0.7071752369554196 * 0.7071752369554196;
  static const double HIGH = 1.584864701130855;
  static const double BAND = 1.258720930232562;
  static const double LOW = 38.13547087602444 * 38.13547087602444;
  static const double LOW_Q = 0.5003270373238773 * 0.5003270373238773;
  const double high = HEAD - HIGH * square;
  const double head = HEAD - square;
  const double low = LOW - square;
  const double over = high * high + BAND * BAND * HEAD / HEAD_Q * square;
  const double under = head * head + HEAD / HEAD_Q * square;
  return over * square * square / (under * (low * low + LOW / LOW_Q * square));
}

static const HarpMember one[HARP_MEMBERS] = {{.share = 1.0, .decay = 1.0}};

/* Mean of e^(−2yt) for t from 0 to 1, within 0.2 dB. */
static double kept(double y) {
  return 1.0 / (y + sqrt(1.0 + y * y));
}

/* ω² = 4 asin²(√a/2), well enough for an ear. */
static double square_of_angle(double a) {
  const double q = 0.25 * a;
  return a * (1.0 + q * (1.0 / 3.0 + q * (8.0 / 45.0)));
}

static double read_of(const Heard* heard, const double* sines) {
  return heard->weights[0] * sines[0] + heard->weights[1] * sines[1];
}

/* What the pickup reads of a partial and what its body makes of it, which are in step, or not. */
static double square_met(const Heard* heard, double read, double sine, double hz) {
  const double angle = 2.0 * PI * hz / heard->rate_hz;
  const double half = sin(0.5 * angle);
  const double late = heard->spread > 0.0 ? 2.0 * PI * hz * HARP_STEREO_S : 0.0;
  const double aside = heard->spread * sin(late);
  const double complex rate =
      heard->pickup_type == PICKUP_VELOCITY ? 2.0 * half * complex_of(half, cos(0.5 * angle)) : 1.0;
  const double complex dry = heard->dry * read * rate * complex_of(cos(late), -sin(late));
  double complex gain[2];
  double square = 0.0;
  body_gain(heard->body, heard->shape, hz, gain);
  for (int side = 0; side < 2; ++side) {
    const double complex both =
        dry * complex_of(1.0, side ? -aside : aside) + heard->wet * sine * gain[side];
    square += creal(both) * creal(both) + cimag(both) * cimag(both);
  }
  return square;
}

/* Of partial k, on both sides: which of the body's modes the lowest meet is heard. */
static double
square_heard(const Heard* heard, uint32_t k, const double* turned, double a, double hz) {
  const double read = read_of(heard, &turned[TAPPED]);
  if (heard->body && k <= MET_BY_MODES) {
    return square_met(heard, read, turned[PULLED], hz);
  }
  const double alone = (2.0 + heard->spread * heard->spread) * heard->dry * heard->dry * read *
                       read * (heard->pickup_type == PICKUP_VELOCITY ? a : 1.0);
  const double pull = heard->wet * turned[PULLED];
  return heard->body ? alone + 2.0 * pull * pull * body_power(heard->body, heard->shape, hz)
                     : alone;
}

/* And what all members make of a mode that is as loud as `weighed` when it begins. */
static void add_together(Power* power, const Heard* heard, Pole mode, double weighed) {
  const double n_frames = WINDOW_S * heard->rate_hz;
  const double fall = heard->is_held ? 0.0 : 0.5 * mode.g * n_frames;
  const double turn = sqrt(square_of_angle(mode.a)) * n_frames;
  power->alone += weighed * harp_members_kept(one, fall, turn);
  power->together += weighed * harp_members_kept(heard->members, fall, turn);
}

/* Add `n` modes that are all as `k` is. */
static void add(Power* power, const Heard* heard, uint32_t k, const double* turned, double n) {
  const StringCoefs* const c = &heard->coefs;
  const double lambda = 2.0 - 2.0 * turned[STRING];
  const Pole mode = {fmin(LARGEST_A, (c->k1 + (c->k2 + c->k3 * lambda) * lambda) * lambda),
                     c->z0 + c->z1 * lambda};
  const double square_hz =
      heard->rate_hz * heard->rate_hz / (4.0 * PI * PI) * square_of_angle(mode.a);
  const double plain = 0.5 * n * spectrum_square(&heard->spectrum, k, mode, &turned[EXCITED]) *
                       square_heard(heard, k, turned, mode.a, sqrt(square_hz));
  const double weighed = plain * k_weight(square_hz);
  power->plain += plain;
  power->begun += weighed;
  power->whole += weighed * kept(0.5 * mode.g * WINDOW_S * heard->rate_hz);
  if (heard->members) {
    add_together(power, heard, mode, weighed);
  }
}

static void turn_to(Turns* turns, double k) {
  for (int i = 0; i < MOST_TURNS; ++i) {
    turns->now[i] = i < TAPPED ? cos(k * turns->angle[i]) : sin(k * turns->angle[i]);
  }
}

static void start(Turns* turns) {
  turn_to(turns, 1.0);
  for (int i = 0; i < MOST_TURNS; ++i) {
    turns->before[i] = i < TAPPED ? 1.0 : 0.0;
    turns->twice[i] = 2.0 * (i < TAPPED ? turns->now[i] : cos(turns->angle[i]));
  }
}

static void turn(Turns* turns) {
  for (int i = 0; i < MOST_TURNS; ++i) {
    const double next = turns->twice[i] * turns->now[i] - turns->before[i];
    turns->before[i] = turns->now[i];
    turns->now[i] = next;
  }
}

static Power sum(const Heard* heard, Turns* turns, uint32_t n_masses) {
  Power power = {0};
  double way = 0.5;
  uint32_t k = 1;
  start(turns);
  for (; k <= n_masses && k <= ONE_BY_ONE; ++k) {
    add(&power, heard, k, turns->now, 1.0);
    turn(turns);
  }
  while (k <= n_masses) {
    const uint32_t n_left = n_masses + 1 - k;
    const uint32_t n = k / RUN < n_left ? k / RUN : n_left;
    way = fmod(way + GOLDEN, 1.0);
    const uint32_t at = k + (uint32_t)(way * n);
    turn_to(turns, at);
    add(&power, heard, at, turns->now, n);
    k += n;
  }
  return power;
}

static Spectrum spectrum_for(const HarpPatch* patch, const HarpBalance* string, Pluck pluck) {
  const double angle1 = 2.0 * PI * string->target.tone.f0_hz / string->target.rate_hz;
  switch (patch->exciter) {
  case EXCITER_STRIKE: {
    const Strike strike = {pluck.place, pluck.hardness, string->hammer_mass,
                           USUAL_STRIKE * pluck.amplitude};
    return spectrum_of_strike(string->n_masses, strike, angle1);
  }
  case EXCITER_BOW:
    return spectrum_of_bow(pluck.place, angle1);
  case EXCITER_PLUCK:
    break;
  }
  return spectrum_of_pluck(string->n_masses, pluck, angle1);
}

/* Where the harp's pickup is, or will be.  A spread makes each side louder, by half of what it
 * makes the loudest partials. */
static void
set_taps(Heard* heard, Turns* turns, const HarpPatch* patch, const HarpBalance* string) {
  const double f0_hz = 440.0 * exp2(((double)string->key - 69.0) / 12.0);
  const ChainTap tap = pickup_tap_of_type(patch->pickup_type, string->n_masses, patch->pickup,
                                          2.0 * PI * f0_hz / string->target.rate_hz);
  const double mix = patch->radiates ? patch->body.mix : 0.0;
  const double force =
      (double)pickup_tap_of_type(PICKUP_FORCE, string->n_masses, 0.0, 0.0).weight[0];
  heard->spread = patch->spread;
  heard->dry = sqrt(1.0 - mix);
  heard->body = mix > 0.0 ? patch->radiates : NULL;
  heard->shape = patch->body.shape;
  heard->wet = sqrt(mix) * force;
  turns->angle[PULLED] = turns->angle[STRING];
  for (int i = 0; i < 2; ++i) {
    turns->angle[TAPPED + i] = turns->angle[STRING] * (tap.mass[i] + 1.0);
    heard->weights[i] = (double)tap.weight[i];
  }
}

double harp_balance_gain(const HarpPatch* patch, const HarpBalance* string, Pluck pluck) {
  Heard heard = {.pickup_type = patch->pickup_type, .rate_hz = string->target.rate_hz};
  Turns turns = {.angle = {PI / (string->n_masses + 1.0)}};
  if (tuning_solve(&string->target, string->n_masses, &heard.coefs)) {
    return 1.0;
  }
  heard.members = string->members && string->members[0].share < 1.0 ? string->members : NULL;
  heard.is_held = patch->exciter == EXCITER_BOW;
  heard.spectrum = spectrum_for(patch, string, pluck);
  turns.angle[EXCITED] = heard.spectrum.angles[0];
  turns.angle[EXCITED + 1] = heard.spectrum.angles[1];
  set_taps(&heard, &turns, patch, string);
  const Power power = sum(&heard, &turns, string->n_masses);
  const double damping =
      patch->string.damping_per_s * exp2(patch->string.tracking * (MIDDLE_KEY - 69.0) / 12.0);
  const double usual = kept(WINDOW_S * damping);
  const double share =
      patch->exciter == EXCITER_BOW
          ? 1.0
          : fmin(fmax(power.whole / power.begun, usual / MOST_DECAY), usual * MOST_DECAY);
  const double gain = sqrt(POWER * usual / (power.begun * share));
  const double most = fmin(HARP_BALANCE_MOST, LARGEST / sqrt(2.0 * power.plain));
  const double alone =
      gain < most ? fmax(gain, 1.0 / HARP_BALANCE_MOST) : fmax(most, 1.0 / HARP_BALANCE_MOST);
  if (!(power.together > 0.0)) {
    return alone;
  }
  const double others = sqrt(power.alone / power.together);
  return alone * fmin(fmax(others, 1.0 / HARP_BALANCE_OTHERS), HARP_BALANCE_OTHERS);
}
