/** Networks for tests, and dense algebra to hold them against. */
#ifndef HOOKE_TESTS_SUPPORT_NETWORKS_H
#define HOOKE_TESTS_SUPPORT_NETWORKS_H

#include "core/analysis/network.h"
#include "tests/support/random.h"

#include <complex.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** How unlike the elements of a random network are, in powers of ten up and down from 1. */
typedef struct {
  uint32_t most_masses;
  double mass_decades;
  double stiffness_decades;
  double damping_decades; /**< Of what would be critical at the damper's end */
  bool is_damped;
} NetworkKind;

/** A network with `kind->most_masses` at most: one to four parts, each tied to the ground once or
 * more; trees with loops; dampers anywhere.  Checked, at rest. */
Network* networks_random(Random* random, const NetworkKind* kind);

/** Add `n` levers of two to five points, ground too, of weights from −2 to 2, and check again. */
void networks_add_levers(Network* network, Random* random, uint32_t n);

/** A mass on a spring and a damper to the ground; the mass is point 0. */
Network* networks_mass(double mass_kg, double stiffness, double damping);

/** A uniform string, checked; its first mass is point 0. */
Network* networks_string(uint32_t n, double mass_kg, double stiffness, double damping);

/** Whether everything that is asked of a test is to be done. */
bool networks_is_long(void);

/** The points of the masses, n_masses of them. */
void networks_masses(const Network* network, uint32_t* point);

/** Read and write the state (x, v) of the masses, 2 n_masses. */
void networks_get(const Network* network, double* state);
void networks_set(Network* network, const double* state);

/** The matrix of one step on (x, v), column by column from unit states; order 2 n_masses. */
void networks_step_matrix(Network* network, double step_s, double* matrix);

/** A of [MQ09] (43), from the links and levers one by one; order 2 n_masses. */
void networks_state_matrix(const Network* network, double* matrix);

/** All matrices are column-major with ld = order. */
void networks_multiply(size_t order, const double* a, const double* b, double* product);
void networks_apply(size_t order, const double* a, const double* x, double* y);

/** e^{tA} by a Taylor series of the scaled matrix, squared again. */
void networks_exponential(size_t order, const double* a, double t, double* result);

/** The largest modulus of an eigenvalue of the step matrix. */
double networks_spectral_radius(Network* network, double step_s);

/** Zeros, or the test fails; to be freed. */
double* networks_zeros(size_t n);

#endif
