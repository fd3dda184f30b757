#include "tests/support/hammers.h"

#include <math.h>
#include <stddef.h>

static double stored(const Felt* felt, double c) {
  return c > 0.0 ? felt->stiffness * pow(c, felt->exponent + 1.0) / (felt->exponent + 1.0) : 0.0;
}

/* Scaled so that one blow presses a rigid felt of this kind by about `depth`. */
HammerMake hammers_anyhow(Random* random, double loss) {
  const double velocity = random_log_between(random, 1e-6, 1e3);
  const double exponent = random_between(random, 1.0, 5.0);
  const double depth = velocity * random_log_between(random, 1e-3, 1e3);
  const double mass = random_log_between(random, 1e-4, 1e3);
  return (HammerMake){
      .place = random_between(random, -0.1, 1.1),
      .mass = mass,
      .felt = {.stiffness =
                   0.5 * (exponent + 1.0) * mass * velocity * velocity / pow(depth, exponent + 1.0),
               .exponent = exponent,
               .loss = loss > 0.0 ? random_log_between(random, 1e-2, 10.0) / velocity : 0.0},
      .velocity = velocity,
  };
}

void hammers_shake(Strung* strung, Random* random, double size) {
  for (uint32_t i = 0; i < strung->chain.n_masses; ++i) {
    chain_place(&strung->chain, i, (float)(size * random_between(random, -1.0, 1.0)),
                (float)(size * random_between(random, -1.0, 1.0)));
  }
}

/* Strike, and step until the hammer has left; its steps, and those in which it pressed. */
uint32_t hammers_strike(Strung* strung, Strike wanted, uint32_t* n_pressed) {
  Hammer hammer;
  uint32_t n = 0;
  hammer_throw(&hammer, &strung->chain, wanted, strung->angle1, strung->rate_hz);
  *n_pressed = 0;
  do {
    strung_step(strung, 0);
    ++n;
    *n_pressed +=
        hammer_act(&hammer, &strung->chain) || hammer.force > 0.0 ? hammer.force > 0.0 : 0;
  } while (hammer.is_active);
  return n;
}

double hammers_energy(const Hammer* hammer, const Strung* strung, const Motion* motion) {
  const double length = strung->chain.n_masses + 1.0;
  const double at = fmin(fmax(hammer->make.place * length, 1.0), length - 1.0);
  const uint32_t i = (uint32_t)at;
  const double w = at - i;
  const double x = (1.0 - w) * motion->x[i - 1] + (w > 0.0 ? w * motion->x[i] : 0.0);
  const double u = (1.0 - w) * motion->u[i - 1] + (w > 0.0 ? w * motion->u[i] : 0.0);
  const double now = hammer->position - x;
  const double before = now - hammer->velocity + u;
  Felt felt = hammer->make.felt;
  felt.stiffness *= hammer->hold * length;
  return 0.5 * hammer->make.mass * length * hammer->velocity * hammer->velocity +
         0.5 * (stored(&felt, now) + stored(&felt, before));
}
