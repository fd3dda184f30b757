#include "core/excite/bow.h"

#include "core/base/maths.h"
#include "core/excite/contact.h"

#include <float.h>
#include <math.h>

/* Friction at rest, and where it slips fast; and the speed, of the hair's, at which it is half way
 * between. */
static const double STATIC = 0.8;
static const double DYNAMIC = 0.3;
static const double HALF_WAY = 0.2;

/* The string's twist under the hair: its damper, of the string's impedance, and its spring, of that
 * for each radian of the fundamental. */
static const double ROLL = 2.0;
static const double ROLL_SPRING = 1.8;

/* A bow is so wide that it comes no nearer to a wall, nor so near that a slip would take fewer
 * frames than these; and further out the string is all too ready to slip twice a period. */
static const double LEAST_PLACE = 0.05;
static const double SLIP_FRAMES = 4.0;
static const double MOST_PLACE = 0.2;

/* As far as it goes for that: half way between nodes of the fourth partial and the fifth. */
static const double FARTHEST = 0.222;

/* Force, of the most with which each round of the string still pulls the hair off, for no pressure
 * and for all, at a place; nearer to the wall the string asks for less of it. */
static const double LIGHTEST = 0.36;
static const double HEAVIEST = 0.47;
static const double USUAL_PLACE = 0.13;
static const double NEARER = 0.25;

/* The hair's edge drags at the string as it slips there: how far it is away, towards the wall, and
 * its damper, of the string's impedance. */
static const double WIDTH = 0.02;
static const double EDGE = 0.03;
static const double FEEBLE = 0.125; /* The strength below which it drags less */

/* What the hair is drawn faster than the string is to go, for the string rolls back under it; and
 * the more so from a place on. */
static const double SLACK = 1.15;
static const double MORE_SLACK = 0.9;
static const double TIGHT_PLACE = 0.1;

/* Time in which it is pressed, of that in which it comes to its speed. */
static const double PRESSING = 0.3;

/* The most that it can swell to. */
static const double STRONGEST = 2.0;

/* What the hair and the string settle in a step. */
typedef struct {
  double free;  /* v without friction */
  double yield; /* What v gives way to a force of 1 */
  double force; /* F */
  double v0;
} Meeting;

static double friction_at(const Meeting* m, double speed) {
  return m->force * (DYNAMIC + (STATIC - DYNAMIC) / (1.0 + speed / m->v0));
}

/*
  How fast it slips, |v|, where `free` is counted in its direction: with w = free − yield F μd,

      v² + (v0 − w) v − w v0 + yield F (μs − μd) v0 = 0,

  of which the larger root is the one that is there to stay; 0 where it slips no more.
*/
static double slip_of(const Meeting* m, double free) {
  const double w = free - m->yield * m->force * DYNAMIC;
  const double sum = m->v0 + w;
  const double discriminant = sum * sum - 4.0 * m->yield * m->force * (STATIC - DYNAMIC) * m->v0;
  return discriminant > 0.0 ? fmax(0.0, 0.5 * (w - m->v0 + sqrt(discriminant))) : 0.0;
}

static double sign_of(BowState state) {
  return state == BOW_STICKS ? 0.0 : state == BOW_SLIPS_BACK ? -1.0 : 1.0;
}

/* What slips goes on slipping for as long as it can; what sticks, up to friction at rest. */
static double settle_slip(Bow* bow, const Meeting* m) {
  const double speed = bow->state == BOW_STICKS ? 0.0 : slip_of(m, sign_of(bow->state) * m->free);
  if (speed > 0.0) {
    return speed;
  }
  bow->state = BOW_STICKS;
  if (fabs(m->free) > m->yield * m->force * STATIC) {
    bow->state = m->free > 0.0 ? BOW_SLIPS_AHEAD : BOW_SLIPS_BACK;
    return slip_of(m, fabs(m->free));
  }
  return 0.0;
}

static void settle(Bow* bow, const Meeting* m) {
  const double speed = settle_slip(bow, m);
  const double sign = sign_of(bow->state);
  bow->slip = sign * speed;
  bow->friction = bow->state == BOW_STICKS ? -m->free / m->yield : -sign * friction_at(m, speed);
}

static Contact edge_at(const Chain* chain, double place) {
  return contact_at(chain, place + (place < 0.5 ? -WIDTH : WIDTH));
}

/* What is given to a string in its own time is the same at any pitch. */
static void follow(Bow* bow, const Chain* chain) {
  bow->haste = sqrt(fmax(0.0, chain_pace(chain) / bow->pace));
  (void)line_next(&bow->strength);
  (void)line_next(&bow->drawn);
  (void)line_next(&bow->pressed);
  bow->hair = bow->haste * bow->strength.value * bow->drawn.value;
  bow->is_active = !bow->is_lifted || bow->pressed.n_left > 0;
}

/* What comes next is seen from where the bow will be. */
static void move_on(Bow* bow, const Chain* chain) {
  if (bow->place.n_left > 0) {
    (void)line_next(&bow->place);
    bow_notice(bow, chain);
  }
}

/* What it does is what it did, for a strength of 1, and the roll keeps its energy. */
static void take_over(Bow* bow, double spring) {
  const double now = bow->haste * bow->strength.value;
  bow->rolled *= sqrt(bow->haste * bow->spring / spring);
  bow->drawn.value *= now;
  bow->pressed.value *= now;
  bow->is_lifted = false;
}

/* Where it can be bowed: fraction of the length from the nearer wall, then from the one. */
double bow_place(double wanted, double angle1) {
  const double least = fmax(LEAST_PLACE, SLIP_FRAMES * angle1 / (2.0 * PI));
  const double most = fmax(MOST_PLACE, fmin(least, FARTHEST));
  const double beta = fmin(fmax(fmin(wanted, 1.0 - wanted), least), most);
  return wanted > 0.5 ? 1.0 - beta : beta;
}

static uint32_t frames_of(double time_s, double rate_hz) {
  return (uint32_t)fmax(1.0, round(time_s * rate_hz));
}

void bow_start(Bow* bow, const Chain* chain, Stroke stroke, double angle1, double rate_hz) {
  const double place = bow_place(stroke.place, angle1);
  const double beta = fmin(place, 1.0 - place);
  /* Near half the rate a place hardly moves from one step to the next but one, however far it
   * swings. */
  const double swing = sin(angle1);
  const double speed = 8.0 * beta * (1.0 - beta) * stroke.amplitude * swing / (2.0 * PI) * SLACK *
                       (1.0 + MORE_SLACK * fmax(0.0, beta - TIGHT_PLACE));
  /* Schelleng's most: the corner brings 2 √k1 b/β, and friction falls by so much at its slip. */
  const double heavy = 2.0 / (beta * (STATIC - DYNAMIC)) * pow(beta / USUAL_PLACE, NEARER);
  const double force = heavy * LIGHTEST * pow(HEAVIEST / LIGHTEST, stroke.pressure) * speed;
  const double spring = ROLL_SPRING * angle1;
  const uint32_t n_attack = frames_of(stroke.attack_s, rate_hz);
  if (bow->is_active) {
    take_over(bow, spring);
  } else {
    *bow = (Bow){.is_active = true};
    line_set(&bow->place, place);
  }
  line_set(&bow->strength, 1.0);
  line_to(&bow->place, place, n_attack);
  line_to(&bow->drawn, speed, n_attack);
  line_to(&bow->pressed, force, frames_of(PRESSING * stroke.attack_s, rate_hz));
  bow->pace = chain_pace(chain);
  bow->full = force;
  bow->haste = 1.0;
  bow->n_lift = frames_of(stroke.release_s, rate_hz);
  bow->spring = spring;
  bow_notice(bow, chain);
}

void bow_swell(Bow* bow, double strength, uint32_t n_frames) {
  line_to(&bow->strength, fmin(fmax(strength, 0.0), STRONGEST), n_frames);
}

void bow_lift(Bow* bow) {
  if (!bow->is_lifted) {
    bow->is_lifted = true;
    line_to(&bow->pressed, 0.0, bow->n_lift);
  }
}

void bow_notice(Bow* bow, const Chain* chain) {
  const Contact contact = contact_at(chain, bow->place.value);
  const Contact edge = edge_at(chain, bow->place.value);
  bow->before = contact_velocity(chain, &contact);
  bow->beside = contact_velocity(chain, &edge);
}

bool bow_act(Bow* bow, Chain* chain) {
  if (!bow->is_active) {
    return false;
  }
  const Contact contact = contact_at(chain, bow->place.value);
  const Contact edge = edge_at(chain, bow->place.value);
  const double impedance = sqrt(chain->now.k1);
  follow(bow, chain);
  const double after = contact_velocity(chain, &contact);
  const double spring = impedance * bow->haste * bow->spring;
  const double roll = 1.0 / (impedance * ROLL + 0.5 * spring);
  const double force = bow->haste * bow->strength.value * bow->pressed.value * impedance;
  /* The edge's drag, whatever the friction; and what each does to the other. */
  const double touch = EDGE * impedance * fmin(1.0, bow->strength.value / FEEBLE) *
                       fmin(1.0, bow->pressed.value / bow->full);
  const double drag = touch / (1.0 + 0.5 * touch * edge.square);
  const double both = 0.5 * contact_overlap(&contact, &edge);
  const double beside = contact_velocity(chain, &edge);
  const double edge_free = 0.5 * (beside + bow->beside) - bow->hair;
  const Meeting m = {
      .free = 0.5 * (after + bow->before) - bow->hair - roll * spring * bow->rolled -
              both * drag * edge_free,
      .yield = 0.5 * contact.square + roll - both * both * drag,
      .force = force,
      .v0 = fmax(DBL_MIN, HALF_WAY * bow->hair),
  };
  settle(bow, &m);
  bow->rolled += roll * (bow->friction - spring * bow->rolled);
  bow->drag = -drag * (edge_free + both * bow->friction);
  contact_push(chain, &contact, bow->friction);
  contact_push(chain, &edge, bow->drag);
  const double now = after + contact.square * bow->friction + 2.0 * both * bow->drag;
  const double edge_now = beside + edge.square * bow->drag + 2.0 * both * bow->friction;
  bow->work = 0.5 * (bow->friction * (now + bow->before) + bow->drag * (edge_now + bow->beside));
  bow->before = now;
  bow->beside = edge_now;
  move_on(bow, chain);
  return bow->is_active;
}
