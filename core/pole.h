/**
   One mass on a spring and a damper, stepped by symplectic Euler.

   The oscillator x'' + γ x' + ω0² x = 0, with γ = Z/m [1/s] and ω0² = k/m [rad²/s²], is stepped
   with h = 1/rate [s], velocity first and position with the new velocity ([MQ09] (5)).  All that
   matters of it are two numbers,

       a = (ω0 h)²,   g = γ h,   both dimensionless,

   because its poles solve  z² + (a + g − 2) z + (1 − g) = 0  ([MQ09] (23)).

   [MQ09] is D. Morgan and S. Qiao, "Analysis of Damped Mass-Spring Systems for Sound Synthesis",
   2009.  The equations are given here in the corrected form; the README lists what was corrected.

   Thread: any.  All of this room is real-time safe and allocates nothing.
*/
#ifndef HOOKE_CORE_POLE_H
#define HOOKE_CORE_POLE_H

#include "core/status.h"

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

#endif
