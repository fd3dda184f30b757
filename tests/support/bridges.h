/** Strings on a bridge a second way: dense matrices, straight from the equations of
 * core/voice/bridge.h.
 */
#ifndef HOOKE_TESTS_SUPPORT_BRIDGES_H
#define HOOKE_TESTS_SUPPORT_BRIDGES_H

#include "core/voice/bridge.h"

#include "tests/support/energy.h"

#include <complex.h>
#include <stddef.h>
#include <stdint.h>

enum { BRIDGES_STRINGS = 4, BRIDGES_MASSES = 24 };

/** Strings that are tied to a bridge. */
typedef struct {
  Bridge bridge;
  uint32_t n_strings;
  uint32_t n_masses[BRIDGES_STRINGS];
  StringCoefs coefs[BRIDGES_STRINGS];
  BridgeTie ties[BRIDGES_STRINGS];
  Motion motions[BRIDGES_STRINGS];
} Strung;

/** Masses of all strings, and the bridge's. */
size_t bridges_order(const Strung* strung);

/** K and Z of the whole, order × order, column-major, symmetric: each string's weighed by its r,
 * the bridge last; and the masses. */
void bridges_forces(const Strung* strung, double* stiffness, double* damping, double* mass);

/** All poles of the whole, 2 × order, by dgeev. */
void bridges_poles(const Strung* strung, double complex* poles);

/** What is left of the last unknown once all others are eliminated; NAN where the rest is not
 * positive.  The matrix is destroyed. */
double bridges_complement(size_t order, double* matrix);

/** H of core/energy.h, of the whole. */
double bridges_energy(const Strung* strung);

/** One step in double, by motion_step() and bridge_step(). */
void bridges_step(Strung* strung);

#endif
