#include "core/excite/hammer.h"

#include "core/excite/contact.h"
#include "core/excite/rehearsal.h"
#include "core/string/chain_numbers.h"

#include <math.h>

/* Least pull of the springs that a string's bending may leave, of k1. */
static const double LEAST_PULL = 0.01;

/* Halvings that find a way to rounding. */
enum { MOST_HALVINGS = 60 };

/*
  How far what a string has now can ever carry a place of it.  With y = x − u/2 and B = I − Z/2 −
  K/4 its energy H = ½ uᵀB u + ½ yᵀK y never grows; a corner y there takes ½ k y²/(s (1 − s)(N +
  1)), k being the least that K is to L, and a speed eᵀu at least ½ (eᵀu)² headroom / eᵀe.
*/
static double reach(const Chain* chain, const Contact* contact, double place) {
  const ChainSums sums = chain_numbers_sum(chain);
  const StringCoefs c = chain->now;
  const double length = chain->n_masses + 1.0;
  const double most = c.k1 + 4.0 * fmax(c.k2, 0.0) + 16.0 * fmax(c.k3, 0.0);
  const double least = fmax(c.k1 + 4.0 * fmin(c.k2, 0.0), LEAST_PULL * c.k1);
  const double twice = sums.uu + most * sums.slope;
  const double headroom = fmax(tuning_headroom(c, chain->n_masses), 0.1 * TUNING_LAST_MARGIN);
  const double share = fmin(fmax(place, 1.0 / length), 1.0 - 1.0 / length);
  return sqrt(twice * share * (1.0 - share) * length / least) +
         0.5 * sqrt(twice * contact->square / headroom);
}

/* It is over once the hammer flies away from all that the string can still do, and has had back
 * what the felt held a step ago. */
static bool is_out_of_reach(const Hammer* hammer) {
  return hammer->force <= 0.0 && hammer->before <= 0.0 && hammer->velocity < 0.0 &&
         hammer->position < -hammer->far;
}

/* When its time is over, what the felt still holds fades. */
static void age(Hammer* hammer) {
  if (hammer->n_left > 0) {
    --hammer->n_left;
  } else {
    hammer->hold = fmax(0.0, hammer->hold - hammer->fall);
  }
  hammer->is_active = hammer->hold > 0.0 && !is_out_of_reach(hammer);
}

static void compare(Hammer* hammer, const Chain* chain, const Contact* contact) {
  hammer->now = hammer->position - contact_position(chain, contact);
  hammer->before = hammer->now - hammer->velocity + contact_velocity(chain, contact);
}

/* What the felt would hold, twice, were the hammer further back. */
static double held(const Hammer* hammer, double back) {
  const Felt* const felt = &hammer->make.felt;
  return felt_energy(felt, hammer->now - back) + felt_energy(felt, hammer->before - back);
}

/* As far as it takes for the felt to hold no more than that. */
static double way_back(const Hammer* hammer, double most) {
  double low = 0.0;
  double high = fmax(hammer->now, hammer->before);
  for (int i = 0; i < MOST_HALVINGS; ++i) {
    const double middle = 0.5 * (low + high);
    *(held(hammer, middle) > most ? &low : &high) = middle;
  }
  return high;
}

double hammer_hardness(double hardness, double softness) {
  return fmax(HAMMER_SOFT, fmin(1.0, hardness + softness * (HAMMER_SOFT - hardness)));
}

void hammer_start(Hammer* hammer, const Chain* chain, HammerMake make, double rate_hz) {
  const Contact contact = contact_at(chain, make.place);
  const double closing = make.velocity - contact_velocity(chain, &contact);
  *hammer = (Hammer){
      .make = make,
      .position = contact_position(chain, &contact) + fmin(closing, 0.0),
      .velocity = make.velocity,
      .hold = 1.0,
      .fall = fmin(1.0, 1.0 / (HAMMER_LEAVING_S * rate_hz)),
      .far = reach(chain, &contact, make.place),
      .n_left = (uint32_t)(HAMMER_MOST_S * rate_hz),
      .is_active = true,
  };
  hammer_notice(hammer, chain);
}

void hammer_throw(
    Hammer* hammer, const Chain* chain, Strike strike, double angle1, double rate_hz) {
  hammer_start(hammer, chain, rehearsal_make(chain->n_masses, strike, angle1), rate_hz);
}

/* What moves the string must not press the felt, for none would have paid for it. */
void hammer_notice(Hammer* hammer, const Chain* chain) {
  const Contact contact = contact_at(chain, hammer->make.place);
  const double most = held(hammer, 0.0);
  compare(hammer, chain, &contact);
  if (held(hammer, 0.0) > most) {
    hammer->position -= way_back(hammer, most);
    compare(hammer, chain, &contact);
  }
}

bool hammer_act(Hammer* hammer, Chain* chain) {
  if (!hammer->is_active) {
    return false;
  }
  const Contact contact = contact_at(chain, hammer->make.place);
  const double length = chain->n_masses + 1.0;
  const double mass = hammer->make.mass * length;
  const bool was_pressed = hammer->force > 0.0;
  const double free = hammer->position + hammer->velocity - contact_position(chain, &contact);
  const double before = hammer->before;
  Felt felt = hammer->make.felt;
  felt.stiffness *= hammer->hold * length;
  const double speed_before = hammer->velocity - (hammer->now - before);
  hammer->before = hammer->now;
  hammer->force = felt_press(&felt, before, free, contact.square + 1.0 / mass, &hammer->now);
  hammer->velocity -= hammer->force / mass;
  hammer->position += hammer->velocity;
  const double speed = hammer->velocity - (hammer->now - hammer->before);
  hammer->work = 0.5 * hammer->force * (speed + speed_before);
  if (hammer->force > 0.0) {
    contact_push(chain, &contact, hammer->force);
  } else if (was_pressed) {
    hammer->far = reach(chain, &contact, hammer->make.place);
  }
  age(hammer);
  return hammer->is_active;
}
