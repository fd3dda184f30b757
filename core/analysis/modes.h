/**
   The modes of a network: what it will sound like, and whether it will be stable.

   With M = diag(m) [kg], the stiffness K [N/m] and the damping Z [kg/s] over its n masses, the
   network moves as  M x'' + Z x' + K x = 0,  with the 2n analog eigenvalues s of

       A = [0 I; −M⁻¹K −M⁻¹Z],   s² M + s Z + K singular.                          [MQ09] (43)

   Stepped by symplectic Euler with h = 1/rate, its poles z are the eigenvalues of the step matrix,
   and  (z − 1)² M + h (z − 1) Z + h² z K  is singular.  With z = 1 + h w this reads

       w² M + w (Z + h K) + K  singular:

   the poles are exactly the analog eigenvalues w of a network with dampers h K the stronger.  Where
   Z = α M + β K, proportional damping, each mode is one mass (core/string/pole.h) with a = h² ω_k²,
   g = h c_k, and mapping s to z eigenvalue by eigenvalue, as [MQ09] section 4.2 does, is exact.
   Elsewhere it is not, and may call stable what explodes: paper_… say what it gives.

   The verdict needs no eigenvalue that is not real.  For the vector y of a pole, the scheme is one
   mass with a = h² y*Ky / y*My and g = h y*Zy / y*My, so |z| ≤ 1 if a + 2g ≤ 4; and if
   P(−1) = 4M − 2h Z − h² K has a negative direction, then P(z) = (z − 1)² M + h (z − 1) Z + h² z K,
   which is positive as z → −∞, is singular at some real z < −1.  So

       the network is stable  iff  4M − 2h Z − h² K  has no negative eigenvalue,

   which generalises (33), a + 2g ≤ 4, and the largest stable step is where it becomes singular.

   A part that hangs on no ground has a mode of 0 Hz, whose slower eigenvalue is 0: it drifts, at a
   speed that stays if its other eigenvalue is 0 too, and dies by dampers otherwise.

   Thread: any.  Allocates; calls LAPACK; is not real-time safe.
*/
#ifndef HOOKE_CORE_ANALYSIS_MODES_H
#define HOOKE_CORE_ANALYSIS_MODES_H

#include "core/analysis/modes_watch.h"
#include "core/analysis/network.h"
#include "core/base/status.h"
#include "core/string/pole.h"

#include <complex.h>
#include <stdbool.h>
#include <stdint.h>

/** One mode: two eigenvalues and two poles. */
typedef struct {
  /** s [1/s]: a conjugate pair, σ + jμ (μ > 0) first; or two real ones, the slower first */
  double complex analog[2];
  /** z of the scheme: a conjugate pair, the upper first; or two real ones, the larger |z| first */
  double complex pole[2];
  Tone tone;         /**< As it is heard, from pole[0]: F [Hz], 0 where z > 0 is real; τ [s], of a
                          free one that of its speed */
  double warp_cents; /**< F against Im s/2π [cents]; NaN where either does not vibrate */
  double radius;     /**< |pole[0]|, which is 1 or less where stable */
  double paper_radius; /**< The same, had from analog[] by the one-mass map ([MQ09] section 4.2) */
  PoleRegion region;   /**< Which motion the two poles make */
  bool is_free;        /**< Whether it hangs on no ground: analog[0] and a pole's z − 1 are 0 */
} Mode;

/** The modes of a network, in order of |s|, their natural frequency; of a pair of real eigenvalues
 * this is the mean √(s1 s2). */
typedef struct {
  double rate_hz;
  uint32_t n_modes;
  bool is_complete;      /**< Whether these are all of them, and not the lowest only */
  bool is_proportional;  /**< Whether Z = α M + β K to rounding */
  bool is_stable;        /**< The verdict, of all modes even where not all are listed */
  bool paper_is_stable;  /**< The paper's: whether no listed paper_radius is above 1, but for
                              rounding */
  double radius;         /**< The largest of the modes listed */
  double paper_radius;   /**< The largest of the modes listed */
  double largest_step_s; /**< The largest stable time step [s] */
  Mode mode[];           /**< n_modes */
} Modes;

/**
   Find the modes of a checked network.

   Proportional damping, or none, is solved by a symmetric solver, and any other by dgeev, of all
   masses or, where few modes are wanted, of a subspace.

   @param rate_hz     Steps per second [Hz], > 0 and finite
   @param n_wanted    How many, the lowest; 0: all.  Where few are wanted the time grows with those
                      and the number of masses, unless unequal dampers leave one so low overdamped;
                      for all it grows with the cube of the masses
   @param[out] modes  To be given to modes_free(); untouched on failure
   @return STATUS_OK; STATUS_BAD_ARGUMENT (the rate, or the network is not checked);
   STATUS_ILL_SCALED where rounding could have moved a mode by a thousandth of itself;
   STATUS_NO_CONVERGENCE; STATUS_NO_MEMORY
*/
Status modes_solve(const Network* network, double rate_hz, uint32_t n_wanted, Modes** modes);

/** Free what modes_solve() gave; NULL is fine. */
void modes_free(Modes* modes);

/**
   Find the largest time step with which a checked network is stable: the least positive root of
   det(4M − 2h Z − h² K).  Exact to a few roundings, however the network is scaled and damped.

   @param watch        Told of what is done; NULL: nobody
   @param[out] step_s  [s]; INFINITY where nothing is linked to anything; untouched on failure
   @return STATUS_OK; STATUS_BAD_ARGUMENT (not checked); STATUS_ILL_SCALED (k/m or Z/m is no
   number); STATUS_NO_MEMORY
*/
Status modes_largest_step(const Network* network, const ModesWatch* watch, double* step_s);

#endif
