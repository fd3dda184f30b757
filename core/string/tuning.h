/**
   The uniform string, from the sound that is wanted to its coefficients, in closed form.

   N masses hang in a row between two fixed, hinged ends.  With L = tridiag(−1, 2, −1) and the state
   scaled by the time step, u = h v, one step of symplectic Euler is

       u ← u − (k1 L + k2 L² + k3 L³) x − (z0 I + z1 L) u ;   x ← x + u.

   The sine basis makes all of it diagonal.  With λ_k = 4 sin²(kπ / (2(N + 1))), mode k is one mass
   (core/string/pole.h) with

       a_k = k1 λ_k + k2 λ_k² + k3 λ_k³,   g_k = z0 + z1 λ_k,

   so Algorithm 1 of [MQ09] has a closed form, and the string is stable iff a_k > 0 and a_k + 2 g_k
   ≤ 4 in every mode.

   Partials.  Masses in a row are flat in their upper modes.  What an ideal or stiff string wants of
   its k-th, φ = kπ/(N + 1), is the angle ψ a step with

       ψ² = c² φ² (1 + β φ²),   c² = (2F(N + 1)/rate)² / (1 + B),   β = B ((N + 1)/π)²,

   c being the Courant number of the string without its bending.  That is a = 4 sin²(ψ/2), which in
   terms of λ = 4 sin²(φ/2) is the series

       a = c² (λ + b λ² + d λ³ + …),
       b = β + (1 − c²)/12,   d = (1 − c²) ((4 − c²)/360 + β/6).

   So few masses ring as true as many, with terms in L² and L³ that only a stiff bar would have.
   From c = 1 on there is nothing to mend: the chain holds all that is below Nyquist.

   Thread: any.  All of this room is real-time safe, allocates nothing, and takes a bounded time.
*/
#ifndef HOOKE_CORE_STRING_TUNING_H
#define HOOKE_CORE_STRING_TUNING_H

#include "core/base/status.h"
#include "core/string/pole.h"

#include <stdint.h>

/**
   The part of the stability limit that is left unused, so that no partial is above 0.91 of half the
   rate.  A mode nearer to the limit beats with half the rate more slowly than a player's gesture,
   and no bent clock (core/string/chain.h) keeps a gesture from feeding it: at a thousandth it can
   grow by e in a hundredth of a second, with what is left here in some twentieths at the very
   worst.
*/
#define TUNING_MARGIN 0.02

/** The same of a note so high that one mass is all it can have; its clock is bent exactly. */
#define TUNING_LAST_MARGIN 1e-4

/** How true the partials are to the ideal or stiff string's; each is solved with its b and d. */
typedef enum {
  PARTIALS_LUMPED, /**< b = β, d = 0: those of the chain itself, as in [MQ09] */
  PARTIALS_TRUE,   /**< b of the series, d = 0 */
  PARTIALS_TRUEST  /**< b and d of the series */
} Partials;

/** The string that is wanted. */
typedef struct {
  double rate_hz; /**< Steps per second [Hz], > 0 */
  Tone tone;      /**< Of the fundamental: 0 < F < rate/2 [Hz], τ > 0 [s] */
  double loss;    /**< Share s of the fundamental's damping that sits between masses, 0 to 1 */
  double inharmonicity; /**< B ≥ 0 of f_k = k f1 √((1 + B k²)/(1 + B)); 0 is a perfectly flexible
                            string */
  Partials partials;
} TuningTarget;

/** The string that has it; all dimensionless. */
typedef struct {
  double k1; /**< Springs between neighbours, (h² k/m) */
  double k2; /**< Bending stiffness */
  double z0; /**< Dampers to ground, (h Z/m) */
  double z1; /**< Dampers between neighbours */
  double k3; /**< What straightens the upper partials */
} StringCoefs;

/**
   The target with more damping, of which the share `loss` sits between the masses: what was there
   stays as it was.  With g = 1 − exp(−2/(rate τ)) before and g' after,

       s' = (s g + loss (g' − g)) / g'.

   @param tau_s  Of the fundamental [s], 0 < tau_s ≤ the target's
*/
TuningTarget tuning_damped(TuningTarget target, double tau_s, double loss);

/** λ_k = 4 sin²(kπ / (2(N + 1))), the k-th eigenvalue of L; 1 ≤ k ≤ n_masses. */
double tuning_lambda(uint32_t n_masses, uint32_t k);

/** Mode `k` (1 ≤ k ≤ n_masses) of a string, as one mass. */
Pole tuning_mode(StringCoefs coefs, uint32_t n_masses, uint32_t k);

/**
   Solve for the string of `n_masses` whose fundamental is exactly `target->tone`:

       g1, a1 by pole_solve();  z0 = g1 (1 − s),  z1 = g1 s / λ1,
       k1 = a1 / (λ1 (1 + b λ1 + d λ1²)),  k2 = b k1,  k3 = d k1,

   with the b and d of target->partials, in which 1 − c² counts as 0 where it is negative.

   It may be unstable in its upper modes: see tuning_headroom().

   @param[out] coefs  Untouched on failure
   @return STATUS_OK or STATUS_BAD_ARGUMENT (n_masses of 0, anything out of range or not a number)
*/
Status tuning_solve(const TuningTarget* target, uint32_t n_masses, StringCoefs* coefs);

/**
   The smallest of 1 − (a_k + 2 g_k)/4 over the modes; −INFINITY where k2 or k3 is so negative that
   a mode is not pulled back.  The string is stable iff this is not negative.  Where k2 or k3 is
   negative it may come out lower than the truth, never higher: it is that of the whole interval
   0 < λ ≤ λ_N.  k1 > 0 and z1 ≥ 0 are taken for granted.
*/
double tuning_headroom(StringCoefs coefs, uint32_t n_masses);

/**
   The largest number of masses, at most `limit`, whose string for `target` keeps its margin of
   headroom: TUNING_MARGIN, or TUNING_LAST_MARGIN of one mass.

   @return 0 if not even one mass does (F at or above Nyquist, or within 0.7 % below it) or the
   target is out of range
*/
uint32_t tuning_max_masses(const TuningTarget* target, uint32_t limit);

/**
   Solve as tuning_solve(), but for a string that must keep its `n_masses`: pitch and decay stay
   exact, and where the string would have less than its margin of headroom, first stiffness gives
   way and with it what keeps the partials true (in a straight line to k3 = 0 and a slightly
   negative bending, which flattens the upper ones), then loss, then bending again.

   @param[out] coefs  Untouched on failure
   @return STATUS_OK; STATUS_BAD_ARGUMENT as tuning_solve(); STATUS_UNSTABLE if nothing that may
   give way suffices, which takes a pitch about an octave above the one that n_masses can hold, and
   the same one for all partials
*/
Status tuning_fit(const TuningTarget* target, uint32_t n_masses, StringCoefs* coefs);

#endif
