#include "core/excite/contact.h"

#include "core/string/chain_numbers.h"

#include <math.h>

Contact contact_at(const Chain* chain, double place) {
  const double last = chain->n_masses;
  const double at = fmin(fmax(place * (last + 1.0), 1.0), last);
  const double mass = fmin(floor(at), fmax(1.0, last - 1.0));
  const double share = at - mass;
  return (Contact){
      .mass = {(uint32_t)mass - 1, share > 0.0 ? (uint32_t)mass : (uint32_t)mass - 1},
      .weight = {1.0 - share, share},
      .square = (1.0 - share) * (1.0 - share) + share * share,
  };
}

double contact_overlap(const Contact* a, const Contact* b) {
  double sum = 0.0;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      sum += a->mass[i] == b->mass[j] ? a->weight[i] * b->weight[j] : 0.0;
    }
  }
  return sum;
}

double contact_position(const Chain* chain, const Contact* contact) {
  return contact->weight[0] * chain_numbers_position(chain, contact->mass[0]) +
         contact->weight[1] * chain_numbers_position(chain, contact->mass[1]);
}

double contact_velocity(const Chain* chain, const Contact* contact) {
  return contact->weight[0] * chain_numbers_velocity(chain, contact->mass[0]) +
         contact->weight[1] * chain_numbers_velocity(chain, contact->mass[1]);
}

void contact_push(Chain* chain, const Contact* contact, double force) {
  chain_numbers_touch(chain);
  for (int side = 0; side < 2; ++side) {
    const uint32_t i = contact->mass[side];
    const double change = contact->weight[side] * force;
    if (change != 0.0) {
      chain_numbers_place(chain, i, chain_numbers_position(chain, i) + change,
                          chain_numbers_velocity(chain, i) + change);
    }
  }
}
