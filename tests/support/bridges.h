/** Strings on a bridge a second way: dense matrices, straight from the equations of
 * core/voice/bridge.h.
 */
#ifndef HOOKE_TESTS_SUPPORT_BRIDGES_H
#define HOOKE_TESTS_SUPPORT_BRIDGES_H

#include "core/voice/bridge.h"

#include "tests/support/energy.h"
#include "tests/support/random.h"

#include <complex.h>
#include <stddef.h>
#include <stdint.h>

enum {
  BRIDGES_STRINGS = 4,
  BRIDGES_MASSES = 24,
  BRIDGES_MODES = 40,
  BRIDGES_MOST_ORDER = BRIDGES_STRINGS * BRIDGES_MASSES + BRIDGES_MODES
};

/** Strings that are tied to a bridge. */
typedef struct {
  Bridge bridge;
  uint32_t n_strings;
  uint32_t n_masses[BRIDGES_STRINGS];
  StringCoefs coefs[BRIDGES_STRINGS];
  BridgeTie ties[BRIDGES_STRINGS];
  Motion motions[BRIDGES_STRINGS];
} Strung;

/** A body of `n_modes` that is nowhere near any that is built: 50 Hz to 4 kHz (and 0.44 of the
 * rate), Q from 5 to 200, 0.02 to 5 kg. */
Body bridges_body(Random* random, uint32_t n_modes, double rate_hz);

/** One mass as often as not, else on a body of 1 to BRIDGES_MODES modes. */
void bridges_draw(Random* random, double rate_hz, Bridge* bridge);

/** Masses of all strings, and the bridge's modes. */
size_t bridges_order(const Strung* strung);

/** K and Z of the whole, order × order, column-major, symmetric: each string's weighed by its r,
 * the bridge's modes last, every one of them tied to every string; and the masses. */
void bridges_forces(const Strung* strung, double* stiffness, double* damping, double* mass);

/** All poles of the whole, 2 × order, by dgeev. */
void bridges_poles(const Strung* strung, double complex* poles);

/** Eliminate all but the last `n_last` unknowns, whose matrix is left in the corner.
 * @return false where what was eliminated is not positive */
bool bridges_eliminate(size_t order, size_t n_last, double* matrix);

/** Make 4M − 2Z − K of K, Z and M. */
void bridges_top(size_t order, double* stiffness, const double* damping, const double* mass);

/** H of core/energy.h, of the whole. */
double bridges_energy(const Strung* strung);

/** One step in double, by motion_step() and bridge_step(). */
void bridges_step(Strung* strung);

#endif
