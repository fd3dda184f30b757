/**
   Strings and single masses as the reference engine plays them.

   Time is counted in steps: h = 1 s, m = 1 kg.  So a mass is a Pole (core/string/pole.h) with the
   spring a [N/m] and the damper g [kg/s], and its velocity is u = h v [m, per step]. Thread: any.
   Allocates where it says so.
*/
#ifndef HOOKE_TOOLS_REPORT_FIGURE_SCHEME_H
#define HOOKE_TOOLS_REPORT_FIGURE_SCHEME_H

#include "core/analysis/network_schemes.h"
#include "core/base/status.h"
#include "core/string/pole.h"

#include <stdint.h>

/** Where a mass is. */
typedef struct {
  double x; /**< [m] */
  double u; /**< Velocity [m per step] */
} FigureState;

/** ½ u² + ½ a x² [J].  Without damping, forward Euler multiplies it by 1 + a in each step, backward
 * Euler divides it by as much. */
double figure_scheme_energy(Pole pole, FigureState state);

/**
   Play one mass with core/analysis/network_schemes.

   @param start     State before the first step
   @param[out] out  n_states states, out[0] being `start`
   @return STATUS_OK; STATUS_NO_MEMORY; STATUS_NO_CONVERGENCE; allocates
*/
Status figure_scheme_play(
    NetworkScheme scheme, Pole pole, FigureState start, uint32_t n_states, FigureState* out);

/**
   Play a string between two fixed ends with core/analysis/network: its first mass is displaced by 1
   m and let go, and its first mass is listened to.

   @param n_masses  ≥ 1
   @param segment   Spring a [N/m] and damper g [kg/s] of each of its n_masses + 1 segments
   @param[out] x    n_frames positions [m], from the start on
   @return STATUS_OK; STATUS_BAD_ARGUMENT for 0 masses; STATUS_NO_MEMORY; allocates
*/
Status figure_scheme_pluck(uint32_t n_masses, Pole segment, uint32_t n_frames, double* x);

#endif
