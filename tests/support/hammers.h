/** What the tests of hammers share. */
#ifndef HOOKE_TESTS_SUPPORT_HAMMERS_H
#define HOOKE_TESTS_SUPPORT_HAMMERS_H

#include "core/excite/hammer.h"
#include "tests/support/random.h"
#include "tests/support/strung.h"

#include <stdint.h>

/** Any hammer, scaled so that one blow presses a rigid felt of its kind by about what was drawn;
 * its felt loses nothing where `loss` is 0. */
HammerMake hammers_anyhow(Random* random, double loss);

/** Give every mass any position and velocity up to `size`. */
void hammers_shake(Strung* strung, Random* random, double size);

/** Strike, and step until the hammer has left.  @return Its steps, and those in which it pressed */
uint32_t hammers_strike(Strung* strung, Strike wanted, uint32_t* n_pressed);

/** Energy of a hammer and its felt at a string that does `motion`, from positions: ½ M U² + ½ (φ(c)
 * + φ(c a step ago)). */
double hammers_energy(const Hammer* hammer, const Strung* strung, const Motion* motion);

#endif
