/**
   The s-plane of one mass, times h: where its two eigenvalues σ ± jμ may lie, and which motion
   symplectic Euler makes of them.

   With g = γh = −2σh and a = (ω0 h)² = (σh)² + (μh)² every point of it is one mass (core/pole.h).
   All is dimensionless, and angles are in radians per sample.  Thread: any; allocates nothing.
*/
#ifndef HOOKE_TOOLS_FIGURE_PLANE_H
#define HOOKE_TOOLS_FIGURE_PLANE_H

#include "core/pole.h"

#include <stdbool.h>

/** The mass whose eigenvalues are σ ± jμ; σh ≤ 0, μh ≥ 0. */
Pole figure_plane_mass(double sigma_h, double mu_h);

/** σh = −g/2. */
double figure_plane_sigma(Pole pole);

/** μh = √(a − g²/4); NaN where the mass does not vibrate even before it is stepped. */
double figure_plane_mu(Pole pole);

/** σ_d h = ln|z|, the digital damping, [MQ09] (40). */
double figure_plane_damping(Pole pole);

/** The borders between the motions, as g over w = ω0 h, 0 ≤ w ≤ 2. */
typedef enum {
  FIGURE_BORDER_VIBRATES, /**< g = w (2 − w): complex poles below it, [MQ09] (27) */
  FIGURE_BORDER_TURNS,    /**< g = 2 − w²: the larger pole is left of 0 above it, [MQ09] (34) */
  FIGURE_BORDER_LIMIT     /**< g = 2 − w²/2: stable up to it, [MQ09] (33) */
} FigureBorder;

double figure_plane_border(FigureBorder border, double w);

/**
   Where the line of constant μh crosses a border, found by asking core/pole.

   @param border  FIGURE_BORDER_VIBRATES, reached first from σ = 0, or FIGURE_BORDER_TURNS, which
                  is where the angle passes π/2
   @param mu_h    0 < μh < √2
   @return σh
*/
double figure_plane_corner(FigureBorder border, double mu_h);

/** μh of the mass with γh = 1 whose two poles both vanish, found by asking core/pole. */
double figure_plane_singular_mu(void);

/**
   The mass that vibrates at `angle`, 0 < angle < π, with σ_d h = `damping` < 0, by pole_solve():
   with one of the two held and the other running it draws iso-frequency and iso-damping lines.
*/
Pole figure_plane_tone(double angle, double damping);

/**
   The mass that does not vibrate and has γh = `g` and a larger pole of modulus r = exp(`damping`):

       z = r:   a = (1 − r)(g − 1 + r)/r,      z = −r:   a = (1 + r)(1 + r − g)/r.

   It has the modulus r for 1 − r² ≤ g ≤ 1 + r².
*/
Pole figure_plane_real(double damping, bool is_at_pi, double g);

#endif
