/**
   One mass under each of the schemes of core/analysis/network_schemes, as the 2 × 2 matrix of a
   step.

   The state is (x, u) with u = h v; a = (ω0 h)² and g = γ h as in core/string/pole.h.  Every mode
   of the uniform string is such a mass.

   Thread: any; allocates nothing.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_STEP_H
#define HOOKE_TOOLS_BENCH_BENCH_STEP_H

#include "core/analysis/network_schemes.h"
#include "core/string/pole.h"

#include <stdbool.h>

/** (x, u) ← (xx x + xu u, ux x + uu u). */
typedef struct {
  double xx, xu, ux, uu;
} BenchStep;

/** What a step of `scheme` does to a mass. */
BenchStep bench_step_of(NetworkScheme scheme, Pole mass);

/** The pitch and the decay that are heard of a mass; τ < 0 where it grows. */
Tone bench_step_tone(NetworkScheme scheme, double rate_hz, Pole mass);

/** The larger modulus of the two poles. */
double bench_step_radius(NetworkScheme scheme, Pole mass);

/**
   Find the mass that sounds as `tone`, by Newton's method on the trace and determinant of the step.

   @param[out] mass  Untouched on failure
   @return false if there is none with g ≥ 0: backward Euler damps by itself
*/
bool bench_step_solve(NetworkScheme scheme, double rate_hz, Tone tone, Pole* mass);

#endif
