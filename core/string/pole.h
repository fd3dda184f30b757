/**
   One mass on a spring and a damper, stepped by symplectic Euler.

   The oscillator x'' + γ x' + ω0² x = 0, with γ = Z/m [1/s] and ω0² = k/m [rad²/s²], is stepped
   with h = 1/rate [s], velocity first and position with the new velocity ([MQ09] (5)).  All that
   matters of it are two numbers,

       a = (ω0 h)²,   g = γ h,   both dimensionless,

   because its poles solve  z² + (a + g − 2) z + (1 − g) = 0  ([MQ09] (23)).

   [MQ09] is D. Morgan and S. Qiao, "Analysis of Damped Mass-Spring Systems for Sound Synthesis",
   2009.  The equations are given here in the corrected form; doc/physics.md lists what was
   corrected.

   Thread: any.  All of this room is real-time safe and allocates nothing.
*/
#ifndef HOOKE_CORE_STRING_POLE_H
#define HOOKE_CORE_STRING_POLE_H

#include "core/base/status.h"

#include <stdbool.h>

/** A mass under symplectic Euler; zero is a free mass at rest. */
typedef struct {
  double a; /**< (ω0 h)², dimensionless */
  double g; /**< γ h, dimensionless */
} Pole;

/** What is heard of a mass. */
typedef struct {
  double f0_hz; /**< Frequency [Hz]; 0 where it does not vibrate */
  double tau_s; /**< Time in which it dies to 1/e [s]; INFINITY: never; negative: it grows */
} Tone;

/** What the two poles are; X(name, text). */
#define POLE_REGION_LIST(X)                                                                        \
  X(COMPLEX, "vibrates")                                                                           \
  X(REAL_AT_ZERO, "creeps")                                                                        \
  X(REAL_AT_PI, "flips")                                                                           \
  X(UNSTABLE, "grows")

#define POLE_REGION_ENUM(name, text) POLE_##name,
typedef enum { POLE_REGION_LIST(POLE_REGION_ENUM) POLE_REGION_COUNT } PoleRegion;
#undef POLE_REGION_ENUM

/** The mass with natural frequency `omega0` [rad/s, ≥ 0] and damping `gamma` [1/s] at `rate_hz`
 * [Hz, > 0]. */
Pole pole_from_analog(double rate_hz, double omega0, double gamma);

/**
   Find the mass that sounds as `tone` once it is stepped.

   The scheme plays sharp and dies a little differently, so ask for the one whose warped pitch and
   decay are those wanted:  g = 1 − exp(−2h/τ),  a = 2 − g − 2 exp(−h/τ) cos(2πFh).   [MQ09] (30),
   (45), Algorithm 2.

   @param rate_hz    Steps per second [Hz], > 0
   @param tone       0 < F < rate/2 [Hz]; τ > 0 [s], INFINITY for no damping
   @param[out] pole  Untouched on failure
   @return STATUS_OK or STATUS_BAD_ARGUMENT.  Every tone in range has a stable mass.
*/
Status pole_solve(double rate_hz, Tone tone, Pole* pole);

/** Where the pole of larger modulus lies: its angle [rad per sample], 0 to π; [MQ09] (30), right
 * past π/2. */
double pole_angle(Pole pole);

/** The larger modulus of the two poles; √(1 − g) where they are complex ([MQ09] (29)). */
double pole_radius(Pole pole);

/** The frequency and decay that are heard; [MQ09] (30), (40).  `rate_hz` [Hz, > 0]. */
Tone pole_tone(double rate_hz, Pole pole);

/** Whether the two poles are a conjugate pair: a² + (2g − 4) a + g² < 0  ([MQ09] (27)). */
bool pole_is_complex(Pole pole);

/** Whether the mass stays bounded: a ≥ 0, 0 ≤ g < 2 and a + 2g ≤ 4  ([MQ09] (33)).  NaN is not
 * stable. */
bool pole_is_stable(Pole pole);

/** Which of the four kinds of motion the mass makes; [MQ09] (27), (33), (34). */
PoleRegion pole_region(Pole pole);

/** A region in a word; never NULL. */
const char* pole_region_text(PoleRegion region);

/**
   The largest stable time step [s] of a mass with `omega0` [rad/s, > 0] and `gamma` [1/s, ≥ 0]:
   h = (−γ + √(γ² + 4 ω0²)) / ω0²,  which is (33) solved for h; the paper's conclusion has the signs
   otherwise.
*/
double pole_largest_step_s(double omega0, double gamma);

/** The mass whose analog eigenvalues are σ ± jμ [1/s, rad/s]:  a = (σ² + μ²) h²,  g = −2σh;
 * `rate_hz` [Hz, > 0]. */
Pole pole_from_eigenvalue(double rate_hz, double sigma, double mu);

/*
   The plane of analog eigenvalues ([MQ09] sections 3.5 to 3.8), in units of the time step: σh, 0 or
   less, to the left and μh, 0 or more, upwards.  Its regions are those of pole_region() of
   pole_from_eigenvalue(1, σh, μh).  An eigenvalue which moves left from the axis at a constant μh
   crosses three edges, whose σh is given; NaN where there is none, or μh < 0.
*/

/**
   The edge of vibrating: to the right of it the poles are a conjugate pair ([MQ09] (27), (38)).

   With u³ (4 − u) = 4 (μh)², 0 ≤ u ≤ 2, it is at  σh = u (u − 2)/2.  The poles become real at 0
   below the singular point and real at π above it; from μh = 2 up there is no such pair.
*/
double pole_edge_vibrating(double mu_h);

/**
   The edge of turning, where the poles' sum is 0:  σh = 1 − √(3 − (μh)²)  ([MQ09] (34), (39)).
   Below the singular point real poles begin to flip here; above it a pair turns past π/2.
*/
double pole_edge_turning(double mu_h);

/** The edge of stability, a + 2g = 4:  σh = 2 − √(8 − (μh)²), where that is 0 or less ([MQ09] (33),
 * (36)). */
double pole_edge_stable(double mu_h);

/** Where the first two edges meet and both poles are 0: γh = 1, μh = √3/2. */
#define POLE_SINGULAR_SIGMA_H (-0.5)
#define POLE_SINGULAR_MU_H 0.86602540378443864676

/**
   The line of one digital frequency ([MQ09] Figure 16): the μh at `sigma_h` for which a pair of
   poles has the angle ω_d h.  (μh)² = 2 − g − 2√(1 − g) cos(ω_d h) − (σh)².

   @param sigma_h  −1/2 < σh ≤ 0
   @param angle    ω_d h, 0 to π
   @return μh ≥ 0; NaN where an argument is out of its range
*/
double pole_line_of_frequency(double sigma_h, double angle);

/**
   The line of one digital damping ([MQ09] Figure 17) where poles are a pair: it is vertical, at
   σh = −(1 − r²)/2, whatever μh, between two real branches.

   @param radius  r = exp(σ_d h), 0 < r ≤ 1
   @return σh; NaN out of that range
*/
double pole_line_of_damping(double radius);

/**
   The same line where poles are real: the μh at `sigma_h` for which the larger pole is r, or −r.

   @param is_at_pi  Whether it is −r
   @return μh ≥ 0; NaN where the branch does not pass
*/
double pole_branch_of_damping(double sigma_h, double radius, bool is_at_pi);

#endif
