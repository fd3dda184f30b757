/**
   The string a second way: dense matrices, LAPACK and plain loops in double, straight from the
   equations of core/string/tuning.h and sharing none of their code.

   Matrices are column-major with ld = order.
*/
#ifndef HOOKE_TESTS_SUPPORT_ORACLE_H
#define HOOKE_TESTS_SUPPORT_ORACLE_H

#include "core/base/complex_of.h"
#include "core/string/tuning.h"

#include <complex.h>
#include <stddef.h>
#include <stdint.h>

/** Print what was measured beside what is allowed, and fail the test if it is more, or no number.
 */
#define assert_within(what, worst, limit)                                                          \
  oracle_assert_within(what, (double)(worst), (double)(limit), __FILE__, __LINE__)

void oracle_assert_within(const char* what, double worst, double limit, const char* file, int line);

/** All eigenvalues of a matrix, order × order, by dgeev; the matrix is destroyed. */
void oracle_eigenvalues(size_t order, double* matrix, double complex* values);

/** The stiffness K = k1 L + k2 L² + k3 L³ and the damping Z = z0 I + z1 L, both n × n. */
void oracle_forces(StringCoefs coefs, uint32_t n, double* stiffness, double* damping);

/** All 2n poles of the string: the eigenvalues of its step matrix on (x, u). */
void oracle_poles(StringCoefs coefs, uint32_t n, double complex* poles);

/** The largest modulus of oracle_poles(). */
double oracle_spectral_radius(StringCoefs coefs, uint32_t n);

/** The two eigenvalues of the step matrix of one mass. */
void oracle_mass_poles(double a, double g, double complex poles[2]);

/** Step a string of n ≤ 1024 masses once. */
void oracle_step(StringCoefs coefs, uint32_t n, double* x, double* u);

/** The scheme's own energy, ½ uᵀu + ½ xᵀK (x − u); constant without damping. */
double oracle_energy(const double* stiffness, uint32_t n, const double* x, const double* u);

/** ½ (u_new + u_old)ᵀ Z u_old: the energy that a step takes from a damped string. */
double oracle_loss(const double* damping, uint32_t n, const double* u_old, const double* u_new);

/** The smallest of 1 − (a_k + 2 g_k)/4 over all modes, one by one; −∞ if a mode has a_k ≤ 0. */
double oracle_headroom(StringCoefs coefs, uint32_t n);

#endif
